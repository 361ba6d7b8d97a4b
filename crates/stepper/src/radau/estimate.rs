//! What a step may be: its error, and the length of a first one.

use super::Radau;
use super::tableau::{ESTIMATE, FIRST, dot};
use crate::System;

/// Rounding of the state, in last places, that the power of something stiff may be mistaken for.
// A stack's power goes with the rate of a voltage that is a difference of two over a resistance. Of one of 0.1 mΩ steps went as the
// inverse of the tolerance below 1e-9, each ten times as many as before for nothing.
const ROUNDING: f64 = 8.0;

impl Radau {
    /// The error of a step in units of `scale`, infinite where it is not finite.
    ///
    /// The difference r = h (γ f₀ + Σ eᵢ kᵢ) of two quadratures, and (1 - hγJ)⁻¹ r of the coupled components: a stiff component
    /// that is where it belongs but for rounding has slopes f₀ far beyond what will become of it. Quadratures go with what is
    /// left of them, and are judged no finer than the rounding of the state makes their slopes. It falls with h⁶, as the error of the dense output does. One more evaluation, as Hairer and Wanner have it
    /// for first steps, would let steps pass over what fades within them; the work that is lost there counts.
    pub(super) fn error(&mut self, scale: &[f64]) -> f64 {
        let (p, n) = (self.positions, self.dimension);
        let (m, g) = (n - p, FIRST * self.extent.step);
        let jacobian = &self.jacobian;
        let sound = self.filter.factor(|a, b| {
            let unit = if a == b { 1.0 } else { 0.0 };
            let moved = if b < p { g * g * jacobian.at(p + a, b) } else { 0.0 };
            unit - g * jacobian.at(p + a, p + b) - moved
        });
        if !sound {
            return f64::INFINITY;
        }
        let h = self.extent.step;
        let raw = |i: usize| h * (FIRST * jacobian.base[i] + dot(&ESTIMATE, &self.k[i]));
        for (i, to) in self.stage.iter_mut().enumerate() {
            *to = raw(i);
        }
        for a in 0..m {
            let along: f64 = (0..p).map(|x| jacobian.at(p + a, x) * self.stage[x]).sum();
            self.missed[a] = self.stage[p + a] + g * along;
        }
        self.filter.solve(&mut self.missed[..m]);
        self.stage[p..].copy_from_slice(&self.missed[..m]);
        for x in 0..p {
            self.stage[x] += g * self.stage[p + x];
        }
        let (mut most, mut probe) = (0.0_f64, 0.0_f64);
        let mut judge = |error: f64, scale: f64| {
            let error = (error / scale).abs();
            most = most.max(error);
            probe += error;
        };
        for (error, scale) in self.stage.iter().zip(scale) {
            judge(*error, *scale);
        }
        for (q, scale) in (n..self.k.len()).zip(&scale[n.min(scale.len())..]) {
            let rounding = ROUNDING * f64::EPSILON * h.abs() * jacobian.size(q, &self.begin);
            judge(raw(q) + g * jacobian.along(q, &self.stage), scale + rounding);
        }
        if probe.is_finite() { most } else { f64::INFINITY }
    }

    /// A first step for a fresh start: one that moves the state by a hundredth at its first slopes, at most `longest`.
    pub(super) fn starting_step<S: System + ?Sized>(
        &mut self,
        system: &S,
        longest: f64,
        scale: &[f64],
    ) -> f64 {
        if !self.first_known {
            self.restart_slopes(system);
        }
        let norm = |values: &[f64]| {
            let sizes =
                values.iter().zip(scale).take(self.dimension).map(|(value, scale)| (value / scale).abs());
            sizes.fold(0.0, f64::max)
        };
        // What an explicit step of Euler's may move: control lengthens it sixfold from step to step.
        let (size, speed) = (norm(&self.begin).max(1.0), norm(&self.first));
        if speed > 0.0 { (0.01 * size / speed).min(longest) } else { longest }
    }
}
