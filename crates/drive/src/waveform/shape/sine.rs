//! Sine: offset + amplitude sin(ωt + phase).

use super::Sines;
use super::harmonics::Harmonic;
use super::turn::Turn;
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{finite, smooth};
use crate::waveform::{Sample, Timing, WaveformError};

/// Single sine about a mean value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::waveform) struct Sine {
    pub(super) amplitude: f64,
    pub(super) phase: f64,
    pub(super) offset: f64,
}

impl Sine {
    #[inline]
    pub(super) fn at(&self, turn: Turn) -> Sample {
        let term = turn.term(Harmonic { amplitude: self.amplitude, order: 1.0, phase: self.phase });
        Sample { value: self.offset + term.value, ..term }
    }

    /// Returns the sine as one smooth piece from start to stop.
    pub(super) fn course(self, timing: &Timing) -> Result<Course, WaveformError> {
        timing.check_period()?;
        let Self { amplitude, phase, offset } = self;
        smooth("amplitude", amplitude, amplitude * timing.curvature())?;
        finite("phase", phase)?;
        smooth("offset", offset, offset.abs() + amplitude.abs())?;
        Ok(Course {
            chain: Chain::Sines(Sines::One(self)),
            ends: None,
            period: Some(timing.period),
            range: (offset - amplitude.abs(), offset + amplitude.abs()),
            wave: timing.period,
            has_jumps: false,
        })
    }
}
