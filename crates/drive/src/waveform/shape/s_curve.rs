//! S-curve: like the sawtooth, each way from rest to rest with a limited jerk.
//!
//! A way of length Δ in a time L takes four phases of constant jerk J, each for the time τ, and goes at its largest speed
//! V = Δ/(L-2τ) = Jτ² between the second and the third: J = Δ/(τ²(L-2τ)), the largest acceleration Jτ.

use super::Way;
use super::cubic::Cubic;
use super::flyback::Flyback;
use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{smooth, within};
use crate::waveform::{Timing, WaveformError};

/// Part of a way by which phases may be longer than it for their rounding.
const ROUNDING: f64 = 1e-12;

/// Cubic and straight pieces, five to a way; four where the phases fill it.
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

/// The phases of one way.
fn way(start: f64, time: f64, (from, to): (f64, f64), tau: f64) -> [Leg; 5] {
    let speed = (to - from) / (time - 2.0 * tau);
    // A phase goes Jτ³/6, the second one the rest of Vτ.
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
