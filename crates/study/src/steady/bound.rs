//! How far the step of a fixed point may be off.
//!
//! A state that misses the fixed point by e comes back with the defect r = (A - 1) e, so e = -(1 - A)⁻¹ r: what a geometric
//! series of plain periods would add up to, r/(1 - ρ) along a single direction. The step misses by its gradient times that.
//! What the run itself misses in a period, by its tolerance, is a defect, too: the same period by finer tolerances
//! tells, the larger of what two of them do, since two runs may miss alike. Last, every number is rounded in every step: N steps
//! and events leave N ε of a natural scale, and of the way gone. All are taken without regard to sign, and twice.

use super::SteadyError;
use super::map::{Gradient, Map};
use super::newton::{Fixed, solve};
use nalgebra::{DMatrix, DVector};
use stickslip_drive::scene::Axis;

/// Tightest tolerance there is.
const TIGHTEST: f64 = 1e-13;
/// Tolerances by which it goes once more, in those of the search.
// With the first alone 24 of 995 steps of drawn drives were off by more than their bound, one by 47 times: swings take as many nodes by a
// tenth of 1e-9, and miss the same.
const FINER: [f64; 2] = [0.1, 1e-3];
/// Safety: the gradient is one of first order.
const SAFETY: f64 = 2.0;

pub(super) struct Bound {
    /// Of the step, m.
    pub(super) step: f64,
    /// At the fixed point.
    pub(super) gradient: Gradient,
}

/// Bound of the step of a body, by the gradient at the fixed point.
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
    // What rounding leaves of any number may have any sign.
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
