//! How far a waveform has turned: what its sines share.

use super::harmonics::Harmonic;
use crate::waveform::{Sample, Timing};
use std::f64::consts::TAU;

/// Angle of a waveform and its rate at one time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    /// rad, between 0 and 2π before the phase is added.
    angle: f64,
    /// rad/s.
    omega: f64,
}

impl Turn {
    #[inline]
    pub(super) fn at(timing: &Timing, t: f64) -> Self {
        let turns = (t - timing.delay) / timing.period;
        // Whole turns are taken off before the multiplication by 2π, whose rounding they would magnify.
        Self { angle: TAU * (turns - turns.floor()) + timing.phase, omega: TAU / timing.period }
    }

    /// One sine and its derivatives.
    #[inline]
    pub(super) fn term(&self, harmonic: Harmonic) -> Sample {
        let order = harmonic.order;
        let (sin, cos) = (order * self.angle + harmonic.phase).sin_cos();
        let (value, speed) = (harmonic.amplitude * sin, order * self.omega);
        Sample { value, rate: harmonic.amplitude * speed * cos, acceleration: -value * speed * speed }
    }
}
