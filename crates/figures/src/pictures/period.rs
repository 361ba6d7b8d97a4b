//! Last period of a long run, which is enlarged next to or below the plot of the whole run.

use stickslip_run::{Job, Kept, Periods, Series};

/// Number of periods above which a run is long.
const MOST_PERIODS: usize = 5;
/// Maximum number of turning points of a curve that remain distinguishable.
const MOST_TURNS: usize = 120;
/// Minimum size of an oscillation relative to the curve's range.
const SWING: f64 = 0.05;
/// Quantities whose oscillations are checked.
const RINGING: [&str; 3] = ["u_m", "z_m", "pitch_rad"];
/// Minimum number of rows for an enlargement.
const LEAST_ROWS: usize = 16;

/// Last complete period of the waveform that defines the periods.
#[derive(Debug, Clone, Copy)]
pub(super) struct LastPeriod {
    /// Number of the period, counted from 1.
    pub(super) number: usize,
    /// Start and end, s.
    pub(super) span: (f64, f64),
}

impl LastPeriod {
    /// Returns the last period; `None` for runs of few periods.
    pub(super) fn of_many(job: &Job, kept: &Kept) -> Option<Self> {
        Self::of(job, kept).filter(|period| period.number > MOST_PERIODS)
    }

    /// Returns the last period and its rows. `None` for short runs without fast oscillations, and if the period has too few rows.
    pub(super) fn with_rows(job: &Job, kept: &Kept) -> Option<(Self, Series)> {
        let period = Self::of(job, kept)?;
        let is_long = period.number > MOST_PERIODS || (period.number > 2 && rings(job, &kept.series));
        if !is_long {
            return None;
        }
        let (start, end) = period.span;
        let series = kept.series.part(period.span);
        let is_whole = series.time().first().is_some_and(|t| t - start < 0.1 * (end - start));
        (is_whole && series.time().len() >= LEAST_ROWS).then_some((period, series))
    }

    fn of(job: &Job, kept: &Kept) -> Option<Self> {
        let waveform = job.scenario.scene.waveforms.get(job.scenario.figures.waveform?)?;
        let periods = Periods::until(&waveform.part, kept.whole_until())?;
        let (start, end) = periods.last();
        // The period must be inside the output window.
        let [from, to] = job.scenario.written.window;
        let hair = 1e-9 * (end - start);
        (from <= start + hair && to >= end - hair)
            .then_some(Self { number: periods.count, span: (start, end) })
    }
}

/// Returns whether a displacement oscillates too fast to be resolved in the plot.
fn rings(job: &Job, series: &Series) -> bool {
    let bodies = job.scenario.scene.bodies.iter().map(|body| body.name.as_str());
    let parts = bodies.chain(job.model.contacts().map(|(name, _)| name));
    let mut columns =
        parts.flat_map(|part| RINGING.iter().map(move |quantity| series.column(part, quantity)));
    columns.any(|column| turns(column) > MOST_TURNS)
}

/// Returns the number of turning points of a curve, with a hysteresis relative to its range.
fn turns(values: &[f64]) -> usize {
    let extent = values.iter().fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(*v), high.max(*v)));
    let swing = SWING * (extent.1 - extent.0);
    let (mut turns, mut is_rising, mut far) = (0, true, values.first().copied().unwrap_or(0.0));
    for value in values {
        if (value > &far) == is_rising {
            far = *value;
        } else if (value - far).abs() > swing {
            (turns, is_rising, far) = (turns + 1, !is_rising, *value);
        }
    }
    turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn swings_are_counted_and_noise_is_not() {
        let wave = |k: u32, noise: f64| {
            let t = f64::from(k) / 1000.0;
            (std::f64::consts::TAU * 7.0 * t).sin() + noise * f64::from(k % 2)
        };
        let curve = |noise| (0..1000).map(|k| wave(k, noise)).collect::<Vec<f64>>();
        assert_eq!([turns(&curve(0.0)), turns(&curve(0.04))], [14, 14]);
        assert_eq!([turns(&[]), turns(&[1.0; 9])], [0, 0]);
    }
}
