//! Plots of a single contact under a load history.
//!
//! The plots use the same builders of `stickslip-plot` as the plots of runs.

pub(crate) mod moments;

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use moments::{Shown, frames};
use stickslip_contact::{Apex, Curve, Fields, Interface, Memory};
use stickslip_plot::{
    Figure, FrictionWork, HysteresisLoop, PlotError, ProfilePair, anchors_figure, fields_figure,
    friction_figure, marked_loop_figure, profile_figure, substitute_figure,
};
use stickslip_run::program::this_program;
use stickslip_run::provenance::{HASH, PROGRAM, SCENARIO, TITLE};
use stickslip_run::theory::{BEYOND, Sheet, Stop, Subject, Walk};

/// Names of the plots.
pub const NAMES: [&str; 7] = ["substitute", "fields", "loop", "profile", "memory", "friction", "cycle"];

/// Size of an animation, px, and duration of a frame, ms.
const ANIMATED: (u32, u32) = (800, 700);
const DELAY: u16 = 120;

/// Maximum number of numbered corners in the loop, and of corners with a curve in the plot of friction work.
const NUMBERED: usize = 24;
const LINED: usize = 12;
/// Number of points of the profile.
const POINTS: usize = 301;

/// Returns all possible file names of the plots.
pub fn all_files() -> Vec<String> {
    Look::all_files_of(&NAMES)
}

/// Draws all plots, the animation only if `is_animated`. Each plot has its own result; an error does not affect the other plots.
pub fn draw(
    subject: &Subject<'_>,
    sheet: &Sheet,
    walk: &Walk,
    (look, is_animated): (&Look, bool),
) -> Vec<Result<Vec<Picture>, FigureError>> {
    let pen = Pen { look, provenance: provenance(subject), kept: None };
    let title = format!("{}, contact {}", subject.job.title(), subject.name);
    let shown = Shown::of(subject.law, walk);
    let drawn = |plot: &'static str, figure: Figure<'_>| {
        pen.draw_as(plot, figure).map_err(|source: PlotError| FigureError::Plot { plot, source })
    };
    let mut pictures = vec![
        drawn(NAMES[0], substitute_figure(&title, &shown.substitutes())),
        drawn(NAMES[1], fields_figure(&title, &shown.fields())),
        hysteresis(subject.law, walk, |course, marks| {
            drawn(NAMES[2], marked_loop_figure(&title, course, marks))
        }),
        profile(subject.law, sheet, walk, |pair| drawn(NAMES[3], profile_figure(&title, pair))),
        drawn(NAMES[4], anchors_figure(&title, &shown.anchors())),
        friction(walk, |work| drawn(NAMES[5], friction_figure(&title, work))),
    ];
    if is_animated {
        let animation = pen.animate(NAMES[6], cycle(subject.law, walk, &title), DELAY);
        pictures.push(animation.map_err(|source| FigureError::Plot { plot: NAMES[6], source }));
    }
    pictures
}

/// Returns the metadata of the pictures.
fn provenance(subject: &Subject<'_>) -> Vec<(String, String)> {
    let job = subject.job;
    let entries = [
        (TITLE, job.title().to_owned()),
        (PROGRAM, this_program()),
        ("Contact", subject.name.to_owned()),
        (HASH, job.hash.clone()),
        (SCENARIO, job.resolved.clone()),
    ];
    entries.map(|(key, text)| (key.to_owned(), text)).to_vec()
}

/// Sketches of the springs in the last sections, frame by frame.
fn cycle(law: &Interface, walk: &Walk, title: &str) -> Vec<Figure<'static>> {
    let mut figures = Vec::new();
    frames(law, walk, |moment| {
        let figure = substitute_figure(title, std::slice::from_ref(moment));
        figures.push(Figure { size: ANIMATED, ..figure });
    });
    figures
}

/// Returns at most `most` of `count` indices, equally spaced, including the first and the last.
fn spread(count: usize, most: usize) -> impl Iterator<Item = usize> {
    let shown = count.min(most);
    (0..shown).map(move |k| if count <= most { k } else { k * (count - 1) / (shown - 1) })
}

/// Calls `drawn` with the hysteresis loop and its numbered corners.
fn hysteresis<T>(
    law: &Interface,
    walk: &Walk,
    drawn: impl FnOnce(HysteresisLoop<'_>, &[(f64, f64, String)]) -> T,
) -> T {
    let u: Vec<f64> = walk.stops.iter().map(|stop| stop.apex.u).collect();
    let force: Vec<f64> = walk.stops.iter().map(|stop| stop.force).collect();
    let first = walk.stops.first().map(|stop| stop.apex.d);
    let depth = first.filter(|d| walk.stops.iter().all(|stop| stop.apex.d == *d));
    let stops = spread(walk.moments.len(), NUMBERED).map(|place| &walk.moments[place].stop);
    let marks: Vec<(f64, f64, String)> =
        stops.map(|stop| (stop.apex.u, stop.force, stop.corner.to_string())).collect();
    let course = HysteresisLoop {
        name: "numbers mark the corners",
        u: &u,
        force: &force,
        gross_slip: depth.map(|d| law.gross_slip_displacement(d)),
        limit: depth.map(|d| law.friction() * law.normal_force(d)),
    };
    drawn(course, &marks)
}

/// Calls `drawn` with the profiles f(r) and g(x).
fn profile<T>(law: &Interface, sheet: &Sheet, walk: &Walk, drawn: impl FnOnce(&ProfilePair<'_>) -> T) -> T {
    let reach = BEYOND * law.profile().radius(walk.deepest);
    let x: Vec<f64> = (0..POINTS).map(|k| reach * k as f64 / (POINTS - 1) as f64).collect();
    let g: Vec<f64> = x.iter().map(|x| law.profile().depth(*x)).collect();
    let f = gaps(law, &x);
    let (d, a) = (sheet.pressed.d.0, sheet.pressed.a.0);
    drawn(&ProfilePair { x: &x, f: f.as_deref(), g: &g, d, a })
}

/// Returns the profile f at given distances, m: by its formula, or d - deflection of a contact of that radius. `None` for spring lists.
fn gaps(law: &Interface, x: &[f64]) -> Option<Vec<f64>> {
    let farthest = x.last().copied().unwrap_or(0.0);
    let d = law.profile().depth(farthest);
    let memory = Memory::Curve(Curve::new(law, Apex { d: if d.is_finite() { d } else { 0.0 }, u: 0.0 }));
    let fields = Fields::of(law, &memory)?;
    let gap = |r: f64| match law.profile().gap(r) {
        Some(gap) => gap,
        None if d.is_finite() => d - fields.at(r).deflection,
        None => f64::NAN,
    };
    Some(x.iter().map(|r| gap(*r)).collect())
}

/// Calls `drawn` with the friction work per area over radius and history.
fn friction<T>(walk: &Walk, drawn: impl FnOnce(&FrictionWork<'_>) -> T) -> T {
    let along = |corner: usize, share: f64| corner as f64 - 1.0 + share;
    let (mut moments, mut work) = (Vec::new(), Vec::new());
    let radii = walk.friction.as_ref().map_or(&[][..], |course| &course.radii);
    for step in walk.friction.iter().flat_map(|course| &course.steps) {
        moments.push(along(step.corner, step.share));
        work.extend_from_slice(&step.work);
    }
    let corner = |stop: &Stop| (stop.corner as f64, format!("corner {}", stop.corner));
    let stops: Vec<&Stop> =
        walk.moments.iter().map(|moment| &moment.stop).filter(|stop| stop.corner > 0).collect();
    let marks: Vec<(f64, String)> = spread(stops.len(), LINED).map(|place| corner(stops[place])).collect();
    drawn(&FrictionWork { axis: ("corner", ""), moments: &moments, r: radii, work: &work, marks: &marks })
}
