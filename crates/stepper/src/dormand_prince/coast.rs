//! Steps in which nothing changes what acts: parabolas.
//!
//! With constant accelerations x₁ = x₀ + h(v₀ + h a/2), v₁ = v₀ + h a, and every other component runs along a straight line.
//! A body in gross slip under a constant load moves so, and one in flight.

use super::DormandPrince;
use crate::System;

impl DormandPrince {
    /// The end of a parabola and its slopes, without an evaluation; 0, or infinity where it is not finite.
    pub(super) fn coast<S: System + ?Sized>(&mut self, system: &S) -> f64 {
        // The stages would sum up the same parabola for 12 evaluations, and estimate the rounding of their sums.
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

    /// Its dense output, without an evaluation: the first three coefficients of the nested form hold a parabola.
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
