//! The picture of a curve of a machine.

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{MachineCourse, MachineCurve, machine_figure};
use stickslip_results::provenance::{HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_results::{Real, quantity};
use stickslip_study::curve::{Curve, Motion, Motionless, Traced};

/// Name of the picture, and of that of a curve that was interrupted, beside which a finished one stays.
const NAMES: [&str; 2] = ["curve", "curve-partial"];

/// Names of all files that any look gives to it, and that go where it is written: a whole curve takes the place of both.
pub fn all_files(traced: &Traced) -> Vec<String> {
    Look::all_files_of(&NAMES[usize::from(traced.is_cut())..])
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
    let entries = [
        (TITLE, curve.job.title().to_owned()),
        (PROGRAM, curve.job.program.clone()),
        ("Curve", curve.kind.name().to_owned()),
        (HASH, curve.job.hash.clone()),
        (SCENARIO, curve.job.resolved.clone()),
    ];
    let provenance = entries.map(|(key, text)| (key.to_owned(), text)).to_vec();
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
    let pen = Pen { look, provenance, kept: None };
    let plot = NAMES[usize::from(traced.is_cut())];
    let figure = machine_figure(&title(curve, traced), &machine);
    pen.draw_as(plot, figure).map_err(|source| FigureError::Plot { plot, source })
}

fn title(curve: &Curve, traced: &Traced) -> String {
    let title = curve.job.title();
    match (traced.done(), traced.points.len()) {
        _ if !traced.is_cut() => title.to_owned(),
        (done, all) => format!("{title} (interrupted: {done} of {all} points)"),
    }
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
    let step = || MachineCourse {
        name: "step",
        unit: "m",
        values: of(&|motion, _| motion.step),
        spreads: of(&|motion, _| motion.spread),
    };
    let speed = || MachineCourse {
        name: "mean speed",
        unit: "m/s",
        values: of(&|motion, _| motion.speed()),
        spreads: of(&|motion, _| motion.spread / motion.period),
    };
    let against = |load: f64| traced.direction * load;
    let power = || MachineCourse {
        name: "power",
        unit: "W",
        values: of(&|motion, load| against(load) * motion.speed()),
        spreads: of(&|motion, load| load.abs() * motion.spread / motion.period),
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
    let mut faults: Vec<(&'static str, Vec<f64>)> = Vec::new();
    for point in &traced.points {
        let Some(reason) = point.motion.as_ref().err().map(Motionless::kind) else { continue };
        match faults.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, at)) => at.push(point.value),
            None => faults.push((reason, vec![point.value])),
        }
    }
    faults
}
