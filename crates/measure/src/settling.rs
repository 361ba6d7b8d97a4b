//! Convergence of a sequence and extrapolation of its limit, by Prony's method.
//!
//! The step lengths of a periodically driven system are iterates of a map. Near a fixed point, differences e of consecutive values obey a
//! linear recurrence, eₖ = a₁eₖ₋₁ + … + aₚeₖ₋ₚ. Its roots λ determine the behaviour: the largest |λ| is the decay or growth factor per
//! period, and its angle gives the oscillation period. The sum of all future differences gives the limit. The coefficients are fitted by
//! least squares to the last half of the sequence. The lowest order with a negligible residual is used.
//!
//! Source: de Prony, *J. École Polytechnique* 1 (1795) 24. Order 1 is Aitken, *Proc. R. Soc. Edinburgh* 46 (1926) 289.

mod recurrence;

use crate::sequence::{Sequence, half_range, mean_of};
use recurrence::{CLEAN, Recurrence};
use std::f64::consts::TAU;

/// Relative distance from the limit within which a sequence has settled.
pub const BAND: f64 = 1e-3;
/// Largest relative residual of a recurrence that counts as a fit.
const PATTERN: f64 = 0.2;
/// Relative deviations below this value count as rounding errors.
const ROUNDING: f64 = 1e-9;
/// If the relative half range of the last half of the values is below this value, no recurrence is fitted.
const FAINT: f64 = 1e-6;
/// Fraction of the remaining change that is added to the error of an extrapolated limit.
// Determined by 22 extrapolated limits of random drives.
const UNFORESEEN: f64 = 0.3;
/// Minimum number of values of a settled sequence.
const FEWEST: usize = 4;
/// Minimum number of values for calling a sequence irregular. A shorter sequence may still be in its initial transient.
const FEW: usize = 12;

/// Behaviour of a sequence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Settling {
    /// The sequence has settled.
    Settled(Settled),
    /// The sequence approaches a limit but has not settled, or there are too few values.
    NotSettled {
        /// Difference between the last two values. `None` for a single value.
        change: Option<f64>,
        /// Extrapolated limit and its error, which is the difference of two fits plus 30 % of the remaining change.
        ///
        /// `None` if there is no fit, or if the remaining change exceeds the range of all values.
        limit: Option<(f64, f64)>,
    },
    /// The sequence varies without a pattern.
    Irregular {
        /// Half the range of the values in the last half of the sequence.
        spread: f64,
    },
    /// The sequence changes in one direction without a recognised limit, or the values are too large to converge.
    Drifts {
        /// Difference between the last two values.
        change: f64,
    },
    /// The sequence oscillates about a mean.
    Beats {
        /// Oscillation period, in values.
        period: f64,
        /// Growth factor of the amplitude per value, below 1 for a decay. `None` if it cannot be determined yet.
        growth: Option<f64>,
        /// Mean of the oscillation.
        about: f64,
        /// Amplitude at the end.
        amplitude: f64,
    },
}

/// Known bounds of the values, in their unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Magnitude below which a value counts as zero.
    pub least: f64,
    /// Magnitude above which a sequence is not considered to converge. Infinite if unknown.
    pub most: f64,
    /// Error of each value.
    pub error: f64,
}

/// Result for a settled sequence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settled {
    /// Index of the first value from which all values are within [`BAND`] of the limit.
    pub from: usize,
    /// Number of values at the end that are averaged.
    pub last: usize,
    /// Mean of these values.
    pub value: f64,
    /// Error of the mean as an estimate for all later values.
    pub error: f64,
}

impl Settling {
    /// Determines the behaviour of a sequence.
    pub fn of<S: Sequence + ?Sized>(values: &S, bounds: Bounds) -> Self {
        match Self::judged(values, bounds) {
            // Such large values are no steps: the body is carried away, even if all values are equal.
            Self::Settled(settled) if settled.value.abs() > bounds.most => {
                let change = ending(values, 0).zip(ending(values, 1)).map(|(last, before)| last - before);
                Self::Drifts { change: change.unwrap_or(0.0) }
            }
            other => other,
        }
    }

    /// Determines the behaviour of a sequence without a check of the magnitude of the values.
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
            // For a slow drift below the threshold, no limit is known.
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

    /// Determines the behaviour from a fitted recurrence.
    fn by<S: Sequence + ?Sized>(
        fit: &Recurrence,
        values: &S,
        (change, scale, bounds): (Option<f64>, f64, Bounds),
    ) -> Self {
        let (count, (growth, angle)) = (values.count(), fit.root);
        // An oscillation must complete more than one period within the sequence.
        let swings = angle * count as f64 > TAU;
        let period = if swings { TAU / angle } else { 1.0 };
        let last = ending(values, 0).unwrap_or(0.0);
        let near = match swings {
            true => {
                let end = values.part(count - ((period.ceil() as usize).max(3)).min(count)..count);
                end.fold(0.0, |most: f64, v| most.max((v - fit.limit).abs()))
            }
            // Remaining change of a monotonic sequence.
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

    /// Returns the result for a settled sequence.
    ///
    /// `near` is the distance of the last value from the limit, and `apart` is the difference of the limits of two fits.
    fn settled<S: Sequence + ?Sized>(values: &S, (limit, near): (f64, f64), apart: f64, scale: f64) -> Self {
        let count = values.count();
        // Sequences on disk are read from their beginning.
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

/// Returns the value that is `before` positions before the last value.
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
        // sₖ = 5 - 4·0.9ᵏ: the last change is 0.4·0.9ᵏ⁻¹, and the remaining change is 4·0.9ᵏ.
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
                    // The remaining change is at least one thousandth.
                    assert!(0.7 * f64::abs(rate).powi(count as i32) > 1e-3 * 2.0 * 0.5, "{rate} {count}");
                }
            }
        }
    }

    #[test]
    fn beats_have_a_period_and_fade_or_grow() {
        for growth in [0.997, 1.001] {
            // With a harmonic of one tenth of the amplitude, as in simulated drives.
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
        // Larger than any possible step, with a curved trend.
        let of = |k: f64| 1000.0 * (1.0 - 0.99_f64.powf(k));
        let found = Settling::of(&values(60, of), Bounds { most: 10.0, ..BOUNDS });
        assert!(matches!(found, Settling::Drifts { .. }), "{found:?}");
    }

    #[test]
    fn even_steps_beyond_what_any_step_can_be_drift() {
        // A body moving at a constant velocity: 2 µm per period, ten times the stroke of 200 nm.
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
        // The companion matrix of eₖ = eₖ₋₄ is a permutation, for which the unshifted iteration does not converge.
        for start in 0..8 {
            let values = values(64, |k| 1.0 + f64::from((k as u32 + start) / 4 % 2));
            let found = Settling::of(&values, BOUNDS);
            assert!(!matches!(found, Settling::Settled(_)), "{start}: {found:?}");
        }
    }

    /// Values below the threshold that decay by a thousandth per step: later values differ from their mean.
    #[test]
    fn what_fades_below_what_counts_may_come_to_nothing() {
        let bounds = Bounds { least: 3e-9, ..BOUNDS };
        for count in [20, 40, 160] {
            let fades = values(count, |k| 1.45e-9 * 0.9988_f64.powf(k));
            let Settling::Settled(found) = Settling::of(&fades, bounds) else { panic!("{count}") };
            assert!(found.value.abs() <= found.error, "{count}: {found:?}");
            // The same values in random order are not settled.
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
        // Steps near zero are constant.
        let still = Settling::of(&[1e-20, -2e-20, 1e-21, 3e-20, 0.0], Bounds { least: 1e-9, ..BOUNDS });
        assert!(matches!(still, Settling::Settled(_)), "{still:?}");
    }
}
