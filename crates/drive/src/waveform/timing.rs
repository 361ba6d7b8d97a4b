//! When a waveform runs.

use super::error::{WaveformError, finite, within};
use std::f64::consts::TAU;

/// When a waveform runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Period, s, above 0; a table or an input has none and ignores it.
    pub period: f64,
    /// Start, s; before it the first value is held. Default 0, and 0 for an input.
    pub delay: f64,
    /// Advances the waveform by phase/2π periods, rad; default 0, and 0 for a table or an input.
    pub phase: f64,
    /// Periods after which the last value is held, above 0; none: for ever. None for a table or an input. A jump that ends the last
    /// period still takes place: it is the limit of a short flyback.
    pub cycles: Option<f64>,
}

impl Timing {
    /// From t = 0 for ever, with this `period` (s).
    #[must_use]
    pub fn every(period: f64) -> Self {
        Self { period, delay: 0.0, phase: 0.0, cycles: None }
    }

    /// When it stops, s; infinite where it runs for ever.
    pub(super) fn stop(&self) -> f64 {
        self.cycles.map_or(f64::INFINITY, |n| n * self.period + self.delay)
    }

    /// ω², per s²: what turns an amplitude into an acceleration.
    pub(super) fn curvature(&self) -> f64 {
        (TAU / self.period).powi(2)
    }

    /// Of any waveform.
    pub(super) fn check(&self) -> Result<(), WaveformError> {
        finite("delay", self.delay)?;
        finite("phase", self.phase)
    }

    /// Of a waveform with a period.
    pub(super) fn check_period(&self) -> Result<(), WaveformError> {
        within("period", self.period, "a finite number above 0", self.period > 0.0)?;
        self.cycles.map_or(Ok(()), |cycles| within("cycles", cycles, "a finite number above 0", cycles > 0.0))
    }

    /// Of a waveform without a period.
    pub(super) fn check_single(&self) -> Result<(), WaveformError> {
        within("phase", self.phase, "0 where there is no period", self.phase == 0.0)?;
        self.cycles.map_or(Ok(()), |cycles| within("cycles", cycles, "none where there is no period", false))
    }

    /// Of an input, whose caller alone says when.
    pub(super) fn check_supplied(&self) -> Result<(), WaveformError> {
        self.check_single()?;
        within("delay", self.delay, "0 for an input, which starts with the run", self.delay == 0.0)
    }
}
