//! Work-precision diagrams: what an error costs.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Note, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style};

/// Runs of one method from coarse to fine; as many errors as seconds and evaluations. Values not above 0 are gaps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorkCurve<'a> {
    /// What it is among the others of its group; stands at its end.
    pub name: &'a str,
    /// What the curves of a pair of panels have in common.
    pub group: &'a str,
    /// Error, dimensionless.
    pub error: &'a [f64],
    /// Time per simulated second, s.
    pub seconds: &'a [f64],
    /// Evaluations per simulated second.
    pub evaluations: &'a [f64],
    /// Place of its colour.
    pub place: usize,
}

/// Most curves of a panel: more are not told apart where they meet.
const MOST: usize = 5;
/// Fewest points that have a slope.
const LEAST: usize = 3;
/// Points within this factor of the least error may be on the floor of rounding, or of what a row of springs can do.
const FLOOR: f64 = 5.0;
/// Height of the title and the axes, and of a pair of panels, px.
const AROUND: u32 = 260;
const EACH: u32 = 560;

/// Error over time (left) and over evaluations (right), all axes logarithmic, a pair of panels for each group with at most five
/// curves; names and slopes (powers of the work with which the error falls, above its floor) stand at the ends of the curves, as far as there is room; the
/// legend has all names. `error` says
/// in parts of what the error is measured; below `floor` the reference itself is no longer sure.
pub fn work_precision_figure<'a>(
    title: &str,
    error: &str,
    curves: &[WorkCurve<'a>],
    floor: Option<f64>,
) -> Figure<'a> {
    let is_drawn = |curve: &&WorkCurve<'_>| curve.error.iter().any(|error| *error > 0.0);
    let shown: Vec<&WorkCurve<'a>> = curves.iter().filter(is_drawn).collect();
    if shown.is_empty() {
        return Figure::without_data(title, "no run has an error");
    }
    let mut groups: Vec<&str> = Vec::new();
    for curve in &shown {
        if !groups.contains(&curve.group) {
            groups.push(curve.group);
        }
    }
    let axis = |label: &str, unit: &str| Axis { logarithmic: true, ..Axis::new(Label::plain(label), unit) };
    let floor = floor.filter(|floor| *floor > 0.0);
    let panel = |(curves, heading): (&[&WorkCurve<'a>], &str), x: Axis, work: Work<'a>| Panel {
        heading: Label::plain(heading),
        x,
        y: axis(error, ""),
        series: curves.iter().map(|curve| series(curve, work(curve))).collect(),
        references: floor
            .into_iter()
            .map(|y| Reference::Horizontal { y, label: Label::plain("doubt of the reference") })
            .collect(),
        notes: curves.iter().filter_map(|curve| name(curve, work(curve))).collect(),
        ..Panel::default()
    };
    let mut panels = Vec::new();
    for group in groups {
        let members: Vec<&WorkCurve<'a>> =
            shown.iter().copied().filter(|curve| curve.group == group).collect();
        for curves in members.chunks(MOST) {
            let (seconds, evaluations) =
                (axis("time per simulated second", "s"), axis("evaluations per simulated second", ""));
            panels.push(panel((curves, group), seconds, |curve| curve.seconds));
            panels.push(panel((curves, ""), evaluations, |curve| curve.evaluations));
        }
    }
    Figure {
        title: Label::plain(title),
        size: Figure::size_for(AROUND, EACH, panels.len() / 2),
        panels,
        arrangement: Arrangement::Columns { columns: 2 },
        ..Figure::default()
    }
    .with_room_for_legends()
}

/// The work that a panel lays off.
type Work<'a> = fn(&WorkCurve<'a>) -> &'a [f64];

fn series<'a>(curve: &WorkCurve<'a>, work: &'a [f64]) -> Series<'a> {
    let style = Style { ink: Some(Ink::Palette(curve.place)), dash: Some(Dash::Solid), width: 0.8 };
    Series { style, marked: true, ..Series::new(curve.name, work, curve.error) }
}

/// Points of a curve that can be drawn: work and error.
fn points(curve: &WorkCurve<'_>, work: &[f64]) -> Vec<(f64, f64)> {
    let points = work.iter().copied().zip(curve.error.iter().copied());
    points.filter(|(work, error)| *work > 0.0 && *error > 0.0).collect()
}

/// Name and slope at the end with the most work.
fn name(curve: &WorkCurve<'_>, work: &[f64]) -> Option<Note> {
    let points = points(curve, work);
    let end = points.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let slope =
        slope(&points).map_or(String::new(), |slope| format!(", {slope:.1}").replace('-', "\u{2212}"));
    let line = Label::plain(&format!("{}{slope}", curve.name));
    Some(Note { lines: vec![line], about: [end; 2], on: None, ink: Some(Ink::Palette(curve.place)) })
}

/// The power of the work with which the error changes, by least squares of the logarithms above the floor.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
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
    (above.len() >= LEAST && along > 0.0).then_some(across / along)
}
