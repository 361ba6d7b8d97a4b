//! Where a curve meets zero: between a place where the drive steps and one where it does not.
//!
//! Beyond the edge there are no steps, or steps back, so there is no root to close in on from both sides. But the steps before it
//! are nearly a straight line: the line through the two nearest places with a step says where it ends, and a place half a tolerance
//! before that end is tried, or one half a tolerance beyond it where the last one was as near. Where the line misleads, the
//! bracket is halved.

use super::CurveError;

/// A bracket: the drive steps at one of its ends and not at the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// A place with a step.
    pub steps: f64,
    /// A place without.
    pub still: f64,
    /// Places that were tried.
    pub runs: u32,
}

/// Most places that are tried.
const MOST: u32 = 60;
/// Where the end is tried, in widths of the tolerance before and beyond the line's.
const ASIDE: f64 = 0.45;
/// An edge this near to zero, as a share of the bracket that it was in, is at zero: it has no size to be a share of.
const NOTHING: f64 = 1e-2;

impl Bracket {
    /// Whether a tolerance is one that is closed in to.
    ///
    /// # Errors
    /// A tolerance out of its range, 1e-9 to 0.1.
    pub(super) fn check(tolerance: f64) -> Result<(), CurveError> {
        if (1e-9..=0.1).contains(&tolerance) { Ok(()) } else { Err(CurveError::Tolerance(tolerance)) }
    }

    /// The middle.
    #[must_use]
    pub fn middle(&self) -> f64 {
        0.5 * (self.steps + self.still)
    }

    /// Half of what lies between.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        0.5 * (self.steps - self.still).abs()
    }

    /// Narrows a bracket until it is no wider than a share of its middle. `known` are places with their steps, the nearest to the
    /// edge first, at least one; `still` one without; `try_at` gives the step at a place, or none where there is none, and hears how
    /// much of the way is behind, 0 to 1: by how many times the bracket is narrower, as a power.
    ///
    /// # Errors
    /// Those of a place that cannot be tried.
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

/// The place to be tried by the line through the two nearest places with steps; none where it leads out of the bracket.
fn aimed(known: &[(f64, f64)], bracket: Bracket, width: f64) -> Option<f64> {
    let (&(x, step), &(farther, longer)) = (known.first()?, known.get(1)?);
    let end = x - step * (farther - x) / (longer - step);
    let inwards = (bracket.steps - bracket.still).signum();
    let is_within = |at: f64| inwards * (at - bracket.still) > 0.0 && inwards * (bracket.steps - at) > 0.0;
    let (before, beyond) = (end + inwards * ASIDE * width, end - inwards * ASIDE * width);
    // What is not finite lies nowhere.
    [before, beyond].into_iter().find(|at| is_within(*at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// Steps |S - S₀|ᵖ on the side of `known`, none on the other.
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

    /// A bent curve to 1e-4 in fewer than 20 tries, whether one place with a step is known or two.
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

    /// A bracket about zero has no middle to be a share of.
    #[test]
    fn an_edge_at_zero_comes_to_an_end() {
        let bracket = found(0.0, 1.0, &[1.0], -1.0, 1e-4);
        assert!(bracket.runs <= 25 && bracket.half_width() <= 1e-6, "{bracket:?}");
    }
}
