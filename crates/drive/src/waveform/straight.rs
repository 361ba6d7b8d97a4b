//! Straight pieces.

use super::Sample;

/// A straight way between two corners.
///
/// It is anchored at the end with the smaller magnitude: where a value falls to 0 or rises from it, rounding cannot
/// carry it to the other side. The other end is set exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Straight {
    anchor: (f64, f64),
    other: (f64, f64),
    rate: f64,
}

/// A value that moves at a constant rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Line {
    pub(crate) time: f64,
    value: f64,
    pub(crate) rate: f64,
}

impl Line {
    /// Value at a time, s.
    #[inline]
    pub(crate) fn at(&self, t: f64) -> f64 {
        self.value + self.rate * (t - self.time)
    }
}

impl Straight {
    /// From one (time, value) to the other; the rate belongs to the rounded times, so that value and rate agree.
    pub(super) fn between(from: (f64, f64), to: (f64, f64)) -> Self {
        let time = to.0 - from.0;
        let rate = if time > 0.0 { (to.1 - from.1) / time } else { 0.0 };
        let (anchor, other) = if from.1.abs() <= to.1.abs() { (from, to) } else { (to, from) };
        Self { anchor, other, rate }
    }

    /// Held at `value`; `time` is any finite time.
    pub(super) fn held(time: f64, value: f64) -> Self {
        Self { anchor: (time, value), other: (time, value), rate: 0.0 }
    }

    /// Both its ends as they are anchored, and its rate: the numbers it is made of.
    pub(super) fn numbers(&self) -> [f64; 5] {
        [self.anchor.0, self.anchor.1, self.other.0, self.other.1, self.rate]
    }

    /// Of these.
    pub(super) fn of([time, value, other, there, rate]: [f64; 5]) -> Self {
        Self { anchor: (time, value), other: (other, there), rate }
    }

    /// Its line, whose other end is not set exactly.
    pub(super) fn line(&self) -> Line {
        Line { time: self.anchor.0, value: self.anchor.1, rate: self.rate }
    }

    #[inline]
    pub(super) fn at(&self, t: f64) -> Sample {
        let value = if t == self.other.0 { self.other.1 } else { self.line().at(t) };
        Sample { value, rate: self.rate, acceleration: 0.0 }
    }
}
