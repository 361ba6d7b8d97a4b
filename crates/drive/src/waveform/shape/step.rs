//! Step: a single jump from 0.

use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{finite, smooth};
use crate::waveform::{Timing, WaveformError};

/// Returns a chain without pieces between two constant values.
pub(super) fn course(height: f64, at: f64, timing: &Timing) -> Result<Course, WaveformError> {
    timing.check_single()?;
    finite("height", height)?;
    smooth("at", at, timing.delay + at)?;
    Ok(Course {
        chain: Chain::Step(timing.delay + at),
        ends: Some((0.0, height)),
        period: None,
        range: (height.min(0.0), height.max(0.0)),
        wave: f64::INFINITY,
        has_jumps: height != 0.0,
    })
}
