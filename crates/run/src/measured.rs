//! Measured loops: a displacement and a tangential force from a table, cut into cycles and measured as those of a run are.

use crate::job::Job;
use crate::kept::Kept;
use serde::Serialize;
use std::ops::Range;
use std::path::Path;
use stickslip_measure::Periods;
use stickslip_measure::contact_path;
use stickslip_measure::cycles::Cut;
use stickslip_measure::cycles::returns;
use stickslip_measure::series::extent;
use stickslip_measure::{Cycle, SeriesError, noise, returning_cycles, reversals, split_cycles};
use stickslip_record::{Recipe, Record, RecordError, Role};
use thiserror::Error;

/// Columns of the table of measured cycles: names as in a run's `cycles.csv`. Times are places of lines where there are none; stiffnesses are
/// fitted to the first tenth of the way back.
const HEAD: [&str; 17] = [
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
    "work_J",
    "stage",
    "flags",
];
/// Reversals are confirmed by a way back of so many standard deviations of the noise, and of this share of the range at least.
const SURE: f64 = 12.0;
const LEAST: f64 = 1e-3;
/// A cycle is open whose ends are farther apart than this share of its range.
const OPEN: f64 = 0.1;
/// A stage ends where the amplitude, or the time of a cycle, differs by more than these shares: noise moves reversals of a sine by a tenth.
const STAGE: [f64; 2] = [0.1, 0.25];

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
    /// A period in a table without times.
    #[error("{0}: a period needs a column of times, or the one named by --time")]
    NoTime(String),
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
    /// ∮F du over its rows as they are, J.
    pub work: f64,
    /// Number of its stage, from 1: cycles of about one amplitude and one time that follow each other.
    pub stage: usize,
    /// Whether its ends are farther apart than a tenth of its range: its figures are those of the loop closed by a chord.
    pub is_open: bool,
}

/// What of a record lies in its cycles. A row belongs to one cycle, that which it begins or lies in; works are ∫F du by the trapezoids between rows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Account {
    /// Rows of the record.
    pub rows: usize,
    /// Rows in cycles.
    pub rows_in_cycles: usize,
    /// All others.
    pub rows_outside: usize,
    /// Work of the whole record, J.
    #[serde(rename = "work_J")]
    pub work: f64,
    /// Work in cycles, J.
    #[serde(rename = "work_in_cycles_J")]
    pub work_in_cycles: f64,
    /// Work of all others, J.
    #[serde(rename = "work_outside_J")]
    pub work_outside: f64,
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
        let (file, force, notes) = (path.display().to_string(), force.unwrap_or_default(), record.notes);
        Ok(Self { file, t, has_time, u, force, is_turned: false, notes })
    }

    /// Its cycles: of a period, s, from the first line on, or else from one reversal to the next of its kind, those that come back.
    ///
    /// Forces that do work against the motion are those that resist it, and are turned round.
    ///
    /// # Errors
    /// Times that do not ascend, a period without times, and no cycle at all.
    pub fn cycles(&mut self, period: Option<f64>) -> Result<Vec<MeasuredCycle>, MeasuredError> {
        let failed = |source| MeasuredError::Series { file: self.file.clone(), source };
        let start = self.t.first().copied().unwrap_or(0.0);
        let spans = match period {
            Some(_) if !self.has_time => return Err(MeasuredError::NoTime(self.file.clone())),
            Some(period) => {
                split_cycles(&self.t, &self.u, &self.force, Cut::Period { start, period }).map_err(failed)?
            }
            None => {
                // What is no record is refused here.
                let any = Cut::Reversals { least: f64::MIN_POSITIVE };
                split_cycles(&self.t, &self.u, &self.force, any).map_err(failed)?;
                self.with_changing(&returning_cycles(&self.t, &self.u, 0.0))
            }
        };
        if spans.is_empty() {
            return Err(MeasuredError::NoCycle(self.file.clone()));
        }
        let all = self.measure(&spans).map_err(failed)?;
        if all.iter().map(|cycle| cycle.cycle.dissipated).sum::<f64>() >= 0.0 {
            return Ok(all);
        }
        self.is_turned = true;
        self.force.iter_mut().for_each(|force| *force = -*force);
        let failed = |source| MeasuredError::Series { file: self.file.clone(), source };
        self.measure(&spans).map_err(failed)
    }

    /// What of the record lies in these cycles, which follow each other.
    #[must_use]
    pub fn account(&self, cycles: &[MeasuredCycle]) -> Account {
        let mut outside = 0.0;
        let mut next = 0;
        for cycle in cycles {
            outside += (next..cycle.span.start).map(|row| self.work_after(row)).sum::<f64>();
            next = cycle.span.end - 1;
        }
        let rows = self.u.len();
        outside += (next..rows.saturating_sub(1)).map(|row| self.work_after(row)).sum::<f64>();
        let rows_in_cycles = cycles.iter().map(|cycle| cycle.span.len() - 1).sum();
        let work_in_cycles = cycles.iter().map(|cycle| cycle.work).sum();
        Account {
            rows,
            rows_in_cycles,
            rows_outside: rows - rows_in_cycles,
            work: (0..rows.saturating_sub(1)).map(|row| self.work_after(row)).sum(),
            work_in_cycles,
            work_outside: outside,
        }
    }

    /// Work between a row and the next, J.
    fn work_after(&self, row: usize) -> f64 {
        0.5 * (self.force[row] + self.force[row + 1]) * (self.u[row + 1] - self.u[row])
    }

    fn measure(&self, spans: &[Range<usize>]) -> Result<Vec<MeasuredCycle>, SeriesError> {
        let one = |span: &Range<usize>| {
            let cycle = of_loop(&self.u[span.clone()], &self.force[span.clone()])?;
            let time = [self.t[span.start], self.t[span.end - 1]];
            let (u, force) = (&self.u[span.clone()], &self.force[span.clone()]);
            let opening_at_zero = Cycle::of_loop(u, force)?.half_opening;
            let work = (span.start..span.end - 1).map(|row| self.work_after(row)).sum();
            let is_open = !returns(u, 0.0, OPEN);
            Ok(MeasuredCycle { span: span.clone(), time, cycle, opening_at_zero, work, stage: 0, is_open })
        };
        let mut cycles = spans.iter().map(one).collect::<Result<Vec<_>, _>>()?;
        stages(&mut cycles);
        Ok(cycles)
    }

    /// With those between reversals before, between and after them: of growing and of shrinking amplitudes, that do not come back.
    fn with_changing(&self, cycles: &[Range<usize>]) -> Vec<Range<usize>> {
        let (low, high) = extent(&self.u);
        let least = (SURE * noise(&self.u)).max(LEAST * (high - low));
        let (last, mut all, mut from) = (self.u.len().saturating_sub(1), Vec::new(), None);
        for next in cycles.iter().map(Some).chain([None]) {
            let (start, end) = (from.unwrap_or(0), next.map_or(last, |next| next.start));
            let inner = reversals(&self.u[start..=end], least).into_iter().map(|place| start + place);
            let mut places: Vec<usize> = inner.filter(|place| (start + 1..end).contains(place)).collect();
            // What the record begins with is no reversal: it must have come there.
            if let Some(&first) = places.first().filter(|_| from.is_none()) {
                let (low, high) = extent(&self.u[start..=first]);
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
}

/// Numbers the stages of cycles.
fn stages(cycles: &mut [MeasuredCycle]) {
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

/// The last cycle of contact `c` of a run, measured in the same way: its displacements, forces and quantities; none where none comes back.
#[must_use]
pub fn simulated(job: &Job, c: usize, kept: &Kept) -> Option<(Vec<f64>, Vec<f64>, Cycle)> {
    let trail = contact_path(job, c, &kept.series);
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

/// `cycles.csv` of measured loops; μ_e under a mean normal force, N. What a cycle does not have is left empty.
#[must_use]
pub fn table(cycles: &[MeasuredCycle], normal: Option<f64>) -> String {
    let mut text = HEAD.join(",") + "\n";
    for (number, MeasuredCycle { time, cycle, opening_at_zero, work, stage, is_open, .. }) in
        (1..).zip(cycles)
    {
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
            normal.and_then(|normal| cycle.friction_coefficient(normal)),
            cycle.stiffness_after_maximum,
            cycle.stiffness_after_minimum,
            *opening_at_zero,
            Some(*work),
        ];
        let cells = values.map(|value| value.map_or_else(String::new, |value| format!("{value:e}")));
        let flags = if *is_open { "open" } else { "" };
        text.push_str(&format!("{number},{},{stage},{flags}\n", cells.join(",")));
    }
    text
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
