//! The quantities of a stepping drive.

use crate::series::{SeriesError, check, check_lengths, check_positive, check_time, mean, sum};

/// Deviation from the steady step, as a share of it, within which a drive counts as settled.
pub const SETTLED_BAND: f64 = 0.05;

/// One period of a drive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Step length: x at the end less x at the start of the period, m.
    pub length: f64,
    /// Forward stroke: the largest x within the period less x at its start, m, in the direction of travel.
    pub forward: f64,
    /// Way lost in the flyback and after: the largest x within the period less x at its end, m, in the
    /// direction of travel.
    pub backward: f64,
}

/// The steady state: statistics over the last half of the periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steady {
    /// Number of periods averaged: half of them, rounded up.
    pub periods: usize,
    /// Steady step: mean step length, m.
    pub step: f64,
    /// Repeatability: standard deviation of the step length (n-1), m; none for a single period.
    pub repeatability: Option<f64>,
    /// Mean back-step; none where a period has no forward stroke.
    pub back_step: Option<f64>,
}

/// The quantities of a drive's record.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    /// Every whole period in order.
    pub periods: Vec<Step>,
    /// Mean speed over the whole periods, m/s.
    pub mean_speed: f64,
    /// Net travel over the whole record, a trailing part of a period included, m.
    pub net_travel: f64,
    /// The steady state.
    pub steady: Steady,
    /// First period from which every step stays within [`SETTLED_BAND`] of the steady step; none where even the
    /// averaged half does not, and the steady step is then a mean of steps that still vary.
    pub settled_from: Option<usize>,
}

impl Step {
    /// Back-step: the share of the forward stroke that is lost; none without forward stroke.
    pub fn back_step(&self) -> Option<f64> {
        Some(self.backward / self.forward).filter(|share| self.forward > 0.0 && share.is_finite())
    }
}

impl Steps {
    /// Takes the quantities of the slider's position x(t), m over s, driven with a period T, s. Periods count
    /// from the first sample; positions at their ends are interpolated linearly.
    ///
    /// The direction of travel is the sign of the displacement over the whole periods: a drive that runs backwards
    /// has negative steps and the same back-steps.
    ///
    /// # Errors
    /// Fewer than 2 samples, series of different lengths, values that are not finite, times that decrease, a
    /// period not above 0, a record shorter than a period or with fewer samples than periods.
    pub fn of_record(t: &[f64], x: &[f64], period: f64) -> Result<Self, SeriesError> {
        check_lengths(("x", x), ("t", t))?;
        check_time(t, 2)?;
        check("x", x, 2)?;
        check_positive("period", period)?;
        let count = whole_periods(t, period)?;
        let ends: Vec<f64> = (0..=count).map(|k| position(t, x, t[0] + k as f64 * period)).collect();
        let travel = ends[count] - ends[0];
        let direction = if travel < 0.0 { -1.0 } else { 1.0 };
        let periods: Vec<Step> = (0..count)
            .map(|k| {
                let inside = span(t, t[0] + k as f64 * period, t[0] + (k + 1) as f64 * period);
                let (start, end) = (direction * ends[k], direction * ends[k + 1]);
                let most = x[inside].iter().fold(start.max(end), |most, &x| most.max(direction * x));
                Step { length: ends[k + 1] - ends[k], forward: most - start, backward: most - end }
            })
            .collect();
        let steady = Steady::of_periods(&periods[count / 2..]);
        Ok(Self {
            mean_speed: travel / (count as f64 * period),
            net_travel: x[x.len() - 1] - x[0],
            settled_from: settled_from(&periods, &steady),
            steady,
            periods,
        })
    }
}

impl Steady {
    fn of_periods(periods: &[Step]) -> Self {
        let lengths: Vec<f64> = periods.iter().map(|p| p.length).collect();
        let step = mean(&lengths);
        let spread = sum(lengths.iter().map(|l| (l - step).powi(2)));
        let back: Option<Vec<f64>> = periods.iter().map(Step::back_step).collect();
        Self {
            periods: periods.len(),
            step,
            repeatability: (lengths.len() > 1).then(|| (spread / (lengths.len() - 1) as f64).sqrt()),
            back_step: back.map(|shares| mean(&shares)),
        }
    }
}

/// Number of whole periods in the record; at least one.
fn whole_periods(t: &[f64], period: f64) -> Result<usize, SeriesError> {
    let duration = t[t.len() - 1] - t[0];
    // Sums of rounded time steps miss the end of a period by a little.
    let count = (duration / period + 1e-6).floor();
    if count < 1.0 {
        return Err(SeriesError::ShorterThanPeriod { duration, period });
    }
    if count > t.len() as f64 {
        return Err(SeriesError::TooShort { series: "t", least: count.min(1e18) as usize, got: t.len() });
    }
    Ok(count as usize)
}

/// Samples with start < t < end (a hair inside, so that rounding moves no sample into the wrong period).
fn span(t: &[f64], start: f64, end: f64) -> std::ops::Range<usize> {
    let hair = 1e-9 * (end - start);
    let first = t.partition_point(|&s| s <= start + hair);
    first..t.partition_point(|&s| s < end - hair).max(first)
}

/// x at a time by linear interpolation, the end value beyond the end. At a jump in x the value before it.
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

fn settled_from(periods: &[Step], steady: &Steady) -> Option<usize> {
    let off = |p: &Step| (p.length - steady.step).abs() > SETTLED_BAND * steady.step.abs();
    let from = periods.iter().rposition(off).map_or(0, |last| last + 1);
    (from <= periods.len() - steady.periods).then_some(from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    /// A slider that goes forward by `forward` over 0.8 of each period and back by `back(k)` in the rest.
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
        let steps = Steps::of_record(&t, &x, 1.0).unwrap();
        assert_eq!(steps.periods.len(), 8);
        assert_relative_eq!(steps.steady.step, 1.5, max_relative = 1e-14);
        assert_abs_diff_eq!(steps.steady.repeatability.unwrap(), 0.0, epsilon = 1e-14);
        assert_relative_eq!(steps.steady.back_step.unwrap(), 0.25, max_relative = 1e-14);
        assert_relative_eq!(steps.mean_speed, 1.5, max_relative = 1e-14);
        assert_relative_eq!(steps.net_travel, 12.0, max_relative = 1e-14);
        assert_eq!((steps.settled_from, steps.steady.periods), (Some(0), 4));
    }

    #[test]
    fn the_way_in_is_told_from_the_steady_state() {
        // Two short steps of 0.5, then steps of 1.4 and 1.6 by turns: mean 1.5, standard deviation (n-1) over
        // six 0.1·√(6/5); all within 5 % would be 1.425 to 1.575, so it has not settled; at ±0.05 it has.
        let back = |k: usize, wobble: f64| match k {
            0 | 1 => 1.5,
            k if k % 2 == 0 => 0.5 - wobble,
            _ => 0.5 + wobble,
        };
        let (t, x) = staircase(12, 2.0, |k| back(k, 0.1));
        let steps = Steps::of_record(&t, &x, 1.0).unwrap();
        assert_relative_eq!(steps.steady.step, 1.5, max_relative = 1e-14);
        assert_relative_eq!(steps.steady.repeatability.unwrap(), 0.1 * 1.2_f64.sqrt(), max_relative = 1e-12);
        assert_eq!(steps.settled_from, None);
        let (t, x) = staircase(12, 2.0, |k| back(k, 0.05));
        assert_eq!(Steps::of_record(&t, &x, 1.0).unwrap().settled_from, Some(2));
    }

    #[test]
    fn a_drive_that_runs_backwards_mirrors() {
        let (t, x) = staircase(4, 2.0, |_| 0.5);
        let mirrored: Vec<f64> = x.iter().map(|x| -x).collect();
        let (ahead, back) =
            (Steps::of_record(&t, &x, 1.0).unwrap(), Steps::of_record(&t, &mirrored, 1.0).unwrap());
        assert_eq!(back.steady.step, -ahead.steady.step);
        assert_eq!(back.steady.back_step, ahead.steady.back_step);
        assert_eq!(back.mean_speed, -ahead.mean_speed);
    }

    #[test]
    fn a_trailing_part_counts_for_travel_alone() {
        let (mut t, mut x) = staircase(3, 2.0, |_| 1.0);
        t.push(3.5);
        x.push(20.0);
        let steps = Steps::of_record(&t, &x, 1.0).unwrap();
        assert_eq!((steps.periods.len(), steps.net_travel), (3, 15.0));
        assert_relative_eq!(steps.mean_speed, 1.0, max_relative = 1e-14);
    }

    #[test]
    fn no_motion_is_no_back_step_and_no_error() {
        let steps = Steps::of_record(&[0.0, 1.0, 2.0], &[1.0; 3], 1.0).unwrap();
        assert_eq!((steps.steady.step, steps.steady.back_step, steps.settled_from), (0.0, None, Some(0)));
    }

    #[test]
    fn what_has_no_steps_is_refused() {
        let refused = |t: &[f64], x: &[f64], period| Steps::of_record(t, x, period).unwrap_err();
        assert!(matches!(refused(&[], &[], 1.0), SeriesError::TooShort { .. }));
        assert!(matches!(refused(&[0.0, 1.0], &[0.0], 1.0), SeriesError::Lengths { .. }));
        assert!(matches!(refused(&[0.0, f64::NAN], &[0.0; 2], 1.0), SeriesError::NotFinite { .. }));
        assert!(matches!(refused(&[0.0, -1.0], &[0.0; 2], 1.0), SeriesError::TimeDecreases { .. }));
        assert!(matches!(refused(&[0.0, 1.0], &[0.0; 2], 2.0), SeriesError::ShorterThanPeriod { .. }));
        assert!(matches!(refused(&[0.0, 1.0], &[0.0; 2], -1.0), SeriesError::Parameter { .. }));
        assert!(matches!(refused(&[0.0, 1.0], &[0.0; 2], 1e-12), SeriesError::TooShort { .. }));
    }
}
