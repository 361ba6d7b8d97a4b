//! Error estimate of a step, and length of the first step.

use super::order5::Error4;
use super::order8::{Error3, Error5};
use super::tableau::{Pair, Row};
use super::{DormandPrince, Grade, ORDER};
use crate::System;

impl DormandPrince {
    /// Returns the length of a first step, at most `longest`, by the rule of Hairer, Nørsett, Wanner, section II.4. Costs one evaluation.
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
        // An explicit Euler step that moves the state by a hundredth shows how the slopes change.
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

    /// Returns the error estimate of the step in units of `scale`, over all components for which `scale` has a value.
    ///
    /// The estimate of DOP853 is h e₅² / √(e₅² + 0.01 e₃²). Here e₅ and e₃ are maxima over the components, not root mean squares.
    pub(super) fn error(&self, scale: &[f64]) -> f64 {
        if self.extent.grade == Grade::Few { self.error_of_fifth(scale) } else { self.error_of_eighth(scale) }
    }

    /// Returns the embedded estimate h e₄ of DOPRI5, raised to the power 8/5 to be of order h⁸. e₄ is the maximum over the components.
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

    /// Returns the largest component of an error estimate in units of `scale`, and the sum of all components, which detects NaN.
    // One estimate per call: two at once would not be vectorised.
    #[inline(never)]
    fn largest<R: Row>(&self, scale: &[f64]) -> [f64; 2] {
        let (mut largest, mut sum) = ([0.0_f64; 2], [0.0_f64; 2]);
        // A mean would dilute the error of one component by others at rest. The error would depend on the number of bodies.
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
