//! Stages of a measured record, and the rows and energies within its cycles.

use super::MeasuredCycle;
use serde::Serialize;
use serde_json::{Map, Value, json};
use std::ops::Range;
use stickslip_measure::{Interval, SteadyLoop, Thresholds, steady_loop};

/// Relative changes of the amplitude and of the cycle duration that start a new stage.
const STAGE: [f64; 2] = [0.1, 0.25];
/// Maximum number of stages with a fitted steady loop. The stages with the most cycles are fitted.
const FITTED: usize = 20;
/// Deviation of the forces from the best fitting branch, relative to Q\*, above which the family of curves does not describe the loop.
pub const MISFIT: f64 = 0.01;
/// Quantiles of Student's t for 95 % intervals, for degrees of freedom from 1.
const STUDENT: [f64; 10] = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228];

/// Consecutive cycles of similar amplitude and duration.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Indices of the cycles of the stage.
    pub cycles: Range<usize>,
    /// Start and end, s.
    pub time: [f64; 2],
    /// Steady loop. `None` if the cycles have no common period.
    pub steady: Option<SteadyLoop>,
    /// Results with confidence intervals, by name.
    pub results: Vec<(&'static str, Interval)>,
    /// Slip regime, if a profile was given: `partial`, `gross`, or `undecided` if a confidence interval contains the threshold.
    pub regime: Option<&'static str>,
}

/// Numbers of rows and energies of a record within and outside of its cycles.
///
/// A row that two cycles share belongs to the later cycle. Energies are ∫F du by the trapezoidal rule.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Account {
    /// Number of rows.
    pub rows: usize,
    /// Number of rows within cycles.
    pub rows_in_cycles: usize,
    /// Number of rows outside of cycles.
    pub rows_outside: usize,
    /// Work of the whole record, J.
    #[serde(rename = "work_J")]
    pub work: f64,
    /// Work within cycles, J.
    #[serde(rename = "work_in_cycles_J")]
    pub work_in_cycles: f64,
    /// Work outside of cycles, J.
    #[serde(rename = "work_outside_J")]
    pub work_outside: f64,
}

impl Account {
    pub(super) fn of(cycles: &[MeasuredCycle], rows: (&[f64], &[f64])) -> Self {
        let count = rows.0.len();
        let between = |from: usize, to: usize| (from..to).map(|row| work_after(rows, row)).sum::<f64>();
        let (mut outside, mut next) = (0.0, 0);
        for cycle in cycles {
            outside += between(next, cycle.span.start);
            next = cycle.span.end - 1;
        }
        let rows_in_cycles = cycles.iter().map(|cycle| cycle.span.len() - 1).sum();
        Self {
            rows: count,
            rows_in_cycles,
            rows_outside: count - rows_in_cycles,
            work: between(0, count.saturating_sub(1)),
            work_in_cycles: cycles.iter().map(|cycle| cycle.work).sum(),
            work_outside: outside + between(next, count.saturating_sub(1)),
        }
    }
}

/// Returns the work between a row and the next row, J.
pub(super) fn work_after((u, force): (&[f64], &[f64]), row: usize) -> f64 {
    0.5 * (force[row] + force[row + 1]) * (u[row + 1] - u[row])
}

/// Assigns the cycles to stages and evaluates each stage. `record` are the times, displacements and forces.
pub(super) fn stages(
    cycles: &mut [MeasuredCycle],
    record: (&[f64], &[f64], &[f64]),
    thresholds: Option<&Thresholds>,
) -> Vec<Stage> {
    number(cycles);
    let mut start = 0;
    let parts = cycles.chunk_by(|a, b| a.stage == b.stage).map(|stage| {
        start += stage.len();
        start - stage.len()..start
    });
    let parts: Vec<Range<usize>> = parts.collect();
    let mut lengths: Vec<usize> = parts.iter().map(Range::len).collect();
    lengths.sort_unstable_by(|a, b| b.cmp(a));
    let least = lengths.get(FITTED).map_or(0, |length| length + 1);
    let measured = parts.into_iter().map(|part| Stage::of(cycles, part, record, least));
    measured
        .map(|stage| Stage { regime: thresholds.map(|thresholds| stage.regime(thresholds)), ..stage })
        .collect()
}

fn number(cycles: &mut [MeasuredCycle]) {
    let differs = |a: f64, b: f64, share: f64| (a - b).abs() > share * b.abs();
    let (mut stage, mut first, mut end) = (0, None, None);
    for cycle in cycles {
        let amplitude = cycle.cycle.displacement_amplitude;
        let (time, is_open) = (cycle.time[1] - cycle.time[0], cycle.is_open);
        let goes_on = first.is_some_and(|(a, t, open)| {
            !differs(amplitude, a, STAGE[0]) && !differs(time, t, STAGE[1]) && open == is_open
        });
        if !goes_on || end != Some(cycle.span.start) {
            (stage, first) = (stage + 1, Some((amplitude, time, is_open)));
        }
        (cycle.stage, end) = (stage, Some(cycle.span.end - 1));
    }
}

impl Stage {
    /// Evaluates the cycles of a stage. A steady loop is fitted if there are at least `least` cycles.
    fn of(
        cycles: &[MeasuredCycle],
        part: Range<usize>,
        (t, u, force): (&[f64], &[f64], &[f64]),
        least: usize,
    ) -> Self {
        let stage = &cycles[part.clone()];
        let (first, last) = (&stage[0], &stage[stage.len() - 1]);
        let rows = first.span.start..last.span.end;
        let time = [first.time[0], last.time[1]];
        let period = (time[1] - time[0]) / stage.len() as f64;
        let fit = || steady_loop(&t[rows.clone()], &u[rows.clone()], &force[rows.clone()], period);
        let steady = (stage.len() >= least && !first.is_open).then(fit).flatten();
        let results = match &steady {
            None => by_cycles(stage),
            Some(steady) if steady.misfit < MISFIT => of_steady(steady),
            // Both the scatter of the cycles and the misfit of the branch contribute to the error, so both intervals are combined.
            Some(steady) => {
                let other = of_steady(steady);
                let widened = |(name, own): (&'static str, Interval)| {
                    let other = other.iter().find(|(same, _)| *same == name).map_or(own, |(_, other)| *other);
                    (name, Interval { low: own.low.min(other.low), high: own.high.max(other.high), ..own })
                };
                by_cycles(stage).into_iter().map(widened).collect()
            }
        };
        Self { cycles: part, time, steady, results, regime: None }
    }

    /// Returns the slip regime from the confidence intervals and the thresholds.
    fn regime(&self, thresholds: &Thresholds) -> &'static str {
        let all = [
            ("energy_ratio", thresholds.energy_ratio),
            ("system_free_ratio", thresholds.system_free_ratio),
            ("slip_ratio", thresholds.slip_ratio),
        ];
        let sides = all.into_iter().filter_map(|(name, limit)| {
            let (interval, limit) = (self.result(name)?, limit?);
            let is_known = interval.low >= limit || interval.high < limit;
            Some(if is_known { Some(interval.low >= limit) } else { None })
        });
        let sides: Vec<Option<bool>> = sides.collect();
        match sides.first() {
            Some(Some(first)) if sides.iter().all(|side| *side == Some(*first)) => {
                if *first {
                    "gross"
                } else {
                    "partial"
                }
            }
            _ => "undecided",
        }
    }

    /// Returns a result by its name.
    #[must_use]
    pub fn result(&self, name: &str) -> Option<Interval> {
        self.results.iter().find(|(own, _)| *own == name).map(|(_, interval)| *interval)
    }

    /// Returns the results as JSON. Interval ends that are not finite are null.
    #[must_use]
    pub fn results(&self) -> Value {
        Value::Object(
            self.results
                .iter()
                .map(|(name, interval)| ((*name).to_owned(), json!(interval)))
                .collect::<Map<_, _>>(),
        )
    }
}

/// Returns the results of a steady loop by name.
fn of_steady(steady: &SteadyLoop) -> Vec<(&'static str, Interval)> {
    let all = [
        ("displacement_amplitude_m", Some(steady.displacement_amplitude)),
        ("force_amplitude_N", Some(steady.force_amplitude)),
        ("dissipated_J", Some(steady.dissipated)),
        ("half_opening_m", Some(steady.half_opening)),
        ("half_opening_at_zero_force_m", steady.half_opening_at_zero_force),
        ("energy_ratio", Some(steady.energy_ratio)),
        ("system_free_ratio", steady.system_free_ratio),
        ("slip_ratio", Some(steady.slip_ratio)),
        ("friction_force_N", steady.friction_force),
        ("stiffness_N_m", Some(steady.stiffness)),
    ];
    all.into_iter().filter_map(|(name, interval)| Some((name, interval?))).collect()
}

/// Returns the means over the cycles of a stage, with confidence intervals from their scatter.
///
/// For a single cycle the interval ends are not finite.
fn by_cycles(stage: &[MeasuredCycle]) -> Vec<(&'static str, Interval)> {
    type Figure = fn(&MeasuredCycle) -> Option<f64>;
    let all: [(&str, Figure); 10] = [
        ("displacement_amplitude_m", |cycle| Some(cycle.cycle.displacement_amplitude)),
        ("force_amplitude_N", |cycle| Some(cycle.cycle.force_amplitude)),
        ("dissipated_J", |cycle| Some(cycle.cycle.dissipated)),
        ("half_opening_m", |cycle| cycle.cycle.half_opening),
        ("half_opening_at_zero_force_m", |cycle| cycle.opening_at_zero),
        ("energy_ratio", |cycle| cycle.cycle.energy_ratio()),
        ("system_free_ratio", |cycle| cycle.cycle.system_free_ratio()),
        ("slip_ratio", |cycle| cycle.cycle.slip_ratio()),
        ("friction_force_N", |cycle| cycle.cycle.friction_coefficient(1.0)),
        ("stiffness_N_m", |cycle| cycle.stiffness),
    ];
    let mean = |figure: Figure| {
        let values: Vec<f64> = stage.iter().filter_map(figure).collect();
        let count = values.len() as f64;
        let value = values.iter().sum::<f64>() / count;
        let squares = values.iter().map(|other| (other - value).powi(2)).sum::<f64>();
        // For more degrees of freedom than in the table, the normal quantile with its first correction is used.
        let quantile =
            STUDENT.get(values.len().wrapping_sub(2)).copied().unwrap_or(1.96 + 2.6 / (count - 1.0));
        let half = quantile * (squares / (count - 1.0) / count).sqrt();
        (!values.is_empty()).then_some(Interval { value, low: value - half, high: value + half })
    };
    all.into_iter().filter_map(|(name, figure)| Some((name, mean(figure)?))).collect()
}
