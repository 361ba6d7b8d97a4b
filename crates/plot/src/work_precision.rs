//! Work-precision diagrams: what an error costs.

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style};

/// Runs of one method from coarse to fine; as many errors as seconds and evaluations. Values not above 0 are gaps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorkCurve<'a> {
    /// Name in the legend; none where empty. Pale curves of one name and dash share an entry.
    pub name: &'a str,
    /// Error, dimensionless.
    pub error: &'a [f64],
    /// Time per simulated second, s.
    pub seconds: &'a [f64],
    /// Evaluations per simulated second.
    pub evaluations: &'a [f64],
    /// Colour; pale ones are drawn first, without marks.
    pub ink: Ink,
    /// Interruption of the line.
    pub dash: Dash,
}

/// Error over time (left) and over evaluations (right), both axes logarithmic. `error` says in parts of what the error
/// is measured; below `floor` the reference itself is no longer sure.
pub fn work_precision_figure<'a>(
    title: &str,
    error: &str,
    curves: &[WorkCurve<'a>],
    floor: Option<f64>,
) -> Figure<'a> {
    let is_drawn = |curve: &WorkCurve<'_>| curve.error.iter().any(|error| *error > 0.0);
    let mut shown: Vec<&WorkCurve<'a>> = curves.iter().filter(|curve| is_drawn(curve)).collect();
    if shown.is_empty() {
        return Figure::without_data(title, "no run has an error");
    }
    shown.sort_by_key(|curve| !is_pale(curve.ink));
    let axis = |label: &str, unit: &str| Axis { logarithmic: true, ..Axis::new(Label::plain(label), unit) };
    let references = floor.into_iter().filter(|floor| *floor > 0.0);
    let references: Vec<Reference> = references
        .map(|y| Reference::Horizontal { y, label: Label::plain("doubt of the reference") })
        .collect();
    let keys = keys(&shown);
    let panel = |x: Axis, work: fn(&WorkCurve<'a>) -> &'a [f64]| Panel {
        x,
        y: axis(error, ""),
        series: shown.iter().map(|curve| series(curve, work(curve))).chain(keys.clone()).collect(),
        references: references.clone(),
        ..Panel::default()
    };
    let panels = vec![
        panel(axis("time per simulated second", "s"), |curve| curve.seconds),
        panel(axis("evaluations per simulated second", ""), |curve| curve.evaluations),
    ];
    Figure {
        title: Label::plain(title),
        panels,
        arrangement: Arrangement::Row,
        size: (Figure::DEFAULT_SIZE.0, 900),
        ..Figure::default()
    }
    .with_room_for_legends()
}

/// Names of the pale curves, in grey: no points, entries of the legend alone.
fn keys<'a>(shown: &[&WorkCurve<'a>]) -> Vec<Series<'a>> {
    let mut keys: Vec<(&str, Dash)> = Vec::new();
    for curve in shown.iter().filter(|curve| is_pale(curve.ink)) {
        if !keys.contains(&(curve.name, curve.dash)) {
            keys.push((curve.name, curve.dash));
        }
    }
    let key = |(name, dash): (&str, Dash)| {
        let style = Style { ink: Some(Ink::Muted), dash: Some(dash), width: 0.8 };
        Series { style, ..Series::new(name, Vec::new(), Vec::new()) }
    };
    keys.into_iter().map(key).collect()
}

fn series<'a>(curve: &WorkCurve<'a>, work: &'a [f64]) -> Series<'a> {
    let pale = is_pale(curve.ink);
    let style = Style { ink: Some(curve.ink), dash: Some(curve.dash), width: if pale { 0.8 } else { 1.0 } };
    let name = if pale { "" } else { curve.name };
    Series { style, marked: !pale, ..Series::new(name, work, curve.error) }
}

fn is_pale(ink: Ink) -> bool {
    matches!(ink, Ink::Pale(_))
}
