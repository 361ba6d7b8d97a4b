//! Bracketing of the value at which steps vanish: one end of the bracket has steps, the other has none.
//!
//! Beyond the value at which steps vanish, the step length is zero or reversed, so ordinary root finding does not apply. On the side with
//! steps, the step length is nearly linear. The line through the two nearest points with steps predicts the zero, and the next evaluation
//! is 0.45 tolerances before or beyond the prediction. The bracket is bisected if the prediction fails to halve it.

use super::CurveError;

/// Bracket of the value at which steps vanish.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// End with steps.
    pub steps: f64,
    /// End without steps.
    pub still: f64,
    /// Number of evaluations.
    pub runs: u32,
}

/// Maximum number of evaluations.
const MOST: u32 = 60;
/// Distance of an evaluation from the predicted zero, relative to the tolerance.
const ASIDE: f64 = 0.45;
/// Smallest value to which the relative tolerance refers, as a fraction of half the initial bracket, so that a search near zero ends.
const NOTHING: f64 = 1e-2;

impl Bracket {
    /// Checks a relative tolerance.
    ///
    /// # Errors
    /// Fails if the tolerance is outside 1e-9 to 0.1.
    pub(super) fn check(tolerance: f64) -> Result<(), CurveError> {
        if (1e-9..=0.1).contains(&tolerance) { Ok(()) } else { Err(CurveError::Tolerance(tolerance)) }
    }

    /// Returns the midpoint of the bracket.
    #[must_use]
    pub fn middle(&self) -> f64 {
        0.5 * (self.steps + self.still)
    }

    /// Returns half of the width of the bracket.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        0.5 * (self.steps - self.still).abs()
    }

    /// Returns the bracket of the zero, narrowed to `tolerance` times its midpoint. Returns `None` if `known` is empty.
    ///
    /// `known` contains points and their step lengths, nearest to the zero first. `still` is a point without steps. `try_at` returns the
    /// step length at a point, or `None` without steps. The second argument of `try_at` is the progress of the search, 0 to 1, on a
    /// logarithmic scale of the bracket width.
    ///
    /// # Errors
    /// Returns the first error of `try_at`.
    pub fn narrow<E>(
        mut known: Vec<(f64, f64)>,
        still: f64,
        tolerance: f64,
        mut try_at: impl FnMut(f64, f64) -> Result<Option<f64>, E>,
    ) -> Result<Option<Self>, E> {
        let Some(&(steps, _)) = known.first() else { return Ok(None) };
        let mut bracket = Self { steps, still, runs: 0 };
        let whole = bracket.half_width();
        let (least, mut misled) = (NOTHING * whole, false);
        while bracket.runs < MOST {
            let (middle, half) = (bracket.middle(), bracket.half_width());
            let width = tolerance * middle.abs().max(least);
            if 2.0 * half <= width || middle == bracket.steps || middle == bracket.still {
                break;
            }
            let at = if misled { middle } else { aimed(&known, bracket, width).unwrap_or(middle) };
            bracket.runs += 1;
            let behind = math::ln(whole / half) / math::ln(2.0 * whole / width);
            match try_at(at, behind.clamp(0.0, 1.0))? {
                Some(step) => {
                    bracket.steps = at;
                    known.insert(0, (at, step));
                }
                None => bracket.still = at,
            }
            misled = bracket.half_width() > 0.5 * half;
        }
        Ok(Some(bracket))
    }
}

/// Returns the next point to evaluate by linear extrapolation of the two nearest step lengths. Returns `None` if this point is outside the
/// bracket.
fn aimed(known: &[(f64, f64)], bracket: Bracket, width: f64) -> Option<f64> {
    let (&(x, step), &(farther, longer)) = (known.first()?, known.get(1)?);
    let end = x - step * (farther - x) / (longer - step);
    let inwards = (bracket.steps - bracket.still).signum();
    let is_within = |at: f64| inwards * (at - bracket.still) > 0.0 && inwards * (bracket.steps - at) > 0.0;
    let (before, beyond) = (end + inwards * ASIDE * width, end - inwards * ASIDE * width);
    // Comparisons with NaN are false, so points that are not finite are excluded.
    [before, beyond].into_iter().find(|at| is_within(*at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// Returns the bracket for step lengths |S - S₀|ᵖ on the side of `known` and no steps beyond S₀.
    fn found(edge: f64, power: f64, known: &[f64], still: f64, tolerance: f64) -> Bracket {
        let step = |at: f64| {
            let beyond = (at - edge) * (known[0] - still).signum();
            (beyond > 0.0).then(|| beyond.powf(power))
        };
        let known = known.iter().map(|at| (*at, step(*at).unwrap())).collect();
        Bracket::narrow(known, still, tolerance, |at, _| Ok::<_, Infallible>(step(at))).unwrap().unwrap()
    }

    #[test]
    fn a_straight_curve_takes_four_tries() {
        let bracket = found(0.74, 1.0, &[1.0, 1.2], 0.5, 1e-4);
        assert!(bracket.runs <= 4, "{bracket:?}");
        assert!(bracket.still < 0.74 && bracket.steps > 0.74 && bracket.half_width() <= 0.5e-4);
    }

    /// Nonlinear curves need fewer than 20 evaluations for 1e-4, with one or two known steps.
    #[test]
    fn bent_curves_and_a_single_step_end_in_a_bracket() {
        for power in [0.5, 1.5, 3.0] {
            for known in [&[1.0, 1.2][..], &[1.0]] {
                let bracket = found(0.74, power, known, 0.5, 1e-4);
                assert!(bracket.runs < 20, "{power}: {bracket:?}");
                assert!(bracket.still <= 0.74 && bracket.steps > 0.74, "{power}: {bracket:?}");
                assert!(bracket.half_width() <= 0.4e-4, "{power}: {bracket:?}");
            }
        }
    }

    #[test]
    fn an_edge_beyond_the_steps_is_found_as_well() {
        let bracket = found(0.4, 1.0, &[0.3, 0.2], 0.9, 1e-5);
        assert!(bracket.steps < 0.4 && bracket.still >= 0.4 && bracket.half_width() <= 2.1e-6, "{bracket:?}");
    }

    /// The midpoint of a bracket around zero gives no scale for a relative tolerance.
    #[test]
    fn an_edge_at_zero_comes_to_an_end() {
        let bracket = found(0.0, 1.0, &[1.0], -1.0, 1e-4);
        assert!(bracket.runs <= 25 && bracket.half_width() <= 1e-6, "{bracket:?}");
    }
}
