//! S-curve: a sawtooth with strokes from rest to rest and limited jerk.
//!
//! A stroke Δ of duration L has four phases of constant jerk J, each of duration τ. Between the second and the third phase the velocity has
//! its largest value V = Δ/(L-2τ) = Jτ². Hence J = Δ/(τ²(L-2τ)); the largest acceleration is Jτ.

use super::Way;
use super::cubic::Cubic;
use super::flyback::Flyback;
use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{smooth, within};
use crate::waveform::{Timing, WaveformError};

/// Relative rounding error by which the phases may exceed the duration of a stroke.
const ROUNDING: f64 = 1e-12;

/// Returns cubic and linear pieces, five per stroke; four if the phases of constant jerk take the whole stroke.
pub(super) fn course(
    stroke: f64,
    flyback: f64,
    rounding: f64,
    timing: &Timing,
) -> Result<Course, WaveformError> {
    let ways = Flyback::new(stroke, flyback, timing)?;
    within("flyback", flyback, "a time above 0", flyback > 0.0)?;
    let room = ways.shortest - 4.0 * rounding >= -ROUNDING * ways.shortest;
    if !(rounding > 0.0 && room) {
        return Err(WaveformError::Rounding { most: 0.25 * ways.shortest, got: rounding });
    }
    smooth("stroke", stroke, stroke / (ways.shortest - 2.0 * rounding) / rounding)?;
    let mut legs = Vec::with_capacity(10);
    legs.extend(way(0.0, ways.rise, (0.0, stroke), rounding));
    legs.extend(way(ways.rise, flyback, (stroke, 0.0), rounding));
    Ok(Course {
        chain: Chain::Corners(Corners::periodic(&legs, timing)),
        ends: None,
        period: Some(timing.period),
        range: (stroke.min(0.0), stroke.max(0.0)),
        wave: f64::INFINITY,
        has_jumps: false,
    })
}

/// Returns the segments of one stroke.
fn way(start: f64, time: f64, (from, to): (f64, f64), tau: f64) -> [Leg; 5] {
    let speed = (to - from) / (time - 2.0 * tau);
    // A phase covers Jτ³/6, the second one the rest of Vτ.
    let (short, long) = (speed * tau / 6.0, speed * tau);
    let cubic = |at: f64, values: (f64, f64), first: f64, last: f64| Leg {
        start: at,
        values,
        way: Way::Cubic(Cubic::new(first, last)),
    };
    let end = start + time;
    [
        cubic(start, (from, from + short), 0.0, 0.5 * speed),
        cubic(start + tau, (from + short, from + long), 0.5 * speed, speed),
        Leg::straight(start + 2.0 * tau, (from + long, to - long)),
        cubic((end - 2.0 * tau).max(start + 2.0 * tau), (to - long, to - short), speed, 0.5 * speed),
        cubic(end - tau, (to - short, to), 0.5 * speed, 0.0),
    ]
}
