//! Plot of a performance curve; [`holding`] plots holding forces, [`optimum`] the sections through an optimum.

pub mod holding;
pub mod optimum;

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{MachineCourse, MachineCurve, MachineLine, machine_figure};
use stickslip_run::provenance::{HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_run::{Job, Real, Warning, quantity};
use stickslip_study::curve::{Curve, Motion, Point, Sense, Traced, Way};

/// Names of the plot of a complete and of an interrupted curve.
const NAMES: [&str; 2] = ["curve", "curve-partial"];

/// Returns all possible file names of the plot; existing files are deleted when the plot is written. A complete curve also replaces an
/// interrupted one.
pub fn all_files(is_cut: bool) -> Vec<String> {
    Look::all_files_of(&NAMES[usize::from(is_cut)..])
}

/// Draws a curve: mean speed, step length or power over the parameter, with the points without a steady motion. The
/// curves of both directions must have the same values of the parameter.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn draw(ways: &[Way<'_>], logarithmic: bool, look: &Look) -> Result<Vec<Picture>, FigureError> {
    let Some((curve, traced)) = ways.first().copied() else { return Ok(Vec::new()) };
    let values: Vec<f64> = traced.points.iter().map(|point| point.value).collect();
    let name = match (curve.kind.is_of_load(), traced.direction < 0.0) {
        (true, _) if ways.len() > 1 => "opposing load",
        (true, true) => "opposing load along +x",
        (true, false) => "opposing load along \u{2212}x",
        (false, _) => &curve.variation.name,
    };
    let machine = MachineCurve {
        axis: (name, curve.variation.unit),
        logarithmic,
        values: &values,
        // Curves over loads begin without additional load.
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

/// Draws a curve with its metadata. The title of an interrupted curve gives the number of points done.
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

/// Draws a curve under a name and a title, with its metadata.
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

/// Returns the results of the curve, one panel each.
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

/// Function that computes a result from a motion and the value of the parameter.
type Told<'a> = &'a dyn Fn(&Motion, f64) -> f64;

/// Returns the result and its variation at all points.
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

/// Returns the special points that were found: name with value and parameter, and the parameter.
fn landmarks(curve: &Curve, traced: &Traced) -> Vec<(String, f64)> {
    let found = traced.landmarks.iter().filter_map(|landmark| {
        let at = *landmark.at.as_ref().ok()?;
        // Prefixes require a unit.
        let place = match curve.variation.unit {
            "" => format!("{at:.4}"),
            unit => quantity(Real(at), unit),
        };
        let sense = curve.sense.map_or(String::new(), |sense| format!(" {}", sense.name()));
        let value = landmark
            .value
            .map_or(String::new(), |value| format!("{} at ", quantity(Real(value), landmark.unit())));
        Some((format!("{}{sense}: {value}{place}", landmark.words(&curve.variation.name)), at))
    });
    found.collect()
}

/// Returns the values without a motion and values with warnings, grouped by reason; for both directions together.
fn faults(ways: &[Way<'_>]) -> Vec<(String, Vec<f64>)> {
    let points = || ways.iter().flat_map(|(_, traced)| &traced.points);
    let kind = |point: &Point| Some((point.value, point.motion.as_ref().err()?.kind().to_owned()));
    let warned = points().map(|point| (point.value, point.warnings.as_slice()));
    lanes(points().filter_map(kind).chain(warnings(warned)))
}

/// Returns the values with warnings, and the text of their lane.
fn warnings<'a>(points: impl Iterator<Item = (f64, &'a [Warning])>) -> impl Iterator<Item = (f64, String)> {
    points.flat_map(|(at, warnings)| {
        warnings.iter().map(move |warning| (at, format!("warning: {}", warning.kind)))
    })
}

/// Groups values by their reason.
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
