//! Steps in which nothing changes what acts: parabolas.

use super::Dop853;
use crate::System;

impl Dop853 {
    /// The end of a parabola and its slopes, without an evaluation; 0, or infinity where it is not finite.
    pub(super) fn coast<S: System + ?Sized>(&mut self, system: &S) -> f64 {
        let (h, n) = (self.step, system.positions());
        for i in 0..self.end.len() {
            let slope = self.first[i];
            let bend = if i < n { self.first[n + i] } else { 0.0 };
            self.end[i] = self.begin[i] + h * (slope + 0.5 * h * bend);
            self.last[i] = slope + h * bend;
        }
        self.last_known = true;
        if self.end.iter().sum::<f64>().is_finite() { 0.0 } else { f64::INFINITY }
    }

    /// Its dense output, without an evaluation.
    pub(super) fn dense_coast(&mut self) {
        let h = self.step;
        let ends = self.begin.iter().zip(&self.end);
        for ((c, slope), (begin, end)) in self.polynomials.iter_mut().zip(&self.first).zip(ends) {
            let rise = end - begin;
            *c = [*begin, rise, h * slope - rise, 0.0, 0.0, 0.0, 0.0, 0.0];
        }
        self.dense_known = true;
    }
}
