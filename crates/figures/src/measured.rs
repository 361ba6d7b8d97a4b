//! The picture of measured loops, and of a simulated one beside them.

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{HysteresisLoop, Ink, loop_figure};
use stickslip_run::measured::middle;
use stickslip_run::program::this_program;
use stickslip_run::provenance::{PROGRAM, TITLE};

/// Name of the picture.
pub const NAME: &str = "loop";
/// Width of the last measured loop and of those before it.
const BOLD: f64 = 1.15;
const FINE: f64 = 0.9;

/// A loop: displacements, m, and forces, N.
#[derive(Debug, Clone, Copy)]
pub struct Curve<'a> {
    /// What the legend calls it.
    pub name: &'a str,
    /// Displacements, m.
    pub u: &'a [f64],
    /// Forces, N.
    pub force: &'a [f64],
}

/// What is drawn, each about the middle of its own cycle: zeros of gauges and of runs are not the same.
#[derive(Debug, Clone, Copy)]
pub struct Loops<'a> {
    /// Above the picture.
    pub title: &'a str,
    /// The cycles before the last one, which stand behind it.
    pub before: Option<Curve<'a>>,
    /// The last measured cycle.
    pub measured: Curve<'a>,
    /// A simulated cycle, with u_c (m) and μF_N (N) of its contact where its load is constant.
    pub simulated: Option<(Curve<'a>, Option<[f64; 2]>)>,
}

/// Names of all files that any look gives to it.
#[must_use]
pub fn all_files() -> Vec<String> {
    Look::all_files_of(&[NAME])
}

/// Draws it.
///
/// # Errors
/// What the drawing itself fails for.
pub fn draw(loops: &Loops<'_>, look: &Look) -> Result<Vec<Picture>, FigureError> {
    let (simulated, scale) = loops.simulated.unzip();
    let about = |curve: Curve<'_>| (middle(curve.u), middle(curve.force));
    let own = about(loops.measured);
    let curves = [
        loops.before.map(|curve| (curve, own)),
        Some((loops.measured, own)),
        simulated.map(|curve| (curve, about(curve))),
    ];
    let moved: Vec<(&str, Vec<f64>, Vec<f64>)> = curves
        .into_iter()
        .flatten()
        .map(|(curve, (u, force))| (curve.name, shifted(curve.u, u), shifted(curve.force, force)))
        .collect();
    let scale = scale.flatten();
    let drawn = moved.iter().map(|(name, u, force)| HysteresisLoop {
        name,
        u,
        force,
        gross_slip: scale.map(|[u_c, _]| u_c),
        limit: scale.map(|[_, limit]| limit),
    });
    let loops_drawn: Vec<HysteresisLoop<'_>> = drawn.collect();
    let mut figure = loop_figure(loops.title, &loops_drawn);
    let first = usize::from(loops.before.is_some());
    for (place, series) in figure.panels.iter_mut().flat_map(|panel| panel.series.iter_mut().enumerate()) {
        let (ink, width) = match place.checked_sub(first) {
            None => (Ink::Pale(0), FINE),
            Some(place) => (Ink::Palette(place), BOLD),
        };
        (series.style.ink, series.style.width) = (Some(ink), width);
    }
    let provenance = vec![(TITLE.to_owned(), loops.title.to_owned()), (PROGRAM.to_owned(), this_program())];
    let pen = Pen { look, provenance, kept: None };
    pen.draw_as(NAME, figure).map_err(|source| FigureError::Plot { plot: NAME, source })
}

fn shifted(values: &[f64], by: f64) -> Vec<f64> {
    values.iter().map(|value| value - by).collect()
}
