//! Where a swing turns.
//!
//! ν²(q) = ν₀² + 2q b̄(q) has one zero on each side of the motion, its derivative is 2b and its second one
//! 2b': all three come of one evaluation, so that Halley's third order costs no more than Newton's second.

use super::Swing;
use std::array;

/// Steps of Halley's method to a turning point: two suffice, more are for slow starts.
// What has not converged is stepped: with 2 the events of 32 contacts on one slider cost 5 % more evaluations at 1e-9.
const HALLEY: usize = 30;
/// Its last step, relative: one that leaves nothing, to the third power, and one that is always worth another.
// Between both the step goes with the third root of the tolerance: they act below 1e-12 and above 8e-3 only. With a
// tenth of the rough one P1 at 1e-2 takes 14 % more evaluations, and its books, 7e-7, close to rounding.
pub(super) const EXACT: f64 = 1e-5;
pub(super) const ROUGH: f64 = 0.02;

impl Swing<'_> {
    /// The turning points near two guesses: ν₀² + 2∫b = 0 by Halley's method, m.
    #[inline(always)]
    pub(super) fn turning(&mut self, speed: f64, guesses: [f64; 2]) -> Option<[f64; 2]> {
        let mut q = guesses;
        for _ in 0..HALLEY {
            self.evaluations += 2;
            let [mean, force, bend] = self.force(q);
            // Both at once: what a leap waits for are roots and quotients one after another, not
            // instructions.
            let step: [f64; 2] = array::from_fn(|i| {
                let left = speed * speed + 2.0 * q[i] * mean[i];
                let step = 2.0 * left * force[i] / (4.0 * force[i] * force[i] - left * bend[i]);
                // Where b still drives on, the slide is fastest further out: from there the step would lead to the other point.
                if force[i] * guesses[i] > 0.0 { -q[i] } else { step }
            });
            q = array::from_fn(|i| q[i] - step[i]);
            // The last step is exact to the third power of itself.
            if (0..2).all(|i| step[i].abs() <= self.last * q[i].abs()) {
                return (0..2).all(|i| force[i] * guesses[i] <= 0.0).then_some(q);
            }
        }
        None
    }
}

/// Where ν² would turn if b were a parabola: a Halley step from q, where it would for a straight b, there `force`, of slope
/// `bend`. Where the parabola turns by itself, or the step is no small one, the straight b is the better guess.
#[inline(always)]
pub(super) fn softer(q: f64, force: f64, bend: f64, softening: f64) -> f64 {
    let left = (1.0 / 3.0) * softening * q * q * q;
    let (steeper, bend) = (force + 0.5 * softening * q * q, bend + softening * q);
    let step = 2.0 * left * steeper / (4.0 * steeper * steeper - left * bend);
    if steeper * force > 0.0 && step.abs() < 0.5 * q.abs() { q - step } else { q }
}
