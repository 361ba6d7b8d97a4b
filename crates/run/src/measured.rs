//! Measured loops: a displacement and a tangential force from a table, cut into cycles and measured as those of a run are.

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

/// Columns of the table of measured cycles: names as in a run's `cycles.csv`. Times are places of lines where there are none; stiffnesses are
/// fitted to the first tenth of the way back.
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
/// Reversals are confirmed by a way back of so many standard deviations of the noise, and of this share of the range at least.
const SURE: f64 = 12.0;
const LEAST: f64 = 1e-3;
/// A cycle is open whose ends are farther apart than this share of its range.
const OPEN: f64 = 0.1;
/// A load varies whose range is more than this share of its mean.
const VARIES: f64 = 0.1;
/// How often the compliance of a rig is found again.
const ROUNDS: usize = 3;
/// Cycles follow each other whose ends are apart by no more than this share of a cycle.
const NEAR: f64 = 0.2;

/// Why there are no measured loops.
#[derive(Debug, Error)]
pub enum MeasuredError {
    /// The table.
    #[error(transparent)]
    Table(#[from] RecordError),
    /// Numbers that are no record.
    #[error("{file}: {source}")]
    Series {
        /// The table.
        file: String,
        /// What is wrong with it.
        source: SeriesError,
    },
    /// A period or a span of times in a table without times.
    #[error("{0}: --period, --from and --to need a column of times, or the one named by --time")]
    NoTime(String),
    /// No rows between the times that are asked for.
    #[error("{0}: no rows between --from and --to")]
    Nothing(String),
    /// A rig that is not softer than the whole.
    #[error(
        "{0}: the rig's stiffness cannot be found: rig and contact together are not softer than the contact alone\n   help: give it with --rig-stiffness, if it is known"
    )]
    Rig(String),
    /// Nothing that comes back.
    #[error(
        "{0}: no cycle comes back to within a tenth of its range\n   help: say the period, if it has one, with --period"
    )]
    NoCycle(String),
}

/// A measured record.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Name of its file.
    pub file: String,
    /// Times, s; places of the lines where there are none.
    pub t: Vec<f64>,
    /// Whether these are times.
    pub has_time: bool,
    /// Displacements, m.
    pub u: Vec<f64>,
    /// Forces that drive them, N.
    pub force: Vec<f64>,
    /// Normal forces, N, where the table has them.
    pub normal: Option<Vec<f64>>,
    /// Whether the table has them with the other sign: as the forces that resist.
    pub is_turned: bool,
    /// What reading it has done that nobody has asked for, in sentences.
    pub notes: Vec<String>,
}

/// One cycle of a record: where it lies in it, when, and its quantities. Its opening is that at the middle of its forces, whose zero a
/// load cell need not have.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredCycle {
    /// Places of the record, both ends with them.
    pub span: Range<usize>,
    /// From when to when, s.
    pub time: [f64; 2],
    /// Its quantities.
    pub cycle: Cycle,
    /// Half of the opening where the force itself is zero, m; none of a loop that nowhere is.
    pub opening_at_zero: Option<f64>,
    /// Tangent of the branches at the reversals, N/m; none of a loop without a way.
    pub stiffness: Option<f64>,
    /// Mean, least and largest normal force, N, where the table has them.
    pub normal: Option<[f64; 3]>,
    /// How it slips, by the thresholds of a profile that is known.
    pub regime: Option<Regime>,
    /// ∮F du over its rows as they are, J.
    pub work: f64,
    /// Number of its stage, from 1: cycles of about one amplitude and one time that follow each other.
    pub stage: usize,
    /// Whether its ends are farther apart than a tenth of its range: its figures are those of the loop closed by a chord.
    pub is_open: bool,
}

/// What of a record is evaluated, and how.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct How {
    /// Period of the cycles from the first row on, s.
    pub period: Option<f64>,
    /// Time of the first row, s.
    pub from: Option<f64>,
    /// Time of the last row, s.
    pub to: Option<f64>,
    /// First and last of the cycles, from 1.
    pub cycles: Option<[usize; 2]>,
    /// What is taken out of the record.
    pub correct: Correct,
    /// The rig that lies in series with the contact, whose share of the displacement is taken out.
    pub rig: Option<Rig>,
    /// Power n of the contact's profile f ~ rⁿ, for its regimes.
    pub profile: Option<f64>,
}

/// What was found in a record.
#[derive(Debug, Clone, PartialEq)]
pub struct Evaluated {
    /// Its cycles.
    pub cycles: Vec<MeasuredCycle>,
    /// Its stages.
    pub stages: Vec<Stage>,
    /// What lies in the cycles, and what outside.
    pub account: Account,
    /// Single rows of the displacement and of the force that stand far out of their neighbours, and were left out.
    pub spikes: [usize; 2],
    /// Displacements and forces without spikes, and without what was taken out of them, where they differ from the record.
    pub rows: Option<[Vec<f64>; 2]>,
    /// The steady loop of the stage of most cycles before anything was taken out of the record.
    pub found: Option<SteadyLoop>,
    /// The stage of most cycles with the rig in it, and the stiffness of the rig, N/m, where its share was taken out.
    pub with_rig: Option<(Stage, Interval)>,
}

impl Evaluated {
    /// The stage of most cycles, the last of equal ones.
    #[must_use]
    pub fn longest(&self) -> Option<&Stage> {
        self.stages.iter().max_by_key(|stage| stage.cycles.len())
    }

    /// Mean normal force of the stage of most cycles, N, where the table has normal forces and they press.
    #[must_use]
    pub fn mean_load(&self) -> Option<f64> {
        let stage = self.longest()?;
        let cycles = &self.cycles[stage.cycles.clone()];
        let sum: Option<f64> = cycles.iter().map(|cycle| cycle.normal.map(|[mean, ..]| mean)).sum();
        sum.map(|sum| sum / cycles.len() as f64).filter(|mean| *mean > 0.0)
    }

    /// Whether the force resists the motion: by the steady loop where the rows tell, else by the slopes after the reversals, else by the area.
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
    /// Reads a record from a table of an instrument; what the recipe leaves out is guessed.
    ///
    /// # Errors
    /// A file that is no such table, or lacks a column that is asked for.
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

    /// Evaluates it: finds its cycles, of a period from the first row on or from one reversal to the next of its kind, measures
    /// each, and each stage with its intervals.
    ///
    /// A force that resists the motion is turned round. Lag and drift of the stage of most cycles are taken out of all of it on request.
    ///
    /// # Errors
    /// Times that do not ascend, a period or a span of times without times, and no cycle at all.
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

    /// Evaluates it without the share of a rig in the displacement; `evaluated` is with it.
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
        // Rig and contact together have other branches than the contact alone: what is left of the rig is found again without most of it.
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

    /// Keeps the rows between two times.
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
                // What is no record is refused here.
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
        // A compliance that is not known leaves B alone.
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
            // An open loop is closed by a chord, another along all of its way.
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

/// Mean, least and largest of normal forces.
fn of_load(normal: &[f64]) -> [f64; 3] {
    let (low, high) = extent(normal);
    [normal.iter().sum::<f64>() / normal.len() as f64, low, high]
}

/// Values without the gap between their ends, spread evenly over all rows.
fn without_gap(values: &[f64]) -> Vec<f64> {
    let gap = values.last().zip(values.first()).map_or(0.0, |(last, first)| last - first);
    let rows = values.len().saturating_sub(1).max(1) as f64;
    values.iter().enumerate().map(|(row, value)| value - gap * row as f64 / rows).collect()
}

/// With cycles between reversals before, between and after them: of growing and of shrinking amplitudes, that do not come back.
fn with_changing(u: &[f64], cycles: &[Range<usize>]) -> Vec<Range<usize>> {
    let (low, high) = extent(u);
    let least = (SURE * noise(u)).max(LEAST * (high - low));
    let (last, mut all, mut from) = (u.len().saturating_sub(1), Vec::new(), None);
    for next in cycles.iter().map(Some).chain([None]) {
        let (start, end) = (from.unwrap_or(0), next.map_or(last, |next| next.start));
        let inner = reversals(&u[start..=end], least).into_iter().map(|place| start + place);
        let mut places: Vec<usize> = inner.filter(|place| (start + 1..end).contains(place)).collect();
        // What the record begins with is no reversal: it must have come there.
        if let Some(&first) = places.first().filter(|_| from.is_none()) {
            let (low, high) = extent(&u[start..=first]);
            if high - low <= least {
                places.remove(0);
            }
        }
        places.splice(0..0, from);
        places.extend(next.map(|next| next.start));
        // Of the kind of the ends, which are reversals themselves; else of that of the first.
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

/// Cycles whose ends noise has moved apart by less than a fifth of a cycle follow each other.
fn joined(mut cycles: Vec<Range<usize>>) -> Vec<Range<usize>> {
    for k in 1..cycles.len() {
        let (end, next) = (cycles[k - 1].end - 1, cycles[k].clone());
        if next.start > end && (next.start - end) as f64 <= NEAR * next.len() as f64 {
            cycles[k].start = end;
        }
    }
    cycles
}

/// The last cycle of contact `c` of a run, measured in the same way: its displacements, or those of a channel such as `rig.x`, its forces and quantities; none
/// where none comes back, or there is no such channel.
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

/// `cycles.csv` of measured loops; μ_e under a mean normal force, N, or else under that of each cycle. What a cycle does not have is left empty.
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
    /// Energy coefficient of friction under a mean normal force, N, or else under its own.
    #[must_use]
    pub fn friction(&self, normal: Option<f64>) -> Option<f64> {
        let own = self.normal.map(|[mean, ..]| mean).filter(|mean| *mean > 0.0);
        normal.or(own).and_then(|normal| self.cycle.friction_coefficient(normal))
    }

    /// What is odd about it: `open`, a `load` that varies by more than a tenth of its mean, or `unloaded`.
    fn flags(&self) -> String {
        let is_unloaded = self.normal.is_some_and(|[mean, ..]| mean <= 0.0);
        let varies = self.normal.is_some_and(|[mean, low, high]| high - low > VARIES * mean.abs());
        let all = [(self.is_open, "open"), (is_unloaded, "unloaded"), (varies && !is_unloaded, "load")];
        all.iter().filter(|(is, _)| *is).map(|(_, word)| *word).collect::<Vec<_>>().join(" ")
    }
}

/// The middle between the least and the largest value.
#[must_use]
pub fn middle(values: &[f64]) -> f64 {
    let (low, high) = extent(values);
    low + 0.5 * (high - low)
}

/// A loop about the middle of its forces.
fn of_loop(u: &[f64], force: &[f64]) -> Result<Cycle, SeriesError> {
    let middle = middle(force);
    let force: Vec<f64> = force.iter().map(|force| force - middle).collect();
    Cycle::of_loop(u, &force)
}
