//! Rate-limited sawtooth.
//!
//! The requested sawtooth rises at rate s in the time T-τ and falls in the flyback τ. The output falls at the rate limit r and meets the
//! requested sawtooth in the next rise, at the time u = (S - rτ)/(r + s) after the end of the period. Then the output follows the request
//! to the top. Except in the first period, the stroke is reduced by s·u, and the flyback takes τ + u.

use super::flyback::Flyback;
use super::sawtooth;
use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{smooth, within};
use crate::waveform::{Timing, WaveformError};
use std::f64::consts::TAU;

/// Returns linear pieces, two per period. Without a phase the waveform starts at 0 and lags from its first flyback on; with a phase it
/// starts in its periodic form.
pub(super) fn course(stroke: f64, flyback: f64, rate: f64, timing: &Timing) -> Result<Course, WaveformError> {
    let ways = Flyback::new(stroke, flyback, timing)?;
    within("rate", rate, "a finite rate above 0", rate > 0.0)?;
    let size = ways.stroke.abs();
    smooth("stroke", stroke, size / ways.rise)?;
    let up = size / ways.rise;
    if rate < up {
        return Err(WaveformError::Rate { least: up, got: rate });
    }
    let missing = size - rate * flyback;
    if missing <= 0.0 {
        return sawtooth::course(stroke, flyback, timing);
    }
    let late = missing / (rate + up);
    let low = stroke * (late / ways.rise);
    // Counted from the top: the delayed return ends in the next period.
    let legs = [Leg::straight(0.0, (stroke, low)), Leg::straight(flyback + late, (low, stroke))];
    let phase = timing.phase - TAU * (ways.rise / timing.period);
    let corners = Corners::periodic(&legs, &Timing { phase, ..*timing });
    let leads = timing.phase == 0.0;
    let bottom = if leads { 0.0 } else { low };
    Ok(Course {
        chain: Chain::Corners(if leads { corners.led_by(0.0) } else { corners }),
        ends: None,
        period: Some(timing.period),
        range: (stroke.min(bottom), stroke.max(bottom)),
        wave: f64::INFINITY,
        has_jumps: false,
    })
}
