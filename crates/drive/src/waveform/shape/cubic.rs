//! Cubic segments between two corners, given by values and rates.

use crate::waveform::Sample;

/// Cubic segment, given by the rates at its ends (per s).
///
/// With the duration h and the mean rate Δ, the segment is value₀ + s(r₀ + s(c + s d)), c = (3Δ - 2r₀ - r₁)/h, d = (r₀ + r₁ - 2Δ)/h²
/// (Hermite). The acceleration is constant if r₀ + r₁ = 2Δ; the jerk is 6d.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::waveform) struct Cubic {
    pub(super) rates: (f64, f64),
}

impl Cubic {
    pub(super) fn new(first: f64, last: f64) -> Self {
        Self { rates: (first, last) }
    }

    /// Returns the segment reversed in time.
    pub(super) fn reversed(self) -> Self {
        Self { rates: (-self.rates.1, -self.rates.0) }
    }

    /// Returns value and derivatives at `t` (s). Each half is evaluated from its own end of the segment. Values at the ends are thus exact,
    /// and rounding does not change a sign near 0.
    pub(super) fn at(self, from: (f64, f64), to: (f64, f64), t: f64) -> Sample {
        let (first, last) = self.rates;
        let time = to.0 - from.0;
        if time <= 0.0 {
            return Sample { value: to.1, rate: last, acceleration: 0.0 };
        }
        let mean = (to.1 - from.1) / time;
        let d = (first + last - 2.0 * mean) / (time * time);
        let (s, value, rate, c) = if t - from.0 <= 0.5 * time {
            (t - from.0, from.1, first, (3.0 * mean - 2.0 * first - last) / time)
        } else {
            (t - to.0, to.1, last, (first + 2.0 * last - 3.0 * mean) / time)
        };
        Sample {
            value: value + s * (rate + s * (c + s * d)),
            rate: rate + s * (2.0 * c + 3.0 * s * d),
            acceleration: 2.0 * c + 6.0 * s * d,
        }
    }
}
