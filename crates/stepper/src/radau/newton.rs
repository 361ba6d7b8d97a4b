//! The stages of a step, by the simplified Newton iteration.
//!
//! Unknown are the slopes k of all coupled components but the positions, whose stages follow from those of the velocities:
//! w = w₀ + h A k and x = x₀ + h c v₀ + h² A² k. A correction δ obeys [1 - h A ⊗ ∂f/∂w - h² A² ⊗ ∂f/∂x] δ = f - k with the
//! derivatives at the start of the step. It begins with k = 0: nothing of an earlier step is needed, so that a step depends on its
//! start alone.

use super::Radau;
use super::tableau::{A, NODES, SQUARE, STAGES, dot};
use crate::System;

/// Most corrections of one step; more say that it is too long.
const CORRECTIONS: u32 = 10;
/// Part of what is allowed of the step that the iteration may leave.
// Corrections fall by a factor of a hundred and more where the derivatives hold: a tenth of it costs less than one of them.
const LEFT: f64 = 1e-2;
/// Corrections that no longer fall are rounding where they are below this part of what is allowed.
const ROUNDING: f64 = 0.1;

impl Radau {
    /// Finds the slopes of all stages, and the stages; false where the iteration fails.
    pub(super) fn solve_stages<S: System + ?Sized>(&mut self, system: &S, scale: &[f64]) -> bool {
        if !self.factor_stages() {
            return false;
        }
        self.k.fill([0.0; STAGES]);
        self.correct_stages(system, scale)
    }

    /// The same from slopes that are there, by the matrix that is there.
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
            // The first ratio tells of the start more than of the iteration. Not a number is no progress, either.
            if decay.is_nan() || round > 1 && decay > 0.5 {
                return size <= ROUNDING;
            }
            before = size;
        }
        false
    }

    /// The matrix of the corrections, stage by stage.
    pub(super) fn factor_stages(&mut self) -> bool {
        let (p, m, h) = (self.positions, self.dimension - self.positions, self.extent.step);
        let jacobian = &self.jacobian;
        self.matrix.factor(|row, column| {
            let ((i, a), (j, b)) = ((row / m, row % m), (column / m, column % m));
            let unit = if row == column { 1.0 } else { 0.0 };
            // The first of what is unknown are velocities, which move positions.
            let moved = if b < p { h * h * SQUARE[i][j] * jacobian.at(p + a, b) } else { 0.0 };
            unit - h * A[i][j] * jacobian.at(p + a, p + b) - moved
        })
    }

    /// Stages that follow from the slopes, less the state at the start.
    fn follow(&mut self) {
        let (p, n, h) = (self.positions, self.dimension, self.extent.step);
        for component in p..n {
            let k = &self.k[component];
            self.z[component] = std::array::from_fn(|i| h * dot(&A[i], k));
        }
        for x in 0..p {
            let (speed, k) = (self.begin[p + x], &self.k[p + x]);
            self.z[x] = std::array::from_fn(|i| h * (NODES[i] * speed + h * dot(&SQUARE[i], k)));
        }
    }

    /// Slopes of all stages as they are now, and of the coupled ones what they miss.
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

    /// Corrects slopes and stages; the size of what was corrected, in units of what is allowed.
    ///
    /// Quadratures are corrected with them by their derivatives: the power of a stiff damper goes with differences of velocity
    /// that are far below what is allowed of a velocity.
    fn correct(&mut self, scale: &[f64]) -> f64 {
        let (p, n, h) = (self.positions, self.dimension, self.extent.step);
        let m = n - p;
        self.matrix.solve(&mut self.missed);
        for a in 0..m {
            let by: [f64; STAGES] = std::array::from_fn(|i| self.missed[i * m + a]);
            self.k[p + a].iter_mut().zip(by).for_each(|(k, by)| *k += by);
            self.shift[p + a] = std::array::from_fn(|i| h * dot(&A[i], &by));
            if a < p {
                self.shift[a] = std::array::from_fn(|i| h * h * dot(&SQUARE[i], &by));
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
        // `max` drops NaN, a sum does not.
        if probe.is_finite() { most } else { f64::NAN }
    }

    /// Stages of the positions' slopes and of the quadratures, and the end of the step.
    pub(super) fn arrive(&mut self) {
        let (p, n, h) = (self.positions, self.dimension, self.extent.step);
        for x in 0..p {
            let speed = self.begin[p + x];
            self.k[x] = self.z[p + x].map(|z| speed + z);
        }
        for q in n..self.k.len() {
            let k = &self.k[q];
            self.z[q] = std::array::from_fn(|i| h * dot(&A[i], k));
        }
        for (to, (y, z)) in self.end.iter_mut().zip(self.begin.iter().zip(&self.z)) {
            *to = y + z[STAGES - 1];
        }
        for (to, k) in self.last.iter_mut().zip(&self.k) {
            *to = k[STAGES - 1];
        }
    }
}
