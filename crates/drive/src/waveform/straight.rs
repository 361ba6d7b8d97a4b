//! Linear pieces.

use super::Sample;

/// Linear segment between two corners.
///
/// The value is evaluated from the end with the smaller magnitude, so rounding does not change a sign near 0. The value at the other end is
/// exact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Straight {
    anchor: (f64, f64),
    other: (f64, f64),
    rate: f64,
}

/// Value with a constant rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Line {
    pub(crate) time: f64,
    value: f64,
    pub(crate) rate: f64,
}

impl Line {
    /// Returns the value at a time (s).
    #[inline]
    pub(crate) fn at(&self, t: f64) -> f64 {
        self.value + self.rate * (t - self.time)
    }
}

impl Straight {
    /// Returns the segment between two points (time, value). The rate is computed from the rounded times.
    pub(super) fn between(from: (f64, f64), to: (f64, f64)) -> Self {
        let time = to.0 - from.0;
        let rate = if time > 0.0 { (to.1 - from.1) / time } else { 0.0 };
        let (anchor, other) = if from.1.abs() <= to.1.abs() { (from, to) } else { (to, from) };
        Self { anchor, other, rate }
    }

    /// Returns a segment with a constant `value`; `time` is any finite time.
    pub(super) fn held(time: f64, value: f64) -> Self {
        Self { anchor: (time, value), other: (time, value), rate: 0.0 }
    }

    /// Returns the data of the segment: both ends and the rate.
    pub(super) fn numbers(&self) -> [f64; 5] {
        [self.anchor.0, self.anchor.1, self.other.0, self.other.1, self.rate]
    }

    /// Returns the segment with this data.
    pub(super) fn of([time, value, other, there, rate]: [f64; 5]) -> Self {
        Self { anchor: (time, value), other: (other, there), rate }
    }

    /// Returns the segment as a line; the value at the other end is not exact.
    pub(super) fn line(&self) -> Line {
        Line { time: self.anchor.0, value: self.anchor.1, rate: self.rate }
    }

    #[inline]
    pub(super) fn at(&self, t: f64) -> Sample {
        let value = if t == self.other.0 { self.other.1 } else { self.line().at(t) };
        Sample { value, rate: self.rate, acceleration: 0.0 }
    }
}
