//! Sequences of values in memory or on disk.

use crate::series::sum;
use std::ops::Range;

/// A sequence of values that can be read in parts, from memory or from disk.
pub trait Sequence {
    /// Returns the number of values.
    fn count(&self) -> usize;

    /// Iterates over the values of an index range. Unreadable values are NaN.
    fn part(&self, range: Range<usize>) -> impl Iterator<Item = f64>;
}

impl<T: AsRef<[f64]> + ?Sized> Sequence for T {
    fn count(&self) -> usize {
        self.as_ref().len()
    }

    fn part(&self, range: Range<usize>) -> impl Iterator<Item = f64> {
        self.as_ref().get(range).unwrap_or_default().iter().copied()
    }
}

/// Returns the arithmetic mean of the values in an index range, or NaN for an empty range.
pub(crate) fn mean_of(values: &(impl Sequence + ?Sized), range: Range<usize>) -> f64 {
    let count = range.len();
    sum(values.part(range)) / count as f64
}

/// Returns half the difference between the maximum and the minimum of the values in an index range.
pub(crate) fn half_range(values: &(impl Sequence + ?Sized), range: Range<usize>) -> f64 {
    let extent = |(low, high): (f64, f64), v: f64| (low.min(v), high.max(v));
    let (low, high) = values.part(range).fold((f64::INFINITY, f64::NEG_INFINITY), extent);
    0.5 * (high - low).max(0.0)
}
