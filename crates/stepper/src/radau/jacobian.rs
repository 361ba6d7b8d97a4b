//! How slopes go with the state, by differences.

use crate::System;

/// Least difference, in last places of what it is added to.
// Fewer leave more rounding in a derivative than the simplified Newton iteration has use for: its errors shrink by that much.
const PLACES: f64 = 4096.0;

/// Derivatives of the slopes of all components by the coupled ones, about the start of a step.
#[derive(Debug, Clone)]
pub(super) struct Jacobian {
    /// By component and by coupled component.
    entries: Vec<f64>,
    dimension: usize,
    /// How far each coupled component is moved.
    differences: Vec<f64>,
    /// Slopes at the start, which are needed for the differences.
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

    /// Takes over what another one of the same size knows, in the room there is.
    pub(super) fn copy(&mut self, of: &Self) {
        self.entries.copy_from_slice(&of.entries);
        self.base.copy_from_slice(&of.base);
        self.known = of.known;
    }

    /// Evaluations that it takes.
    pub(super) fn cost(&self) -> u64 {
        self.dimension as u64 + 1
    }

    /// Takes the differences at a time and a state.
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
            // What was really added, after rounding.
            let by = (to - at).recip();
            for (i, (slope, base)) in self.slopes.iter().zip(&self.base).enumerate() {
                self.entries[i * n + j] = (slope - base) * by;
            }
        }
        self.known = true;
    }

    /// ∂(slope of `i`)/∂(component `j`).
    #[inline]
    pub(super) fn at(&self, i: usize, j: usize) -> f64 {
        self.entries[i * self.dimension + j]
    }

    /// Change of the slope of `i` with changes of the coupled components.
    #[inline]
    pub(super) fn along(&self, i: usize, changes: &[f64]) -> f64 {
        let row = &self.entries[i * self.dimension..(i + 1) * self.dimension];
        row.iter().zip(changes).map(|(a, change)| a * change).sum()
    }

    /// Σ |∂(slope of `i`)/∂(component `j`) · component `j`|: what a relative change of every component may make of a slope.
    pub(super) fn size(&self, i: usize, y: &[f64]) -> f64 {
        let row = &self.entries[i * self.dimension..(i + 1) * self.dimension];
        row.iter().zip(y).map(|(a, y)| (a * y).abs()).sum()
    }
}
