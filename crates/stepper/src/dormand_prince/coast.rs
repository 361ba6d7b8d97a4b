//! Steps under constant accelerations, whose exact solution is a parabola.
//!
//! x₁ = x₀ + h(v₀ + h a/2), v₁ = v₀ + h a; every other component is linear in time. Bodies move in this way in gross slip under constant
//! load or in flight.

use super::DormandPrince;
use crate::System;

impl DormandPrince {
    /// Computes the end of a parabola and its slopes without an evaluation. The error is 0, or infinite if the end is not finite.
    pub(super) fn coast<S: System + ?Sized>(&mut self, system: &S) -> f64 {
        // The stages would give the same parabola after 12 evaluations, plus rounding.
        let (h, n) = (self.extent.step, system.positions());
        for i in 0..self.end.len() {
            let slope = self.ends.first[i];
            let bend = if i < n { self.ends.first[n + i] } else { 0.0 };
            self.end[i] = self.begin[i] + h * (slope + 0.5 * h * bend);
            self.ends.last[i] = slope + h * bend;
        }
        self.ends.last_known = true;
        if self.end.iter().sum::<f64>().is_finite() { 0.0 } else { f64::INFINITY }
    }

    /// Sets the dense output of a parabola without an evaluation. Its first three coefficients represent the parabola exactly.
    pub(super) fn dense_coast(&mut self) {
        let h = self.extent.step;
        let ends = self.begin.iter().zip(&self.end);
        for ((c, slope), (begin, end)) in self.polynomials.iter_mut().zip(&self.ends.first).zip(ends) {
            let rise = end - begin;
            *c = [*begin, rise, h * slope - rise, 0.0, 0.0, 0.0, 0.0, 0.0];
        }
        self.dense_known = true;
    }
}
