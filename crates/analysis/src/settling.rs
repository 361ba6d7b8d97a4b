//! Whether a sequence has settled, and where it goes.
//!
//! Lengths of steps under a periodic drive are values of one map, applied again and again. Near a fixed point of the map their
//! differences e obey a linear recurrence, eₖ = a₁eₖ₋₁ + … + aₚeₖ₋ₚ, whose roots λ say all: the largest |λ| how fast what is
//! left of the start fades or grows in a period, its angle with which period it beats, the sum of all differences still to come
//! how far the limit is. The recurrence is fitted by least squares to the last half of the sequence, of the lowest order that
//! leaves nothing.
//!
//! Source: de Prony, *J. École Polytechnique* 1 (1795) 24; Aitken, *Proc. R. Soc. Edinburgh* 46 (1926) 289, is its order 1.

use crate::sequence::{Sequence, half_range, mean_of};
use crate::series::sum;
use nalgebra::{Complex, DMatrix, DVector, Schur};
use std::f64::consts::TAU;

/// How near to its limit every later value must be, relative to the limit or to the least length that counts.
pub const BAND: f64 = 1e-3;
/// Orders of recurrences that are tried.
// Three lines of a spectrum are told apart; what needs more is called irregular. With order 2 alone the growth of a beat whose
// first overtone is a tenth of it comes out with the wrong sign.
const ORDERS: [usize; 5] = [1, 2, 3, 4, 6];
/// What a recurrence may leave of the differences to count as exact, and at all.
const EXACT: f64 = 1e-5;
const PATTERN: f64 = 0.2;
/// What it may leave where growth is to be read off it.
const CLEAN: f64 = 0.03;
/// Most iterations of a decomposition: a shift of exactly four values never comes to an end.
const MOST_TURNS: usize = 1000;
/// Most values that are fitted.
const MOST: usize = 4096;
/// Swings of which the growth is told.
const MANY: f64 = 3.0;
/// No drive grows by that much in a period: a recurrence with such a root fits rounding.
const WILD: f64 = 1.25;
/// Deviations below this share of the scale are rounding: nothing is read off them.
const ROUNDING: f64 = 1e-9;
/// Half ranges of the last half below this share have no pattern that anybody would see.
const FAINT: f64 = 1e-6;
/// Least number of values of which the last agree to call them settled, and to read a recurrence off them.
const FEWEST: usize = 4;
const FEWEST_TO_FIT: usize = 6;
/// Less than this many values without a pattern may still be the way in.
const FEW: usize = 12;

/// What a sequence does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Settling {
    /// It stays where it is.
    Settled(Settled),
    /// It is on its way, or there are too few values to tell.
    NotSettled {
        /// The last change from one value to the next; none of one value.
        change: Option<f64>,
        /// Where that leads, and how far off that may be: by what two fits of it are apart, and a tenth of the way. None where they
        /// do not say, or where it is farther than all that the values have gone: nothing is foreseen so far.
        limit: Option<(f64, f64)>,
    },
    /// It changes without a pattern.
    Irregular {
        /// Half of what lies between the largest and the least value of the last half.
        spread: f64,
    },
    /// It goes on in one direction, to no limit that could be told, or is larger than what is on its way to one.
    Drifts {
        /// The last change from one value to the next.
        change: f64,
    },
    /// It swings about a mean.
    Beats {
        /// Period of the swing, in values.
        period: f64,
        /// By which factor the swing grows from one value to the next, below 1 where it fades; none where that cannot be told yet.
        growth: Option<f64>,
        /// What it swings about.
        about: f64,
        /// Its amplitude at the end.
        amplitude: f64,
    },
}

/// What is known of values beforehand, in their unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Magnitude below which a value counts as nothing.
    pub least: f64,
    /// Magnitude beyond which no value is on its way to a limit; infinite where nothing is known.
    pub most: f64,
    /// Error that each value may have.
    pub error: f64,
}

/// A sequence that has settled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settled {
    /// Place of the first value from which all lie within [`BAND`] of the limit.
    pub from: usize,
    /// Number of the last values that are as near to the limit as the end is: what is averaged.
    pub last: usize,
    /// Their mean.
    pub value: f64,
    /// How far the mean of all later values may lie from it.
    pub error: f64,
}

impl Settling {
    /// Judges values.
    pub fn of<S: Sequence + ?Sized>(values: &S, bounds: Bounds) -> Self {
        match Self::judged(values, bounds) {
            // However even they are: what goes that far in one period is carried away.
            Self::Settled(settled) if settled.value.abs() > bounds.most => {
                let change = ending(values, 0).zip(ending(values, 1)).map(|(last, before)| last - before);
                Self::Drifts { change: change.unwrap_or(0.0) }
            }
            other => other,
        }
    }

    /// The same without a look at how large they are.
    fn judged<S: Sequence + ?Sized>(values: &S, bounds: Bounds) -> Self {
        let (Bounds { least, .. }, count) = (bounds, values.count());
        let Some(last) = ending(values, 0).filter(|_| values.part(0..count).all(f64::is_finite)) else {
            return Self::NotSettled { change: None, limit: None };
        };
        let scale = |limit: f64| limit.abs().max(least);
        let quarter = count - (count / 4).clamp(3.min(count), count)..count;
        let change = ending(values, 1).map(|before| last - before);
        let spread = half_range(values, quarter.clone());
        if count >= FEWEST && spread <= ROUNDING * scale(last) {
            return Self::settled(values, (mean_of(values, quarter), spread), bounds.error, scale(last));
        }
        let half = count / 2..count;
        let (middle, spread) = (mean_of(values, half.clone()), half_range(values, half.clone()));
        if count >= FEWEST && values.part(half).all(|value| value.abs() <= least) {
            return Self::settled(values, (middle, spread), bounds.error, scale(last));
        }
        let is_shown = spread > FAINT * scale(middle);
        let fit = Fit::best(values).filter(|fit| fit.rest <= PATTERN && is_shown);
        let Some(fit) = fit else {
            let is_near = count >= FEWEST_TO_FIT && 2.0 * spread <= BAND * scale(middle);
            return match is_near {
                true => Self::settled(values, (middle, 2.0 * spread), bounds.error, scale(middle)),
                false if count < FEW => Self::NotSettled { change, limit: None },
                false => Self::Irregular { spread },
            };
        };
        fit.judge(values, (change, scale(fit.limit), bounds))
    }

    /// Values that are as near to a limit as `near` at their end, with how far fits of it are apart.
    fn settled<S: Sequence + ?Sized>(values: &S, (limit, near): (f64, f64), apart: f64, scale: f64) -> Self {
        let count = values.count();
        // Sequences on a disk are read from their beginning.
        let after = |far: f64| {
            let far = values.part(0..count).enumerate().filter(|(_, value)| (value - limit).abs() > far);
            far.last().map_or(0, |(place, _)| place + 1)
        };
        let from = after(BAND * scale).min(count - 3.min(count));
        let last = (count - after(3.0 * near).max(from)).max(3.min(count));
        let averaged = count - last..count;
        let value = mean_of(values, averaged.clone());
        let error = (value - limit).abs() + apart + half_range(values, averaged).max(near);
        Self::Settled(Settled { from, last, value, error })
    }
}

/// The value so many places before the last.
fn ending<S: Sequence + ?Sized>(values: &S, before: usize) -> Option<f64> {
    let place = values.count().checked_sub(before + 1)?;
    values.part(place..place + 1).next()
}

/// A recurrence fitted to the end of a sequence.
struct Fit {
    /// What it leaves of the differences: root mean squares over each other.
    rest: f64,
    /// The largest root: its magnitude and its angle.
    root: (f64, f64),
    /// Where the sequence goes.
    limit: f64,
    /// How far that is from the limit by another order.
    apart: f64,
}

impl Fit {
    /// The lowest order that leaves nothing, or else the one that leaves least.
    fn best<S: Sequence + ?Sized>(values: &S) -> Option<Self> {
        let count = values.count();
        if count < FEWEST_TO_FIT {
            return None;
        }
        // The way in is left out: the half of a long sequence, the first two values of a short one.
        let from = if count > 32 {
            (count / 2).max(count.saturating_sub(MOST))
        } else {
            (count / 2).min(count - FEWEST_TO_FIT).min(count / 8 + 2)
        };
        let end: Vec<f64> = values.part(from..count).collect();
        let mut best: Option<Self> = None;
        for order in ORDERS {
            let Some(fit) = Self::of(&end, order) else { continue };
            let before = best.as_ref().map_or(f64::INFINITY, |best| best.rest);
            let apart = best.as_ref().map_or(f64::INFINITY, |best| (best.limit - fit.limit).abs());
            if before <= EXACT {
                // One order more tells how sure the limit is, and nothing else: it fits rounding.
                best = best.map(|best| Self { apart: best.apart.min(apart), ..best });
                break;
            }
            if fit.rest < 0.7 * before {
                best = Some(Self { apart, ..fit });
            }
        }
        best
    }

    /// Of one order; none where there are too few values, all are equal, or a root says that it fits rounding. The roots are the
    /// eigenvalues of the companion matrix, whose first row is a.
    fn of(values: &[f64], order: usize) -> Option<Self> {
        let steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let largest = steps.iter().fold(0.0, |most: f64, e| most.max(e.abs()));
        let rows = steps
            .len()
            .checked_sub(order)
            .filter(|rows| *rows >= 2 * order && largest > 0.0 && largest.is_finite())?;
        let e = |k: usize| steps[k] / largest;
        let matrix = DMatrix::from_fn(rows, order, |i, j| e(i + order - 1 - j));
        let after = DVector::from_fn(rows, |i, _| e(i + order));
        let a = matrix.clone().try_svd(true, true, f64::EPSILON, MOST_TURNS)?.solve(&after, 1e-13).ok()?;
        if a.iter().any(|a| !a.is_finite()) {
            return None;
        }
        let rest = (&matrix * &a - &after).norm() / after.norm();
        let companion = DMatrix::from_fn(order, order, |i, j| match i {
            0 => a[j],
            _ => f64::from(u8::from(i == j + 1)),
        });
        let roots = Schur::try_new(companion, f64::EPSILON, MOST_TURNS)?.complex_eigenvalues();
        let largest_root = roots.iter().max_by(|p, q| p.norm().total_cmp(&q.norm()))?;
        // A swing and its overtones grow alike: it is the slowest of them.
        let alike = |root: &&Complex<f64>| root.norm() >= 0.995 * largest_root.norm() && root.arg() != 0.0;
        let slowest = roots.iter().filter(alike).min_by(|p, q| p.arg().abs().total_cmp(&q.arg().abs()));
        let root = slowest.filter(|_| largest_root.arg() != 0.0).unwrap_or(largest_root);
        // S = Σ of all later differences: S = Σ aⱼ (S + the last j of them).
        let known = |j: usize| sum((0..=j).map(|k| e(steps.len() - 1 - k)));
        let left = sum((0..order).map(|j| a[j] * known(j))) / (1.0 - a.sum());
        let limit = values.last()? + left * largest;
        let is_good = rest.is_finite() && limit.is_finite() && root.norm() < WILD;
        is_good.then(|| Self { rest, root: (root.norm(), root.arg().abs()), limit, apart: f64::INFINITY })
    }

    /// By which factor a swing grows from one value to the next: that of the root where nothing else is left, or else that of the
    /// deviations, root mean squares over as many whole swings at the start and at the end of the last half. None where these are
    /// less than one swing each, or contradict the root.
    fn growth<S: Sequence + ?Sized>(&self, values: &S, period: f64) -> Option<f64> {
        let (count, middle) = (values.count(), values.count() / 2);
        let half = count - middle;
        let swings = (0.5 * half as f64 / period).floor();
        let span = (swings * period).round() as usize;
        if swings < 1.0 || span >= half || (half as f64) < MANY * period {
            return None;
        }
        let square = |part| sum(values.part(part).map(|value: f64| (value - self.limit).powi(2)));
        let ratio = square(count - span..count) / square(middle..middle + span);
        let envelope = ratio.powf(0.5 / (half - span) as f64);
        let agree = (envelope > 1.0) == (self.root.0 > 1.0);
        let growth = if self.rest > CLEAN { envelope } else { self.root.0 };
        (growth.is_finite() && (agree || self.rest > CLEAN)).then_some(growth)
    }

    /// What it makes of the values.
    fn judge<S: Sequence + ?Sized>(
        &self,
        values: &S,
        (change, scale, bounds): (Option<f64>, f64, Bounds),
    ) -> Settling {
        let (count, (growth, angle)) = (values.count(), self.root);
        // One swing in the whole sequence or less is none: it could as well be a bend.
        let swings = angle * count as f64 > TAU;
        let period = if swings { TAU / angle } else { 1.0 };
        let last = ending(values, 0).unwrap_or(0.0);
        let near = match swings {
            true => {
                let end = values.part(count - ((period.ceil() as usize).max(3)).min(count)..count);
                end.fold(0.0, |most: f64, v| most.max((v - self.limit).abs()))
            }
            // What is still to come, on the way that is the same in every period.
            false => (last - self.limit).abs(),
        };
        let fades = growth < 1.0;
        let apart = if self.apart.is_finite() { self.apart } else { near };
        if fades && near + apart <= BAND * scale {
            return Settling::settled(values, (self.limit, near), apart + bounds.error, scale);
        }
        if swings && self.crossings(values) >= 2 {
            let growth = self.growth(values, period);
            return Settling::Beats { period, growth, about: self.limit, amplitude: near };
        }
        if last.abs() > bounds.most || !fades && self.rest <= CLEAN {
            return Settling::Drifts { change: change.unwrap_or(0.0) };
        }
        let (gone, to_go) = (2.0 * half_range(values, 0..count), (self.limit - last).abs());
        let is_foreseen = fades && to_go <= gone;
        Settling::NotSettled { change, limit: is_foreseen.then_some((self.limit, apart + 0.1 * to_go)) }
    }

    /// How often the last half passes the limit.
    fn crossings<S: Sequence + ?Sized>(&self, values: &S) -> usize {
        let mut above = values.part(values.count() / 2..values.count()).map(|value| value > self.limit);
        let mut before = above.next().unwrap_or_default();
        above.filter(|now| *now != std::mem::replace(&mut before, *now)).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Bounds = Bounds { least: 0.0, most: f64::INFINITY, error: 0.0 };

    fn values(count: usize, of: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..count).map(|k| of(k as f64)).collect()
    }

    fn settled(values: &[f64]) -> Settled {
        match Settling::of(values, BOUNDS) {
            Settling::Settled(settled) => settled,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_geometric_way_to_a_limit_is_told_from_its_end() {
        // sₖ = 5 - 4·0.9ᵏ: a change of 0.4·0.9ᵏ⁻¹, and 4·0.9ᵏ still to come.
        let of = |k: f64| 5.0 - 4.0 * 0.9_f64.powf(k);
        let Settling::NotSettled { change: Some(change), limit: Some((limit, _)) } =
            Settling::of(&values(30, of), BOUNDS)
        else {
            panic!("not on its way")
        };
        assert!((change - 0.4 * 0.9_f64.powi(28)).abs() < 1e-12 && (limit - 5.0).abs() < 1e-9);
        // 4·0.9ᵏ < 5·10⁻³ from k = 64 on.
        let found = settled(&values(120, of));
        assert_eq!(found.from, 64);
        assert!((found.value - 5.0).abs() <= found.error && found.error < 1e-4, "{found:?}");
    }

    #[test]
    fn the_error_holds_however_little_is_left() {
        for rate in [0.3, 0.7, 0.95, -0.6, -0.97] {
            for count in [10, 40, 160, 640] {
                let values = values(count, |k| {
                    -2.0 + 0.7 * f64::powf(-1.0, k * f64::from(rate < 0.0)) * f64::abs(rate).powf(k)
                        + 0.1 * 0.2_f64.powf(k)
                });
                if let Settling::Settled(found) = Settling::of(&values, BOUNDS) {
                    assert!((found.value + 2.0).abs() <= found.error + 1e-15, "{rate} {count}: {found:?}");
                } else {
                    // No less than a thousandth is left.
                    assert!(0.7 * f64::abs(rate).powi(count as i32) > 1e-3 * 2.0 * 0.5, "{rate} {count}");
                }
            }
        }
    }

    #[test]
    fn beats_have_a_period_and_fade_or_grow() {
        for growth in [0.997, 1.001] {
            // With an overtone of a tenth, as beats of drives have one.
            let of = |k: f64| {
                let phase = TAU * k / 7.5;
                3.0 + 0.05 * f64::powf(growth, k) * (phase.cos() + 0.1 * (2.0 * phase + 1.0).cos())
            };
            let found = Settling::of(&values(100, of), BOUNDS);
            let Settling::Beats { period, growth: Some(got), about, .. } = found else { panic!("{found:?}") };
            assert!((period - 7.5).abs() < 1e-6 && (got - growth).abs() < 1e-6, "{found:?}");
            assert!((about - 3.0).abs() < 1e-9);
        }
    }

    #[test]
    fn what_goes_on_without_limit_drifts() {
        let found = Settling::of(&values(20, |k| 1.0 - 0.5 * k), BOUNDS);
        assert!(matches!(found, Settling::Drifts { change } if (change + 0.5).abs() < 1e-12), "{found:?}");
        // Beyond what any step can be, on a way that bends.
        let of = |k: f64| 1000.0 * (1.0 - 0.99_f64.powf(k));
        let found = Settling::of(&values(60, of), Bounds { most: 10.0, ..BOUNDS });
        assert!(matches!(found, Settling::Drifts { .. }), "{found:?}");
    }

    #[test]
    fn even_steps_beyond_what_any_step_can_be_drift() {
        // A body pulled at a constant velocity: 2 µm a period, ten times the stroke of 200 nm.
        let bounds = Bounds { most: 4e-7, ..BOUNDS };
        let found = Settling::of(&values(40, |k| 2e-6 + 1e-6 * 0.1_f64.powf(k)), bounds);
        assert!(matches!(found, Settling::Drifts { .. }), "{found:?}");
        assert!(matches!(Settling::of(&values(40, |_| -3e-7), bounds), Settling::Settled(_)));
    }

    #[test]
    fn chaos_is_irregular_and_noise_is_settled() {
        // The logistic map, x → 3.9 x (1 - x).
        let mut x = 0.4;
        let mut next = || {
            x *= 3.9 * (1.0 - x);
            x
        };
        let chaos: Vec<f64> = (0..200).map(|_| next()).collect();
        let found = Settling::of(&chaos, BOUNDS);
        assert!(matches!(found, Settling::Irregular { spread } if spread > 0.3), "{found:?}");
        let noise: Vec<f64> = chaos.iter().map(|x| 1.0 + 1e-4 * (x - 0.5)).collect();
        let found = settled(&noise);
        assert!((found.value - 1.0).abs() <= found.error && found.error < 1e-3, "{found:?}");
    }

    #[test]
    fn values_held_for_four_periods_come_to_an_end() {
        // The companion of eₖ = eₖ₋₄ is a permutation, on which an unshifted iteration turns for ever.
        for start in 0..8 {
            let values = values(64, |k| 1.0 + f64::from((k as u32 + start) / 4 % 2));
            let found = Settling::of(&values, BOUNDS);
            assert!(!matches!(found, Settling::Settled(_)), "{start}: {found:?}");
        }
    }

    #[test]
    fn few_values_are_judged_with_care() {
        assert!(matches!(Settling::of(&[0.0; 0], BOUNDS), Settling::NotSettled { .. }));
        assert!(matches!(Settling::of(&[1.0, 1.0, 1.0], BOUNDS), Settling::NotSettled { .. }));
        assert_eq!(settled(&[9.0, 1.0, 1.0, 1.0]).value, 1.0);
        assert!(matches!(Settling::of(&[9.0, 1.0, 1.1, 1.0], BOUNDS), Settling::NotSettled { .. }));
        // Steps of next to nothing are constant.
        let still = Settling::of(&[1e-20, -2e-20, 1e-21, 3e-20, 0.0], Bounds { least: 1e-9, ..BOUNDS });
        assert!(matches!(still, Settling::Settled(_)), "{still:?}");
    }
}
