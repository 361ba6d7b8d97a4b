//! Least squares of model and data by the method of Levenberg and Marquardt.

use super::data::Data;
use super::error::FitError;
use super::model::Model;
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};
use std::cell::Cell;

/// Half the distance of central differences, in logarithms of the parameters.
const STEP: f64 = 1e-3;
/// Largest change of the logarithm of a parameter.
const FAR: f64 = 6.0;
/// Factor on the initial residuals. The product replaces the residuals of a variant without result, so that the search turns away.
const WALL: f64 = 10.0;

/// Least-squares problem: model, data and weights.
pub(super) struct Squares<'a> {
    pub(super) model: &'a Model<'a>,
    pub(super) data: &'a Data,
    /// Weight of each row: inverse variance, relative to the inverse variance of the noise of a force.
    pub(super) weights: Vec<f64>,
}

/// Result of the minimisation.
pub(super) struct Found {
    /// Coordinates of the parameters: logarithms of their ratios to the initial values, or values if the initial value is 0.
    pub(super) place: Vec<f64>,
    /// Weighted sum of squared residuals, N².
    pub(super) squares: f64,
    /// Forces of the model including the offset, N.
    pub(super) force: Vec<f64>,
    /// Weighted residuals, N.
    pub(super) left: DVector<f64>,
    pub(super) runs: usize,
}

impl Squares<'_> {
    /// Returns the weighted residuals at a point, and the forces of the model including the best constant offset.
    fn left(&self, place: &[f64]) -> Result<(DVector<f64>, Vec<f64>), FitError> {
        let mut force = self.model.force(place, self.data)?;
        if self.data.is_loop {
            let weight: f64 = self.weights.iter().sum();
            let rows = self.data.force.iter().zip(&force).zip(&self.weights);
            let offset = rows.map(|((own, model), weight)| weight * (own - model)).sum::<f64>() / weight;
            force.iter_mut().for_each(|force| *force += offset);
        }
        let rows = self.data.force.iter().zip(&force).zip(&self.weights);
        let left = rows.map(|((own, model), weight)| weight.sqrt() * (model - own));
        Ok((DVector::from_iterator(force.len(), left), force))
    }

    /// Returns the derivatives of the residuals by central differences.
    pub(super) fn slopes(&self, place: &[f64]) -> Result<DMatrix<f64>, FitError> {
        let mut slopes = DMatrix::zeros(self.data.force.len(), place.len());
        for k in 0..place.len() {
            let at = |by: f64| {
                let mut place = place.to_vec();
                place[k] += by;
                self.left(&place)
            };
            slopes.set_column(k, &((at(STEP)?.0 - at(-STEP)?.0) / (2.0 * STEP)));
        }
        Ok(slopes)
    }

    /// Minimises the sum of squares from an initial point.
    pub(super) fn least(&self, start: &[f64]) -> Result<Found, FitError> {
        let (left, _) = self.left(start)?;
        let runs = Cell::new(1);
        let problem =
            Problem { squares: self, place: DVector::from_row_slice(start), wall: WALL * left, runs: &runs };
        let (problem, report) = LevenbergMarquardt::new().with_patience(20).minimize(problem);
        let place: Vec<f64> = problem.place.iter().copied().collect();
        let is_end = report.termination.was_successful() || report.number_of_evaluations > 1;
        if !is_end || place.iter().any(|value| !value.is_finite() || value.abs() > FAR) {
            return Err(FitError::NoFit);
        }
        let (left, force) = self.left(&place)?;
        Ok(Found { squares: left.norm_squared(), left, force, place, runs: runs.get() + 1 })
    }
}

struct Problem<'a, 'b> {
    squares: &'a Squares<'b>,
    place: DVector<f64>,
    wall: DVector<f64>,
    runs: &'a Cell<usize>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_, '_> {
    type ParameterStorage = Owned<f64, Dyn>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;

    fn set_params(&mut self, place: &DVector<f64>) {
        self.place.copy_from(place);
    }

    fn params(&self) -> DVector<f64> {
        self.place.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        self.runs.set(self.runs.get() + 1);
        if self.place.iter().any(|value| value.abs() > FAR) {
            return Some(self.wall.clone());
        }
        Some(self.squares.left(self.place.as_slice()).map_or_else(|_| self.wall.clone(), |(left, _)| left))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        self.runs.set(self.runs.get() + 2 * self.place.len());
        self.squares.slopes(self.place.as_slice()).ok()
    }
}
