//! Places of a branch at which its motions change their kind, and the functions that are zero there.
//!
//! * Fold: the varied number turns, its share of the tangent is 0; a multiplier is 1.
//! * Period doubling: a multiplier is -1, so ∏(1 + λ) = 0.
//! * Neimark–Sacker: a pair is on the unit circle, so ∏(λᵢλⱼ - 1) = 0 over all pairs i < j; where λᵢ and λⱼ are real the function is zero as
//!   well and nothing happens.
//! * Branching: a multiplier is 1 and the varied number does not turn: another branch crosses, det of the derivatives by all
//!   unknowns is 0.

use super::corrector::matrix;
use super::happened::Change;
use super::standing::{Measure, Standing};
use crate::steady::Multiplier;
use nalgebra::{Complex, ComplexField};
use serde::{Deserialize, Serialize};

/// How near a multiplier is to where it must be, at a place that is closed in on.
const THERE: f64 = 1e-2;
/// Most tries for a place.
const MOST: u32 = 60;

/// What happens at a place of a branch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Bifurcation {
    /// The branch turns back.
    Fold,
    /// A motion of twice the period leaves it.
    PeriodDoubling,
    /// A beat neither fades nor grows: motions that beat for ever leave it.
    NeimarkSacker {
        /// Periods of the beat.
        beat: f64,
    },
    /// Another branch of the same period crosses.
    Branching,
    /// What leads a disturbance on changes at once: two events, by contact or block and kind, change places, the first comes first below;
    /// or none does, and what changes is nothing that a period tells.
    Break(Option<[(String, String); 2]>),
    /// Something begins to happen in a period, or no longer does.
    Event(Vec<Change>),
}

/// A place of a branch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// What happens there.
    pub kind: Bifurcation,
    /// The varied number there, SI: the middle of a bracket.
    pub value: f64,
    /// Half of the bracket.
    pub half_width: f64,
    /// Step there, m.
    pub step: Option<f64>,
    /// Whether motions are stable on the side of smaller and of larger values; of a fold, before and after it along the branch.
    pub stable: [bool; 2],
}

impl Bifurcation {
    /// Its word in files.
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

    /// In words.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Fold => "the branch turns back: a stable and an unstable motion meet".to_owned(),
            Self::PeriodDoubling => "a disturbance that changes sides every period neither fades nor grows: motions of twice the period begin".to_owned(),
            Self::NeimarkSacker { beat } => {
                format!("a beat of {beat:.3} periods neither fades nor grows: motions that beat for ever begin")
            }
            Self::Branching => "another branch crosses".to_owned(),
            Self::Break(Some([one, other])) => format!(
                "multipliers jump: {} of {} comes before {} of {} below, after it above",
                one.1, one.0, other.1, other.0
            ),
            Self::Break(None) => "multipliers jump, though as much happens in a period as before, in the same order".to_owned(),
            Self::Event(changes) => {
                let one = |change: &Change| match (change.below, change.above) {
                    (0, count) => format!("above, {} of {} appears ({count} a period)", change.kind, change.source),
                    (count, 0) => format!("above, {} of {} vanishes ({count} a period below)", change.kind, change.source),
                    (below, above) => format!("{} of {}: {below} a period below, {above} above", change.kind, change.source),
                };
                changes.iter().map(one).collect::<Vec<_>>().join("; ")
            }
        }
    }
}

/// A function that is zero at one kind of place.
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

    /// Its value at a motion.
    pub(super) fn at(self, standing: &Standing, measure: Measure) -> f64 {
        let values = || eigenvalues(&standing.point.multipliers);
        match self {
            Self::Fold => standing.pace(),
            Self::PeriodDoubling => values().iter().map(|value| value + 1.0).product::<Complex<f64>>().re,
            Self::NeimarkSacker => pairs(&values()).map(|[a, b]| a * b - 1.0).product::<Complex<f64>>().re,
            Self::Branching => matrix(&standing.slopes, &measure.row(&standing.tangent)).determinant(),
        }
    }

    /// Whether a multiplier is there where it must be. Where multipliers jump the function may leap over zero.
    pub(super) fn is_met(self, standing: &Standing) -> bool {
        let values = eigenvalues(&standing.point.multipliers);
        match self {
            Self::Fold | Self::Branching => values.iter().any(|value| (value - 1.0).modulus() < THERE),
            Self::PeriodDoubling => values.iter().any(|value| (value + 1.0).modulus() < THERE),
            Self::NeimarkSacker => pairs(&values).any(|[a, b]| (a * b - 1.0).modulus() < THERE),
        }
    }

    /// Whether it is zero at a motion but for what its multipliers may be off: a pair that nothing damps lies on the unit circle all
    /// along, and crosses it nowhere.
    pub(super) fn is_idle(self, standing: &Standing) -> bool {
        let multipliers = &standing.point.multipliers;
        self == Self::NeimarkSacker
            && multipliers.iter().any(|it| it.im != 0.0 && (it.modulus() - 1.0).abs() <= it.error)
    }

    /// What happens where it is zero; none where that is nothing.
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

/// ∏(1 - λ): where the branch turns back it changes its sign, through 0 at a fold, by a jump at an event.
pub(super) fn turn(standing: &Standing) -> f64 {
    eigenvalues(&standing.point.multipliers).iter().map(|value| 1.0 - value).product::<Complex<f64>>().re
}

/// All of them, both of each pair.
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

/// The zero of a function between two places at which it has values of different signs: regula falsi, of the end that stays half the
/// value (Illinois), until it lies between two places that are no farther apart than `width`. Returns the last place on either side.
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
        // Next to an end that is as good as the zero the other side of it is looked at.
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

    /// A pair on the circle counts, two real multipliers whose product is 1 do not change their signs together.
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
