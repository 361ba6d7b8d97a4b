//! Data of one component during a step.

use super::tableau::{INTEGRALS, REFINED, SAMPLED, SAMPLES, STAGES};

/// Data of one position with its velocity, or of one quadrature, during a step.
///
/// The data of a component are contiguous in memory, because sums over stages run over one component.
#[derive(Debug, Clone, Copy, Default)]
pub struct Track {
    /// Position at the start of the step; unused for a quadrature.
    pub(super) x: f64,
    /// Velocity or quadrature at the start of the step.
    pub(super) v: f64,
    /// Accelerations or quadrature rates at the stages.
    pub(super) k: [f64; STAGES],
    /// Interpolated positions at the nodes whose accelerations are evaluated again.
    pub(super) refined: [f64; REFINED.end - REFINED.start],
    /// Coefficients c of the dense output v + hθ Σ cθʲ of the velocity or quadrature.
    pub(super) velocity: [f64; SAMPLES],
    /// Coefficients c of the dense output x + hθ(v + hθ Σ cθʲ) of the position.
    pub(super) position: [f64; SAMPLES],
}

impl Track {
    /// Computes the dense-output polynomials through the samples.
    pub(super) fn interpolate(&mut self) {
        self.velocity = [0.0; SAMPLES];
        for (column, stage) in INTEGRALS.iter().zip(SAMPLED) {
            for (to, weight) in self.velocity.iter_mut().zip(column) {
                *to += weight * self.k[stage];
            }
        }
        for (j, (to, from)) in self.position.iter_mut().zip(&self.velocity).enumerate() {
            *to = from * (1.0 / (j + 2) as f64);
        }
    }

    /// Returns the position at fraction θ of the step h (s).
    #[inline]
    pub(super) fn position(&self, h: f64, share: f64) -> f64 {
        self.x + share * h * (self.v + h * share * horner(&self.position, share))
    }

    /// Returns the velocity or quadrature at fraction θ of the step h (s).
    #[inline]
    pub(super) fn velocity(&self, h: f64, share: f64) -> f64 {
        self.v + h * share * horner(&self.velocity, share)
    }
}

/// Returns Σ cⱼxʲ.
#[inline]
fn horner(coefficients: &[f64; SAMPLES], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Returns Σ wⱼkⱼ over the first `count` stages, skipping zero weights.
#[inline(always)]
pub(super) fn dot(weights: &[f64], k: &[f64; STAGES], count: usize) -> f64 {
    let mut sum = 0.0;
    for j in 0..count {
        if weights[j] != 0.0 {
            sum += weights[j] * k[j];
        }
    }
    sum
}
