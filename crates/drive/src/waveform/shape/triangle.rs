//! Triangle: linear to the stroke in half a period, then linear return.

use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::smooth;
use crate::waveform::{Timing, WaveformError};

/// Returns linear pieces, two per period.
pub(super) fn course(stroke: f64, timing: &Timing) -> Result<Course, WaveformError> {
    timing.check_period()?;
    smooth("stroke", stroke, 2.0 * stroke / timing.period)?;
    let top = 0.5 * timing.period;
    let legs = [Leg::straight(0.0, (0.0, stroke)), Leg::straight(top, (stroke, 0.0))];
    Ok(Course {
        chain: Chain::Corners(Corners::periodic(&legs, timing)),
        ends: None,
        period: Some(timing.period),
        range: (stroke.min(0.0), stroke.max(0.0)),
        wave: f64::INFINITY,
        has_jumps: false,
    })
}
