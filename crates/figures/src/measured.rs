//! Plots of measured loops, also with a simulated loop.

use crate::look::{Look, Pen, Picture};
use crate::pictures::FigureError;
use stickslip_plot::{
    Arrangement, Axis, Figure, HysteresisLoop, Ink, Label, MapContent, Panel, ResultMap, Series, loop_figure,
    map_figure,
};
use stickslip_run::measured::middle;
use stickslip_run::program::this_program;
use stickslip_run::provenance::{PROGRAM, TITLE};

/// Name of the plot.
pub const NAME: &str = "loop";
/// Names of the plots of many cycles.
const LOG: &str = "log";
const EVOLUTION: &str = "evolution";
/// Maximum number of columns, and number of rows of the map.
const COLUMNS: usize = 600;
const LEVELS: usize = 120;
/// Width of the colour bar relative to the map.
const BAR: f64 = 0.3;
/// Line width of the last measured loop and of earlier loops.
const BOLD: f64 = 1.15;
const FINE: f64 = 0.9;

/// Loop: displacements and forces.
#[derive(Debug, Clone, Copy)]
pub struct Curve<'a> {
    /// Name in the legend.
    pub name: &'a str,
    /// Displacements, m.
    pub u: &'a [f64],
    /// Forces, N.
    pub force: &'a [f64],
}

/// Loops in a plot. Each is shifted so that its middle is at the origin, since zeros of sensors and runs differ.
#[derive(Debug, Clone, Copy)]
pub struct Loops<'a> {
    /// Title of the plot.
    pub title: &'a str,
    /// Earlier cycles, drawn behind the last one.
    pub before: Option<Curve<'a>>,
    /// Last measured cycle.
    pub measured: Curve<'a>,
    /// Simulated cycle. For a contact with constant load also its u_c (m) and μF_N (N).
    pub simulated: Option<(Curve<'a>, Option<[f64; 2]>)>,
}

/// Cycles of a record.
#[derive(Debug, Clone)]
pub struct Course<'a> {
    /// Title of the plots.
    pub title: &'a str,
    /// Numbers of the cycles.
    pub numbers: Vec<f64>,
    /// Loops of the cycles.
    pub loops: Vec<Curve<'a>>,
    /// Results over the cycles: name, unit, and one value per cycle; NaN without a result.
    pub figures: Vec<(&'static str, &'static str, Vec<f64>)>,
}

/// Returns all possible file names of the plots.
#[must_use]
pub fn all_files() -> Vec<String> {
    Look::all_files_of(&[NAME, LOG, EVOLUTION])
}

/// Draws the results over the cycles, and a map of the force over cycle and displacement. The map shows the branch
/// from the largest to the smallest displacement.
///
/// # Errors
/// If a figure cannot be drawn.
pub fn draw_course(course: &Course<'_>, look: &Look) -> Result<Vec<Picture>, FigureError> {
    let provenance =
        || vec![(TITLE.to_owned(), course.title.to_owned()), (PROGRAM.to_owned(), this_program())];
    let draw = |plot, figure| {
        let pen = Pen { look, provenance: provenance(), kept: None };
        pen.draw_as(plot, figure).map_err(|source| FigureError::Plot { plot, source })
    };
    let mut pictures = draw(EVOLUTION, evolution_figure(course))?;
    if let Some(log) = log_figure(course) {
        pictures.extend(draw(LOG, log)?);
    }
    Ok(pictures)
}

/// Returns the map of the force over cycle and displacement; `None` if the displacements have no range.
fn log_figure<'a>(course: &Course<'a>) -> Option<Figure<'a>> {
    let count = course.loops.len().min(COLUMNS);
    let chosen: Vec<usize> = (0..count).map(|k| k * (course.loops.len() - 1) / (count - 1).max(1)).collect();
    let ends = |curve: &Curve<'_>| {
        let (low, high) = curve
            .u
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), u| (low.min(*u), high.max(*u)));
        [low, high]
    };
    let all = course.loops.iter().map(ends);
    let [low, high] = all.fold([f64::INFINITY, f64::NEG_INFINITY], |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    let ys: Vec<f64> = (0..LEVELS).map(|k| low + (high - low) * (k as f64 + 0.5) / LEVELS as f64).collect();
    if !ys.is_sorted_by(|a, b| a < b && b.is_finite()) {
        return None;
    }
    let values = chosen.iter().flat_map(|k| falling(&course.loops[*k], &ys)).collect();
    let map = ResultMap {
        axes: [("cycle", "", false), ("displacement", "m", false)],
        places: [chosen.iter().map(|k| course.numbers[*k]).collect(), ys],
        content: MapContent::Numbers { name: ("falling force", "N"), values, contours: &[] },
        points: &[],
    };
    let mut figure = map_figure(course.title, map);
    // Wide enough for the colour bar in a narrow column.
    figure.panels.iter_mut().skip(1).for_each(|bar| bar.share = BAR);
    Some(figure)
}

/// Returns the force at given displacements on the branch from the largest to the smallest displacement; NaN outside.
fn falling(curve: &Curve<'_>, at: &[f64]) -> Vec<f64> {
    let count = curve.u.len();
    let place = |is_better: fn(f64, f64) -> bool| {
        (0..count).reduce(|best, k| if is_better(curve.u[k], curve.u[best]) { k } else { best }).unwrap_or(0)
    };
    let (top, bottom) = (place(|a, b| a > b), place(|a, b| a < b));
    let steps = (bottom + count - top) % count;
    let mut way: Vec<[f64; 2]> =
        (0..=steps).map(|k| (top + k) % count).map(|k| [curve.u[k], curve.force[k]]).collect();
    way.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let force = |u: f64| {
        let after = way.partition_point(|point| point[0] < u);
        let (before, after) = (way.get(after.wrapping_sub(1))?, way.get(after)?);
        let width = after[0] - before[0];
        let share = if width > 0.0 { (u - before[0]) / width } else { 0.0 };
        Some(before[1] + share * (after[1] - before[1]))
    };
    at.iter().map(|u| force(*u).unwrap_or(f64::NAN)).collect()
}

/// Returns the results over the cycles, one panel each.
fn evolution_figure<'a>(course: &Course<'a>) -> Figure<'a> {
    let panel = |(name, unit, values): &(&'static str, &'static str, Vec<f64>)| Panel {
        x: Axis::new(Label::plain("cycle"), ""),
        y: Axis::new(Label::markup(name), unit),
        series: vec![Series::new("", course.numbers.clone(), values.clone())],
        ..Panel::default()
    };
    let is_known = |figure: &&(&str, &str, Vec<f64>)| figure.2.iter().any(|value| value.is_finite());
    Figure {
        title: Label::plain(course.title),
        panels: course.figures.iter().filter(is_known).map(panel).collect(),
        arrangement: Arrangement::Column { share_x: true },
        ..Figure::default()
    }
}

/// Draws loops.
///
/// # Errors
/// If the figure cannot be drawn.
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
