//! Parabola: constant acceleration from rest, a turn, and the mirrored motion.
//!
//! A slider sticks to the moving foot while the acceleration is below μF_N/m, and thus reaches the largest velocity that friction allows.
//! The slider slips during the turn at the stroke, which may be a cusp. With stroke S, period T and turn τ, the velocity at the turn is V =
//! 4S/T. The acceleration is 2V/(T-τ), during the turn -2V/τ.

use super::Way;
use super::cubic::Cubic;
use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::smooth;
use crate::waveform::{Timing, WaveformError};

/// Returns parabolic pieces, three per period; two if the turn has zero duration.
pub(super) fn course(stroke: f64, turn: f64, timing: &Timing) -> Result<Course, WaveformError> {
    timing.check_period()?;
    let period = timing.period;
    if !(turn >= 0.0 && period - turn > 0.0) {
        return Err(WaveformError::Turn { period, got: turn });
    }
    let half = 0.5 * (period - turn);
    let shortest = if turn > 0.0 { turn.min(half) } else { half };
    let speed = 4.0 * (stroke / period);
    smooth("stroke", stroke, speed / shortest)?;
    // ½aτ² = ½V·half; the turn has the rest of the stroke, ¼Vτ.
    let shoulder = 0.5 * speed * half;
    let leg = |start: f64, values: (f64, f64), rates: (f64, f64)| Leg {
        start,
        values,
        way: Way::Cubic(Cubic::new(rates.0, rates.1)),
    };
    let legs = [
        leg(0.0, (0.0, shoulder), (0.0, speed)),
        leg(half, (shoulder, shoulder), (speed, -speed)),
        leg(half + turn, (shoulder, 0.0), (-speed, 0.0)),
    ];
    Ok(Course {
        chain: Chain::Corners(Corners::periodic(&legs, timing)),
        ends: None,
        period: Some(period),
        range: (stroke.min(0.0), stroke.max(0.0)),
        wave: f64::INFINITY,
        has_jumps: false,
    })
}
