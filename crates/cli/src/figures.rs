//! The pictures of a run.

use crate::contact_path::ContactPath;
use crate::job::Job;
use crate::run::Outcome;
use crate::series::Series;
use crate::summary::periods;
use stickslip_drive::scene::{Freedom, Side};
use stickslip_plot::{
    Figure, HysteresisLoop, Ink, PlotError, Track, Trajectory, draw_png, loop_figure, trajectory_figure,
};
use stickslip_scenario::PlotName;

/// A picture's file and its bytes.
pub(crate) type Picture = (&'static str, Result<Vec<u8>, PlotError>);

/// A curve in the figure of loops.
struct Curve {
    name: String,
    path: ContactPath,
    gross_slip: Option<f64>,
    limit: Option<f64>,
    /// Stands behind the others.
    is_muted: bool,
}

/// Draws the pictures that the scenario asks for.
pub(crate) fn draw(job: &Job, outcome: &Outcome) -> Vec<Picture> {
    let mut names = job.scenario.plots.clone();
    names.sort_by_key(|name| *name as u8);
    names.dedup();
    let pictures = |name| match name {
        PlotName::Loop => vec![("loop.png", loops(job, outcome))],
        PlotName::Trajectory => vec![("trajectory.png", trajectory(job, outcome))],
        // Here the pictures drawn from tables on disk come in.
        PlotName::Energy | PlotName::Phase | PlotName::Events | PlotName::State | PlotName::Memory => {
            Vec::new()
        }
    };
    names.into_iter().flat_map(pictures).collect()
}

/// What a picture comes from, as its text chunks say.
fn provenance(job: &Job) -> Vec<(String, String)> {
    let (stepper, word, value) = job.stepper();
    let entries = [
        ("Title", job.title().to_owned()),
        ("Software", format!("{} {}", env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"))),
        ("Scenario SHA-256", job.hash.clone()),
        ("Stepper", stepper.to_owned()),
        (if word == "tolerance" { "Tolerance" } else { "Step/s" }, format!("{value:?}")),
    ];
    entries.map(|(key, text)| (key.to_owned(), text)).to_vec()
}

/// Force over displacement. A contact that comes back to its start in every cycle is shown all the way. One that
/// travels on, as in a drive, would smear its loops over the picture: of it the last period is shown, and behind it,
/// if it is the only contact, the first in grey; u counts from the start of the period.
fn loops(job: &Job, outcome: &Outcome) -> Result<Vec<u8>, PlotError> {
    let curves: Vec<Curve> =
        (0..job.model.contacts().count()).flat_map(|c| curves(job, outcome, c)).collect();
    let loops: Vec<HysteresisLoop<'_>> = curves
        .iter()
        .map(|curve| HysteresisLoop {
            name: &curve.name,
            u: &curve.path.u,
            force: &curve.path.force,
            gross_slip: curve.gross_slip,
            limit: curve.limit,
        })
        .collect();
    let mut figure = loop_figure(job.title(), &loops);
    let inks = inks(&curves);
    for (place, series) in figure.panels.iter_mut().flat_map(|panel| panel.series.iter_mut().enumerate()) {
        // The panel of normalised loops leaves out those without limits; its series say whose they are.
        let place = if let Some(Ink::Palette(curve)) = series.style.ink { curve } else { place };
        series.style.ink = inks.get(place).copied();
    }
    figure.provenance = provenance(job);
    draw_png(&figure)
}

/// Grey for what stands behind, the palette for the others.
fn inks(curves: &[Curve]) -> Vec<Ink> {
    let mut place = 0;
    let ink = |curve: &Curve| {
        if curve.is_muted {
            return Ink::Muted;
        }
        place += 1;
        Ink::Palette(place - 1)
    };
    curves.iter().map(ink).collect()
}

fn curves(job: &Job, outcome: &Outcome, c: usize) -> Vec<Curve> {
    let Some((name, law)) = job.model.contacts().nth(c) else { return Vec::new() };
    let count = job.count(c);
    let is_alone = job.model.contacts().count() == 1;
    let name = if count > 1 { format!("{name} × {count}") } else { name.to_owned() };
    let scale = job.model.contact_scale(c).filter(|_| job.has_constant_load(c));
    let curve = |words: &str, path: ContactPath, is_muted: bool| Curve {
        name: match (is_alone, words) {
            (_, "") => name.clone(),
            (true, words) => words.to_owned(),
            (false, words) => format!("{name}, {words}"),
        },
        path,
        gross_slip: scale.map(|(u_c, _)| u_c),
        limit: scale.map(|(_, normal)| f64::from(count) * law.friction() * normal),
        is_muted,
    };
    let path = ContactPath::of(job, c, &outcome.kept.series);
    let Some(periods) = periods(job, c, outcome.state.time()) else { return vec![curve("", path, false)] };
    let last = path.part(periods.last());
    if last.is_closed() {
        return vec![curve("", path, false)];
    }
    let mut curves = Vec::new();
    if periods.count > 1 && is_alone {
        curves.push(curve("first period", path.part(periods.first()).counted_from_start(), true));
    }
    let words =
        if periods.count > 1 { format!("period {}", periods.count) } else { "first period".to_owned() };
    curves.push(curve(&words, last.counted_from_start(), false));
    curves
}

/// Positions over time, displacements of the contacts below.
fn trajectory(job: &Job, outcome: &Outcome) -> Result<Vec<u8>, PlotError> {
    let series = &outcome.kept.series;
    let (mut feet, mut sliders) = (Vec::new(), Vec::new());
    for (place, body) in job.scenario.scene.bodies.iter().enumerate() {
        let tracks = match body.part.x {
            Freedom::Fixed => continue,
            Freedom::Follows(_) => &mut feet,
            Freedom::Free if has_actuator(job, place) => &mut feet,
            Freedom::Free => &mut sliders,
        };
        tracks.push(track(series, &body.name, "x_m"));
    }
    if sliders.is_empty() {
        // Nothing to stand out against: the prescribed motion is what there is to see.
        std::mem::swap(&mut feet, &mut sliders);
    }
    let relative = job.model.contacts().map(|(name, _)| track(series, name, "u_m")).collect();
    let trajectory =
        Trajectory { time: series.time(), feet, sliders, relative, gross_slip: gross_slip(job, outcome) };
    let mut figure: Figure<'_> = trajectory_figure(job.title(), &trajectory);
    figure.provenance = provenance(job);
    draw_png(&figure)
}

/// Whether an actuator moves a body.
fn has_actuator(job: &Job, place: usize) -> bool {
    job.scenario.scene.actuators.iter().any(|actuator| actuator.part.between.contains(&Side::Body(place)))
}

fn track<'a>(series: &'a Series, name: &'a str, quantity: &str) -> Track<'a> {
    Track { name, values: series.column(name, quantity) }
}

/// u_c of the only contact, where it oscillates about its start.
fn gross_slip(job: &Job, outcome: &Outcome) -> Option<f64> {
    let (name, _) = job.model.contacts().next().filter(|_| job.model.contacts().count() == 1)?;
    let (u_c, _) = job.model.contact_scale(0).filter(|_| job.has_constant_load(0))?;
    let u = outcome.kept.series.column(name, "u_m");
    let (first, last) = (u.first()?, u.last()?);
    ((last - first).abs() <= 2.0 * u_c).then_some(u_c)
}
