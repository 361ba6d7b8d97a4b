//! Turning points of a closed-form oscillation.
//!
//! The squared velocity ν²(q) = ν₀² + 2q b̄(q) has one zero on each side of the motion. The derivatives 2b and 2b' come from the same
//! evaluation, so Halley's method of third order costs no more than Newton's.

use super::Swing;
use crate::quadrature::lanes;

/// Largest number of Halley steps to a turning point.
const HALLEY: usize = 30;
/// Bounds of the relative size of the last step: below the first, the remaining error is rounding; above the second, one more step is made.
// In between, the bound is proportional to the cube root of the tolerance.
pub(super) const EXACT: f64 = 1e-5;
pub(super) const ROUGH: f64 = 0.02;

impl Swing<'_> {
    /// Returns the turning points near two guesses, m, as zeros of ν₀² + 2∫b dq by Halley's method.
    #[inline(always)]
    pub(super) fn turning(&mut self, speed: f64, guesses: [f64; 2]) -> Option<[f64; 2]> {
        let mut q = guesses;
        for _ in 0..HALLEY {
            self.evaluations += 2;
            let [mean, force, bend] = self.force(q);
            // Both zeros together allow parallel execution.
            let step: [f64; 2] = lanes(|i| {
                let left = speed * speed + 2.0 * q[i] * mean[i];
                let step = 2.0 * left * force[i] / (4.0 * force[i] * force[i] - left * bend[i]);
                // If b still accelerates, the step would lead to the other turning point.
                if force[i] * guesses[i] > 0.0 { -q[i] } else { step }
            });
            q = lanes(|i| q[i] - step[i]);
            // The remaining error is of third order.
            if (0..2).all(|i| step[i].abs() <= self.last * q[i].abs()) {
                return (0..2).all(|i| force[i] * guesses[i] <= 0.0).then_some(q);
            }
        }
        None
    }
}

/// Improves the guess q of a turning point, found for a linear b, by one Halley step for a parabolic b. `force` is b at q and `bend` its
/// derivative. If the parabola has an extremum, or the step is not small, q is returned.
#[inline(always)]
pub(super) fn softer(q: f64, force: f64, bend: f64, softening: f64) -> f64 {
    let left = (1.0 / 3.0) * softening * q * q * q;
    let (steeper, bend) = (force + 0.5 * softening * q * q, bend + softening * q);
    let step = 2.0 * left * steeper / (4.0 * steeper * steeper - left * bend);
    if steeper * force > 0.0 && step.abs() < 0.5 * q.abs() { q - step } else { q }
}
