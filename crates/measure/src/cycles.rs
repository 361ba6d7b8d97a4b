//! Splitting of a long record of displacement and force into cycles.

use crate::series::{SeriesError, check, check_lengths, check_positive, check_time, extent};
use std::ops::Range;

pub use stickslip_record::noise;

/// Maximum difference of u between start and end of a closed cycle, relative to the range of u.
pub const CLOSED: f64 = 0.01;
/// Tried reversal thresholds, relative to the range of u. A larger threshold must increase the time covered by cycles by the factor `MORE`.
const WAYS_BACK: [f64; 6] = [CLOSED, 0.02, 0.05, 0.1, 0.2, 0.4];
const MORE: f64 = 1.05;
/// Upper limit of the closing tolerance for noisy records, relative to the range of u.
const ALIKE: f64 = 0.1;

/// Rule for the ends of cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cut {
    /// Cycles between consecutive maxima (or minima) of u. The parts before the first and after the last cycle are omitted.
    Reversals {
        /// Displacement that confirms a reversal, m, above 0. The value should exceed the noise, but not the smallest stroke.
        least: f64,
    },
    /// Cycles of equal duration that start at t₀, t₀ + T, t₀ + 2T, …
    Period {
        /// Start t₀, s.
        start: f64,
        /// Period T, s, above 0.
        period: f64,
    },
}

/// Splits a record (t, u, q) into cycles and returns their index ranges.
///
/// Each range includes both end samples, so neighbouring cycles share a sample. An incomplete cycle at the end is omitted. Without
/// reversals, no cycles are returned.
///
/// # Errors
/// The series differ in length, are not finite, have decreasing times, or are shorter than one period.
pub fn split_cycles(t: &[f64], u: &[f64], q: &[f64], cut: Cut) -> Result<Vec<Range<usize>>, SeriesError> {
    check_time(t, 2)?;
    check_lengths(("u", u), ("t", t))?;
    check_lengths(("q", q), ("t", t))?;
    check("u", u, 2)?;
    check("q", q, 2)?;
    let places = match cut {
        Cut::Reversals { least } => {
            check_positive("least", least)?;
            // Reversals are alternately maxima and minima, so every second one is of the same kind.
            reversals(u, least).into_iter().step_by(2).collect()
        }
        Cut::Period { start, period } => period_starts(t, start, period)?,
    };
    Ok(places.windows(2).map(|ends| ends[0]..ends[1] + 1).collect())
}

/// Returns the closed cycles between reversals of the same kind, as index ranges that include both end samples.
///
/// A cycle is closed if u returns to its initial value, or if the range of u is at most `still` (m). Several reversal thresholds are tried,
/// because noise and small inner loops cause additional reversals. A larger threshold is used only if its cycles cover more time.
#[must_use]
pub fn returning_cycles(t: &[f64], u: &[f64], still: f64) -> Vec<Range<usize>> {
    let (low, high) = extent(u);
    let mut best = (0.0, Vec::new());
    for share in WAYS_BACK {
        let cut = Cut::Reversals { least: share * (high - low) };
        let mut cycles = split_cycles(t, u, u, cut).unwrap_or_default();
        cycles.retain(|cycle| returns(&u[cycle.clone()], still, share.min(ALIKE)));
        let time = cycles.iter().map(|cycle| t[cycle.end - 1] - t[cycle.start]).sum::<f64>();
        if time > MORE * best.0 {
            best = (time, cycles);
        }
    }
    best.1
}

/// Returns whether u returns to its initial value within a fraction `share` of its range, or whether this range is at most `still`, m.
#[must_use]
pub fn returns(u: &[f64], still: f64, share: f64) -> bool {
    let (low, high) = extent(u);
    let way = u.last().zip(u.first()).map_or(0.0, |(last, first)| last - first);
    high - low <= still || way.abs() <= share * (high - low)
}

/// Returns the indices of the reversals of u, alternately maxima and minima.
///
/// Each reversal is confirmed by a displacement of more than `least` after it. The start of the record is not a reversal.
#[must_use]
pub fn reversals(u: &[f64], least: f64) -> Vec<usize> {
    let mut found = Vec::new();
    let (mut low, mut high) = (0, 0);
    let mut direction = 0_i8;
    for (i, &value) in u.iter().enumerate() {
        if value > u[high] {
            high = i;
        }
        if value < u[low] {
            low = i;
        }
        if direction >= 0 && u[high] - value > least {
            if high > 0 || direction > 0 {
                found.push(high);
            }
            (direction, low) = (-1, i);
        } else if direction <= 0 && value - u[low] > least {
            if low > 0 || direction < 0 {
                found.push(low);
            }
            (direction, high) = (1, i);
        }
    }
    found
}

/// Returns the index of the sample nearest to each t₀ + kT within the record.
fn period_starts(t: &[f64], start: f64, period: f64) -> Result<Vec<usize>, SeriesError> {
    check_positive("period", period)?;
    check("start", &[start], 1)?;
    let (first, last) = (t[0], t[t.len() - 1]);
    // Sums of rounded time steps may miss the end of a period slightly.
    let slack = 1e-6 * period;
    let mut places = Vec::new();
    let mut k = ((first - slack - start) / period).ceil().max(0.0);
    loop {
        let time = start + k * period;
        if time > last + slack {
            break;
        }
        let after = t.partition_point(|&s| s < time).min(t.len() - 1);
        let before = after.saturating_sub(1);
        let place = if time - t[before] < t[after] - time { before } else { after };
        if places.last().is_some_and(|&p| p >= place) {
            // The record has fewer samples than periods.
            return Err(SeriesError::TooShort { series: "t", least: places.len() + 2, got: t.len() });
        }
        places.push(place);
        k += 1.0;
    }
    if places.len() < 2 {
        return Err(SeriesError::ShorterThanPeriod { duration: last - first.max(start), period });
    }
    Ok(places)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Returns u = sin(2πt) over `cycles` s with `n` samples per cycle.
    fn sine(cycles: usize, n: usize) -> (Vec<f64>, Vec<f64>) {
        let t: Vec<f64> = (0..=cycles * n).map(|i| i as f64 / n as f64).collect();
        let u = t.iter().map(|t| (TAU * t).sin()).collect();
        (t, u)
    }

    #[test]
    fn reversals_of_a_sine_are_a_period_apart() {
        let (t, u) = sine(5, 100);
        let cycles = split_cycles(&t, &u, &u, Cut::Reversals { least: 0.1 }).unwrap();
        // Maxima at 0.25, 1.25, … 4.25.
        assert_eq!(cycles, [25..126, 125..226, 225..326, 325..426]);
    }

    #[test]
    fn noise_below_the_least_way_back_makes_no_reversals() {
        let (t, mut u) = sine(5, 100);
        for (i, v) in u.iter_mut().enumerate() {
            *v += if i % 2 == 0 { 0.02 } else { -0.02 };
        }
        let cycles = split_cycles(&t, &u, &u, Cut::Reversals { least: 0.1 }).unwrap();
        assert_eq!(cycles.len(), 4);
        assert!(cycles.iter().all(|c| c.len().abs_diff(101) <= 14), "{cycles:?}");
    }

    /// Five oscillations of amplitude 1 with inner loops of 0.06, without and with noise of 0.04: only the oscillations count.
    #[test]
    fn loops_within_loops_and_noise_make_no_cycles() {
        let (t, u) = sine(5, 1000);
        let within = |t: &f64| 0.03 * (20.0 * TAU * t).sin();
        let u: Vec<f64> = t.iter().zip(u).map(|(t, u)| u + within(t)).collect();
        let noisy: Vec<f64> = u.iter().enumerate().map(|(i, u)| u + 0.02 * (i as f64 * 2.4).sin()).collect();
        for u in [u, noisy] {
            let cycles = returning_cycles(&t, &u, 0.0);
            assert_eq!(cycles.len(), 4);
            assert!(cycles.iter().all(|cycle| cycle.len().abs_diff(1001) < 60), "{cycles:?}");
        }
        // Growing oscillations are not closed.
        let (t, mut u) = sine(5, 100);
        u.iter_mut().zip(&t).for_each(|(u, t)| *u *= (0.5 * t).exp());
        assert!(returning_cycles(&t, &u, 0.0).is_empty());
    }

    #[test]
    fn a_known_period_cuts_where_it_says() {
        let (t, u) = sine(3, 10);
        let cut = Cut::Period { start: 0.5, period: 1.0 };
        assert_eq!(split_cycles(&t, &u, &u, cut).unwrap(), [5..16, 15..26]);
        // The start is before the record, and sums of time steps are rounded.
        let t: Vec<f64> = (0..=30).scan(0.0, |s, _| Some(std::mem::replace(s, *s + 0.1))).collect();
        let cut = Cut::Period { start: 0.0, period: 1.0 };
        assert_eq!(split_cycles(&t, &u, &u, cut).unwrap(), [0..11, 10..21, 20..31]);
    }

    #[test]
    fn what_cannot_be_cut_is_refused() {
        let (t, u) = sine(1, 10);
        let cut = Cut::Period { start: 0.0, period: 2.0 };
        assert!(matches!(split_cycles(&t, &u, &u, cut), Err(SeriesError::ShorterThanPeriod { .. })));
        let cut = Cut::Period { start: 0.0, period: 1e-3 };
        assert!(matches!(split_cycles(&t, &u, &u, cut), Err(SeriesError::TooShort { .. })));
        let cut = Cut::Period { start: 0.0, period: 0.0 };
        assert!(matches!(split_cycles(&t, &u, &u, cut), Err(SeriesError::Parameter { .. })));
        let cut = Cut::Reversals { least: 0.1 };
        assert!(matches!(split_cycles(&t, &u[1..], &u, cut), Err(SeriesError::Lengths { .. })));
        assert_eq!(split_cycles(&t, &vec![1.0; t.len()], &u, cut).unwrap(), []);
    }
}
