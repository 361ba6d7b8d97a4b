//! Solution of the stage equations by the simplified Newton iteration.
//!
//! The unknowns are the slopes k of all coupled components except positions. Stages are w = w₀ + h A k and x = x₀ + h c v₀ + h² A² k. A
//! correction δ satisfies [1 - h A ⊗ ∂f/∂w - h² A² ⊗ ∂f/∂x] δ = f - k, with the Jacobian at the start of the step. The iteration begins
//! with k = 0, so that the result depends on the start of the step only.

use super::Radau;
use super::tableau::{A, NODES, SQUARE, STAGES, dot};
use crate::System;

/// Largest number of corrections in one step. If more are needed, the step is too long.
const CORRECTIONS: u32 = 10;
/// Allowed remaining error of the iteration, as a fraction of the tolerance of the step.
const LEFT: f64 = 1e-2;
/// Fraction of the tolerance below which corrections that no longer decrease count as rounding.
const ROUNDING: f64 = 0.1;

impl Radau {
    /// Solves for the slopes and states of all stages. Returns false if the iteration fails.
    pub(super) fn solve_stages<S: System + ?Sized>(&mut self, system: &S, scale: &[f64]) -> bool {
        if !self.factor_stages() {
            return false;
        }
        self.k.fill([0.0; STAGES]);
        self.correct_stages(system, scale)
    }

    /// Iterates from the present slopes with the present matrix of corrections. Returns false if the iteration fails.
    pub(super) fn correct_stages<S: System + ?Sized>(&mut self, system: &S, scale: &[f64]) -> bool {
        self.follow();
        let mut before = f64::INFINITY;
        for round in 0..CORRECTIONS {
            self.evaluate_stages(system);
            let size = self.correct(scale);
            let decay = size / before;
            let left = if round == 0 { size } else { size * decay / (1.0 - decay) };
            if size == 0.0 || (round == 0 || decay < 1.0) && left <= LEFT {
                return true;
            }
            // The first ratio depends on the initial guess. NaN is no progress.
            if decay.is_nan() || round > 1 && decay > 0.5 {
                return size <= ROUNDING;
            }
            before = size;
        }
        false
    }

    /// Assembles and factors the matrix of the corrections, stage by stage.
    pub(super) fn factor_stages(&mut self) -> bool {
        let (p, m, h) = (self.positions, self.dimension - self.positions, self.extent.step);
        let jacobian = &self.jacobian;
        self.matrix.factor(|row, column| {
            let ((i, a), (j, b)) = ((row / m, row % m), (column / m, column % m));
            let unit = if row == column { 1.0 } else { 0.0 };
            // The first unknowns are velocities, which determine positions.
            let moved = if b < p { h * h * SQUARE[i][j] * jacobian.at(p + a, b) } else { 0.0 };
            unit - h * A[i][j] * jacobian.at(p + a, p + b) - moved
        })
    }

    /// Computes the states of the stages minus the state at the start, from the slopes of the stages.
    fn follow(&mut self) {
        let (p, n, h) = (self.positions, self.dimension, self.extent.step);
        for component in p..n {
            let k = &self.k[component];
            self.z[component] = super::lanes(|i| h * dot(&A[i], k));
        }
        for x in 0..p {
            let (speed, k) = (self.begin[p + x], &self.k[p + x]);
            self.z[x] = super::lanes(|i| h * (NODES[i] * speed + h * dot(&SQUARE[i], k)));
        }
    }

    /// Evaluates the slopes of all stages, and the residuals of the coupled slopes.
    fn evaluate_stages<S: System + ?Sized>(&mut self, system: &S) {
        let (p, n) = (self.positions, self.dimension);
        let m = n - p;
        for i in 0..STAGES {
            for ((to, y), z) in self.stage.iter_mut().zip(&self.begin).zip(&self.z) {
                *to = y + z[i];
            }
            let t = if i + 1 == STAGES {
                self.extent.target
            } else {
                self.extent.time + NODES[i] * self.extent.step
            };
            system.slopes(t, &self.stage, &mut self.newest);
            for a in 0..m {
                self.missed[i * m + a] = self.newest[p + a] - self.k[p + a][i];
            }
            for (k, slope) in self.k[n..].iter_mut().zip(&self.newest[n..]) {
                k[i] = *slope;
            }
        }
        self.evaluations += STAGES as u64;
    }

    /// Corrects slopes and states of the stages. Returns the size of the correction in units of the tolerance.
    ///
    /// The Jacobian corrects quadratures, too: the power of a stiff damper depends on velocity differences far below the tolerance.
    fn correct(&mut self, scale: &[f64]) -> f64 {
        let (p, n, h) = (self.positions, self.dimension, self.extent.step);
        let m = n - p;
        self.matrix.solve(&mut self.missed);
        for a in 0..m {
            let by: [f64; STAGES] = super::lanes(|i| self.missed[i * m + a]);
            self.k[p + a].iter_mut().zip(by).for_each(|(k, by)| *k += by);
            self.shift[p + a] = super::lanes(|i| h * dot(&A[i], &by));
            if a < p {
                self.shift[a] = super::lanes(|i| h * h * dot(&SQUARE[i], &by));
            }
        }
        self.follow();
        let (mut most, mut probe) = (0.0_f64, 0.0_f64);
        for i in 0..STAGES {
            for (j, (to, shift)) in self.stage.iter_mut().zip(&self.shift).enumerate() {
                *to = shift[i];
                let size = (shift[i] / scale[j]).abs();
                most = most.max(size);
                probe += size;
            }
            for (q, k) in self.k.iter_mut().enumerate().skip(n) {
                k[i] += self.jacobian.along(q, &self.stage);
            }
        }
        // `max` ignores NaN, a sum does not.
        if probe.is_finite() { most } else { f64::NAN }
    }

    /// Computes the stages of positions and quadratures, and the state at the end of the step.
    pub(super) fn arrive(&mut self) {
        let (p, n, h) = (self.positions, self.dimension, self.extent.step);
        for x in 0..p {
            let speed = self.begin[p + x];
            self.k[x] = self.z[p + x].map(|z| speed + z);
        }
        for q in n..self.k.len() {
            let k = &self.k[q];
            self.z[q] = super::lanes(|i| h * dot(&A[i], k));
        }
        for (to, (y, z)) in self.end.iter_mut().zip(self.begin.iter().zip(&self.z)) {
            *to = y + z[STAGES - 1];
        }
        for (to, k) in self.last.iter_mut().zip(&self.k) {
            *to = k[STAGES - 1];
        }
    }
}
