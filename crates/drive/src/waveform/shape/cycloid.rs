//! Cycloid: a sawtooth with zero velocity and acceleration at both ends of each stroke.

use super::Way;
use super::flyback::Flyback;
use crate::waveform::course::Course;
use crate::waveform::error::smooth;
use crate::waveform::{Sample, Timing, WaveformError};
use std::f64::consts::{PI, TAU};

/// Returns cycloidal pieces, two per period; without a flyback one piece and a jump.
pub(super) fn course(stroke: f64, flyback: f64, timing: &Timing) -> Result<Course, WaveformError> {
    let ways = Flyback::new(stroke, flyback, timing)?;
    smooth("stroke", stroke, stroke / ways.shortest * (TAU / ways.shortest))?;
    Ok(ways.course(Way::Cycloid, ways.shortest, timing))
}

/// Cycloidal segment: value₀ + Δ(τ - sin(2πτ)/2π), τ = (t - t₀)/(t₁ - t₀).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::waveform) struct Cycloid {
    from: (f64, f64),
    to: (f64, f64),
}

impl Cycloid {
    pub(super) fn between(from: (f64, f64), to: (f64, f64)) -> Self {
        Self { from, to }
    }

    #[inline]
    pub(super) fn at(&self, t: f64) -> Sample {
        if t == self.to.0 {
            return Sample { value: self.to.1, rate: 0.0, acceleration: 0.0 };
        }
        let (time, rise) = (self.to.0 - self.from.0, self.to.1 - self.from.1);
        let part = (t - self.from.0) / time;
        // Half angles: 1 - cos 2πτ = 2 sin² πτ avoids cancellation at the start.
        let (sin, cos) = math::sin_cos(PI * part);
        let mean = rise / time;
        Sample {
            value: self.from.1 + rise * (part - sin * cos / PI),
            rate: mean * 2.0 * sin * sin,
            acceleration: mean / time * 2.0 * TAU * sin * cos,
        }
    }
}
