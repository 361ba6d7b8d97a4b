//! Forward stroke and flyback, which sawtooth and cycloid have in common.

use super::Way;
use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::{Timing, WaveformError};

/// Both strokes of one period.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flyback {
    /// Peak-to-peak value, of any sign.
    pub(super) stroke: f64,
    /// Duration of the forward stroke, s.
    pub(super) rise: f64,
    /// Duration of the shorter stroke, s.
    pub(super) shortest: f64,
}

impl Flyback {
    /// Checks the flyback. Fails if the flyback is negative or leaves no time for the forward stroke.
    pub(super) fn new(stroke: f64, flyback: f64, timing: &Timing) -> Result<Self, WaveformError> {
        timing.check_period()?;
        let period = timing.period;
        if !(flyback >= 0.0 && period - flyback > 0.0) {
            return Err(WaveformError::Flyback { period, got: flyback });
        }
        let rise = period - flyback;
        Ok(Self { stroke, rise, shortest: if flyback > 0.0 { flyback.min(rise) } else { rise } })
    }

    /// Returns the chain of pieces with segments of the form `way`; `wave` is the duration of the shortest wave (s).
    pub(super) fn course(&self, way: Way, wave: f64, timing: &Timing) -> Course {
        let Self { stroke, rise, .. } = *self;
        let legs =
            [Leg { start: 0.0, values: (0.0, stroke), way }, Leg { start: rise, values: (stroke, 0.0), way }];
        Course {
            chain: Chain::Corners(Corners::periodic(&legs, timing)),
            ends: None,
            period: Some(timing.period),
            range: (stroke.min(0.0), stroke.max(0.0)),
            wave,
            has_jumps: stroke != 0.0 && rise >= timing.period,
        }
    }
}
