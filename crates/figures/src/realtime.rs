//! Plots of a real-time run.

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_drive::Scene;
use stickslip_drive::scene::{Coordinate, Freedom};
use stickslip_plot::{
    Figure, MarkedTimes, TimelinePanel, TimesCurve, TimesPanel, timeline_figure, times_figure,
};
use stickslip_realtime::session::Ended;
use stickslip_realtime::worst::{KINDS, kind};
use stickslip_realtime::{Histogram, Report, Timing};
use stickslip_run::Job;
use stickslip_run::provenance::{HASH, PROGRAM, SCENARIO, TITLE};

/// Names of the plots.
pub const NAMES: [&str; 2] = ["realtime", "timeline"];
/// Maximum number of panels of a timeline, without the panel of the times per frame.
const MOST: usize = 6;
/// Units by the ends of channel names, longer ends first.
const UNITS: [(&str, &str); 7] = [
    ("_rad_s", "rad/s"),
    ("_m_s", "m/s"),
    ("_rad", "rad"),
    ("_m", "m"),
    ("_N", "N"),
    ("_J", "J"),
    ("_s", "s"),
];

/// Returns all possible file names of the plots.
pub fn all_files() -> Vec<String> {
    Look::all_files_of(&NAMES)
}

/// Draws the histograms of execution times, and the time histories of inputs and outputs.
///
/// # Errors
/// If a figure cannot be drawn.
pub fn draw(job: &Job, report: &Report, ended: &Ended, look: &Look) -> Result<Vec<Picture>, FigureError> {
    let entries = [
        (TITLE, job.title().to_owned()),
        (PROGRAM, job.program.clone()),
        (HASH, job.hash.clone()),
        (SCENARIO, job.resolved.clone()),
    ];
    let provenance = entries.map(|(key, text)| (key.to_owned(), text)).to_vec();
    let pen = Pen { look, provenance, kept: None };
    let drawn = |plot: &'static str, figure: Figure<'_>| {
        pen.draw_as(plot, figure).map_err(|source| FigureError::Plot { plot, source })
    };
    let title = format!("{}: frames of {} µs, {}", job.name, 1e6 * report.period_s, report.stepper);
    let times = times_panels(report, ended);
    let mut pictures = drawn(NAMES[0], times_figure(&title, report.period_s, &times))?;
    pictures.extend(timeline(job, report, ended, |panels| {
        drawn(NAMES[1], timeline_figure(&title, &ended.film.times, panels))
    })?);
    Ok(pictures)
}

/// Returns histograms of execution time and, in paced runs, of wake-up latency, each with the histogram of an empty loop.
fn times_panels<'a>(report: &Report, ended: &Ended) -> Vec<TimesPanel<'a>> {
    let (timing, floor) = (&ended.timing, &ended.floor);
    let panel = |what, [own, empty]: [&Histogram; 2], marked| {
        let mut curves = vec![curve("loop of the drive", false, own)];
        if empty.total() > 0 {
            curves.push(curve("empty loop", true, empty));
        }
        TimesPanel { heading: String::new(), what, curves, marked }
    };
    let mut panels = vec![panel("execution time", [&timing.execution, &floor.execution], slowest(timing))];
    if report.paced {
        // The latency does not depend on the work in a frame.
        let times = timing.latest.frames().iter().map(|slow| 1e-9 * slow.latency as f64).collect();
        let marked = vec![MarkedTimes { name: "latest frames", times, on: 0 }];
        panels.push(panel("wake-up latency", [&timing.latency, &floor.latency], marked));
    }
    panels
}

fn curve<'a>(name: &'a str, is_beside: bool, histogram: &Histogram) -> TimesCurve<'a> {
    TimesCurve { name, is_beside, bins: histogram.tenths() }
}

/// Returns the slowest frames, grouped by their kind.
fn slowest(timing: &Timing) -> Vec<MarkedTimes<'static>> {
    let usual = timing.usual();
    let of = |name: &'static str| {
        let frames = timing.slowest.frames().iter().filter(|slow| kind(&slow.work, usual) == name);
        MarkedTimes { name, times: frames.map(|slow| 1e-9 * slow.execution as f64).collect(), on: 0 }
    };
    KINDS.into_iter().map(of).filter(|marked| !marked.times.is_empty()).collect()
}

/// Quantity, and the names and values of its channels.
type Group<'a> = (&'a str, Vec<(&'a str, &'a [f64])>);

/// Returns the panels of inputs and outputs, one per quantity, and last the times per frame.
fn timeline<T>(job: &Job, report: &Report, ended: &Ended, draw: impl FnOnce(&[TimelinePanel<'_>]) -> T) -> T {
    let film = &ended.film;
    let series = |names: &[String], values: &[Vec<f64>]| -> Vec<(String, Vec<f64>)> {
        names.iter().cloned().zip(values.iter().cloned()).collect()
    };
    let mut all = series(&report.outputs, &film.outputs);
    all.extend(series(&report.inputs, &film.inputs));
    // The time channel and constant inputs are left out.
    let is_fixed = |name: &str, values: &[f64]| {
        report.inputs.iter().any(|input| input == name) && values.windows(2).all(|pair| pair[0] == pair[1])
    };
    all.retain(|(name, values)| name != "time_s" && !is_fixed(name, values));
    let mut groups: Vec<Group<'_>> = Vec::new();
    for (name, values) in &all {
        let quantity = name.rsplit_once('.').map_or(name.as_str(), |(_, quantity)| quantity);
        match groups.iter_mut().find(|(known, _)| *known == quantity) {
            Some((_, series)) => series.push((name, values)),
            None => groups.push((quantity, vec![(name, values)])),
        }
    }
    groups.truncate(MOST);
    let mut panels = Vec::new();
    for (quantity, series) in groups {
        let (label, unit) = match quantity {
            "stroke" if series.iter().all(|(name, _)| moves(&job.scenario.scene, name)) => ("stroke", "m"),
            _ => named(quantity),
        };
        panels.push(TimelinePanel { label, unit, logarithmic: false, series });
    }
    let seconds = |times: &[f64]| times.iter().map(|time| 1e-9 * time).collect::<Vec<f64>>();
    let (execution, latency) = (seconds(&film.execution), seconds(&film.latency));
    let mut series = vec![("execution time", &execution[..])];
    if report.paced {
        series.push(("wake-up latency", &latency));
    }
    panels.push(TimelinePanel { label: "time per frame", unit: "s", logarithmic: true, series });
    draw(&panels)
}

/// Returns whether a body follows the waveform of this channel.
fn moves(scene: &Scene, channel: &str) -> bool {
    let is_it = |coordinate: &Coordinate| match coordinate.freedom {
        Freedom::Follows(place) => scene.waveforms.get(place).is_some_and(|waveform| {
            channel.rsplit_once('.').is_some_and(|(owner, _)| owner == waveform.name)
        }),
        _ => false,
    };
    scene.bodies.iter().any(|body| is_it(&body.part.x) || is_it(&body.part.z))
}

/// Returns the axis label and unit of a quantity.
fn named(quantity: &str) -> (&str, &'static str) {
    let found = UNITS.iter().find_map(|(end, unit)| Some((quantity.strip_suffix(end)?, *unit)));
    match found {
        Some(("x" | "z", "m")) => ("position", "m"),
        Some(("vx" | "vz", unit)) => ("velocity", unit),
        Some(("fx" | "fn", unit)) => ("force", unit),
        Some((name, unit)) => (name, unit),
        None if quantity == "frequency" => ("frequency", "Hz"),
        None => (quantity, ""),
    }
}

#[cfg(test)]
mod tests {
    use super::slowest;
    use stickslip_realtime::pace::{self, Cycle, Pace, Stop, Timing};
    use stickslip_realtime::plant::Work;

    /// Frames of one step, some with two, with a turning point, or with a merge of memory pieces.
    struct Frames;

    impl Cycle for Frames {
        fn act(&mut self, frame: u64) -> Result<Work, Stop> {
            // Steps, rejected, evaluations, events, detours, knots, merges.
            Ok(match frame {
                3 => [2, 0, 6, 0, 0, 0, 0],
                5 | 6 => [1, 0, 3, 0, 0, 2, 0],
                9 => [1, 0, 3, 0, 0, 2, 1],
                _ => [1, 0, 3, 0, 0, 0, 0],
            })
        }
    }

    #[test]
    fn worst_frames_of_a_stepper_without_events_are_told_apart() {
        let (pace, mut timing) = (Pace { period: 1.0, overrun: None, spin: 0.0 }, Timing::new());
        pace::run(&pace, 12, &mut Frames, &mut timing).unwrap();
        let marked = slowest(&timing);
        let told: Vec<_> = marked.iter().map(|marked| (marked.name, marked.times.len())).collect();
        let known = [("merge", 1), ("turning point or growth", 2), ("corner or cut step", 1), ("plain", 8)];
        assert_eq!(told, known);
    }
}
