//! The energy book of a run: what went in and where it went.

use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Band, Panel, Reference, Series};
use crate::theme::{Ink, Style};
use crate::{Dash, Label};

/// Energies over time. The book closes when input = friction + damping + changes of kinetic and elastic + error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnergyBook<'a> {
    /// Time, s.
    pub time: &'a [f64],
    /// Work of followers, loads and gravity since the start, J.
    pub input: &'a [f64],
    /// Kinetic energy, J.
    pub kinetic: &'a [f64],
    /// Elastic energy, J.
    pub elastic: &'a [f64],
    /// Friction work since the start, J.
    pub friction: &'a [f64],
    /// Work of dampers since the start, J.
    pub damping: &'a [f64],
    /// What the book does not account for, J.
    pub error: &'a [f64],
}

/// Above, the input as a line over the areas of what it became: friction, damping, and what is stored since the
/// start. Below, the two stores by themselves, as changes since the start, and the error of the book.
pub fn energy_figure<'a>(title: &str, book: &EnergyBook<'a>) -> Figure<'a> {
    let time = Axis { tight: true, ..Axis::new(Label::plain("time t"), "s") };
    let axis = |label: &str| Axis::new(Label::plain(label), "J");
    let lost: Vec<f64> =
        book.friction.iter().zip(book.damping).map(|(friction, damping)| friction + damping).collect();
    let line = |name: &str, values: Vec<f64>, ink, width| Series {
        style: Style { ink: Some(ink), dash: Some(Dash::Solid), width },
        ..Series::new(name, book.time, values)
    };
    let mut stores = vec![
        line("elastic", since_start(book.elastic), Ink::Palette(0), 1.0),
        line("kinetic", since_start(book.kinetic), Ink::Palette(1), 1.0),
    ];
    // The larger behind the smaller.
    stores.sort_by(|a, b| f64::total_cmp(&largest(&b.ys), &largest(&a.ys)));
    let zero = Reference::Horizontal { y: 0.0, label: Label::default() };
    let panels = vec![
        Panel {
            x: time.clone(),
            y: axis("energy"),
            bands: areas(book, &lost),
            series: vec![line("input", book.input.to_vec(), Ink::Foreground, 0.6)],
            share: 2.2,
            ..Panel::default()
        },
        Panel {
            x: time.clone(),
            y: axis("stored"),
            series: stores,
            references: vec![zero.clone()],
            share: 1.2,
            ..Panel::default()
        },
        Panel {
            x: time,
            y: axis("error"),
            series: vec![line("", book.error.to_vec(), Ink::Foreground, 0.6)],
            references: vec![zero],
            share: 0.7,
            ..Panel::default()
        },
    ];
    Figure {
        title: Label::plain(title),
        panels,
        arrangement: Arrangement::Column { share_x: true },
        size: Figure::size_for(1300, 0, 0),
        ..Figure::default()
    }
}

/// Friction, damping and the stored energy, one on the other.
fn areas<'a>(book: &EnergyBook<'a>, lost: &[f64]) -> Vec<Band<'a>> {
    let band = |name: &str, low: Vec<f64>, high: Vec<f64>, ink| Band {
        label: Label::plain(name),
        xs: book.time.into(),
        low: low.into(),
        high: high.into(),
        ink,
    };
    let stored = since_start(book.kinetic).into_iter().zip(since_start(book.elastic)).map(|(k, e)| k + e);
    let all = stored.zip(lost).map(|(stored, lost)| stored + lost).collect();
    let zeros = vec![0.0; book.friction.len()];
    let mut bands = vec![band("friction", zeros, book.friction.to_vec(), Ink::Shade(1))];
    if book.damping.iter().any(|damping| *damping != 0.0) {
        bands.push(band("damping", book.friction.to_vec(), lost.to_vec(), Ink::Shade(3)));
    }
    // Over the others: what was stored at the start and is used up reaches down into them.
    bands.push(band("stored since the start", lost.to_vec(), all, Ink::Shade(2)));
    bands
}

/// Largest finite magnitude.
fn largest(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).filter(|value| value.is_finite()).fold(0.0, f64::max)
}

fn since_start(values: &[f64]) -> Vec<f64> {
    let start = values.first().copied().unwrap_or(0.0);
    values.iter().map(|value| value - start).collect()
}
