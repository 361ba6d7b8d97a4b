//! Sawtooth: linear forward stroke, linear flyback.

use super::Way;
use super::flyback::Flyback;
use crate::waveform::course::Course;
use crate::waveform::error::smooth;
use crate::waveform::{Timing, WaveformError};

/// Returns linear pieces, two per period; without a flyback one piece and a jump.
pub(super) fn course(stroke: f64, flyback: f64, timing: &Timing) -> Result<Course, WaveformError> {
    let ways = Flyback::new(stroke, flyback, timing)?;
    smooth("stroke", stroke, stroke / ways.shortest)?;
    Ok(ways.course(Way::Straight, f64::INFINITY, timing))
}
