//! Access to the state during an evaluation, and sums of forces.
//!
//! A [`View`] gives access to time and state components, with or without velocities; code is compiled for each case. A [`Sum`] adds up
//! forces and powers by means of the Jacobian of the contact displacements.

use crate::Sample;
use crate::interval::Row;
use crate::model::{Free, Terms};

/// Access to time and state components for an evaluation.
pub(crate) trait View {
    /// Whether velocities of free coordinates are known. Without them, rates contain prescribed motions only.
    const MOVES: bool;
    /// Returns the time, s.
    fn time(&self) -> f64;
    /// Returns component `i` of the state.
    fn component(&self, i: usize) -> f64;
    /// Returns output `k` of the blocks and quasi-static coordinates, if it has been computed for this evaluation.
    #[inline(always)]
    fn output(&self, k: usize) -> Option<Sample> {
        let _ = k;
        None
    }
}

/// View with the first outputs of blocks and quasi-static coordinates, computed once for all that read them.
pub(crate) struct Once<'v, V> {
    pub(crate) at: &'v V,
    pub(crate) outputs: &'v [Sample],
}

impl<V: View> View for Once<'_, V> {
    const MOVES: bool = V::MOVES;
    #[inline(always)]
    fn time(&self) -> f64 {
        self.at.time()
    }
    #[inline(always)]
    fn component(&self, i: usize) -> f64 {
        self.at.component(i)
    }
    #[inline(always)]
    fn output(&self, k: usize) -> Option<Sample> {
        self.outputs.get(k).copied()
    }
}

/// View of all components of the state.
pub(crate) struct Components<Y> {
    /// Time, s.
    pub(crate) t: f64,
    /// Function that returns a component by index.
    pub(crate) y: Y,
}

impl<Y: Fn(usize) -> f64> View for Components<Y> {
    const MOVES: bool = true;
    #[inline(always)]
    fn time(&self) -> f64 {
        self.t
    }
    #[inline(always)]
    fn component(&self, i: usize) -> f64 {
        (self.y)(i)
    }
}

/// View of positions only.
pub(crate) struct Positions<'a> {
    pub(crate) t: f64,
    pub(crate) x: &'a [f64],
}

impl View for Positions<'_> {
    const MOVES: bool = false;
    #[inline(always)]
    fn time(&self) -> f64 {
        self.t
    }
    #[inline(always)]
    fn component(&self, i: usize) -> f64 {
        self.x[i]
    }
}

/// Value and rates of a linear form of the coordinates at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reading {
    /// Value, m.
    pub(crate) value: f64,
    /// Rate, m/s.
    pub(crate) rate: f64,
    /// Part of the rate from prescribed motions, m/s.
    pub(crate) driven: f64,
}

/// Sums of forces on the free coordinates and of powers.
pub(crate) struct Sum<'a> {
    /// Forces on free coordinates, N or N m; see [`accelerate`].
    pub(crate) dv: &'a mut [f64],
    /// Power of prescribed motions and loads, W.
    pub(crate) input: f64,
    /// Power of dampers, W.
    pub(crate) damping: f64,
}

impl<'a> Sum<'a> {
    /// Creates sums that contain gravity and constant loads; their work counts as potential energy, not as power.
    #[inline(always)]
    pub(crate) fn new(free: &[Free], dv: &'a mut [f64]) -> Self {
        constant_forces(free, dv);
        Self { dv, input: 0.0, damping: 0.0 }
    }

    /// Adds a force along a displacement that is a linear form of the coordinates. The opposite force acts on the source of the prescribed
    /// motion, so the input power is -force·driven.
    ///
    /// `driven` is the part of the displacement's rate from prescribed motions, m/s.
    #[inline(always)]
    pub(super) fn apply(&mut self, free: &Terms, driven: f64, force: f64) {
        for &(i, a) in free {
            self.dv[i] += a * force;
        }
        self.input -= force * driven;
    }

    /// Adds a force along a displacement that is laid out flat, as [`Sum::apply`].
    #[inline(always)]
    pub(crate) fn along(&mut self, row: &impl Row, driven: f64, force: f64) {
        row.pull(self.dv, force);
        self.input -= force * driven;
    }
}

/// Writes gravity and constant loads on the free coordinates.
#[inline(always)]
pub(crate) fn constant_forces(free: &[Free], dv: &mut [f64]) {
    let (mut i, count) = (0, dv.len().min(free.len()));
    // An iterator is inlined only if crates are optimised together.
    while i < count {
        dv[i] = free[i].force;
        i += 1;
    }
}

/// Converts the forces on the free coordinates to accelerations.
#[inline(always)]
pub(crate) fn accelerate(free: &[Free], dv: &mut [f64]) {
    let (mut i, count) = (0, dv.len().min(free.len()));
    while i < count {
        dv[i] *= free[i].mobility;
        i += 1;
    }
}
