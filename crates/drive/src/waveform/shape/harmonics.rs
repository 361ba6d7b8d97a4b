//! Sum of sines: Σ amplitude sin(order ωt + phase).

use super::Sines;
use super::turn::Turn;
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{finite, smooth, within};
use crate::waveform::{Sample, Timing, WaveformError};
use std::f64::consts::TAU;

/// Term of a sum of sines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Amplitude, half of the peak-to-peak value.
    pub amplitude: f64,
    /// Multiple of the fundamental frequency, an integer; 0 gives a constant, amplitude · sin(phase).
    pub order: f64,
    /// Phase, rad.
    pub phase: f64,
}

/// Returns value and derivatives of the sum; never inlined, because single sines are more frequent.
#[inline(never)]
pub(super) fn at(terms: &[Harmonic], turn: Turn) -> Sample {
    terms.iter().map(|harmonic| turn.term(*harmonic)).fold(
        Sample { value: 0.0, rate: 0.0, acceleration: 0.0 },
        |sum, term| Sample {
            value: sum.value + term.value,
            rate: sum.rate + term.rate,
            acceleration: sum.acceleration + term.acceleration,
        },
    )
}

/// Returns the sum as one smooth piece from start to stop.
pub(super) fn course(terms: &[Harmonic], timing: &Timing) -> Result<Course, WaveformError> {
    timing.check_period()?;
    check(terms, timing.curvature())?;
    let highest = terms.iter().map(|term| term.order).fold(1.0, f64::max);
    Ok(Course {
        chain: Chain::Sines(Sines::Sum(terms.to_vec())),
        ends: None,
        period: Some(timing.period),
        range: range(terms),
        wave: timing.period / highest,
        has_jumps: false,
    })
}

fn check(terms: &[Harmonic], curvature: f64) -> Result<(), WaveformError> {
    if terms.is_empty() {
        return Err(WaveformError::Empty { key: "terms" });
    }
    let mut sum = 0.0;
    for term in terms {
        sum += term.amplitude.abs() * (term.order * term.order * curvature).max(1.0);
        smooth("amplitude", term.amplitude, sum)?;
        finite("phase", term.phase)?;
        let whole = term.order >= 0.0 && term.order.fract() == 0.0;
        within("order", term.order, "a whole number of at least 0", whole)?;
    }
    Ok(())
}

/// Largest number of grid points in the search for extremes. Above order 256 the bounds therefore become wider.
const MOST_POINTS: f64 = 262_144.0;

/// Returns bounds of a sum of sines: the extremes on a grid with spacing δ, widened by δ²/8 times the largest curvature Σ |amplitude|
/// order². The bounds are limited to ± Σ |amplitude|.
fn range(terms: &[Harmonic]) -> (f64, f64) {
    let sum: f64 = terms.iter().map(|term| term.amplitude.abs()).sum();
    if let [_] = terms {
        return (-sum, sum);
    }
    let order = terms.iter().map(|term| term.order).fold(1.0, f64::max);
    let points = (1024.0 * order).min(MOST_POINTS) as u32;
    let spacing = TAU / f64::from(points);
    let curvature: f64 = terms.iter().map(|term| term.amplitude.abs() * term.order.powi(2)).sum();
    let margin = 0.125 * spacing * spacing * curvature;
    let (low, high) = (0..points).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), i| {
        let angle = spacing * f64::from(i);
        let value: f64 =
            terms.iter().map(|term| term.amplitude * math::sin(term.order * angle + term.phase)).sum();
        (low.min(value), high.max(value))
    });
    ((low - margin).max(-sum), (high + margin).min(sum))
}
