//! Displacements between bodies, laid out flat: coordinates, coefficients and prescribed motion.

use crate::equations::{Reading, Sum};
use crate::interval::Followed;
use crate::model::{Measure, Model, Terms};
use crate::state::State;

/// Linear form Σ coefficient · coordinate, which also distributes a force to the coordinates.
pub(crate) trait Row: Copy {
    fn of(terms: &Terms) -> Self;
    /// Returns Σ coefficient · coordinate over the free coordinates.
    fn dot(&self, x: &[f64]) -> f64;
    /// Adds a force along the form to the forces on the coordinates.
    fn pull(&self, forces: &mut [f64], force: f64);
    /// Calls `add` with sums that contain the constant forces, and writes the forces into `dv`.
    fn summed<T>(model: &Model, dv: &mut [f64], add: impl FnOnce(Sum<'_>) -> T) -> T;
}

/// Coefficients of all N free coordinates of a model: without indices, and with loops of constant length.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dense<const N: usize>([f64; N]);

/// Coordinates and coefficients of a form in a model with many coordinates. Unused terms have the coefficient 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sparse {
    first: [End; 2],
    /// Terms of two bodies that both tilt.
    others: Option<[End; 2]>,
}

/// A coordinate and its coefficient.
#[derive(Debug, Clone, Copy, Default)]
struct End {
    at: usize,
    arm: f64,
}

impl<const N: usize> Row for Dense<N> {
    fn of(terms: &Terms) -> Self {
        let mut row = [0.0; N];
        terms.iter().for_each(|&(i, a)| row[i] = a);
        Self(row)
    }

    #[inline(always)]
    fn dot(&self, x: &[f64]) -> f64 {
        let Some(x) = x.first_chunk::<N>() else { return 0.0 };
        let mut sum = self.0[0] * x[0];
        for (a, x) in self.0.iter().zip(x).skip(1) {
            sum += a * x;
        }
        sum
    }

    #[inline(always)]
    fn pull(&self, forces: &mut [f64], force: f64) {
        let Some(forces) = forces.first_chunk_mut::<N>() else { return };
        forces.iter_mut().zip(self.0).for_each(|(sum, a)| *sum += a * force);
    }

    #[inline(always)]
    fn summed<T>(model: &Model, dv: &mut [f64], add: impl FnOnce(Sum<'_>) -> T) -> T {
        // Few sums stay in registers.
        let mut forces = [0.0; N];
        let told = add(Sum::new(model, &mut forces));
        dv.copy_from_slice(&forces);
        told
    }
}

impl Row for Sparse {
    fn of(terms: &Terms) -> Self {
        let end = |k: usize| terms.get(k).map_or_else(End::default, |&(at, arm)| End { at, arm });
        Self { first: [end(0), end(1)], others: (terms.len() > 2).then(|| [end(2), end(3)]) }
    }

    #[inline(always)]
    fn dot(&self, x: &[f64]) -> f64 {
        let of = |end: End| end.arm * x[end.at];
        let sum = of(self.first[0]) + of(self.first[1]);
        match self.others {
            Some([one, other]) => (sum + of(one)) + of(other),
            None => sum,
        }
    }

    #[inline(always)]
    fn pull(&self, forces: &mut [f64], force: f64) {
        let mut add = |end: End| forces[end.at] += end.arm * force;
        add(self.first[0]);
        add(self.first[1]);
        if let Some([one, other]) = self.others {
            add(one);
            add(other);
        }
    }

    #[inline(always)]
    fn summed<T>(model: &Model, dv: &mut [f64], add: impl FnOnce(Sum<'_>) -> T) -> T {
        add(Sum::new(model, dv))
    }
}

/// Displacement between bodies: Σ coefficient · coordinate + prescribed part.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Length<'a, R> {
    pub(super) row: R,
    pub(super) followed: Followed<'a>,
}

impl<'a, R: Row> Length<'a, R> {
    pub(super) fn of(measure: &Measure, model: &'a Model, state: &State) -> Option<Self> {
        Some(Self { row: R::of(&measure.free), followed: Followed::of(measure, model, state)? })
    }

    /// Returns displacement and rates; without velocities `v` the rate is that of the prescribed part. Large displacements of two bodies
    /// are subtracted first, to avoid rounding.
    #[inline(always)]
    pub(super) fn at(&self, t: f64, x: &[f64], v: Option<&[f64]>) -> Reading {
        let followed = self.followed.at(t);
        let own = v.map_or(0.0, |v| self.row.dot(v));
        Reading {
            value: self.row.dot(x) + followed.value,
            rate: own + followed.rate,
            driven: followed.rate,
        }
    }

    /// Returns the second derivative, m/s², from the accelerations of the coordinates.
    #[inline(always)]
    pub(super) fn bend(&self, t: f64, a: &[f64]) -> f64 {
        self.row.dot(a) + self.followed.at(t).acceleration
    }
}
