//! Bifurcations of a branch, and the test functions that are zero at bifurcations.
//!
//! * Fold: the parameter has an extremum along the branch, so the tangent has no component along the parameter; a multiplier is 1.
//! * Period doubling: a multiplier is -1, so ∏(1 + λ) = 0.
//! * Neimark–Sacker: a complex pair is on the unit circle, so ∏(λᵢλⱼ - 1) = 0 over all pairs i < j. The product is also zero for real λᵢ =
//!   1/λⱼ, which is not a bifurcation.
//! * Branching: a multiplier is 1 without a fold; another branch crosses. The determinant of the derivatives with
//!   respect to all unknowns is 0.

use super::corrector::matrix;
use super::happened::Change;
use super::standing::{Measure, Standing};
use crate::steady::Multiplier;
use nalgebra::{Complex, ComplexField};
use serde::{Deserialize, Serialize};

/// Largest distance of a multiplier from the value that it must have at a located bifurcation.
const THERE: f64 = 1e-2;
/// Maximum number of evaluations of the root search.
const MOST: u32 = 60;

/// Type of a special point of a branch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Bifurcation {
    /// The branch turns back: the parameter has an extremum along the branch.
    Fold,
    /// An orbit of twice the period branches off.
    PeriodDoubling,
    /// An oscillation is neutral; quasi-periodic motion branches off.
    NeimarkSacker {
        /// Period of the oscillation in drive periods.
        beat: f64,
    },
    /// Another branch of the same period crosses.
    Branching,
    /// The derivatives of the Poincaré map jump. If two events exchange their order, the events are given by source and kind, in the order
    /// below this parameter value.
    Break(Option<[(String, String); 2]>),
    /// An event appears in a period or vanishes.
    Event(Vec<Change>),
}

/// Special point of a branch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Type of the point.
    pub kind: Bifurcation,
    /// Value of the parameter at the special point, SI: midpoint of the bracket.
    pub value: f64,
    /// Half of the width of the bracket that contains the parameter value.
    pub half_width: f64,
    /// Step length at the special point, m.
    pub step: Option<f64>,
    /// Stability of the orbits below and above the parameter value; at a fold, before and after the fold along the branch.
    pub stable: [bool; 2],
}

impl Bifurcation {
    /// Returns the name in output files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::PeriodDoubling => "period doubling",
            Self::NeimarkSacker { .. } => "Neimark-Sacker",
            Self::Branching => "branching",
            Self::Break(_) => "break",
            Self::Event(_) => "event",
        }
    }

    /// Returns a description.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Fold => "the branch turns back: a stable and an unstable orbit meet".to_owned(),
            Self::PeriodDoubling => {
                "a multiplier is -1: a periodic orbit of twice the period branches off".to_owned()
            }
            Self::NeimarkSacker { beat } => {
                format!(
                    "a complex pair of multipliers is on the unit circle: quasi-periodic motion branches off, with a period of {beat:.3} drive periods"
                )
            }
            Self::Branching => "another branch crosses".to_owned(),
            Self::Break(Some([one, other])) => format!(
                "the multipliers jump: {} of {} precedes {} of {} below and follows it above",
                one.1, one.0, other.1, other.0
            ),
            Self::Break(None) => "the multipliers jump, with the same events in the same order".to_owned(),
            Self::Event(changes) => {
                let one = |change: &Change| match (change.below, change.above) {
                    (0, count) => {
                        format!("{} of {} appears above ({count} per period)", change.kind, change.source)
                    }
                    (count, 0) => format!(
                        "{} of {} disappears above ({count} per period below)",
                        change.kind, change.source
                    ),
                    (below, above) => format!(
                        "{} of {}: {below} per period below, {above} above",
                        change.kind, change.source
                    ),
                };
                changes.iter().map(one).collect::<Vec<_>>().join("; ")
            }
        }
    }
}

/// Test function that is zero at one type of bifurcation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Test {
    Fold,
    PeriodDoubling,
    NeimarkSacker,
    Branching,
}

impl Test {
    pub(super) const ALL: [Self; 4] =
        [Self::Fold, Self::PeriodDoubling, Self::NeimarkSacker, Self::Branching];

    /// Returns the value of the test function for an orbit.
    pub(super) fn at(self, standing: &Standing, measure: Measure) -> f64 {
        let values = || eigenvalues(&standing.point.multipliers);
        match self {
            Self::Fold => standing.pace(),
            Self::PeriodDoubling => values().iter().map(|value| value + 1.0).product::<Complex<f64>>().re,
            Self::NeimarkSacker => pairs(&values()).map(|[a, b]| a * b - 1.0).product::<Complex<f64>>().re,
            Self::Branching => matrix(&standing.slopes, &measure.row(&standing.tangent)).determinant(),
        }
    }

    /// Returns whether a multiplier meets the condition of the bifurcation. If multipliers jump, the test function may change sign without
    /// a zero.
    pub(super) fn is_met(self, standing: &Standing) -> bool {
        let values = eigenvalues(&standing.point.multipliers);
        match self {
            Self::Fold | Self::Branching => values.iter().any(|value| (value - 1.0).modulus() < THERE),
            Self::PeriodDoubling => values.iter().any(|value| (value + 1.0).modulus() < THERE),
            Self::NeimarkSacker => pairs(&values).any(|[a, b]| (a * b - 1.0).modulus() < THERE),
        }
    }

    /// Returns whether the test function is zero within its error, because an undamped pair of multipliers stays on the unit circle.
    pub(super) fn is_idle(self, standing: &Standing) -> bool {
        let multipliers = &standing.point.multipliers;
        self == Self::NeimarkSacker
            && multipliers.iter().any(|it| it.im != 0.0 && (it.modulus() - 1.0).abs() <= it.error)
    }

    /// Returns the bifurcation at a zero of the test function. Returns `None` if the zero is no bifurcation.
    pub(super) fn kind(self, standing: &Standing) -> Option<Bifurcation> {
        match self {
            Self::Fold => Some(Bifurcation::Fold),
            Self::PeriodDoubling => Some(Bifurcation::PeriodDoubling),
            Self::Branching => Some(Bifurcation::Branching),
            Self::NeimarkSacker => {
                let values = eigenvalues(&standing.point.multipliers);
                let off = |pair: &[Complex<f64>; 2]| (pair[0] * pair[1] - 1.0).modulus();
                let [one, other] = pairs(&values).min_by(|a, b| off(a).total_cmp(&off(b)))?;
                let is_pair = one.im != 0.0 && one.im == -other.im;
                let beat =
                    Multiplier { re: one.re, im: one.im.abs(), error: 0.0 }.beat().filter(|_| is_pair)?;
                Some(Bifurcation::NeimarkSacker { beat })
            }
        }
    }
}

/// Returns ∏(1 - λ). This product changes sign where the branch turns back: through 0 at a fold, by a jump at an event.
pub(super) fn turn(standing: &Standing) -> f64 {
    eigenvalues(&standing.point.multipliers).iter().map(|value| 1.0 - value).product::<Complex<f64>>().re
}

/// Returns all eigenvalues, including both eigenvalues of each complex pair.
fn eigenvalues(multipliers: &[Multiplier]) -> Vec<Complex<f64>> {
    let both = |multiplier: &Multiplier| {
        let value = Complex::new(multiplier.re, multiplier.im);
        [Some(value), (multiplier.im != 0.0).then(|| value.conj())]
    };
    multipliers.iter().flat_map(both).flatten().collect()
}

fn pairs(values: &[Complex<f64>]) -> impl Iterator<Item = [Complex<f64>; 2]> {
    (0..values.len()).flat_map(move |i| (0..i).map(move |j| [values[j], values[i]]))
}

/// Finds a zero of a function between two points with values of opposite sign, by regula falsi (Illinois variant).
///
/// The search ends when the bracket is at most `width` wide. Returns the bracket and the data of the best evaluation.
pub(super) fn root<T, E>(
    (mut low, mut at_low): (f64, f64),
    (mut high, mut at_high): (f64, f64),
    width: f64,
    mut value: impl FnMut(f64) -> Result<(f64, T), E>,
) -> Result<([f64; 2], Option<T>), E> {
    let (mut best, mut side): (Option<(f64, T)>, f64) = (None, 0.0);
    for _ in 0..MOST {
        if high - low <= width {
            break;
        }
        let guess = low - at_low * (high - low) / (at_high - at_low);
        // The guess keeps a distance from the ends of the bracket, so that both ends approach the zero.
        let aside = 0.45 * width;
        let guess = if guess.is_finite() { guess } else { 0.5 * (low + high) };
        let guess = guess.clamp(low + aside, high - aside);
        let (found, what) = value(guess)?;
        if best.as_ref().is_none_or(|(least, _)| found.abs() <= *least) {
            best = Some((found.abs(), what));
        }
        let (is_low, again) = (found * at_low > 0.0, side * found > 0.0);
        let other = if again { 0.5 } else { 1.0 };
        if is_low {
            (low, at_low, at_high) = (guess, found, other * at_high);
        } else {
            (high, at_high, at_low) = (guess, found, other * at_low);
        }
        side = found;
    }
    Ok(([low, high], best.map(|(_, what)| what)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// cos x = x at 0.7390851332151607 (Dottie's number).
    #[test]
    fn a_zero_is_closed_in_on_from_both_sides() {
        let mut tries = 0;
        let of = |x: f64| {
            tries += 1;
            Ok::<_, Infallible>((x.cos() - x, x))
        };
        let ([low, high], best) = root((0.0, 1.0), (1.0, -0.459_697_694), 1e-10, of).unwrap();
        let zero = 0.739_085_133_215_160_7;
        assert!(low <= zero && zero <= high && high - low <= 1e-10, "{low} {high}");
        assert!((best.unwrap() - zero).abs() <= 1e-10 && tries <= 12, "{tries}");
    }

    /// A complex pair crossing the unit circle changes the sign of the product; two real multipliers with product 1 do not.
    #[test]
    fn the_product_over_pairs_changes_its_sign_with_a_pair() {
        let value = |modulus: f64| {
            let (sin, cos) = 0.8_f64.sin_cos();
            let all = [(modulus * cos, modulus * sin), (0.3, 0.0)].map(|(re, im)| Multiplier {
                re,
                im,
                error: 0.0,
            });
            pairs(&eigenvalues(&all)).map(|[a, b]| a * b - 1.0).product::<Complex<f64>>().re
        };
        assert!(value(0.99) * value(1.01) < 0.0);
    }
}
