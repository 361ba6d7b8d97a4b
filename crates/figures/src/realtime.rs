//! Pictures of a loop in real time.

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_drive::Scene;
use stickslip_drive::scene::{Coordinate, Freedom};
use stickslip_plot::{
    Figure, MarkedTimes, TimelinePanel, TimesCurve, TimesPanel, timeline_figure, times_figure,
};
use stickslip_realtime::plant::{WORK, Work};
use stickslip_realtime::session::Ended;
use stickslip_realtime::worst::Worst;
use stickslip_realtime::{Histogram, Report};
use stickslip_results::Job;
use stickslip_results::provenance::{HASH, PROGRAM, SCENARIO, TITLE};

/// Names of the pictures.
pub const NAMES: [&str; 2] = ["realtime", "timeline"];
/// Bins of a decade.
const BINS: u32 = 10;
/// Most panels of a timeline, times apart.
const MOST: usize = 6;
/// Units by the ends of names, the longer first.
const UNITS: [(&str, &str); 7] = [
    ("_rad_s", "rad/s"),
    ("_m_s", "m/s"),
    ("_rad", "rad"),
    ("_m", "m"),
    ("_N", "N"),
    ("_J", "J"),
    ("_s", "s"),
];

/// Names of all files that any look gives to them.
pub fn all_files() -> Vec<String> {
    Look::all_files_of(&NAMES)
}

/// Draws them.
///
/// # Errors
/// What cannot be drawn.
pub fn draw(job: &Job, report: &Report, ended: &Ended, look: &Look) -> Result<Vec<Picture>, FigureError> {
    let entries = [
        (TITLE, job.title().to_owned()),
        (PROGRAM, job.program.clone()),
        (HASH, job.hash.clone()),
        (SCENARIO, job.resolved.clone()),
    ];
    let provenance = entries.map(|(key, text)| (key.to_owned(), text)).to_vec();
    let pen = Pen { look, provenance };
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

/// Execution time and, where there was a clock, wake-up latency; each beside that of the empty loop.
fn times_panels<'a>(report: &Report, ended: &Ended) -> Vec<TimesPanel<'a>> {
    let (timing, floor) = (&ended.timing, &ended.floor);
    let panel = |what, [own, empty]: [&Histogram; 2], marked| {
        let mut curves = vec![curve("the drive's loop", false, own)];
        if empty.total() > 0 {
            curves.push(curve("empty loop", true, empty));
        }
        TimesPanel { heading: String::new(), what, curves, marked }
    };
    let mut panels = vec![panel(
        "execution time",
        [&timing.execution, &floor.execution],
        marked(&timing.slowest, |slow| slow.execution),
    )];
    if report.paced {
        let marked = marked(&timing.latest, |slow| slow.latency);
        // What a drive did in a frame has nothing to do with when its loop woke.
        let times = marked.into_iter().flat_map(|marked| marked.times).collect();
        let marked = vec![MarkedTimes { name: "latest frames", times, on: 0 }];
        panels.push(panel("wake-up latency", [&timing.latency, &floor.latency], marked));
    }
    panels
}

fn curve<'a>(name: &'a str, is_beside: bool, histogram: &Histogram) -> TimesCurve<'a> {
    let bins = histogram.decades(BINS).into_iter().map(|(low, high, count)| (1e-9 * low, 1e-9 * high, count));
    TimesCurve { name, is_beside, bins: bins.collect() }
}

/// The worst frames by what happened in them: the last thing counted that did.
fn marked<'a>(worst: &Worst, time: fn(&stickslip_realtime::worst::Slow) -> u64) -> Vec<MarkedTimes<'a>> {
    const KINDS: [&str; 4] =
        ["slowest: detours", "slowest: rejected steps", "slowest: events", "slowest: plain steps"];
    let kind = |work: &Work| {
        let has =
            |name: &str| WORK.iter().position(|known| *known == name).is_some_and(|place| work[place] > 0);
        ["detours", "rejected", "events"].iter().position(|name| has(name)).unwrap_or(KINDS.len() - 1)
    };
    let of = |place: usize| {
        let frames = worst.frames().iter().filter(|slow| kind(&slow.work) == place);
        let times = frames.map(|slow| 1e-9 * time(slow) as f64).collect();
        MarkedTimes { name: KINDS[place], times, on: 0 }
    };
    (0..KINDS.len()).map(of).filter(|marked| !marked.times.is_empty()).collect()
}

/// A quantity, and the names and values of its channels.
type Group<'a> = (&'a str, Vec<(&'a str, &'a [f64])>);

/// Channels of one quantity share a panel; the times of frames come last.
fn timeline<T>(job: &Job, report: &Report, ended: &Ended, draw: impl FnOnce(&[TimelinePanel<'_>]) -> T) -> T {
    let film = &ended.film;
    let series = |names: &[String], values: &[Vec<f64>]| -> Vec<(String, Vec<f64>)> {
        names.iter().cloned().zip(values.iter().cloned()).collect()
    };
    let mut all = series(&report.outputs, &film.outputs);
    all.extend(series(&report.inputs, &film.inputs));
    // Time over time says nothing, and neither does an input that never changes.
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
    panels.push(TimelinePanel { label: "time of a frame", unit: "s", logarithmic: true, series });
    draw(&panels)
}

/// Whether a body is where the generator of this channel says.
fn moves(scene: &Scene, channel: &str) -> bool {
    let is_it = |coordinate: &Coordinate| match coordinate.freedom {
        Freedom::Follows(place) => scene.waveforms.get(place).is_some_and(|waveform| {
            channel.rsplit_once('.').is_some_and(|(owner, _)| owner == waveform.name)
        }),
        _ => false,
    };
    scene.bodies.iter().any(|body| is_it(&body.part.x) || is_it(&body.part.z))
}

/// What a quantity is called, and its unit.
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
