//! The last period of a long run, which stands enlarged beside or below the whole: there its ringing is a solid band.

use stickslip_run::{Job, Kept, Periods, Series};

/// A run of more periods than this is long.
const MOST_PERIODS: usize = 10;
/// Turns of a curve that a frame a third of the whole width shows apart.
const MOST_TURNS: usize = 120;
/// A swing of a smaller share of the curve's range makes a thicker line of it, no band.
const SWING: f64 = 0.05;
/// What has panels along time in which it may ring.
const RINGING: [&str; 3] = ["u_m", "z_m", "pitch_rad"];
/// Fewer rows than this show no more enlarged.
const LEAST_ROWS: usize = 16;

/// The last whole period of the waveform that the figures are taken by.
#[derive(Debug, Clone, Copy)]
pub(super) struct LastPeriod {
    /// Counted from 1.
    pub(super) number: usize,
    /// Its start and end, s.
    pub(super) span: (f64, f64),
}

impl LastPeriod {
    /// None of a run of few periods.
    pub(super) fn of_many(job: &Job, kept: &Kept) -> Option<Self> {
        Self::of(job, kept).filter(|period| period.number > MOST_PERIODS)
    }

    /// The last period and its rows; none of a run that shows all by itself, for it has few periods and rings little, or whose last period
    /// has too few rows.
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
        // Of what was not written there is nothing to enlarge.
        let [from, to] = job.scenario.written.window;
        let hair = 1e-9 * (end - start);
        (from <= start + hair && to >= end - hair)
            .then_some(Self { number: periods.count, span: (start, end) })
    }
}

/// Whether something swings more often than can be told apart.
fn rings(job: &Job, series: &Series) -> bool {
    let bodies = job.scenario.scene.bodies.iter().map(|body| body.name.as_str());
    let parts = bodies.chain(job.model.contacts().map(|(name, _)| name));
    let mut columns =
        parts.flat_map(|part| RINGING.iter().map(move |quantity| series.column(part, quantity)));
    columns.any(|column| turns(column) > MOST_TURNS)
}

/// How often a curve turns round after a way of a share of its range.
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
