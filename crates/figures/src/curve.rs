//! The picture of a curve of a machine; [`holding`], that of what it holds at rest.

pub mod holding;

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{MachineCourse, MachineCurve, MachineLine, machine_figure};
use stickslip_results::provenance::{HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_results::{Job, Real, quantity};
use stickslip_study::curve::{Curve, Motion, Point, Traced};

/// Name of the picture, and of that of a curve that was interrupted, beside which a finished one stays.
const NAMES: [&str; 2] = ["curve", "curve-partial"];

/// Names of all files that any look gives to it, and that go where it is written: a whole curve takes the place of both.
pub fn all_files(is_cut: bool) -> Vec<String> {
    Look::all_files_of(&NAMES[usize::from(is_cut)..])
}

/// Draws it: speeds, steps or powers over what is varied, with the points that have no motion.
///
/// # Errors
/// What cannot be drawn.
pub fn draw(
    (curve, traced): (&Curve, &Traced),
    logarithmic: bool,
    look: &Look,
) -> Result<Vec<Picture>, FigureError> {
    let values: Vec<f64> = traced.points.iter().map(|point| point.value).collect();
    let name = match (curve.kind.is_of_load(), traced.direction < 0.0) {
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
        landmarks: landmarks(curve, traced),
        courses: courses(curve, traced),
        faults: faults(traced),
    };
    let done = (traced.done(), traced.points.len());
    drawn((&curve.job, curve.kind.name()), (done, traced.is_cut()), &machine, look)
}

/// A figure with what it comes from. Of points so many are done, of all; one that was interrupted says so in its title.
fn drawn(
    (job, curve): (&Job, &str),
    ((done, all), is_cut): ((usize, usize), bool),
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
    let (plot, mut title) = (NAMES[usize::from(is_cut)], job.title().to_owned());
    if is_cut {
        title.push_str(&format!(" (interrupted: {done} of {all} points)"));
    }
    let figure = machine_figure(&title, machine);
    pen.draw_as(plot, figure).map_err(|source| FigureError::Plot { plot, source })
}

/// What the curve is of, and what it is as well.
fn courses(curve: &Curve, traced: &Traced) -> Vec<MachineCourse<'static>> {
    let of = |figure: &dyn Fn(&Motion, f64) -> f64| -> Vec<f64> {
        let known = traced.points.iter().map(|point| {
            let motion = point.motion.as_ref().ok()?;
            Some(figure(motion, point.value))
        });
        known.map(|figure| figure.unwrap_or(f64::NAN)).collect()
    };
    let course = |name, unit, values, spreads| {
        let lines = vec![MachineLine { name: "", values, spreads }];
        MachineCourse { name, unit, lines }
    };
    let step = || course("step", "m", of(&|motion, _| motion.step), of(&|motion, _| motion.spread));
    let speed = || {
        let spreads = of(&|motion, _| motion.spread / motion.period);
        course("mean speed", "m/s", of(&|motion, _| motion.speed()), spreads)
    };
    let power = || {
        let values = of(&|motion, load| traced.direction * load * motion.speed());
        course("power", "W", values, of(&|motion, load| load.abs() * motion.spread / motion.period))
    };
    match (curve.kind.is_of_speed(), curve.kind.is_of_load()) {
        (true, true) => vec![speed(), power()],
        (true, false) => vec![speed(), step()],
        (false, _) => vec![step()],
    }
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
        Some((format!("{}: {place}", landmark.words()), at))
    });
    found.collect()
}

/// Values without a motion, by the kind of reason.
fn faults(traced: &Traced) -> Vec<(&'static str, Vec<f64>)> {
    let kind = |point: &Point| Some((point.value, point.motion.as_ref().err()?.kind()));
    lanes(traced.points.iter().filter_map(kind))
}

/// Values by the kind of reason.
fn lanes(reasons: impl Iterator<Item = (f64, &'static str)>) -> Vec<(&'static str, Vec<f64>)> {
    let mut lanes: Vec<(&'static str, Vec<f64>)> = Vec::new();
    for (value, reason) in reasons {
        match lanes.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, at)) => at.push(value),
            None => lanes.push((reason, vec![value])),
        }
    }
    lanes
}
