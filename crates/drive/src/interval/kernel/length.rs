//! Displacements between bodies as rows of coefficients, and sums of forces along them.

use super::WIDTH;
use crate::interval::Followed;
use crate::model::{Measure, Model, Terms};
use crate::state::State;

/// Coefficients of all free coordinates.
pub(super) type Row = [f64; WIDTH];

/// Displacement between bodies: Σ coefficient · coordinate + prescribed part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Length<'a> {
    pub(super) row: Row,
    pub(super) followed: Followed<'a>,
}

/// Displacement between bodies and its rates at one time.
#[derive(Clone, Copy)]
pub(super) struct Read {
    pub(super) value: f64,
    pub(super) rate: f64,
    /// Part of the rate from prescribed motions.
    pub(super) driven: f64,
}

/// Sums of forces on N free coordinates and of powers.
pub(super) struct Sums<const N: usize> {
    pub(super) forces: [f64; N],
    pub(super) input: f64,
    pub(super) damping: f64,
}

/// Returns the coefficient of each free coordinate in a linear form.
pub(super) fn row(terms: &Terms) -> Row {
    let mut row = [0.0; WIDTH];
    for &(i, a) in terms {
        row[i] = a;
    }
    row
}

/// Returns Σ coefficient · coordinate over the free coordinates.
#[inline(always)]
pub(super) fn dot<const N: usize>(row: &Row, x: &[f64; N]) -> f64 {
    let mut sum = row[0] * x[0];
    for (a, x) in row.iter().zip(x).skip(1) {
        sum += a * x;
    }
    sum
}

impl<const N: usize> Sums<N> {
    /// Adds a force along a displacement with the prescribed rate `driven`; the input power is -force · driven.
    #[inline(always)]
    pub(super) fn apply(&mut self, row: &Row, driven: f64, force: f64) {
        for (sum, a) in self.forces.iter_mut().zip(row) {
            *sum += a * force;
        }
        self.input -= force * driven;
    }
}

impl<'a> Length<'a> {
    pub(super) fn of(measure: &Measure, model: &'a Model, state: &State) -> Option<Self> {
        Some(Self { row: row(&measure.free), followed: Followed::of(measure, model, state)? })
    }

    /// Returns displacement and rates. Large displacements of two bodies are subtracted first, to avoid rounding.
    #[inline(always)]
    pub(super) fn at<const N: usize>(&self, t: f64, (x, v): (&[f64; N], &[f64; N])) -> Read {
        let followed = self.followed.at(t);
        let (value, rate) = (dot(&self.row, x) + followed.value, dot(&self.row, v) + followed.rate);
        Read { value, rate, driven: followed.rate }
    }
}
