//! Displacements between bodies, laid out flat: coordinates, coefficients and prescribed motion.

use crate::equations::{Reading, Sum, accelerate, constant_forces};
use crate::interval::Followed;
use crate::model::{Measure, Model, Terms};
use crate::state::State;

/// Linear form Σ coefficient · coordinate, which also distributes a force to the coordinates.
pub(crate) trait Row: Copy {
    /// Number of free coordinates, if it is a constant.
    const COUNT: Option<usize> = None;
    fn of(terms: &Terms) -> Self;
    /// Returns Σ coefficient · coordinate over the free coordinates.
    fn dot(&self, x: &[f64]) -> f64;
    /// Adds a force along the form to the forces on the coordinates.
    fn pull(&self, forces: &mut [f64], force: f64);
    /// Adds a force along the form that is a function of its value, and returns it.
    #[inline(always)]
    fn act(&self, x: &[f64], forces: &mut [f64], force: impl FnOnce(f64) -> f64) -> f64 {
        let force = force(self.dot(x));
        self.pull(forces, force);
        force
    }
    /// Calls `add` with sums that contain the constant forces, and writes the forces into `dv`.
    fn summed<T>(model: &Model, dv: &mut [f64], add: impl FnOnce(Sum<'_>) -> T) -> T;
    /// Converts the forces on the coordinates to accelerations.
    #[inline(always)]
    fn accelerate(model: &Model, dv: &mut [f64]) {
        accelerate(&model.free, dv);
    }
}

/// Coefficients of all N free coordinates of a model: without indices, and with loops of constant length.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dense<const N: usize>([f64; N]);

/// Coordinates and coefficients of a form in a model with many coordinates. Unused terms have the coefficient 0.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Sparse {
    One(End),
    Two([End; 2]),
    /// Two bodies of which one tilts, or both.
    Four([End; 4]),
}

/// A coordinate and its coefficient.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct End {
    at: usize,
    arm: f64,
}

impl<const N: usize> Row for Dense<N> {
    const COUNT: Option<usize> = Some(N);

    fn of(terms: &Terms) -> Self {
        let mut row = [0.0; N];
        terms.iter().for_each(|&(i, a)| row[i] = a);
        Self(row)
    }

    #[inline(always)]
    fn dot(&self, x: &[f64]) -> f64 {
        let Some(x) = x.first_chunk::<N>() else { return 0.0 };
        let (mut sum, mut i) = (self.0[0] * x[0], 1);
        // An iterator is inlined only if crates are optimised together.
        while i < N {
            sum += self.0[i] * x[i];
            i += 1;
        }
        sum
    }

    #[inline(always)]
    fn pull(&self, forces: &mut [f64], force: f64) {
        let Some(forces) = forces.first_chunk_mut::<N>() else { return };
        let mut i = 0;
        while i < N {
            forces[i] += self.0[i] * force;
            i += 1;
        }
    }

    #[inline(always)]
    fn summed<T>(model: &Model, dv: &mut [f64], add: impl FnOnce(Sum<'_>) -> T) -> T {
        // Few sums stay in registers. A second call of `add` would keep it from being inlined.
        let mut forces = [0.0; N];
        if let Some(free) = model.free.first_chunk::<N>() {
            constant_forces(free, &mut forces);
        }
        let told = add(Sum { dv: &mut forces, input: 0.0, damping: 0.0 });
        if let Some(dv) = dv.first_chunk_mut::<N>() {
            *dv = forces;
        }
        told
    }

    #[inline(always)]
    fn accelerate(model: &Model, dv: &mut [f64]) {
        if let (Some(free), Some(dv)) = (model.free.first_chunk::<N>(), dv.first_chunk_mut::<N>()) {
            accelerate(free, dv);
        }
    }
}

impl Row for Sparse {
    fn of(terms: &Terms) -> Self {
        let end = |k: usize| terms.get(k).map_or_else(End::default, |&(at, arm)| End { at, arm });
        match terms.len() {
            0 | 1 => Self::One(end(0)),
            2 => Self::Two([end(0), end(1)]),
            _ => Self::Four([end(0), end(1), end(2), end(3)]),
        }
    }

    #[inline(always)]
    fn dot(&self, x: &[f64]) -> f64 {
        let of = |end: &End| end.arm * x[end.at];
        match self {
            Self::One(end) => of(end),
            Self::Two([one, other]) => of(one) + of(other),
            Self::Four(ends) => ends.iter().map(of).sum(),
        }
    }

    #[inline(always)]
    fn pull(&self, forces: &mut [f64], force: f64) {
        let mut add = |end: &End| forces[end.at] += end.arm * force;
        match self {
            Self::One(end) => add(end),
            Self::Two([one, other]) => {
                add(one);
                add(other);
            }
            Self::Four(ends) => ends.iter().for_each(add),
        }
    }

    // One choice of the kind for value and force.
    #[inline(always)]
    fn act(&self, x: &[f64], forces: &mut [f64], force: impl FnOnce(f64) -> f64) -> f64 {
        match self {
            Self::One(end) => {
                let force = force(end.arm * x[end.at]);
                forces[end.at] += end.arm * force;
                force
            }
            Self::Two([one, other]) => {
                let force = force(one.arm * x[one.at] + other.arm * x[other.at]);
                forces[one.at] += one.arm * force;
                forces[other.at] += other.arm * force;
                force
            }
            Self::Four(_) => {
                let force = force(self.dot(x));
                self.pull(forces, force);
                force
            }
        }
    }

    #[inline(always)]
    fn summed<T>(model: &Model, dv: &mut [f64], add: impl FnOnce(Sum<'_>) -> T) -> T {
        add(Sum::new(&model.free, dv))
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
        Reading { value: self.row.dot(x) + followed.value, rate: own + followed.rate, driven: followed.rate }
    }

    /// Returns the second derivative, m/s², from the accelerations of the coordinates.
    #[inline(always)]
    pub(super) fn bend(&self, t: f64, a: &[f64]) -> f64 {
        self.row.dot(a) + self.followed.at(t).acceleration
    }
}
