//! A sawtooth through a limit of the rate.
//!
//! What is asked for is a sawtooth that rises at s in the time T-τ and falls in the flyback τ; what comes falls at the limit r and
//! meets it at the time u = (S - rτ)/(r + s) after the end of the period, on its way up. From then on it follows until the top.
//! Each period but the first is so cut short by s·u, and the flyback lasts τ + u.

use super::flyback::Flyback;
use super::sawtooth;
use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{smooth, within};
use crate::waveform::{Timing, WaveformError};
use std::f64::consts::TAU;

/// Straight pieces, two in a period. Without a phase it starts at 0 and is late only from its first flyback on; with one it
/// starts as it goes on.
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
    // Counted from the top, where the late way back begins: it ends in the period after.
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
