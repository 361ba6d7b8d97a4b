//! The picture of a curve of a machine; [`holding`], that of what it holds at rest.

pub mod holding;
pub mod optimum;

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{MachineCourse, MachineCurve, MachineLine, machine_figure};
use stickslip_run::provenance::{HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_run::{Job, Real, Warning, quantity};
use stickslip_study::curve::{Curve, Motion, Point, Sense, Traced, Way};

/// Name of the picture, and of that of a curve that was interrupted, beside which a finished one stays.
const NAMES: [&str; 2] = ["curve", "curve-partial"];

/// Names of all files that any look gives to it, and that go where it is written: a whole curve takes the place of both.
pub fn all_files(is_cut: bool) -> Vec<String> {
    Look::all_files_of(&NAMES[usize::from(is_cut)..])
}

/// Draws it: speeds, steps or powers over what is varied, with the points that have no motion; of both senses, where both are asked
/// for, at the same values.
///
/// # Errors
/// What cannot be drawn.
pub fn draw(ways: &[Way<'_>], logarithmic: bool, look: &Look) -> Result<Vec<Picture>, FigureError> {
    let Some((curve, traced)) = ways.first().copied() else { return Ok(Vec::new()) };
    let values: Vec<f64> = traced.points.iter().map(|point| point.value).collect();
    let name = match (curve.kind.is_of_load(), traced.direction < 0.0) {
        (true, _) if ways.len() > 1 => "load against the steps",
        (true, true) => "load along +x, against the steps",
        (true, false) => "load along \u{2212}x, against the steps",
        (false, _) => &curve.variation.name,
    };
    let machine = MachineCurve {
        axis: (name, curve.variation.unit),
        logarithmic,
        values: &values,
        // No load besides those it has is where every curve over loads begins.
        present: curve.variation.present.filter(|_| !curve.kind.is_of_load()),
        landmarks: ways.iter().flat_map(|(curve, traced)| landmarks(curve, traced)).collect(),
        courses: courses(ways),
        faults: faults(ways),
    };
    let done = ways.iter().map(|(_, traced)| traced.done()).sum();
    let all = ways.iter().map(|(_, traced)| traced.points.len()).sum();
    let is_cut = ways.iter().any(|(_, traced)| traced.is_cut());
    drawn((&curve.job, curve.kind.name()), ((done, all), is_cut), &machine, look)
}

/// A figure with what it comes from. Of points so many are done, of all; one that was interrupted says so in its title.
fn drawn(
    (job, curve): (&Job, &str),
    ((done, all), is_cut): ((usize, usize), bool),
    machine: &MachineCurve<'_>,
    look: &Look,
) -> Result<Vec<Picture>, FigureError> {
    let (plot, mut title) = (NAMES[usize::from(is_cut)], job.title().to_owned());
    if is_cut {
        title.push_str(&format!(" (interrupted: {done} of {all} points)"));
    }
    pictured((job, curve), (plot, &title), machine, look)
}

/// A figure of this name and title with what it comes from.
fn pictured(
    (job, curve): (&Job, &str),
    (plot, title): (&'static str, &str),
    machine: &MachineCurve<'_>,
    look: &Look,
) -> Result<Vec<Picture>, FigureError> {
    let entries = [
        (TITLE, job.title().to_owned()),
        (PROGRAM, job.program.clone()),
        ("Curve", curve.to_owned()),
        (HASH, job.hash.clone()),
        (SCENARIO, job.resolved.clone()),
    ];
    let provenance = entries.map(|(key, text)| (key.to_owned(), text)).to_vec();
    let pen = Pen { look, provenance, kept: None };
    pen.draw_as(plot, machine_figure(title, machine)).map_err(|source| FigureError::Plot { plot, source })
}

/// What the curve is of, and what it is as well.
fn courses(ways: &[Way<'_>]) -> Vec<MachineCourse<'static>> {
    let Some((curve, _)) = ways.first() else { return Vec::new() };
    let course = |name, unit, line: fn(Way<'_>) -> MachineLine<'static>| {
        let lines = ways.iter().map(|way| line(*way)).collect();
        MachineCourse { name, unit, lines }
    };
    let step = || course("step", "m", |way| line(way, &|motion, _| motion.step, &|motion, _| motion.spread));
    let speed = || {
        course("mean speed", "m/s", |way| {
            line(way, &|motion, _| motion.speed(), &|motion, _| motion.spread / motion.period)
        })
    };
    let power = || {
        course("power", "W", |way| {
            let against = way.1.direction;
            let spread = |motion: &Motion, load: f64| load.abs() * motion.spread / motion.period;
            line(way, &|motion, load| motion.power(against * load), &spread)
        })
    };
    match (curve.kind.is_of_speed(), curve.kind.is_of_load()) {
        (true, true) => vec![speed(), power()],
        (true, false) => vec![speed(), step()],
        (false, _) => vec![step()],
    }
}

/// What a motion makes of a value that is varied.
type Told<'a> = &'a dyn Fn(&Motion, f64) -> f64;

/// A figure of all points, and how far it swings.
fn line((curve, traced): Way<'_>, figure: Told<'_>, spread: Told<'_>) -> MachineLine<'static> {
    let of = |figure: Told<'_>| -> Vec<f64> {
        let known = traced.points.iter().map(|point| {
            let motion = point.motion.as_ref().ok()?;
            Some(figure(motion, point.value))
        });
        known.map(|figure| figure.unwrap_or(f64::NAN)).collect()
    };
    MachineLine { name: curve.sense.map_or("", Sense::name), values: of(figure), spreads: of(spread) }
}

/// Places with a name that were found, with it and where they are.
fn landmarks(curve: &Curve, traced: &Traced) -> Vec<(String, f64)> {
    let found = traced.landmarks.iter().filter_map(|landmark| {
        let at = *landmark.at.as_ref().ok()?;
        // A prefix belongs to a unit.
        let place = match curve.variation.unit {
            "" => format!("{at:.4}"),
            unit => quantity(Real(at), unit),
        };
        let sense = curve.sense.map_or(String::new(), |sense| format!(" {}", sense.name()));
        let value = landmark
            .value
            .map_or(String::new(), |value| format!("{} at ", quantity(Real(value), landmark.unit())));
        Some((format!("{}{sense}: {value}{place}", landmark.words()), at))
    });
    found.collect()
}

/// Values without a motion, by the kind of reason, and those that are warned of; of both senses by that of either.
fn faults(ways: &[Way<'_>]) -> Vec<(String, Vec<f64>)> {
    let points = || ways.iter().flat_map(|(_, traced)| &traced.points);
    let kind = |point: &Point| Some((point.value, point.motion.as_ref().err()?.kind().to_owned()));
    let warned = points().map(|point| (point.value, point.warnings.as_slice()));
    lanes(points().filter_map(kind).chain(warnings(warned)))
}

/// The kinds that points are warned of, and what each lane of a picture says of them.
fn warnings<'a>(points: impl Iterator<Item = (f64, &'a [Warning])>) -> impl Iterator<Item = (f64, String)> {
    points.flat_map(|(at, warnings)| {
        warnings.iter().map(move |warning| (at, format!("warning: {}", warning.kind)))
    })
}

/// Values by the kind of reason.
fn lanes(reasons: impl Iterator<Item = (f64, String)>) -> Vec<(String, Vec<f64>)> {
    let mut lanes: Vec<(String, Vec<f64>)> = Vec::new();
    for (value, reason) in reasons {
        match lanes.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, at)) if at.contains(&value) => {}
            Some((_, at)) => at.push(value),
            None => lanes.push((reason, vec![value])),
        }
    }
    lanes
}
