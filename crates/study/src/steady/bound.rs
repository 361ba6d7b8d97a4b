//! Error of the step length of a fixed point.
//!
//! A state with the error e has the defect r = (A - 1) e, so e = -(1 - A)⁻¹ r, with the Jacobian A of the Poincaré map. The error of the
//! step length is the gradient of the step length times e. Three defects contribute:
//! * the remaining defect of the fixed point;
//! * the integration error of a period: the larger difference to two runs with finer tolerances, because two runs may accidentally have the
//!   same error;
//! * rounding: N ε of each natural scale and of the displacement, for N time steps and events.
//!
//! The absolute values of these contributions are added and doubled.

use super::SteadyError;
use super::map::{Gradient, Map};
use super::newton::{Fixed, solve};
use nalgebra::{DMatrix, DVector};
use stickslip_drive::scene::Axis;

/// Smallest tolerance of the integrator.
const TIGHTEST: f64 = 1e-13;
/// Finer tolerances of the comparison runs, as a fraction of the tolerance.
// Two finer tolerances are used, because one run may have the same nodes and the same error as the run of the orbit.
const FINER: [f64; 2] = [0.1, 1e-3];
/// Safety factor, because the estimate is of first order.
const SAFETY: f64 = 2.0;

pub(super) struct Bound {
    /// Error of the step length, m.
    pub(super) step: f64,
    /// Jacobian at the fixed point.
    pub(super) gradient: Gradient,
}

/// Computes the error of a body's step length, and the Jacobian at the fixed point.
pub(super) fn bound(map: &mut Map<'_>, fixed: &Fixed, body: Option<usize>) -> Result<Bound, SteadyError> {
    let gradient = map.fine_gradient(&fixed.state, &fixed.image)?;
    let tightest = (TIGHTEST / map.tolerance()).min(1.0);
    let mut finer = FINER.map(|finer| finer.max(tightest)).to_vec();
    finer.dedup();
    let exact = finer.iter().map(|finer| map.image(&fixed.state, *finer)).collect::<Result<Vec<_>, _>>()?;
    let of_body = |way: &[f64]| {
        let section = map.section()?;
        section.of_body(way, body?, Axis::X)
    };
    let along = (0..gradient.way.ncols()).map(|j| of_body(gradient.way.column(j).as_slice()).unwrap_or(0.0));
    let along = DVector::from_iterator(gradient.way.ncols(), along);
    let count = fixed.defect.len();
    let left = DMatrix::identity(count, count) - &gradient.numbers;
    let missed = |defect: &DVector<f64>| {
        let off = solve(left.clone(), defect).unwrap_or_else(|| DVector::zeros(count));
        along.iter().zip(off.iter()).map(|(a, off)| (a * off).abs()).sum::<f64>()
    };
    // The rounding errors of the unknowns may have any sign, so their contributions are added in absolute value.
    let anything: f64 =
        (0..count).map(|j| missed(&DVector::from_fn(count, |i, _| if i == j { 1.0 } else { 0.0 }))).sum();
    let rounded = map.steps() as f64 * f64::EPSILON;
    let gone = of_body(&fixed.image.way).unwrap_or(0.0).abs();
    let runs = exact.iter().map(|exact| {
        let run = map.difference(&exact.state, &fixed.image.state).unwrap_or_else(|| DVector::zeros(count));
        let way = of_body(&exact.way).unwrap_or(0.0) - of_body(&fixed.image.way).unwrap_or(0.0);
        missed(&run) + way.abs()
    });
    let run = runs.fold(0.0, f64::max);
    let reach = 1.0 + map.natural(gone);
    let rounding = rounded * (anything * reach + gone);
    let step = SAFETY * (missed(&fixed.defect) + run + rounding);
    Ok(Bound { step, gradient })
}
