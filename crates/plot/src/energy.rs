//! The energy balance of a run: input, losses and stored energies.

use crate::figure::{Arrangement, Figure};
use crate::panel::{Axis, Band, Panel, Reference, Series};
use crate::theme::{Ink, Style};
use crate::{Dash, Label};

/// Energies over time. The balance is input = friction + damping + changes of kinetic and elastic energy + error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnergyBook<'a> {
    /// Time, s.
    pub time: &'a [f64],
    /// Work of prescribed motions, loads and gravity since the start, J.
    pub input: &'a [f64],
    /// Kinetic energy, J.
    pub kinetic: &'a [f64],
    /// Elastic energy, J.
    pub elastic: &'a [f64],
    /// Friction work since the start, J.
    pub friction: &'a [f64],
    /// Work of dampers since the start, J.
    pub damping: &'a [f64],
    /// Error of the balance, J.
    pub error: &'a [f64],
}

/// Fraction of the tallest area below which an area is not drawn.
const THIN: f64 = 1e-3;
/// Fraction of the largest energy below which the error is not shown.
const SMALL: f64 = 1e-6;

/// Draws the input as a curve over stacked areas of friction, damping and stored energy since the start. Where less
/// energy is stored than at the start, the released part is drawn over the losses. Panels below show the kinetic
/// energy, the elastic energy, and the error unless it is negligible.
pub fn energy_figure<'a>(title: &str, book: &EnergyBook<'a>) -> Figure<'a> {
    let panel = |label: &str, values: &'a [f64], ink, share| Panel {
        x: Axis { tight: true, ..Axis::new(Label::plain("time t"), "s") },
        y: Axis::new(Label::plain(label), "J"),
        series: vec![Series {
            style: Style { ink: Some(ink), dash: Some(Dash::Solid), width: 0.7 },
            ..Series::new("", book.time, values)
        }],
        share,
        ..Panel::default()
    };
    let mut balance = panel("energy", book.input, Ink::Foreground, 2.6);
    balance.series[0].label = Label::plain("input");
    balance.bands = areas(book);
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let scale = [book.input, book.kinetic, book.elastic, book.friction, book.damping].map(largest);
    let is_seen = largest(book.error) > SMALL * scale.into_iter().fold(0.0, f64::max);
    let error = is_seen.then(|| Panel {
        references: vec![Reference::Horizontal { y: 0.0, label: Label::default() }],
        ..panel("error", book.error, Ink::Foreground, 0.7)
    });
    // Models without masses have no kinetic energy.
    let moves = book.kinetic.iter().any(|kinetic| *kinetic != 0.0);
    let kinetic = moves.then(|| panel("kinetic", book.kinetic, Ink::Palette(1), 0.9));
    let elastic = panel("elastic", book.elastic, Ink::Palette(0), 0.9);
    Figure {
        title: Label::plain(title),
        panels: [Some(balance), kinetic, Some(elastic), error].into_iter().flatten().collect(),
        arrangement: Arrangement::Column { share_x: true },
        size: Figure::size_for(1500, 0, 0),
        ..Figure::default()
    }
}

/// Returns the stacked areas of friction, damping and stored energy.
fn areas<'a>(book: &EnergyBook<'a>) -> Vec<Band<'a>> {
    let both = book.friction.iter().zip(book.damping);
    let lost: Vec<f64> = both.map(|(friction, damping)| friction + damping).collect();
    let band = |name: &str, low: Vec<f64>, high: Vec<f64>, ink| Band {
        label: Label::plain(name),
        xs: book.time.into(),
        low: low.into(),
        high: high.into(),
        ink,
    };
    let stored = since_start(book.kinetic).into_iter().zip(since_start(book.elastic)).map(|(k, e)| k + e);
    let (gained, used): (Vec<f64>, Vec<f64>) =
        stored.zip(&lost).map(|(stored, lost)| (lost + stored.max(0.0), lost + stored.min(0.0))).unzip();
    let zeros = vec![0.0; book.friction.len()];
    let mut bands = vec![band("friction", zeros, book.friction.to_vec(), Ink::Shade(1))];
    if book.damping.iter().any(|damping| *damping != 0.0) {
        bands.push(band("damping", book.friction.to_vec(), lost.clone(), Ink::Shade(3)));
    }
    // Released energy is drawn only if its area is visible.
    let tallest = gained.iter().copied().fold(0.0, f64::max);
    let is_used = used.iter().zip(&lost).any(|(used, lost)| lost - used > THIN * tallest);
    bands.push(band("stored", lost.clone(), gained, Ink::Shade(2)));
    if is_used {
        bands.push(band("released", used, lost, Ink::Pale(0)));
    }
    bands
}

fn since_start(values: &[f64]) -> Vec<f64> {
    let start = values.first().copied().unwrap_or(0.0);
    values.iter().map(|value| value - start).collect()
}
