//! Axisymmetric profile f(r) and its one-dimensional MDR profile g(x).

use crate::Label;
use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Panel, Reference, Series};
use crate::theme::{Dash, Ink, Style};

/// Axisymmetric profile f(r) and the equivalent one-dimensional profile g(x).
#[derive(Debug, Clone, PartialEq)]
pub struct ProfilePair<'a> {
    /// Distances r or x from the axis, m, ascending from 0.
    pub x: &'a [f64],
    /// Profile f(r) at each distance, m; `None` for a list of springs.
    pub f: Option<&'a [f64]>,
    /// MDR profile g(x) at each distance, m.
    pub g: &'a [f64],
    /// Indentation, m.
    pub d: f64,
    /// Contact radius, m.
    pub a: f64,
}

/// Minimum range shown, as a multiple of the contact radius.
const BEYOND: f64 = 1.15;

/// Draws both profiles on both sides of the axis, with the indentation d and the contact radius ±a.
pub fn profile_figure<'a>(title: &str, pair: &ProfilePair<'a>) -> Figure<'a> {
    let curve = |label: &str, values: &[f64], place: usize| {
        let right: Vec<(f64, f64)> = pair.x.iter().copied().zip(values.iter().copied()).collect();
        let left = right.iter().rev().filter(|(x, _)| *x > 0.0).map(|(x, value)| (-x, *value));
        let (xs, ys): (Vec<f64>, Vec<f64>) = left.chain(right.iter().copied()).unzip();
        let style = Style { ink: Some(Ink::Palette(place)), dash: Some(Dash::at(place)), width: 1.1 };
        Series { style, ..Series::new(Label::plain(label), xs, ys) }
    };
    let three = pair.f.map(|f| curve("f(r), in three dimensions", f, 1));
    let level = Reference::Horizontal { y: pair.d, label: Label::plain("indentation d") };
    let rims =
        [-pair.a, pair.a].map(|x| Reference::Vertical { x, label: Label::plain("contact radius ±a") });
    let references = if pair.a > 0.0 { [vec![level], rims.to_vec()].concat() } else { Vec::new() };
    // The profile of a flat punch ends at its edges, which must be visible.
    let around = (pair.a > 0.0).then_some((-BEYOND * pair.a, BEYOND * pair.a));
    let panel = Panel {
        x: Axis { tight: true, covers: around, ..Axis::new(Label::plain("r, x"), "m") },
        y: Axis::new(Label::plain("height"), "m"),
        series: std::iter::once(curve("g(x), pressed into the row of springs", pair.g, 0))
            .chain(three)
            .collect(),
        references,
        ..Panel::default()
    };
    Figure {
        title: Label::plain(title),
        panels: vec![panel],
        arrangement: Arrangement::Row,
        size: Figure::size_for(900, 0, 0),
        ..Figure::default()
    }
    .with_room_for_legends()
}
