//! Parabola: from rest along a constant acceleration, round a turn, back along the mirror image.
//!
//! A foot under a constant acceleration carries a slider as long as that is below μ times the load over the mass, and reaches the
//! largest speed that friction allows; the turn at the top, a cusp in the limit, is too fast for it. With stroke S, period T
//! and turn τ the speed at the turn is V = 4S/T, the acceleration 2V/(T-τ), that of the turn -2V/τ.

use super::Way;
use super::cubic::Cubic;
use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::smooth;
use crate::waveform::{Timing, WaveformError};

/// Parabolic pieces, three in a period; two without a turn.
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
    // ½aτ² = ½V·half: what is left of the stroke is the height of the turn, ¼Vτ.
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
