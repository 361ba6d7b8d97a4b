//! Evaluation of the steps of a drive: step length, back-step, mean speed and repeatability.

use crate::sequence::Sequence;
use crate::series::{SeriesError, check, check_lengths, check_positive, check_time, sum};
use crate::settling::{Bounds, Settled, Settling};
use std::ops::Range;

/// Positions of a body in one drive period, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stride {
    /// Position at the start.
    pub start: f64,
    /// Position at the end.
    pub end: f64,
    /// Minimum position.
    pub least: f64,
    /// Maximum position.
    pub most: f64,
    /// Largest decrease of the position after a maximum.
    pub fall: f64,
    /// Largest increase of the position after a minimum.
    pub rise: f64,
}

/// A sequence of strides that can be read in parts, from memory or from disk.
pub trait Strides {
    /// Returns the number of strides.
    fn count(&self) -> usize;

    /// Iterates over the strides of an index range. Unreadable strides contain NaN.
    fn part(&self, range: Range<usize>) -> impl Iterator<Item = Stride>;
}

impl Strides for [Stride] {
    fn count(&self) -> usize {
        self.len()
    }

    fn part(&self, range: Range<usize>) -> impl Iterator<Item = Stride> {
        self.get(range).unwrap_or_default().iter().copied()
    }
}

/// Step lengths of a sequence of strides, as a [`Sequence`] of numbers.
struct Lengths<'a, S: ?Sized>(&'a S);

impl<S: Strides + ?Sized> Sequence for Lengths<'_, S> {
    fn count(&self) -> usize {
        self.0.count()
    }

    fn part(&self, range: Range<usize>) -> impl Iterator<Item = f64> {
        self.0.part(range).map(|stride| stride.length())
    }
}

/// Steady state of a settled drive: statistics over the last periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steady {
    /// First period from which all steps are within [`BAND`](crate::settling::BAND) of the limit.
    pub from: usize,
    /// Number of periods at the end that are averaged.
    pub periods: usize,
    /// Steady step length: mean of the averaged periods, m.
    pub step: f64,
    /// Error of the steady step length as an estimate for all later steps, m.
    pub error: f64,
    /// Repeatability: standard deviation of the step length (n-1), m. `None` for a single period.
    pub repeatability: Option<f64>,
    /// Mean back-step, m, see [`Stride::back_step`].
    pub back_step: f64,
}

/// Evaluated steps of a drive.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    /// Number of whole periods.
    pub periods: usize,
    /// Mean velocity over the whole periods, m/s.
    pub mean_speed: f64,
    /// Displacement over the whole record, including an incomplete period at its end, m.
    pub net_travel: f64,
    /// Convergence of the step length.
    pub settling: Settling,
    /// Steady state. `None` for a drive that has not settled.
    pub steady: Option<Steady>,
}

impl Stride {
    /// Creates the stride of a body that moves from `start` via the positions `inside` to `end`, m.
    fn along(start: f64, inside: impl Iterator<Item = f64>, end: f64) -> Self {
        let blank = Self { start, end, least: start, most: start, fall: 0.0, rise: 0.0 };
        inside.chain([end]).fold(blank, |so_far, x| Self {
            least: so_far.least.min(x),
            most: so_far.most.max(x),
            fall: so_far.fall.max(so_far.most - x),
            rise: so_far.rise.max(x - so_far.least),
            ..so_far
        })
    }

    /// Returns the step length, m.
    pub fn length(&self) -> f64 {
        self.end - self.start
    }

    /// Returns the back-step, m: the largest motion against the step direction within this period and a repetition of it.
    ///
    /// For a step forward, the back-step is max x(t₁) - x(t₂) over t₁ ≤ t₂. Without a step, it is the peak-to-peak motion.
    pub fn back_step(&self) -> f64 {
        let step = self.length();
        if step >= 0.0 {
            self.fall.max(self.most - (self.least + step))
        } else {
            self.rise.max(self.most + step - self.least)
        }
    }
}

impl Steps {
    /// Evaluates the strides of a drive. `period` is the drive period, s, and `net_travel` is the displacement over the whole record, m.
    ///
    /// The direction of travel is the sign of the displacement over the whole periods. A drive that moves backwards has negative steps.
    /// `bounds` are known bounds of the step lengths.
    pub fn of_strides<S: Strides + ?Sized>(
        strides: &S,
        period: f64,
        net_travel: f64,
        bounds: Bounds,
    ) -> Self {
        let periods = strides.count();
        let first = strides.part(0..periods.min(1)).next();
        let last = periods.checked_sub(1).and_then(|last| strides.part(last..periods).next());
        let travel = last.zip(first).map_or(0.0, |(last, first)| last.end - first.start);
        let settling = Settling::of(&Lengths(strides), bounds);
        let steady = match settling {
            Settling::Settled(settled) => Some(Steady::of_strides(strides, settled)),
            _ => None,
        };
        let time = (periods as f64 * period).max(f64::MIN_POSITIVE);
        Self { mean_speed: travel / time, net_travel, settling, steady, periods }
    }

    /// Evaluates a recorded position x(t), m and s, with the drive period T, s.
    ///
    /// Periods start at the first sample. Positions at period ends are interpolated linearly.
    ///
    /// # Errors
    /// The series have fewer than 2 samples or different lengths, are not finite, or have decreasing times. The period is not above 0,
    /// exceeds the record, or is shorter than the sampling interval.
    pub fn of_record(t: &[f64], x: &[f64], period: f64, bounds: Bounds) -> Result<Self, SeriesError> {
        check_lengths(("x", x), ("t", t))?;
        check_time(t, 2)?;
        check("x", x, 2)?;
        check_positive("period", period)?;
        let count = whole_periods(t, period)?;
        let ends: Vec<f64> = (0..=count).map(|k| position(t, x, t[0] + k as f64 * period)).collect();
        let stride = |k: usize| {
            let inside = span(t, t[0] + k as f64 * period, t[0] + (k + 1) as f64 * period);
            Stride::along(ends[k], x[inside].iter().copied(), ends[k + 1])
        };
        let strides: Vec<Stride> = (0..count).map(stride).collect();
        Ok(Self::of_strides(strides.as_slice(), period, x[x.len() - 1] - x[0], bounds))
    }
}

impl Steady {
    fn of_strides<S: Strides + ?Sized>(strides: &S, settled: Settled) -> Self {
        let count = strides.count();
        let averaged = count - settled.last.min(count)..count;
        let periods = averaged.len();
        let spread =
            sum(strides.part(averaged.clone()).map(|stride| (stride.length() - settled.value).powi(2)));
        let back_steps = strides.part(averaged).map(|stride| stride.back_step());
        Self {
            from: settled.from,
            periods,
            step: settled.value,
            error: settled.error,
            repeatability: (periods > 1).then(|| (spread / (periods - 1) as f64).sqrt()),
            back_step: sum(back_steps) / periods as f64,
        }
    }
}

/// Returns the number of whole periods in the record, at least one.
fn whole_periods(t: &[f64], period: f64) -> Result<usize, SeriesError> {
    let duration = t[t.len() - 1] - t[0];
    // Sums of rounded time steps may miss the end of a period slightly.
    let count = (duration / period + 1e-6).floor();
    if count < 1.0 {
        return Err(SeriesError::ShorterThanPeriod { duration, period });
    }
    if count > t.len() as f64 {
        return Err(SeriesError::TooShort { series: "t", least: count.min(1e18) as usize, got: t.len() });
    }
    Ok(count as usize)
}

/// Returns the samples with start < t < end. A small tolerance prevents rounding from moving a sample to the wrong period.
fn span(t: &[f64], start: f64, end: f64) -> Range<usize> {
    let hair = 1e-9 * (end - start);
    let first = t.partition_point(|&s| s <= start + hair);
    first..t.partition_point(|&s| s < end - hair).max(first)
}

/// Returns the position x at a time by linear interpolation: beyond the record the first or last value, at a jump the value before it.
fn position(t: &[f64], x: &[f64], time: f64) -> f64 {
    let after = t.partition_point(|&s| s < time);
    if after == 0 {
        return x[0];
    }
    if after == t.len() {
        return x[t.len() - 1];
    }
    let share = (time - t[after - 1]) / (t[after] - t[after - 1]);
    x[after - 1] + share * (x[after] - x[after - 1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    const BOUNDS: Bounds = Bounds { least: 0.0, most: f64::INFINITY, error: 0.0 };

    /// Returns the position of a slider that moves by `forward` during 0.8 of each period and back by `back(k)` in the rest.
    fn staircase(count: usize, forward: f64, back: impl Fn(usize) -> f64) -> (Vec<f64>, Vec<f64>) {
        let (mut t, mut x, mut at) = (vec![0.0], vec![5.0], 5.0);
        for k in 0..count {
            t.extend([k as f64 + 0.4, k as f64 + 0.8, k as f64 + 1.0]);
            x.extend([at + forward / 2.0, at + forward, at + forward - back(k)]);
            at += forward - back(k);
        }
        (t, x)
    }

    #[test]
    fn a_regular_staircase_has_its_steps() {
        let (t, x) = staircase(8, 2.0, |_| 0.5);
        let steps = Steps::of_record(&t, &x, 1.0, BOUNDS).unwrap();
        let steady = steps.steady.unwrap();
        assert_eq!(steps.periods, 8);
        assert_relative_eq!(steady.step, 1.5, max_relative = 1e-14);
        assert_abs_diff_eq!(steady.repeatability.unwrap(), 0.0, epsilon = 1e-14);
        assert_relative_eq!(steady.back_step, 0.5, max_relative = 1e-14);
        assert_relative_eq!(steps.mean_speed, 1.5, max_relative = 1e-14);
        assert_relative_eq!(steps.net_travel, 12.0, max_relative = 1e-14);
        assert_eq!((steady.from, steady.periods), (0, 8));
    }

    #[test]
    fn the_way_in_is_told_from_the_steady_state() {
        // Two short steps of 0.5, then steps of 1.4 and 1.6 alternately: a constant oscillation of two periods. At ±0.5e-3 they are
        // settled: mean 1.5, standard deviation (n-1) over ten 0.5e-3·√(10/9).
        let back = |k: usize, wobble: f64| match k {
            0 | 1 => 1.5,
            k if k % 2 == 0 => 0.5 - wobble,
            _ => 0.5 + wobble,
        };
        let (t, x) = staircase(12, 2.0, |k| back(k, 0.1));
        let steps = Steps::of_record(&t, &x, 1.0, BOUNDS).unwrap();
        assert!(matches!(steps.settling, Settling::Beats { period, .. } if (period - 2.0).abs() < 1e-6));
        assert!(steps.steady.is_none());
        let (t, x) = staircase(12, 2.0, |k| back(k, 0.5e-3));
        let steady = Steps::of_record(&t, &x, 1.0, BOUNDS).unwrap().steady.unwrap();
        assert_eq!((steady.from, steady.periods), (2, 10));
        assert_relative_eq!(steady.step, 1.5, max_relative = 1e-12);
        assert_relative_eq!(
            steady.repeatability.unwrap(),
            0.5e-3 * (10.0_f64 / 9.0).sqrt(),
            max_relative = 1e-9
        );
    }

    #[test]
    fn a_drive_that_runs_backwards_mirrors() {
        let (t, x) = staircase(4, 2.0, |_| 0.5);
        let mirrored: Vec<f64> = x.iter().map(|x| -x).collect();
        let (ahead, back) = (
            Steps::of_record(&t, &x, 1.0, BOUNDS).unwrap(),
            Steps::of_record(&t, &mirrored, 1.0, BOUNDS).unwrap(),
        );
        let steady = |steps: &Steps| steps.steady.unwrap();
        assert_eq!(steady(&back).step, -steady(&ahead).step);
        assert_eq!(steady(&back).back_step, steady(&ahead).back_step);
        assert_eq!(back.mean_speed, -ahead.mean_speed);
    }

    #[test]
    fn a_trailing_part_counts_for_travel_alone() {
        let (mut t, mut x) = staircase(3, 2.0, |_| 1.0);
        t.push(3.5);
        x.push(20.0);
        let steps = Steps::of_record(&t, &x, 1.0, BOUNDS).unwrap();
        assert_eq!((steps.periods, steps.net_travel), (3, 15.0));
        assert_relative_eq!(steps.mean_speed, 1.0, max_relative = 1e-14);
    }

    #[test]
    fn a_back_step_goes_on_into_the_next_period() {
        // From the third of these positions down to the first one after the period end, where the next period starts.
        let stride = Stride::along(0.0, [-1.0, 2.5, 4.0, 3.0].into_iter(), 2.0);
        assert_eq!((stride.fall, stride.rise, stride.back_step()), (2.0, 5.0, 3.0));
        let mirrored = Stride::along(0.0, [1.0, -2.5, -4.0, -3.0].into_iter(), -2.0);
        assert_eq!((mirrored.fall, mirrored.rise, mirrored.back_step()), (5.0, 2.0, 3.0));
        // Without a step: peak to peak.
        assert_eq!(Stride::along(0.0, [1.0, -0.5].into_iter(), 0.0).back_step(), 1.5);
    }

    #[test]
    fn no_motion_is_no_back_step_and_no_error() {
        let steps = Steps::of_record(&[0.0, 1.0, 2.0, 3.0, 4.0], &[1.0; 5], 1.0, BOUNDS).unwrap();
        let steady = steps.steady.unwrap();
        assert_eq!((steady.step, steady.back_step, steady.from), (0.0, 0.0, 0));
    }

    #[test]
    fn what_has_no_steps_is_refused() {
        let refused = |t: &[f64], x: &[f64], period| Steps::of_record(t, x, period, BOUNDS).unwrap_err();
        assert!(matches!(refused(&[], &[], 1.0), SeriesError::TooShort { .. }));
        assert!(matches!(refused(&[0.0, 1.0], &[0.0], 1.0), SeriesError::Lengths { .. }));
        assert!(matches!(refused(&[0.0, f64::NAN], &[0.0; 2], 1.0), SeriesError::NotFinite { .. }));
        assert!(matches!(refused(&[0.0, -1.0], &[0.0; 2], 1.0), SeriesError::TimeDecreases { .. }));
        assert!(matches!(refused(&[0.0, 1.0], &[0.0; 2], 2.0), SeriesError::ShorterThanPeriod { .. }));
        assert!(matches!(refused(&[0.0, 1.0], &[0.0; 2], -1.0), SeriesError::Parameter { .. }));
        assert!(matches!(refused(&[0.0, 1.0], &[0.0; 2], 1e-12), SeriesError::TooShort { .. }));
    }
}
