//! Jacobian of the slopes by finite differences.

use crate::System;

/// Smallest difference of a component, in units of its last place.
// Rounding of the derivatives then limits the convergence of the simplified Newton iteration only slightly.
const PLACES: f64 = 4096.0;

/// Derivatives of the slopes of all components with respect to the coupled components, at the start of a step.
#[derive(Debug, Clone)]
pub(super) struct Jacobian {
    /// Matrix entries, by component and coupled component.
    entries: Vec<f64>,
    dimension: usize,
    /// Increment of each coupled component for the finite differences.
    differences: Vec<f64>,
    /// Slopes at the start of the step.
    pub(super) base: Vec<f64>,
    moved: Vec<f64>,
    slopes: Vec<f64>,
    pub(super) known: bool,
}

impl Jacobian {
    pub(super) fn new((dimension, total): (usize, usize), mut differences: Vec<f64>) -> Self {
        differences.resize(dimension, 0.0);
        Self {
            entries: vec![0.0; dimension * total],
            dimension,
            differences,
            base: vec![0.0; total],
            moved: vec![0.0; dimension],
            slopes: vec![0.0; total],
            known: false,
        }
    }

    /// Copies the derivatives of another Jacobian of the same size.
    pub(super) fn copy(&mut self, of: &Self) {
        self.entries.copy_from_slice(&of.entries);
        self.base.copy_from_slice(&of.base);
        self.known = of.known;
    }

    /// Returns the number of evaluations for one Jacobian.
    pub(super) fn cost(&self) -> u64 {
        self.dimension as u64 + 1
    }

    /// Computes the derivatives by finite differences at time `t` (s) and state `y`.
    pub(super) fn take<S: System + ?Sized>(&mut self, system: &S, t: f64, y: &[f64]) {
        let n = self.dimension;
        self.moved.copy_from_slice(&y[..n]);
        system.slopes(t, &self.moved, &mut self.base);
        for (j, at) in y.iter().copied().enumerate().take(n) {
            let rounding = PLACES * f64::EPSILON * at.abs();
            let to = at + self.differences[j].max(rounding).max(f64::MIN_POSITIVE);
            self.moved[j] = to;
            system.slopes(t, &self.moved, &mut self.slopes);
            self.moved[j] = at;
            // The difference after rounding.
            let by = (to - at).recip();
            for (i, (slope, base)) in self.slopes.iter().zip(&self.base).enumerate() {
                self.entries[i * n + j] = (slope - base) * by;
            }
        }
        self.known = true;
    }

    /// Returns the derivative ∂(slope of `i`)/∂(component `j`).
    #[inline]
    pub(super) fn at(&self, i: usize, j: usize) -> f64 {
        self.entries[i * self.dimension + j]
    }

    /// Returns the change of slope `i` caused by given changes of the coupled components.
    #[inline]
    pub(super) fn along(&self, i: usize, changes: &[f64]) -> f64 {
        let row = &self.entries[i * self.dimension..(i + 1) * self.dimension];
        row.iter().zip(changes).map(|(a, change)| a * change).sum()
    }

    /// Returns Σ |∂(slope of `i`)/∂(component `j`) · component `j`|: the sensitivity of a slope to relative changes of all components.
    pub(super) fn size(&self, i: usize, y: &[f64]) -> f64 {
        let row = &self.entries[i * self.dimension..(i + 1) * self.dimension];
        row.iter().zip(y).map(|(a, y)| (a * y).abs()).sum()
    }
}
