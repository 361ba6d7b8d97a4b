//! Computing cost over problem size.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Series};
use crate::theme::{Dash, Ink, Style};

/// Cost over the size of one part of the problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GrowthCurve<'a> {
    /// Name of the part, such as the number of contacts.
    pub name: &'a str,
    /// Unit of the size; empty for a number.
    pub unit: &'a str,
    /// Sizes, ascending, above 0.
    pub sizes: &'a [f64],
    /// Cost at each size, s.
    pub costs: &'a [f64],
    /// Whether the costs are per size; they are constant if the cost is proportional to the size.
    pub per_size: bool,
}

/// Number of columns of the grid.
const COLUMNS: usize = 3;
/// Minimum range of the cost axis as a ratio, so that constant costs look flat.
const LEAST: f64 = 10.0;

/// Draws one double-logarithmic panel per part: the measured cost, and a dashed line of proportional cost through the first point.
pub fn growth_figure<'a>(title: &str, cost: &str, curves: &[GrowthCurve<'a>]) -> Figure<'a> {
    if curves.iter().all(|curve| curve.sizes.is_empty()) {
        return Figure::without_data(title, "nothing grows");
    }
    let rows = curves.len().div_ceil(COLUMNS);
    Figure {
        title: Label::plain(title),
        panels: curves.iter().map(|curve| panel(curve, cost)).collect(),
        arrangement: Arrangement::Grid { columns: COLUMNS, share: false },
        size: Figure::size_for(180, 520, rows),
        ..Figure::default()
    }
}

fn panel<'a>(curve: &GrowthCurve<'a>, cost: &str) -> Panel<'a> {
    let axis = |label: &str, unit: &str| Axis { logarithmic: true, ..Axis::new(Label::plain(label), unit) };
    let largest = curve.costs.iter().copied().fold(0.0, f64::max);
    let style = |ink, dash, width| Style { ink: Some(ink), dash: Some(dash), width };
    let measured = Series {
        marked: true,
        style: style(Ink::Palette(0), Dash::Solid, 1.0),
        ..Series::new("measured", curve.sizes, curve.costs)
    };
    Panel {
        x: axis(curve.name, curve.unit),
        y: Axis { covers: Some((largest / LEAST, largest)), ..axis(cost, "s") },
        series: [proportional(curve, largest).map(|(sizes, costs)| Series {
            style: style(Ink::Muted, Dash::Dashed, 0.7),
            ..Series::new("in proportion", sizes, costs)
        })]
        .into_iter()
        .flatten()
        .chain([measured])
        .collect(),
        ..Panel::default()
    }
}

/// Returns the end points of the line of proportional cost, cut at the largest measured cost.
fn proportional(curve: &GrowthCurve<'_>, largest: f64) -> Option<(Vec<f64>, Vec<f64>)> {
    let (from, to, cost) = (*curve.sizes.first()?, *curve.sizes.last()?, *curve.costs.first()?);
    if curve.per_size {
        return Some((vec![from, to], vec![cost; 2]));
    }
    let to = to.min(from * (largest / cost).max(1.0));
    Some((vec![from, to], vec![cost, cost * to / from]))
}
