//! Whether a sequence has settled, and where it goes.
//!
//! Lengths of steps under a periodic drive are values of one map, applied again and again. Near a fixed point of the map their
//! differences e obey a linear recurrence, eₖ = a₁eₖ₋₁ + … + aₚeₖ₋ₚ, whose roots λ say all: the largest |λ| how fast what is
//! left of the start fades or grows in a period, its angle with which period it beats, the sum of all differences still to come
//! how far the limit is. The recurrence is fitted by least squares to the last half of the sequence, of the lowest order that
//! leaves nothing.
//!
//! Source: de Prony, *J. École Polytechnique* 1 (1795) 24; Aitken, *Proc. R. Soc. Edinburgh* 46 (1926) 289, is its order 1.

mod recurrence;

use crate::sequence::{Sequence, half_range, mean_of};
use recurrence::{CLEAN, Recurrence};
use std::f64::consts::TAU;

/// How near to its limit every later value must be, relative to the limit or to the least length that counts.
pub const BAND: f64 = 1e-3;
/// What a recurrence may leave of the differences to be a pattern at all.
const PATTERN: f64 = 0.2;
/// Deviations below this share of the scale are rounding: nothing is read off them.
const ROUNDING: f64 = 1e-9;
/// Half ranges of the last half below this share have no pattern that anybody would see.
const FAINT: f64 = 1e-6;
/// Part of the way that is left by which a limit may be missed whatever fits say: ways bend.
// Of 22 limits of drawn drives after 20 or 60 periods, against 20 times as many, a tenth missed four by 1.4 to 2.6 times what was told, this
// three by 1.1 to 1.5.
const UNFORESEEN: f64 = 0.3;
/// Least number of values of which the last agree to call them settled.
const FEWEST: usize = 4;
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
        /// Where that leads, and how far off that may be: by what two fits of it are apart, and three tenths of the way. None where they
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
        if count >= FEWEST && values.part(half.clone()).all(|value| value.abs() <= least) {
            // What is on its way goes on: how far, so slowly, nobody knows.
            let quarter = half.start + half.len() / 2;
            let way = (mean_of(values, half.start..quarter) - mean_of(values, quarter..count)).abs();
            let to_come = if way > 0.5 * spread { least } else { 0.0 };
            return Self::settled(values, (middle, spread), bounds.error + to_come, scale(last));
        }
        let is_shown = spread > FAINT * scale(middle);
        let fit = Recurrence::best(values).filter(|fit| fit.rest <= PATTERN && is_shown);
        let Some(fit) = fit else {
            let is_near = count >= recurrence::FEWEST && 2.0 * spread <= BAND * scale(middle);
            return match is_near {
                true => Self::settled(values, (middle, 2.0 * spread), bounds.error, scale(middle)),
                false if count < FEW => Self::NotSettled { change, limit: None },
                false => Self::Irregular { spread },
            };
        };
        Self::by(&fit, values, (change, scale(fit.limit), bounds))
    }

    /// What a recurrence makes of the values.
    fn by<S: Sequence + ?Sized>(
        fit: &Recurrence,
        values: &S,
        (change, scale, bounds): (Option<f64>, f64, Bounds),
    ) -> Self {
        let (count, (growth, angle)) = (values.count(), fit.root);
        // One swing in the whole sequence or less is none: it could as well be a bend.
        let swings = angle * count as f64 > TAU;
        let period = if swings { TAU / angle } else { 1.0 };
        let last = ending(values, 0).unwrap_or(0.0);
        let near = match swings {
            true => {
                let end = values.part(count - ((period.ceil() as usize).max(3)).min(count)..count);
                end.fold(0.0, |most: f64, v| most.max((v - fit.limit).abs()))
            }
            // What is still to come, on the way that is the same in every period.
            false => (last - fit.limit).abs(),
        };
        let fades = growth < 1.0;
        let apart = if fit.apart.is_finite() { fit.apart } else { near };
        if fades && near + apart <= BAND * scale {
            return Self::settled(values, (fit.limit, near), apart + bounds.error, scale);
        }
        if swings && fit.crossings(values) >= 2 {
            let growth = fit.growth(values, period);
            return Self::Beats { period, growth, about: fit.limit, amplitude: near };
        }
        if last.abs() > bounds.most || !fades && fit.rest <= CLEAN {
            return Self::Drifts { change: change.unwrap_or(0.0) };
        }
        let (gone, to_go) = (2.0 * half_range(values, 0..count), (fit.limit - last).abs());
        let is_foreseen = fades && to_go <= gone;
        Self::NotSettled { change, limit: is_foreseen.then_some((fit.limit, apart + UNFORESEEN * to_go)) }
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

    /// Values below what counts that fade by a thousandth from one to the next: their mean is none of those to come.
    #[test]
    fn what_fades_below_what_counts_may_come_to_nothing() {
        let bounds = Bounds { least: 3e-9, ..BOUNDS };
        for count in [20, 40, 160] {
            let fades = values(count, |k| 1.45e-9 * 0.9988_f64.powf(k));
            let Settling::Settled(found) = Settling::of(&fades, bounds) else { panic!("{count}") };
            assert!(found.value.abs() <= found.error, "{count}: {found:?}");
            // The same values in no order stay where they are.
            let stays = values(count, |k| fades[(k * 7.0) as usize % count]);
            let Settling::Settled(found) = Settling::of(&stays, bounds) else { panic!("{count}") };
            assert!(found.error < 0.3 * found.value, "{count}: {found:?}");
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
