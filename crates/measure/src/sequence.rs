//! Values in order, wherever they lie.

use crate::series::sum;
use std::ops::Range;

/// Values in order: in memory, or on a disk where there are too many. They are read in parts, each from its first to its last.
pub trait Sequence {
    /// How many.
    fn count(&self) -> usize;

    /// Those of a range. What cannot be read is NaN.
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

/// Arithmetic mean of a part; NaN of nothing.
pub(crate) fn mean_of(values: &(impl Sequence + ?Sized), range: Range<usize>) -> f64 {
    let count = range.len();
    sum(values.part(range)) / count as f64
}

/// Half of what lies between the least and the largest of a part.
pub(crate) fn half_range(values: &(impl Sequence + ?Sized), range: Range<usize>) -> f64 {
    let extent = |(low, high): (f64, f64), v: f64| (low.min(v), high.max(v));
    let (low, high) = values.part(range).fold((f64::INFINITY, f64::NEG_INFINITY), extent);
    0.5 * (high - low).max(0.0)
}
