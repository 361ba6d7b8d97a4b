//! Error estimate of a step, and length of the first step.

use super::Radau;
use super::tableau::{ESTIMATE, FIRST, dot};
use crate::System;

/// Rounding error of the state that the error of a quadrature must exceed, in units of the last place.
// The power in a piezo driver contains the difference of two voltages over a small resistance: rounding dominates it.
const ROUNDING: f64 = 8.0;

impl Radau {
    /// Returns the error of a step in units of `scale`; infinite if a result is not finite.
    ///
    /// For coupled components the error is (1 - hγJ)⁻¹ r, with the difference r = h (γ f₀ + Σ eᵢ kᵢ) of two quadratures. The inverse
    /// filters stiff components, whose slopes f₀ are dominated by rounding. Errors of quadratures follow from the filtered components;
    /// rounding of the state limits their accuracy. The estimate is of order h⁶, like the error of the dense output.
    ///
    /// Hairer and Wanner filter the error of first steps a second time. Here no second filter is used: steps resolve fast decays, because
    /// the work dissipated in them counts.
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

    /// Returns the length of a first step, at most `longest` (s), in which the initial slopes change the state by a hundredth.
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
        // The step control lengthens this short step by up to a factor of six per step.
        let (size, speed) = (norm(&self.begin).max(1.0), norm(&self.first));
        if speed > 0.0 { (0.01 * size / speed).min(longest) } else { longest }
    }
}
