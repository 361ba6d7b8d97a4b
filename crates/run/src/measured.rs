//! Evaluation of measured hysteresis loops: displacement and tangential force from a table, split into cycles.

mod clean;
mod stage;
mod told;

use crate::job::Job;
use crate::kept::Kept;
use clean::{Correction, clean};
use stage::{stages, work_after};
use std::borrow::Cow;
use std::ops::Range;
use std::path::Path;
use stickslip_measure::contact_path;
use stickslip_measure::cycles::Cut;
use stickslip_measure::cycles::returns;
use stickslip_measure::series::extent;
use stickslip_measure::{
    Cycle, Interval, SeriesError, SteadyLoop, noise, returning_cycles, reversal_stiffness, reversals,
    split_cycles,
};
use stickslip_measure::{Periods, Regime, Thresholds, Trail};
use stickslip_record::{Recipe, Record, RecordError, Role};
use thiserror::Error;

pub use clean::{Correct, Rig};
pub use stage::{Account, MISFIT, Stage};

/// Columns of the table of measured cycles. Quantities that `cycles.csv` of a run also contains have the same names.
///
/// Row numbers replace missing times. Stiffnesses are fitted to the first tenth of the displacement range after a reversal.
const HEAD: [&str; 20] = [
    "cycle",
    "start_s",
    "end_s",
    "displacement_amplitude_m",
    "force_amplitude_N",
    "half_opening_m",
    "dissipated_J",
    "energy_ratio",
    "system_free_ratio",
    "slip_ratio",
    "energy_coefficient_of_friction",
    "fitted_stiffness_after_maximum_N_m",
    "fitted_stiffness_after_minimum_N_m",
    "half_opening_at_zero_force_m",
    "stiffness_N_m",
    "work_J",
    "stage",
    "flags",
    "mean_normal_force_N",
    "regime",
];
/// Minimum displacement that confirms a reversal: in standard deviations of the noise, and relative to the displacement range.
const SURE: f64 = 12.0;
const LEAST: f64 = 1e-3;
/// Distance between start and end of a cycle, relative to the displacement range, above which the cycle counts as open.
const OPEN: f64 = 0.1;
/// Range of the normal force in a cycle, relative to its mean, above which the cycle gets the flag `load`.
const VARIES: f64 = 0.1;
/// Number of iterations that determine the compliance of the rig.
const ROUNDS: usize = 3;
/// Maximum gap between the end of a cycle and the start of the next cycle, relative to the length of a cycle.
const NEAR: f64 = 0.2;

/// Error of the evaluation of measured loops.
#[derive(Debug, Error)]
pub enum MeasuredError {
    /// The table cannot be read.
    #[error(transparent)]
    Table(#[from] RecordError),
    /// The values of the table cannot be evaluated.
    #[error("{file}: {source}")]
    Series {
        /// Path of the table.
        file: String,
        /// Cause.
        source: SeriesError,
    },
    /// A period or a time interval was given for a table without times.
    #[error("{0}: --period, --from and --to need a column of times; select one with --time")]
    NoTime(String),
    /// The time interval contains no rows.
    #[error("{0}: no rows between --from and --to")]
    Nothing(String),
    /// Rig and contact together are not softer than the contact alone.
    #[error(
        "{0}: the rig stiffness cannot be determined: rig and contact together are not softer than the contact alone\n   help: give a known stiffness with --rig-stiffness"
    )]
    Rig(String),
    /// There is no closed cycle.
    #[error("{0}: no cycle closes within a tenth of its range\n   help: give the period with --period")]
    NoCycle(String),
}

/// A measured record.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Path of the file.
    pub file: String,
    /// Times, s, or row numbers if the table has no times.
    pub t: Vec<f64>,
    /// Whether the table has times.
    pub has_time: bool,
    /// Displacements, m.
    pub u: Vec<f64>,
    /// Tangential forces that drive the motion, N.
    pub force: Vec<f64>,
    /// Normal forces, N, if the table has them.
    pub normal: Option<Vec<f64>>,
    /// Whether the sign of the tangential force was inverted, because the table contains the resisting force.
    pub is_turned: bool,
    /// Notes on assumptions and skipped lines, as sentences.
    pub notes: Vec<String>,
}

/// One cycle of a record with its results.
///
/// The opening of the loop is taken at the middle of the force range, because the zero of a load cell is uncertain.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredCycle {
    /// Rows of the cycle, both ends included.
    pub span: Range<usize>,
    /// Start and end, s.
    pub time: [f64; 2],
    /// Results of the cycle.
    pub cycle: Cycle,
    /// Half opening at zero force, m. `None` if the force does not change sign.
    pub opening_at_zero: Option<f64>,
    /// Tangent stiffness at the reversals, N/m. `None` if u is constant.
    pub stiffness: Option<f64>,
    /// Mean, minimum and maximum normal force, N, if the table has them.
    pub normal: Option<[f64; 3]>,
    /// Slip regime, if a contact profile was given.
    pub regime: Option<Regime>,
    /// Work ∫F du over the rows of the cycle before corrections, J.
    pub work: f64,
    /// Number of the stage, from 1. A stage consists of consecutive cycles of similar amplitude and duration.
    pub stage: usize,
    /// Whether the cycle is open: start and end differ by more than a tenth of the displacement range. A chord closes an open loop.
    pub is_open: bool,
}

/// Settings of an evaluation.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct How {
    /// Period of the cycles from the first row on, s.
    pub period: Option<f64>,
    /// Time of the first row, s.
    pub from: Option<f64>,
    /// Time of the last row, s.
    pub to: Option<f64>,
    /// Numbers of the first and the last cycle, from 1.
    pub cycles: Option<[usize; 2]>,
    /// Effects that are corrected on request.
    pub correct: Correct,
    /// Test rig in series with the contact, whose displacement is subtracted.
    pub rig: Option<Rig>,
    /// Exponent n of the contact profile f ~ rⁿ, for the slip regimes.
    pub profile: Option<f64>,
}

/// Results of an evaluation.
#[derive(Debug, Clone, PartialEq)]
pub struct Evaluated {
    /// Cycles of the record.
    pub cycles: Vec<MeasuredCycle>,
    /// Stages of the record.
    pub stages: Vec<Stage>,
    /// Numbers of rows and energies within and outside of the cycles.
    pub account: Account,
    /// Numbers of removed spikes of the displacement and of the force.
    pub spikes: [usize; 2],
    /// Displacements and forces after all corrections. `None` if no value of the record was changed.
    pub rows: Option<[Vec<f64>; 2]>,
    /// Steady loop of the longest stage before corrections.
    pub found: Option<SteadyLoop>,
    /// Longest stage before the correction for the rig, and stiffness of the rig, N/m. `None` without this correction.
    pub with_rig: Option<(Stage, Interval)>,
}

impl Evaluated {
    /// Returns the stage with the most cycles, or the last of several such stages.
    #[must_use]
    pub fn longest(&self) -> Option<&Stage> {
        self.stages.iter().max_by_key(|stage| stage.cycles.len())
    }

    /// Returns the mean normal force of the longest stage, N. Returns `None` without normal forces, or if the mean is not positive.
    #[must_use]
    pub fn mean_load(&self) -> Option<f64> {
        let stage = self.longest()?;
        let cycles = &self.cycles[stage.cycles.clone()];
        let sum: Option<f64> = cycles.iter().map(|cycle| cycle.normal.map(|[mean, ..]| mean)).sum();
        sum.map(|sum| sum / cycles.len() as f64).filter(|mean| *mean > 0.0)
    }

    /// Returns whether the measured force resists the motion.
    ///
    /// The criterion is the steady loop if its sign is certain, or else the majority of slopes after reversals, or else the loop area.
    fn is_turned(&self) -> bool {
        if let Some(steady) =
            self.longest().and_then(|stage| stage.steady).filter(|steady| steady.is_sense_sure)
        {
            return steady.is_turned;
        }
        let slopes = self.cycles.iter().filter_map(|cycle| cycle.stiffness.map(f64::signum)).sum::<f64>();
        let area = self.cycles.iter().map(|cycle| cycle.cycle.dissipated).sum::<f64>();
        if slopes.abs() > 0.5 * self.cycles.len() as f64 { slopes < 0.0 } else { area < 0.0 }
    }
}

impl Measured {
    /// Reads a record from a table of an instrument. Settings that are missing in the recipe are detected.
    ///
    /// # Errors
    /// The file cannot be read, or lacks a required column.
    pub fn read(path: &Path, recipe: &Recipe) -> Result<Self, MeasuredError> {
        let mut record = Record::read(path, recipe, &[Role::Displacement, Role::Force])?;
        let mut column = |role| record.columns.remove(&role);
        let (time, u, force) = (column(Role::Time), column(Role::Displacement), column(Role::Force));
        let u = u.unwrap_or_default();
        let has_time = time.is_some();
        let t = time.unwrap_or_else(|| (0..u.len()).map(|line| line as f64).collect());
        let normal = column(Role::Normal);
        let (file, force, notes) = (path.display().to_string(), force.unwrap_or_default(), record.notes);
        Ok(Self { file, t, has_time, u, force, normal, is_turned: false, notes })
    }

    /// Splits the record into cycles and evaluates each cycle and each stage with confidence intervals.
    ///
    /// The cycles are periods from the first row on, or extend between reversals of the same kind. The sign of a resisting force is
    /// inverted. On request, time lag and drift of the longest stage are removed from the whole record.
    ///
    /// # Errors
    /// Times do not ascend, the settings contain a period or a time interval but the record has no times, or there is no cycle.
    pub fn evaluate(&mut self, how: &How) -> Result<Evaluated, MeasuredError> {
        if (how.period.is_some() || how.from.is_some() || how.to.is_some()) && !self.has_time {
            return Err(MeasuredError::NoTime(self.file.clone()));
        }
        self.keep(how.from, how.to)?;
        let mut evaluated = self.round(how, &Correction::default())?;
        let longest = evaluated.longest().and_then(|stage| stage.steady);
        self.is_turned = evaluated.is_turned();
        let correction = longest.map(|steady| Correction::of(&steady, how.correct)).unwrap_or_default();
        if self.is_turned {
            self.force.iter_mut().for_each(|force| *force = -*force);
        }
        if self.is_turned || correction != Correction::default() {
            evaluated = self.round(how, &correction)?;
        }
        if let Some(rig) = how.rig {
            evaluated = self.without_rig(how, evaluated, correction, rig)?;
        }
        evaluated.found = longest;
        Ok(evaluated)
    }

    /// Subtracts the displacement of the rig and evaluates the record again. `evaluated` are the results before this correction.
    fn without_rig(
        &self,
        how: &How,
        mut evaluated: Evaluated,
        mut correction: Correction,
        rig: Rig,
    ) -> Result<Evaluated, MeasuredError> {
        let unknown = || MeasuredError::Rig(self.file.clone());
        let whole = evaluated.longest().cloned().ok_or_else(unknown)?;
        let mut stiffness = Interval::default();
        // The correction is iterated, because the branches of rig and contact together differ from those of the contact alone.
        for _ in 0..if matches!(rig, Rig::Contact(_)) { ROUNDS } else { 1 } {
            let tangent = evaluated.longest().and_then(|stage| stage.result("stiffness_N_m"));
            let compliance = rig.compliance(tangent.ok_or_else(unknown)?);
            let before = if matches!(rig, Rig::Contact(_)) { correction.compliance } else { 0.0 };
            let [value, low, high] =
                [compliance.value, compliance.low, compliance.high].map(|own| before + own);
            if value <= 0.0 {
                return Err(unknown());
            }
            stiffness = Interval {
                value: 1.0 / value,
                low: 1.0 / high,
                high: if low > 0.0 { 1.0 / low } else { f64::INFINITY },
            };
            correction.compliance = value;
            evaluated = self.round(how, &correction)?;
        }
        evaluated.with_rig = Some((whole, stiffness));
        Ok(evaluated)
    }

    /// Removes all rows outside of a time interval.
    fn keep(&mut self, from: Option<f64>, to: Option<f64>) -> Result<(), MeasuredError> {
        if from.is_none() && to.is_none() {
            return Ok(());
        }
        let start = from.map_or(0, |from| self.t.partition_point(|t| *t < from));
        let end = to.map_or(self.t.len(), |to| self.t.partition_point(|t| *t <= to));
        if start >= end {
            return Err(MeasuredError::Nothing(self.file.clone()));
        }
        for values in [&mut self.t, &mut self.u, &mut self.force].into_iter().chain(&mut self.normal) {
            values.truncate(end);
            values.drain(..start);
        }
        Ok(())
    }

    fn round(&self, how: &How, correction: &Correction) -> Result<Evaluated, MeasuredError> {
        let failed = |source| MeasuredError::Series { file: self.file.clone(), source };
        let (u, force, spikes) = clean(&self.t, &self.u, &self.force, correction);
        let start = self.t.first().copied().unwrap_or(0.0);
        let spans = match how.period {
            Some(period) => {
                split_cycles(&self.t, &u, &force, Cut::Period { start, period }).map_err(failed)?
            }
            None => {
                // This call only checks the record.
                let any = Cut::Reversals { least: f64::MIN_POSITIVE };
                split_cycles(&self.t, &u, &force, any).map_err(failed)?;
                joined(with_changing(&u, &returning_cycles(&self.t, &u, 0.0)))
            }
        };
        let [first, last] = how.cycles.unwrap_or([1, usize::MAX]);
        let chosen = spans.into_iter().zip(1..).filter(|(_, number)| (first..=last).contains(number));
        let spans: Vec<Range<usize>> = chosen.map(|(span, _)| span).collect();
        if spans.is_empty() {
            return Err(MeasuredError::NoCycle(self.file.clone()));
        }
        let mut cycles = self.measure(&spans, &u, &force).map_err(failed)?;
        // With a rig of unknown compliance, only B has a threshold.
        let is_bare = correction.compliance != 0.0;
        let of = if is_bare { Thresholds::of_profile } else { Thresholds::with_unknown_rig };
        let thresholds = how.profile.map(of).transpose().map_err(failed)?;
        for cycle in &mut cycles {
            cycle.regime = thresholds.map(|thresholds| thresholds.regime(&cycle.cycle));
        }
        let stages = stages(&mut cycles, (&self.t, &u, &force), thresholds.as_ref());
        let account = Account::of(&cycles, (&self.u, &self.force));
        let is_changed = matches!(u, Cow::Owned(_)) || matches!(force, Cow::Owned(_));
        let rows = is_changed.then(|| [u.into_owned(), force.into_owned()]);
        Ok(Evaluated { cycles, stages, account, spikes, rows, found: None, with_rig: None })
    }

    fn measure(
        &self,
        spans: &[Range<usize>],
        u: &[f64],
        force: &[f64],
    ) -> Result<Vec<MeasuredCycle>, SeriesError> {
        let one = |span: &Range<usize>| {
            let is_open = !returns(&u[span.clone()], 0.0, OPEN);
            // An open loop is closed by a chord. The gap of other loops is distributed over all rows.
            let closed = |values: &[f64]| if is_open { values.to_vec() } else { without_gap(values) };
            let (u, force) = (closed(&u[span.clone()]), closed(&force[span.clone()]));
            Ok(MeasuredCycle {
                span: span.clone(),
                time: [self.t[span.start], self.t[span.end - 1]],
                cycle: of_loop(&u, &force)?,
                opening_at_zero: Cycle::of_loop(&u, &force)?.half_opening,
                stiffness: reversal_stiffness(&u, &force),
                normal: self.normal.as_ref().map(|normal| of_load(&normal[span.clone()])),
                regime: None,
                work: (span.start..span.end - 1).map(|row| work_after((&self.u, &self.force), row)).sum(),
                stage: 0,
                is_open,
            })
        };
        spans.iter().map(one).collect()
    }
}

/// Returns the mean, minimum and maximum of normal forces.
fn of_load(normal: &[f64]) -> [f64; 3] {
    let (low, high) = extent(normal);
    [normal.iter().sum::<f64>() / normal.len() as f64, low, high]
}

/// Removes the difference between the last and the first value by distributing it evenly over all rows.
fn without_gap(values: &[f64]) -> Vec<f64> {
    let gap = values.last().zip(values.first()).map_or(0.0, |(last, first)| last - first);
    let rows = values.len().saturating_sub(1).max(1) as f64;
    values.iter().enumerate().map(|(row, value)| value - gap * row as f64 / rows).collect()
}

/// Adds the cycles of growing or decreasing amplitude before, between and after closed cycles.
fn with_changing(u: &[f64], cycles: &[Range<usize>]) -> Vec<Range<usize>> {
    let (low, high) = extent(u);
    let least = (SURE * noise(u)).max(LEAST * (high - low));
    let (last, mut all, mut from) = (u.len().saturating_sub(1), Vec::new(), None);
    for next in cycles.iter().map(Some).chain([None]) {
        let (start, end) = (from.unwrap_or(0), next.map_or(last, |next| next.start));
        let inner = reversals(&u[start..=end], least).into_iter().map(|place| start + place);
        let mut places: Vec<usize> = inner.filter(|place| (start + 1..end).contains(place)).collect();
        // The start of the record is a reversal only if the motion reversed there.
        if let Some(&first) = places.first().filter(|_| from.is_none()) {
            let (low, high) = extent(&u[start..=first]);
            if high - low <= least {
                places.remove(0);
            }
        }
        places.splice(0..0, from);
        places.extend(next.map(|next| next.start));
        // Start and end of a closed cycle are reversals of the same kind. Without a closed cycle, the kind of the first reversal is used.
        let mut kind: Vec<usize> = match (from, next) {
            (None, Some(_)) => places.into_iter().rev().step_by(2).collect(),
            _ => places.into_iter().step_by(2).collect(),
        };
        kind.sort_unstable();
        all.extend(kind.windows(2).filter(|ends| ends[0] < ends[1]).map(|ends| ends[0]..ends[1] + 1));
        all.extend(next.cloned());
        from = next.map(|next| next.end - 1);
    }
    all
}

/// Extends cycles to the end of the previous cycle if the gap between them is caused by noise.
fn joined(mut cycles: Vec<Range<usize>>) -> Vec<Range<usize>> {
    for k in 1..cycles.len() {
        let (end, next) = (cycles[k - 1].end - 1, cycles[k].clone());
        if next.start > end && (next.start - end) as f64 <= NEAR * next.len() as f64 {
            cycles[k].start = end;
        }
    }
    cycles
}

/// Evaluates the last cycle of contact `c` of a run like a measured cycle. Returns displacements, forces and results.
///
/// The displacements are those of the contact, or the values of a channel such as `rig.x`. Returns `None` without a closed cycle or without
/// the channel.
#[must_use]
pub fn simulated(
    job: &Job,
    c: usize,
    kept: &Kept,
    channel: Option<&str>,
) -> Option<(Vec<f64>, Vec<f64>, Cycle)> {
    let trail = match channel {
        None => contact_path(job, c, &kept.series),
        Some(channel) => {
            let (name, _) = job.model.contacts().nth(c)?;
            let (part, quantity) = channel.rsplit_once('.')?;
            let columns = [quantity.to_owned(), format!("{quantity}_m")];
            let x = columns.iter().map(|own| kept.series.column(part, own)).find(|own| !own.is_empty())?;
            let [t, y] = [kept.series.time(), kept.series.column(name, "fx_N")].map(<[f64]>::to_vec);
            Trail { t, x: x.to_vec(), y }
        }
    };
    let last = match Periods::of_contact(job, c, kept.end()) {
        Some(periods) => trail.part(periods.last()),
        None => {
            let last = returning_cycles(&trail.t, &trail.x, 0.0).pop()?;
            trail.part((trail.t[last.start], trail.t[last.end - 1]))
        }
    };
    let cycle = of_loop(&last.x, &last.y).ok()?;
    Some((last.x, last.y, cycle))
}

/// Returns the table `cycles.csv` of measured loops as CSV text. Missing values are empty.
///
/// The energy coefficient of friction μ_e is computed with the mean normal force `normal`, N, or with the measured mean of each cycle.
#[must_use]
pub fn table(cycles: &[MeasuredCycle], normal: Option<f64>) -> String {
    let mut text = HEAD.join(",") + "\n";
    for (number, all) in (1..).zip(cycles) {
        let MeasuredCycle { time, cycle, opening_at_zero, stiffness, work, stage, .. } = all;
        let values = [
            Some(time[0]),
            Some(time[1]),
            Some(cycle.displacement_amplitude),
            Some(cycle.force_amplitude),
            cycle.half_opening,
            Some(cycle.dissipated),
            cycle.energy_ratio(),
            cycle.system_free_ratio(),
            cycle.slip_ratio(),
            all.friction(normal),
            cycle.stiffness_after_maximum,
            cycle.stiffness_after_minimum,
            *opening_at_zero,
            *stiffness,
            Some(*work),
        ];
        let cells = values.map(|value| value.map_or_else(String::new, |value| format!("{value:e}")));
        let load = all.normal.map_or_else(String::new, |[mean, ..]| format!("{mean:e}"));
        let regime = all.regime.map_or("", Regime::word);
        text.push_str(&format!("{number},{},{stage},{},{load},{regime}\n", cells.join(","), all.flags()));
    }
    text
}

impl MeasuredCycle {
    /// Returns the energy coefficient of friction for the mean normal force `normal`, N, or for the measured mean of the cycle.
    #[must_use]
    pub fn friction(&self, normal: Option<f64>) -> Option<f64> {
        let own = self.normal.map(|[mean, ..]| mean).filter(|mean| *mean > 0.0);
        normal.or(own).and_then(|normal| self.cycle.friction_coefficient(normal))
    }

    /// Returns the flags of the cycle: `open`, `load` (the normal force varies by more than a tenth of its mean) and `unloaded`.
    fn flags(&self) -> String {
        let is_unloaded = self.normal.is_some_and(|[mean, ..]| mean <= 0.0);
        let varies = self.normal.is_some_and(|[mean, low, high]| high - low > VARIES * mean.abs());
        let all = [(self.is_open, "open"), (is_unloaded, "unloaded"), (varies && !is_unloaded, "load")];
        all.iter().filter(|(is, _)| *is).map(|(_, word)| *word).collect::<Vec<_>>().join(" ")
    }
}

/// Returns the mean of the minimum and the maximum.
#[must_use]
pub fn middle(values: &[f64]) -> f64 {
    let (low, high) = extent(values);
    low + 0.5 * (high - low)
}

/// Evaluates a loop with the force relative to the middle of its range.
fn of_loop(u: &[f64], force: &[f64]) -> Result<Cycle, SeriesError> {
    let middle = middle(force);
    let force: Vec<f64> = force.iter().map(|force| force - middle).collect();
    Cycle::of_loop(u, &force)
}
