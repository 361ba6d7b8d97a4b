//! Waveforms without corners: a sine and sums of sines.

use super::{Harmonic, Sample, Shape, Timing};
use std::f64::consts::TAU;

/// Value and derivatives at `t`; zeros for a shape that is no sum of sines.
pub(super) fn at(shape: &Shape, timing: &Timing, t: f64) -> Sample {
    let omega = TAU / timing.period;
    let turns = (t - timing.delay) / timing.period;
    // Whole turns are taken off before the multiplication by 2π, whose rounding they would magnify.
    let angle = TAU * (turns - turns.floor()) + timing.phase;
    match shape {
        Shape::Sine { amplitude, phase, offset } => {
            let term = term(Harmonic { amplitude: *amplitude, order: 1.0, phase: *phase }, omega, angle);
            Sample { value: offset + term.value, ..term }
        }
        Shape::Harmonics { terms } => terms.iter().map(|harmonic| term(*harmonic, omega, angle)).fold(
            Sample { value: 0.0, rate: 0.0, acceleration: 0.0 },
            |sum, term| Sample {
                value: sum.value + term.value,
                rate: sum.rate + term.rate,
                acceleration: sum.acceleration + term.acceleration,
            },
        ),
        _ => Sample { value: 0.0, rate: 0.0, acceleration: 0.0 },
    }
}

#[inline]
fn term(harmonic: Harmonic, omega: f64, angle: f64) -> Sample {
    let order = harmonic.order;
    let (sin, cos) = (order * angle + harmonic.phase).sin_cos();
    let (value, speed) = (harmonic.amplitude * sin, order * omega);
    Sample { value, rate: harmonic.amplitude * speed * cos, acceleration: -value * speed * speed }
}

/// Most points of the grid; from order 256 on the bound grows wider instead.
const MOST_POINTS: f64 = 262_144.0;

/// Bounds of a sum of sines: the extremes on a grid of spacing δ, widened by δ²/8 times the largest curvature
/// Σ |amplitude| order², and no wider than Σ |amplitude|.
pub(super) fn range(terms: &[Harmonic]) -> (f64, f64) {
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
            terms.iter().map(|term| term.amplitude * (term.order * angle + term.phase).sin()).sum();
        (low.min(value), high.max(value))
    });
    ((low - margin).max(-sum), (high + margin).min(sum))
}
