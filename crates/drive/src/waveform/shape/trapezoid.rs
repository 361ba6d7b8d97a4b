//! Trapezoid: linear rise to the stroke, hold, linear fall, rest.

use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{smooth, within};
use crate::waveform::{Timing, WaveformError};

/// Relative rounding error by which the durations may exceed a period.
const ROUNDING: f64 = 1e-12;

/// Returns linear pieces, four per period; fewer if a duration is zero.
pub(super) fn course(
    stroke: f64,
    [rise, hold, fall]: [f64; 3],
    timing: &Timing,
) -> Result<Course, WaveformError> {
    timing.check_period()?;
    let period = timing.period;
    for (key, time) in [("rise", rise), ("hold", hold), ("fall", fall)] {
        within(key, time, "a time of at least 0", time >= 0.0)?;
    }
    let busy = rise + hold + fall;
    let fits = busy > 0.0 && busy <= period * (1.0 + ROUNDING);
    if !fits {
        return Err(WaveformError::Busy { period, got: busy });
    }
    for time in [rise, fall] {
        smooth("stroke", stroke, if time > 0.0 { stroke / time } else { 0.0 })?;
    }
    let down = (rise + hold).min(period);
    let legs = [
        Leg::straight(0.0, (0.0, stroke)),
        Leg::straight(rise.min(period), (stroke, stroke)),
        Leg::straight(down, (stroke, 0.0)),
        Leg::straight((down + fall).min(period), (0.0, 0.0)),
    ];
    Ok(Course {
        chain: Chain::Corners(Corners::periodic(&legs, timing)),
        ends: None,
        period: Some(period),
        range: (stroke.min(0.0), stroke.max(0.0)),
        wave: f64::INFINITY,
        has_jumps: stroke != 0.0 && (rise == 0.0 || fall == 0.0),
    })
}
