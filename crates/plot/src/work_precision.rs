//! Work–precision diagrams: error over run time and over force evaluations.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Note, Panel, Series};
use crate::theme::{Dash, Ink, Style};

/// Runs of one method; as many errors as seconds and evaluations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorkCurve<'a> {
    /// Name, shown at the curve.
    pub name: &'a str,
    /// Error, dimensionless.
    pub error: &'a [f64],
    /// Time per simulated second, s.
    pub seconds: &'a [f64],
    /// Force evaluations per simulated second.
    pub evaluations: &'a [f64],
    /// Index of its colour.
    pub place: usize,
}

/// Minimum number of points for which a slope is fitted.
const LEAST: usize = 3;
/// Maximum slope that is fitted. The error of a steeper curve does not depend on the work.
const STEEPEST: f64 = 20.0;
/// Points within this factor of the smallest error may be limited by rounding or by the number of springs.
const FLOOR: f64 = 5.0;

/// Draws error over run time (left) and over force evaluations (right) on logarithmic axes. Each curve connects the Pareto-optimal runs of
/// a method. A dashed line with a number shows its slope. `error` labels the vertical axis.
pub fn work_precision_figure<'a>(title: &str, error: &str, curves: &[WorkCurve<'a>]) -> Figure<'a> {
    let axis = |label: &str, unit: &str| Axis { logarithmic: true, ..Axis::new(Label::plain(label), unit) };
    let panel = |x: Axis, work: fn(&WorkCurve<'a>) -> &'a [f64]| {
        let fronts = curves.iter().map(|curve| (curve, front(work(curve), curve.error)));
        let fronts: Vec<(&WorkCurve<'a>, Vec<(f64, f64)>)> =
            fronts.filter(|(_, front)| !front.is_empty()).collect();
        Panel {
            x,
            y: axis(error, ""),
            series: fronts.iter().flat_map(|(curve, front)| series(curve.place, front)).collect(),
            notes: fronts.iter().filter_map(|(curve, front)| name(curve, front)).collect(),
            ..Panel::default()
        }
    };
    let panels = vec![
        panel(axis("time per simulated second", "s"), |curve| curve.seconds),
        panel(axis("evaluations per simulated second", ""), |curve| curve.evaluations),
    ];
    if panels[0].series.is_empty() {
        return Figure::without_data(title, "no run has a known error");
    }
    let arrangement = Arrangement::Row;
    Figure {
        title: Label::plain(title),
        panels,
        arrangement,
        size: Figure::size_for(900, 0, 0),
        ..Figure::default()
    }
}

/// Returns the Pareto-optimal runs in work and error, by ascending work. Values that are not above 0 are left out.
fn front(work: &[f64], error: &[f64]) -> Vec<(f64, f64)> {
    let runs = work.iter().copied().zip(error.iter().copied());
    let mut runs: Vec<(f64, f64)> = runs.filter(|(work, error)| *work > 0.0 && *error > 0.0).collect();
    runs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut least = f64::INFINITY;
    runs.retain(|(_, error)| {
        let is_better = *error < least;
        least = least.min(*error);
        is_better
    });
    runs
}

/// Returns the curve of Pareto-optimal runs, and the line of its slope.
fn series<'a>(place: usize, front: &[(f64, f64)]) -> Vec<Series<'a>> {
    let style = |dash, width| Style { ink: Some(Ink::Palette(place)), dash: Some(dash), width };
    let line = |points: &[(f64, f64)], style| {
        let (xs, ys): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        Series { style, ..Series::new("", xs, ys) }
    };
    let curve = Series { marked: true, ..line(front, style(Dash::Solid, 0.8)) };
    let fit = slope(front).map(|(_, ends)| line(&ends, style(Dash::at(1), 0.6)));
    std::iter::once(curve).chain(fit).collect()
}

/// Returns the name and the slope of a curve as a note at its end with the most work.
fn name(curve: &WorkCurve<'_>, front: &[(f64, f64)]) -> Option<Note> {
    let end = *front.last()?;
    let slope =
        slope(front).map_or(String::new(), |(slope, _)| format!(", {slope:.1}").replace('-', "\u{2212}"));
    let line = Label::plain(&format!("{}{slope}", curve.name));
    Some(Note { lines: vec![line], about: [end; 2], on: None, ink: Some(Ink::Palette(curve.place)) })
}

/// Returns the exponent of the error over the work, by least squares of the logarithms above the floor, and both ends of the fitted line.
fn slope(points: &[(f64, f64)]) -> Option<(f64, [(f64, f64); 2])> {
    let least = points.iter().map(|point| point.1).fold(f64::INFINITY, f64::min);
    let above = points.iter().filter(|(_, error)| *error > FLOOR * least);
    let above: Vec<(f64, f64)> = above.map(|(work, error)| (math::ln(*work), math::ln(*error))).collect();
    let count = above.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| above.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let (mut across, mut along) = (0.0, 0.0);
    for point in &above {
        across += (point.0 - x) * (point.1 - y);
        along += (point.0 - x).powi(2);
    }
    let slope = across / along;
    let end = |at: f64| (math::exp(at), math::exp(y + slope * (at - x)));
    let (first, last) = (above.first()?.0, above.last()?.0);
    (above.len() >= LEAST && slope.abs() < STEEPEST).then_some((slope, [end(first), end(last)]))
}
