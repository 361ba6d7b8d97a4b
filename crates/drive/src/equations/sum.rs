//! What an evaluation reads and what it adds up.
//!
//! A [`View`] is how an evaluation reads a moment, with velocities or without; compiled for each, so that
//! Nyström's method pays for no rate. A [`Sum`] is where forces meet: by the row of a measure's Jacobian, so
//! that forces along u, d or an elongation need no cases.

use crate::Model;
use crate::model::Terms;

/// Where an evaluation finds the moment it is asked about.
pub(crate) trait View {
    /// Whether velocities of free coordinates are known; otherwise rates are those of followers alone.
    const MOVES: bool;
    /// Time, s.
    fn time(&self) -> f64;
    /// Component `i` of the state.
    fn component(&self, i: usize) -> f64;
}

/// All components of the state.
pub(crate) struct Components<Y> {
    /// s.
    pub(crate) t: f64,
    /// Reads a component by its place.
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

/// Positions alone.
pub(super) struct Positions<'a> {
    pub(super) t: f64,
    pub(super) x: &'a [f64],
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

/// A measure at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reading {
    /// m.
    pub(crate) value: f64,
    /// m/s.
    pub(crate) rate: f64,
    /// The part of the rate that followers make, m/s.
    pub(crate) driven: f64,
}

/// Forces on the free coordinates, and powers, as they add up.
pub(super) struct Sum<'a> {
    /// On each free coordinate, N or N m; in the end its acceleration.
    pub(super) dv: &'a mut [f64],
    /// Power that followers and loads put in, W.
    pub(super) input: f64,
    /// Power that dampers take, W.
    pub(super) damping: f64,
}

impl<'a> Sum<'a> {
    /// Begins with gravity and constant loads, whose work is read off the positions and is no power here.
    #[inline(always)]
    pub(super) fn new(model: &Model, dv: &'a mut [f64]) -> Self {
        for (dv, free) in dv.iter_mut().zip(&model.free) {
            *dv = free.force;
        }
        Self { dv, input: 0.0, damping: 0.0 }
    }

    /// From forces to accelerations; gives the powers.
    ///
    /// Input and damping, W.
    #[inline(always)]
    pub(super) fn accelerate(self, model: &Model) -> (f64, f64) {
        for (dv, free) in self.dv.iter_mut().zip(&model.free) {
            *dv *= free.mobility;
        }
        (self.input, self.damping)
    }

    /// Adds a force along a measure. What drives its followers supplies the opposite force: its power is input.
    ///
    /// `driven` is the part of the measure's rate that followers make, m/s: the input is -force·driven.
    #[inline(always)]
    pub(super) fn apply(&mut self, free: &Terms, driven: f64, force: f64) {
        for &(i, a) in free {
            self.dv[i] += a * force;
        }
        self.input -= force * driven;
    }
}
