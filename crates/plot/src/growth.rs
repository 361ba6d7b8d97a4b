//! What more of something costs.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Series};
use crate::theme::{Dash, Ink, Style};

/// Cost over the size of something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GrowthCurve<'a> {
    /// What grows.
    pub name: &'a str,
    /// Its unit; empty for a number.
    pub unit: &'a str,
    /// Sizes, ascending, above 0.
    pub sizes: &'a [f64],
    /// Costs, as many, s.
    pub costs: &'a [f64],
    /// Whether a cost is one per size already: in proportion, it stays the same.
    pub per_size: bool,
}

/// Panels in a row of the grid.
const COLUMNS: usize = 3;
/// A panel shows at least a decade of costs, so that what does not grow looks flat.
const LEAST: f64 = 10.0;

/// A panel for each thing that grows, both axes logarithmic: the cost, and behind it what would be in proportion to that of the
/// smallest. What rises above the line costs more than its share, what stays below it less.
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

/// The straight line through the first point, no higher than what is shown anyway.
fn proportional(curve: &GrowthCurve<'_>, largest: f64) -> Option<(Vec<f64>, Vec<f64>)> {
    let (from, to, cost) = (*curve.sizes.first()?, *curve.sizes.last()?, *curve.costs.first()?);
    if curve.per_size {
        return Some((vec![from, to], vec![cost; 2]));
    }
    let to = to.min(from * (largest / cost).max(1.0));
    Some((vec![from, to], vec![cost, cost * to / from]))
}
