//! One component in the course of a step.

use super::tableau::{INTEGRALS, REFINED, SAMPLED, SAMPLES, STAGES};

/// One position with its velocity, or one quadrature, in the course of a step.
///
/// All that belongs to one component lies together: sums of stages run over one track, 232 bytes of it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Track {
    /// Position at the start of the step; of no meaning to a quadrature.
    pub(super) x: f64,
    /// Velocity, or quadrature, at the start of the step.
    pub(super) v: f64,
    /// Acceleration, or rate of the quadrature, at the stages.
    pub(super) k: [f64; STAGES],
    /// Positions at which the samples are refined.
    pub(super) refined: [f64; REFINED.end - REFINED.start],
    /// The dense output: v + hθ Σ cθʲ …
    pub(super) velocity: [f64; SAMPLES],
    /// … and x + hθ(v + hθ Σ cθʲ).
    pub(super) position: [f64; SAMPLES],
}

impl Track {
    /// The polynomials through the samples.
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

    /// Position at a fraction θ of the step h.
    #[inline]
    pub(super) fn position(&self, h: f64, share: f64) -> f64 {
        self.x + share * h * (self.v + h * share * horner(&self.position, share))
    }

    /// Velocity, or quadrature.
    #[inline]
    pub(super) fn velocity(&self, h: f64, share: f64) -> f64 {
        self.v + h * share * horner(&self.velocity, share)
    }
}

/// Σ cⱼxʲ.
#[inline]
fn horner(coefficients: &[f64; SAMPLES], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Σ over the first `count` stages; where that is known at compile time, stages of weight zero fall out.
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
