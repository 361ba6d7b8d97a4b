//! Timing of a waveform.

use super::error::{WaveformError, finite, within};
use std::f64::consts::TAU;

/// Timing of a waveform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Period, s, above 0; not used for a table or an input.
    pub period: f64,
    /// Start, s; the first value is held until then. Default 0; must be 0 for an input.
    pub delay: f64,
    /// Phase, rad, which advances the waveform by phase/2π periods. Default 0; must be 0 for a table or an input.
    pub phase: f64,
    /// Number of periods after which the last value is held, above 0. None means endless, and is required for a table or an input. A jump
    /// at the end of the last period still occurs.
    pub cycles: Option<f64>,
}

impl Timing {
    /// Returns an endless timing from t = 0 with this `period` (s).
    #[must_use]
    pub fn every(period: f64) -> Self {
        Self { period, delay: 0.0, phase: 0.0, cycles: None }
    }

    /// Returns the stop time, s; infinite without a limited number of periods.
    pub(super) fn stop(&self) -> f64 {
        self.cycles.map_or(f64::INFINITY, |n| n * self.period + self.delay)
    }

    /// Returns ω², per s², the ratio of acceleration to amplitude.
    pub(super) fn curvature(&self) -> f64 {
        (TAU / self.period).powi(2)
    }

    /// Checks the timing of any waveform.
    pub(super) fn check(&self) -> Result<(), WaveformError> {
        finite("delay", self.delay)?;
        finite("phase", self.phase)
    }

    /// Checks the timing of a periodic waveform.
    pub(super) fn check_period(&self) -> Result<(), WaveformError> {
        within("period", self.period, "a finite number above 0", self.period > 0.0)?;
        self.cycles.map_or(Ok(()), |cycles| within("cycles", cycles, "a finite number above 0", cycles > 0.0))
    }

    /// Checks the timing of a waveform without a period.
    pub(super) fn check_single(&self) -> Result<(), WaveformError> {
        within("phase", self.phase, "0 where there is no period", self.phase == 0.0)?;
        self.cycles.map_or(Ok(()), |cycles| within("cycles", cycles, "none where there is no period", false))
    }

    /// Checks the timing of an input.
    pub(super) fn check_supplied(&self) -> Result<(), WaveformError> {
        self.check_single()?;
        within("delay", self.delay, "0 for an input, which starts with the run", self.delay == 0.0)
    }
}
