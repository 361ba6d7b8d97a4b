//! Corrector of the continuation: Newton's method for state and parameter together.
//!
//! Solves P(s, q) - s = 0 with one additional condition, r·(z - z₀) = 0 for all unknowns z = (s, q). The condition fixes either the length
//! along the tangent or the parameter. Broyden's update corrects the Jacobian of the last point; a new Jacobian is computed if the
//! convergence is slow.

use super::error::Trouble;
use super::place::{Bench, Place, Slopes};
use nalgebra::{DMatrix, DVector};

/// Factor on the tolerance below which the defect counts as zero.
const GOAL: f64 = 10.0;
/// Defect in natural scales that is accepted as rounding error if it does not decrease further.
pub(super) const ROUNDING: f64 = 1e-8;
/// Maximum number of iterations.
const STEPS: u32 = 14;
/// Ratio of successive defects above which a new Jacobian is computed.
const WORN: f64 = 0.2;
/// Ratio of successive defects above which a step with a new Jacobian counts as divergence.
const LEADS_AWAY: f64 = 2.0;
/// Tolerance of the additional condition, in arclength.
const MET: f64 = 1e-13;

/// Target of the corrector.
pub(super) struct Wanted<'a> {
    /// Predicted change of the unknowns: state, then parameter as a fraction of its range.
    pub(super) to: DVector<f64>,
    /// Row vector of the additional condition.
    pub(super) row: &'a DVector<f64>,
}

/// Result of the corrector.
pub(super) struct Corrected {
    pub(super) place: Place,
    /// Total change of the unknowns by the corrector.
    pub(super) gone: DVector<f64>,
    /// Number of iterations.
    pub(super) steps: u32,
}

/// Returns the derivatives of the defect with respect to all unknowns; the last row is the additional condition.
pub(super) fn matrix(slopes: &Slopes, row: &DVector<f64>) -> DMatrix<f64> {
    let count = slopes.by_value.len();
    DMatrix::from_fn(count + 1, count + 1, |i, j| match (i < count, j < count) {
        (true, true) => slopes.gradient.numbers[(i, j)] - f64::from(u8::from(i == j)),
        (true, false) => slopes.by_value[i],
        (false, _) => row[j],
    })
}

/// Iterates from a point with known derivatives until defect and additional condition are zero.
///
/// # Errors
/// Fails if the iteration diverges, or the number of unknowns changes.
pub(super) fn correct(
    bench: &Bench<'_>,
    (from, slopes): (&Place, &Slopes),
    wanted: &Wanted<'_>,
) -> Result<Corrected, Trouble> {
    let count = slopes.by_value.len();
    let goal = GOAL * bench.options.tolerance;
    let mut jacobian = matrix(slopes, wanted.row);
    let mut place = moved(bench, from, &wanted.to)?;
    let (mut gone, mut last) = (wanted.to.clone(), f64::INFINITY);
    // True if the Jacobian was computed at the previous point.
    let mut fresh = false;
    for steps in 0..STEPS {
        let (defect, size) = (place.fixed.defect.clone(), place.fixed.defect.amax());
        let missed = wanted.row.dot(&(&gone - &wanted.to));
        if missed.abs() <= MET && (size <= goal || size <= ROUNDING && size > 0.5 * last) {
            return Ok(Corrected { place, gone, steps });
        }
        if fresh && size > LEADS_AWAY * last && size > ROUNDING {
            return Err(Trouble::Diverged);
        }
        fresh = size > WORN * last && size > ROUNDING;
        if fresh {
            jacobian = matrix(&bench.slopes(&place)?, wanted.row);
        }
        let right = -defect.clone().insert_row(count, missed);
        let step = jacobian.clone().lu().solve(&right).filter(|step| step.iter().all(|x| x.is_finite()));
        let step = step.ok_or(Trouble::Diverged)?;
        let next = moved(bench, &place, &step)?;
        gone += &step;
        mend(&mut jacobian, &step, (&defect, &next.fixed.defect));
        (place, last) = (next, size);
    }
    Err(Trouble::Diverged)
}

/// Returns the point after a step. Memory outside of the Poincaré map is taken from the image, which is the state one period later.
fn moved(bench: &Bench<'_>, place: &Place, step: &DVector<f64>) -> Result<Place, Trouble> {
    let count = place.fixed.defect.len();
    let (along, by) = (step.rows(0, count), step[count]);
    let variant = match by {
        0.0 => std::rc::Rc::clone(&place.variant),
        by => bench.variant(place.variant.value + by * bench.span)?,
    };
    let of = (&place.fixed.image.state, &*place.variant);
    let state = bench.elsewhere(of, &variant, &(along - &place.fixed.defect))?;
    let next = bench.place(&variant, state)?;
    if next.fixed.defect.len() == count { Ok(next) } else { Err(Trouble::OtherForm) }
}

/// Applies Broyden's update to the rows of the defect in the Jacobian.
fn mend(jacobian: &mut DMatrix<f64>, step: &DVector<f64>, (before, after): (&DVector<f64>, &DVector<f64>)) {
    let (count, length) = (before.len(), step.norm_squared());
    if length > 0.0 {
        let mut top = jacobian.rows_mut(0, count);
        let missed = after - before - &top * step;
        top += missed * step.transpose() / length;
    }
}
