//! The classical Runge–Kutta method of order 4 with a fixed step.

use crate::{FixedStep, Stepping, System};

/// Classical Runge–Kutta method of order 4 (Kutta 1901; Hairer, Nørsett, Wanner, *Solving ODEs I*, table II.1.2). The method needs four
/// evaluations per step and has no error estimate.
///
/// ```text
/// k₁ = f(t, y)   k₂ = f(t + h/2, y + h/2 k₁)   k₃ = f(t + h/2, y + h/2 k₂)   k₄ = f(t + h, y + h k₃)
/// y₁ = y + h/6 (k₁ + 2k₂ + 2k₃ + k₄)
/// ```
#[derive(Debug, Clone)]
pub struct Rk4 {
    /// Number of coupled components.
    dimension: usize,
    /// Coupled components of the current stage (`stage`), and all slopes there (`slope`).
    stage: Vec<f64>,
    slope: Vec<f64>,
    /// Partial sum of k₁ + 2k₂ + 2k₃ + k₄.
    sum: Vec<f64>,
    evaluations: u64,
}

impl Rk4 {
    /// Returns a workspace for systems with `dimension` coupled components and `total` components.
    #[must_use]
    pub fn new(dimension: usize, total: usize) -> Self {
        let total = total.max(dimension);
        Self {
            dimension,
            stage: vec![0.0; dimension],
            slope: vec![0.0; total],
            sum: vec![0.0; total],
            evaluations: 0,
        }
    }

    /// Evaluates the slopes at time `t` in the state y + `ahead` · slope.
    #[inline(always)]
    fn stage<S: System + ?Sized>(&mut self, system: &S, t: f64, y: &[f64], ahead: f64) {
        for ((to, y), k) in self.stage.iter_mut().zip(y).zip(&self.slope) {
            *to = y + ahead * k;
        }
        system.slopes(t, &self.stage, &mut self.slope);
    }

    /// Adds the newest slopes to the sum of slopes, with a weight.
    #[inline(always)]
    fn add(&mut self, weight: f64) {
        for (sum, k) in self.sum.iter_mut().zip(&self.slope) {
            *sum += weight * k;
        }
    }
}

impl FixedStep for Rk4 {
    fn sized(_: usize, dimension: usize, total: usize) -> Self {
        Self::new(dimension, total)
    }

    /// Does nothing, because the method keeps no slopes.
    fn restart(&mut self) {}

    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}

impl<S: System + ?Sized> Stepping<S> for Rk4 {
    fn step(&mut self, system: &S, t: f64, y: &mut [f64], h: f64) {
        let half = 0.5 * h;
        for (to, from) in self.stage.iter_mut().zip(y.iter()) {
            *to = *from;
        }
        system.slopes(t, &self.stage[..self.dimension], &mut self.slope);
        self.sum.copy_from_slice(&self.slope);
        self.stage(system, t + half, y, half);
        self.add(2.0);
        self.stage(system, t + half, y, half);
        self.add(2.0);
        self.stage(system, t + h, y, h);
        self.add(1.0);
        for (y, sum) in y.iter_mut().zip(&self.sum) {
            *y += h / 6.0 * sum;
        }
        self.evaluations += 4;
    }
}
