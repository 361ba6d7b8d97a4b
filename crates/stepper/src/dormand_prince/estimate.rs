//! What a step may be: its error, and the length of a first one.

use super::order5::Error4;
use super::order8::{Error3, Error5};
use super::tableau::{Pair, Row};
use super::{DormandPrince, Grade, ORDER};
use crate::System;

impl DormandPrince {
    /// A first step for a fresh start (Hairer, Nørsett, Wanner, section II.4), at most `longest`; one evaluation.
    pub(super) fn starting_step<S: System + ?Sized>(
        &mut self,
        system: &S,
        longest: f64,
        scale: &[f64],
    ) -> f64 {
        if !self.ends.first_known {
            self.restart_slopes(system);
        }
        let norm = |of: &dyn Fn(usize) -> f64| {
            scale.iter().enumerate().take(self.dimension).map(|(i, s)| (of(i) / s).abs()).fold(0.0, f64::max)
        };
        let (size, speed) = (norm(&|i| self.begin[i]), norm(&|i| self.ends.first[i]));
        // Hairer's rule: an explicit Euler step that moves the state by a hundredth shows how slopes change.
        let trial = if size > 1e-5 && speed > 1e-5 { 0.01 * size / speed } else { 1e-6 * longest };
        let trial = trial.min(longest);
        for ((to, y), slope) in self.stage.iter_mut().zip(&self.begin).zip(&self.ends.first) {
            *to = y + trial * slope;
        }
        let t = self.extent.time + trial;
        system.slopes(t, &self.stage[..self.dimension], &mut self.newest[..self.total]);
        self.evaluations += 1;
        let bend = norm(&|i| (self.newest[i] - self.ends.first[i]) / trial);
        let largest = speed.max(bend);
        let step =
            if largest > 1e-15 { math::powf(0.01 / largest, 1.0 / f64::from(ORDER)) } else { 1e3 * trial };
        step.min(100.0 * trial).min(longest)
    }

    /// The estimate of DOP853, h e₅² / √(e₅² + 0.01 e₃²), with the largest component for e₅ and e₃ instead of the root of the
    /// mean square; of all components that `scale` has values for.
    pub(super) fn error(&self, scale: &[f64]) -> f64 {
        if self.extent.grade == Grade::Few { self.error_of_fifth(scale) } else { self.error_of_eighth(scale) }
    }

    /// The embedded estimate of DOPRI5, h e₄ with the largest component, as if it fell with h⁸ as the other does: e^{8/5}.
    fn error_of_fifth(&self, scale: &[f64]) -> f64 {
        let (mut most, mut probe) = (0.0_f64, 0.0_f64);
        for (k, scales) in self.k.iter().zip(scale.chunks(2)) {
            for (error, scale) in Error4::dot(k).0.into_iter().zip(scales) {
                let error = (error / scale).abs();
                most = most.max(error);
                probe += error;
            }
        }
        probe += self.end.iter().sum::<f64>();
        let error = self.extent.step.abs() * most;
        if probe.is_finite() { error * math::powf(error, 0.6) } else { f64::INFINITY }
    }

    fn error_of_eighth(&self, scale: &[f64]) -> f64 {
        let ([five, probe], [three, other]) = (self.largest::<Error5>(scale), self.largest::<Error3>(scale));
        let probe = probe + other + self.end.iter().sum::<f64>();
        if !probe.is_finite() {
            return f64::INFINITY;
        }
        let norm = (five * five + 0.01 * three * three).sqrt();
        if norm > 0.0 { self.extent.step.abs() * five * (five / norm) } else { 0.0 }
    }

    /// The largest component of an estimate in units of `scale`, and the sum of all: of what is no number the largest tells
    /// nothing.
    // Each estimate by itself: two at once are summed one component at a time.
    #[inline(never)]
    fn largest<R: Row>(&self, scale: &[f64]) -> [f64; 2] {
        let (mut largest, mut sum) = ([0.0_f64; 2], [0.0_f64; 2]);
        // With a mean, components at rest dilute the one that matters: a swing with a true error of 54 is told as 504 by the
        // largest, as 321 by the mean, and with fifteen others at rest beside it as 80. A scene of more bodies would be
        // computed less exactly.
        for (k, scales) in self.k.iter().zip(scale.chunks(2)) {
            let units = match scales {
                [a, b] => [1.0 / a, 1.0 / b],
                [a] => [1.0 / a, 0.0],
                _ => break,
            };
            let Pair(errors) = R::dot(k);
            for i in 0..2 {
                let error = (errors[i] * units[i]).abs();
                largest[i] = largest[i].max(error);
                sum[i] += error;
            }
        }
        [largest[0].max(largest[1]), sum[0] + sum[1]]
    }
}
