//! Comparison of a deviation with its limit.

use crate::table::significant;
use std::fmt;

/// A deviation from a known result, with its limit.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// Quantity that is compared.
    pub what: String,
    /// Unit of both numbers; empty for relative deviations.
    pub unit: &'static str,
    /// Largest deviation found.
    pub found: f64,
    /// Largest allowed deviation.
    pub allowed: f64,
}

impl Check {
    /// Creates a check of a deviation in a unit.
    pub(crate) fn new(what: &str, unit: &'static str, found: f64, allowed: f64) -> Self {
        Self { what: what.to_owned(), unit, found: found.abs(), allowed }
    }

    /// Returns whether the deviation is within its limit. NaN is not.
    pub fn holds(&self) -> bool {
        self.found <= self.allowed
    }

    /// Formats the deviation with three digits, or as "below …" if it is negligible relative to the limit.
    // Digits of rounding errors differ between machines and would change the pages.
    pub(crate) fn found_in_words(&self) -> String {
        let nothing = if self.allowed < ROUNDING { self.allowed } else { NOTHING * self.allowed };
        if self.found < nothing {
            format!("below {}", self.quantity(nothing, 2))
        } else {
            self.quantity(self.found, 3)
        }
    }

    /// Formats the limit.
    pub(crate) fn allowed_in_words(&self) -> String {
        self.quantity(self.allowed, 2)
    }

    fn quantity(&self, value: f64, digits: usize) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        format!("{}{unit}", significant(value, digits))
    }
}

impl fmt::Display for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}, asked at most {}", self.what, self.found_in_words(), self.allowed_in_words())
    }
}

/// Limits below this value are met up to rounding errors.
const ROUNDING: f64 = 1e-7;
/// Fraction of the limit below which a deviation is negligible.
const NOTHING: f64 = 1e-3;

/// Returns the root mean square.
pub(crate) fn rms(deviations: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for deviation in deviations {
        sum += deviation * deviation;
        count += 1.0;
    }
    (sum / count).sqrt()
}

/// Returns the largest absolute deviation, or NaN if one is NaN.
pub(crate) fn worst(deviations: impl IntoIterator<Item = f64>) -> f64 {
    deviations.into_iter().map(f64::abs).fold(0.0, |worst, x| if x.is_nan() || x > worst { x } else { worst })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_is_never_good_enough() {
        let check = |found, allowed| Check::new("it", "", found, allowed);
        assert!(check(-0.1, 0.1).holds() && !check(0.11, 0.1).holds() && !check(f64::NAN, 0.1).holds());
        assert!(worst([0.1, f64::NAN, 0.2]).is_nan() && rms([]).is_nan());
        assert!((rms([3.0, -4.0]) - 12.5_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn rounding_is_told_by_its_limit() {
        assert_eq!(Check::new("it", "N", 3.4e-14, 1e-10).found_in_words(), "below 1e-10 N");
        assert_eq!(Check::new("it", "N", 3.4e-9, 1e-10).found_in_words(), "3.40e-9 N");
        assert_eq!(Check::new("it", "N", 1e-13, 1e-6).found_in_words(), "below 1e-9 N");
        assert_eq!(Check::new("it", "", 0.012_34, 0.014).found_in_words(), "0.0123");
    }
}
