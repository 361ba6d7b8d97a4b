//! Newton's method on a state and the varied number together.
//!
//! P(s, q) - s = 0 and one condition more, a row r·(z - z₀) = 0 on all unknowns z = (s, q): that the way from where the branch was
//! goes as far along its tangent as was predicted, or that q is what it is. The gradient of the last place is mended by Broyden's
//! rule, and made anew where that brings too little.

use super::error::Trouble;
use super::place::{Bench, Place, Slopes};
use nalgebra::{DMatrix, DVector};

/// A defect this many times the tolerance is none.
const GOAL: f64 = 10.0;
/// A defect below this, in natural scales, that gets no smaller is one of rounding.
pub(super) const ROUNDING: f64 = 1e-8;
/// Most steps.
const STEPS: u32 = 14;
/// A step that leaves more of the defect asks for a new gradient.
const WORN: f64 = 0.2;
/// By how much more than that a step by a new one leads away.
const LEADS_AWAY: f64 = 2.0;
/// The condition is met where it is missed by less than this, in the branch's own length.
const MET: f64 = 1e-13;

/// What is to be found.
pub(super) struct Wanted<'a> {
    /// From where the branch was: numbers, then the varied one as a share of its range.
    pub(super) to: DVector<f64>,
    /// The row of the condition.
    pub(super) row: &'a DVector<f64>,
}

/// What was.
pub(super) struct Corrected {
    pub(super) place: Place,
    /// From where the branch was.
    pub(super) gone: DVector<f64>,
    /// Steps that it took.
    pub(super) steps: u32,
}

/// The derivatives of the defect by all unknowns, and the row below.
pub(super) fn matrix(slopes: &Slopes, row: &DVector<f64>) -> DMatrix<f64> {
    let count = slopes.by_value.len();
    DMatrix::from_fn(count + 1, count + 1, |i, j| match (i < count, j < count) {
        (true, true) => slopes.gradient.numbers[(i, j)] - f64::from(u8::from(i == j)),
        (true, false) => slopes.by_value[i],
        (false, _) => row[j],
    })
}

/// Goes from a place with known slopes to the one that is wanted.
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
    // Whether the gradient was made at the place before.
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

/// The place a step away from a place. What is carried along comes from its image: it is newer.
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

/// Broyden's rule on the rows of the defect.
fn mend(jacobian: &mut DMatrix<f64>, step: &DVector<f64>, (before, after): (&DVector<f64>, &DVector<f64>)) {
    let (count, length) = (before.len(), step.norm_squared());
    if length > 0.0 {
        let mut top = jacobian.rows_mut(0, count);
        let missed = after - before - &top * step;
        top += missed * step.transpose() / length;
    }
}
