//! Plot of frame times: a row for each scenario; panels for each stepper and, if paced, for the wake-up latency.

use super::{Findings, Loop, PICTURE, STEPPERS};
use stickslip_plot::{
    Figure, MarkedTimes, PlotError, Theme, TimesCurve, TimesPanel, draw_png, draw_svg, times_grid,
};
use stickslip_realtime::worst::{KINDS, Slow, kind};
use stickslip_realtime::{Histogram, Timing};
use stickslip_run::program::this_program;
use stickslip_run::provenance;

/// Number of the slowest frames of a loop that are marked.
const MARKED: usize = 10;
/// Draws the plot as light and dark PNG and as SVG.
pub(super) fn draw(findings: &Findings<'_>) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    let names: Vec<String> =
        findings.request.periods.iter().map(|period| format!("frames of {} µs", micro(*period))).collect();
    let mut panels = Vec::new();
    for place in 0..findings.scenes.len() {
        for stepper in 0..STEPPERS.len() {
            panels.push(execution(findings, (place, stepper), &names));
        }
        if findings.request.paced > 0.0 {
            panels.push(latency(findings, place, &names));
        }
    }
    let columns = STEPPERS.len() + usize::from(findings.request.paced > 0.0);
    let mut figure = times_grid(
        "Execution time of frames without pacing, and wake-up latency of paced frames; ten bins per decade",
        columns,
        &panels,
    );
    figure.provenance = vec![(provenance::PROGRAM.to_owned(), this_program())];
    let dark = Figure { theme: Theme::dark(), ..figure.clone() };
    Ok(vec![
        (format!("{PICTURE}.png"), draw_png(&figure)?),
        (format!("{PICTURE}-dark.png"), draw_png(&dark)?),
        (format!("{PICTURE}.svg"), draw_svg(&figure)?.into_bytes()),
    ])
}

/// Returns the panel of execution times of a stepper without pacing, for all frame lengths.
fn execution<'a>(
    findings: &'a Findings<'_>,
    (scene, stepper): (usize, usize),
    names: &'a [String],
) -> TimesPanel<'a> {
    let loops: Vec<&Loop> =
        findings.loops.iter().filter(|of| (of.scene, of.stepper) == (scene, stepper)).collect();
    let mut curves: Vec<TimesCurve<'a>> =
        loops.iter().map(|of| curve(&names[of.period], false, &of.timing.execution)).collect();
    curves.push(curve("empty loop", true, &findings.empty.execution));
    let mut marked = Vec::new();
    for (on, of) in loops.iter().enumerate() {
        let usual = of.timing.usual();
        let slowest = &of.timing.slowest.frames()[..of.timing.slowest.frames().len().min(MARKED)];
        for name in KINDS {
            let times: Vec<f64> = slowest
                .iter()
                .filter(|slow| kind(&slow.work, usual) == name)
                .map(|slow| 1e-9 * slow.execution as f64)
                .collect();
            if !times.is_empty() {
                marked.push(MarkedTimes { name, times, on });
            }
        }
    }
    let heading = format!("{}, {}", findings.scenes[scene].job.name, STEPPERS[stepper]);
    TimesPanel { heading, what: "execution time", curves, marked }
}

/// Returns the panel of wake-up latencies of the paced frames of the first stepper, for all frame lengths.
fn latency<'a>(findings: &'a Findings<'_>, scene: usize, names: &'a [String]) -> TimesPanel<'a> {
    let loops: Vec<(&Loop, &Timing)> = findings
        .loops
        .iter()
        .filter(|of| (of.scene, of.stepper) == (scene, 0))
        .filter_map(|of| Some((of, of.paced.as_ref()?)))
        .collect();
    let mut curves: Vec<TimesCurve<'a>> =
        loops.iter().map(|(of, paced)| curve(&names[of.period], false, &paced.latency)).collect();
    if let Some(floor) = findings.floors.first() {
        curves.push(curve("empty loop", true, &floor.latency));
    }
    // The wake-up latency does not depend on the work of a frame.
    let latest = |slow: &Slow| 1e-9 * slow.latency as f64;
    let marked = loops.iter().enumerate().map(|(on, (_, paced))| {
        let frames = paced.latest.frames();
        let times = frames[..frames.len().min(MARKED)].iter().map(latest).collect();
        MarkedTimes { name: "latest", times, on }
    });
    let heading = format!("{}, paced", findings.scenes[scene].job.name);
    TimesPanel { heading, what: "wake-up latency", marked: marked.collect(), curves }
}

fn curve<'a>(name: &'a str, is_beside: bool, histogram: &Histogram) -> TimesCurve<'a> {
    TimesCurve { name, is_beside, bins: histogram.tenths() }
}

/// Returns a time in µs, rounded to a nanosecond.
pub(super) fn micro(seconds: f64) -> f64 {
    (1e9 * seconds).round() / 1e3
}
