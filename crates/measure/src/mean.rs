//! Mean of a stationary sequence with correlated values, and its confidence interval by the method of batch means.
//!
//! The means of long batches are nearly independent. The scatter of the batch means gives the error of the total mean. Ten batches suffice
//! (Schmeiser, *Oper. Res.* 30 (1982) 556).

use crate::sequence::{Sequence, mean_of};

/// Maximum number of batches.
const BATCHES: usize = 10;
/// Minimum number of batches.
const FEWEST: usize = 3;
/// Two-sided 95 % quantiles of Student's t for 2 and more degrees of freedom.
///
/// Source: Abramowitz and Stegun, *Handbook of Mathematical Functions* (1964), table 26.10.
const STUDENT: [f64; BATCHES - FEWEST + 1] = [4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262];
/// Maximum ratio of successive changes of the mean for which a limit is extrapolated.
const FORESEEN: f64 = 0.9;

/// Mean of a stationary sequence with its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    /// Mean of the values in all batches.
    pub value: f64,
    /// Half-width of the 95 % confidence interval: t s/√b with Student's t, for b batches whose means have the standard deviation s.
    pub error: f64,
}

impl Mean {
    /// Computes the mean of a sequence. If the sequence oscillates, `period` is the oscillation period in values, otherwise 0.
    ///
    /// Batches contain equal numbers of whole oscillations. There are at most ten batches. Returns `None` for fewer than three.
    pub fn of<S: Sequence + ?Sized>(values: &S, period: f64) -> Option<Self> {
        let (means, start) = batches(values, period)?;
        let value = mean_of(values, start..values.count());
        Some(Self { value, error: error(&means, value)? })
    }

    /// Returns the shift of the mean between the first and the last half of the batches, if it is significant.
    ///
    /// A shift is significant if it exceeds twice the smaller of the errors of both halves. Returns `None` for fewer than six batches.
    pub fn moved<S: Sequence + ?Sized>(values: &S, period: f64) -> Option<Moved> {
        let (means, _) = batches(values, period)?;
        let of = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let (first, last) = means.split_at(means.len() / 2);
        let [a, b] = [first, last].map(of);
        // The smaller error is used, because a half in which the mean still changes has a large error.
        let known = error(first, a)?.min(error(last, b)?);
        let third = means.len() / 3;
        let [to, middle, from] =
            [0, 1, 2].map(|k| means.len() - k * third).map(|end| of(&means[end - third..end]));
        let falls = (to - middle) / (middle - from);
        let left = (to - middle) * falls / (1.0 - falls);
        let is_foreseen = (0.0..FORESEEN).contains(&falls);
        let to_go = if is_foreseen { (to + left - of(&means)).abs() } else { f64::INFINITY };
        let by = (a - b).abs();
        (by > 2.0 * known).then_some(Moved { by, to_go })
    }
}

/// Shift of a mean that has not converged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moved {
    /// Difference between the means of the last and the first half of the batches.
    pub by: f64,
    /// Distance from the total mean to its extrapolated limit. Infinite if the changes between the thirds of the batches do not decrease.
    pub to_go: f64,
}

/// Returns the means of the batches and the index of the first value used.
fn batches<S: Sequence + ?Sized>(values: &S, period: f64) -> Option<(Vec<f64>, usize)> {
    let count = values.count();
    let unit = if period > 0.0 { period } else { 1.0 };
    let units = (count as f64 / unit).floor();
    let batches = BATCHES.min(units as usize);
    if batches < FEWEST {
        return None;
    }
    // Batch boundaries are rounded to whole values, but batch lengths are not, so that no rounding error accumulates.
    let length = (units / batches as f64).floor() * unit;
    let start = |batch: usize| count - ((batches - batch) as f64 * length).round() as usize;
    Some(((0..batches).map(|b| mean_of(values, start(b)..start(b + 1))).collect(), start(0)))
}

/// Returns the half-width of the 95 % confidence interval about `value`.
fn error(means: &[f64], value: f64) -> Option<f64> {
    let student = STUDENT.get(means.len().checked_sub(FEWEST)?)?;
    let scatter = means.iter().map(|mean| (mean - value).powi(2)).sum::<f64>() / (means.len() - 1) as f64;
    Some(student * (scatter / means.len() as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Pseudo-random numbers from -1 to 1 (Knuth's MMIX generator).
    fn noise(seed: u64) -> impl Iterator<Item = f64> {
        let mut state = seed;
        std::iter::repeat_with(move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        })
    }

    /// The remaining change of a converging mean is extrapolated. That of a steady drift is infinite. Noise has no significant change.
    #[test]
    fn a_mean_on_its_way_is_told_from_chance() {
        let of = |f: &dyn Fn(i32) -> f64| -> Vec<f64> { (0..300).map(f).collect() };
        let share = 0.99_f64;
        let rests = of(&|k| share.powi(k));
        let moved = Mean::moved(&rests[..], 0.0).unwrap();
        let mean = rests.iter().sum::<f64>() / 300.0;
        assert!((moved.to_go / mean - 1.0).abs() < 0.05, "{moved:?} {mean}");
        assert_eq!(Mean::moved(&of(&|k| f64::from(k))[..], 0.0).unwrap().to_go, f64::INFINITY);
        let chance = (0..100).filter(|seed| {
            let values: Vec<f64> = noise(seed + 1).take(300).collect();
            Mean::moved(&values[..], 0.0).is_some()
        });
        assert!(chance.count() < 15);
    }

    /// Returns the fraction of 400 sequences of 200 values with mean 0 whose error covers the mean, and the average error.
    fn kept(of: impl Fn(u64) -> Vec<f64>) -> (f64, f64) {
        let found: Vec<Mean> = (0..400).filter_map(|seed| Mean::of(&of(seed), 0.0)).collect();
        let held = found.iter().filter(|mean| mean.value.abs() <= mean.error).count();
        let error = found.iter().map(|mean| mean.error).sum::<f64>() / found.len() as f64;
        (held as f64 / found.len() as f64, error)
    }

    /// For independent values of variance 1/3, the mean of 200 has the 95 % error 1.96 √(1/600) = 0.080.
    #[test]
    fn values_without_memory_have_the_error_of_their_mean() {
        let (held, error) = kept(|seed| noise(seed).skip(50).take(200).collect());
        assert!((0.92..=0.98).contains(&held), "{held}");
        assert!((0.075..0.1).contains(&error), "{error}");
    }

    /// For x → a x + noise, the error of the mean is √((1+a)/(1-a)) times that of independent values of equal variance.
    #[test]
    fn values_that_remember_have_the_larger_error_of_theirs() {
        let of = |a: f64| {
            kept(move |seed| {
                let mut x = 0.0;
                let next = |noise: f64| {
                    x = a * x + noise;
                    x
                };
                noise(seed).map(next).skip(200).take(200).collect()
            })
        };
        for a in [-0.6, 0.3, 0.6, 0.8] {
            let (held, error) = of(a);
            let wanted = 1.96 * (1.0_f64 / 600.0).sqrt() / (1.0 - a);
            assert!((0.87..=1.0).contains(&held), "{a}: {held}");
            assert!((0.75..1.5).contains(&(error / wanted)), "{a}: {error} {wanted}");
        }
    }

    /// An oscillation of amplitude 1 about 3: the error of its mean is far below the amplitude, for any period.
    #[test]
    fn the_mean_of_a_swing_is_that_of_whole_swings() {
        for period in [2.0, 2.7, 7.5, 19.3, 44.4, 63.1] {
            for phase in [0.0, 0.7, 1.9, 3.3, 5.0] {
                let of = |k: usize| 3.0 + (TAU * k as f64 / period + phase).sin();
                let values: Vec<f64> = (0..200).map(of).collect();
                let Some(mean) = Mean::of(&values, period) else { panic!("{period}") };
                // At either end of n values, half a value is missing or added.
                let most = 1.0 / (200.0 - 10.0 * period).max(period * 3.0);
                assert!((mean.value - 3.0).abs() <= most, "{period} {phase}: {mean:?}");
                assert!(mean.error <= 0.15, "{period} {phase}: {mean:?}");
            }
        }
        // Two and a half oscillations are too few.
        assert_eq!(Mean::of(&[1.0; 200], 80.0), None);
        assert_eq!(Mean::of(&[1.0; 2], 0.0), None);
    }

    /// The error of a drift of 1 over the sequence includes the drift.
    #[test]
    fn what_drifts_has_an_error_of_its_drift() {
        let values: Vec<f64> = (0..200).map(|k| f64::from(k) / 200.0).collect();
        let mean = Mean::of(&values, 0.0).unwrap();
        // The means of ten batches are 0.1 apart: √(Σ(0.1 (j - 4.5))²/9) = 0.3028.
        assert!((mean.error - 2.262 * 0.3028 / 10.0_f64.sqrt()).abs() < 1e-3, "{mean:?}");
    }
}
