//! Range checks and texts of ranges.

use crate::fault::Fault;
use crate::path::At;
use crate::quantity::{Dimension, Quantity, SMALLEST};
use crate::units::Kind;

/// Returns the value of a quantity that must be above zero.
pub(super) fn above_zero<D: Dimension>(at: &At<'_>, quantity: Quantity<D>) -> Result<f64, Fault> {
    if quantity.si >= SMALLEST {
        return Ok(quantity.si);
    }
    Err(at.expected(if quantity.si > 0.0 { least(D::KIND) } else { above(D::KIND) }))
}

/// Returns the value of a quantity that must be at least zero.
pub(super) fn at_least_zero<D: Dimension>(at: &At<'_>, quantity: Quantity<D>) -> Result<f64, Fault> {
    if quantity.si >= 0.0 {
        return Ok(quantity.si);
    }
    Err(at.expected(at_least(D::KIND)))
}

/// Returns the message text for a quantity above zero.
pub(super) fn above(kind: Kind) -> String {
    format!("{} above 0 {}", kind.article(), kind.si())
}

/// Returns the message text for a quantity of at least [`SMALLEST`].
pub(super) fn least(kind: Kind) -> String {
    format!("{} of at least {SMALLEST:e} {}", kind.article(), kind.si())
}

/// Returns the message text for a quantity of at least zero.
pub(super) fn at_least(kind: Kind) -> String {
    format!("{} of at least 0 {}", kind.article(), kind.si())
}

/// Message text for a number above zero.
pub(super) const ABOVE: &str = "a number above 0";

/// Returns a number that must be finite and above zero.
pub(super) fn number_above_zero(at: &At<'_>, value: f64) -> Result<f64, Fault> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(at.expected(ABOVE)) }
}

/// Returns a number that must lie between two bounds, both included.
pub(super) fn number_between(at: &At<'_>, value: f64, low: f64, high: f64) -> Result<f64, Fault> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    Err(at.expected(format_args!("a number between {} and {}", plain(low), plain(high))))
}

/// Returns an integer that must lie between two bounds, both included.
pub(super) fn count_between(at: &At<'_>, value: u64, low: u64, high: u64) -> Result<u64, Fault> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    Err(at.expected(format_args!("a whole number between {low} and {high}")))
}

/// Formats a computed number with six digits.
pub(super) fn short(value: f64) -> String {
    let rounded = format!("{value:.5e}").parse().unwrap_or(value);
    if rounded != 0.0 && !(1e-3..1e6).contains(&f64::abs(rounded)) {
        format!("{rounded:e}")
    } else {
        format!("{rounded}")
    }
}

/// Formats a number without rounding; small numbers get an exponent.
fn plain(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-3 { format!("{value:e}") } else { format!("{value}") }
}
