//! What is told of a branch: a table, and all of it in JSON.

use super::{Bifurcation, Branch, Change, Continuation, End, Mark, Point};
use crate::published::{self, Names};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;
use std::io;
use stickslip_quantity::{Definition, columns};
use stickslip_run::Real;
use stickslip_run::files::{BRANCH, PARTIAL_BRANCH};
use stickslip_run::folder::Folder;

/// Names of the table and of what is told of all: of a branch, and of one that was interrupted, beside which a finished one stays.
const NAMES: Names = [["branch.csv", BRANCH], ["branch-partial.csv", PARTIAL_BRANCH]];

/// Names of all files that a branch is written to, pictures apart.
pub fn all_files() -> impl Iterator<Item = String> {
    NAMES.into_iter().flatten().map(str::to_owned)
}

/// All numbers of a branch; written last.
#[derive(Debug, Serialize, JsonSchema)]
struct Report<'a> {
    /// name of the scenario
    scenario: &'a str,
    /// SHA-256 of the resolved scenario, as it is where the branch starts
    scenario_sha256: &'a str,
    /// name and version of the program
    program: &'a str,
    /// `done`, or `interrupted`: then the file is `branch-partial.json`
    status: &'static str,
    /// key path of what is varied; it heads the first column of `branch.csv`, with its unit
    varied: &'a str,
    /// its SI unit; empty of a plain number
    unit: &'static str,
    /// what it is in the scenario: where the branch starts
    #[serde(rename = "scenario_value")]
    present: Real,
    /// where the range begins
    from: Real,
    /// where the range ends
    to: Real,
    /// local error per step of the runs
    tolerance: Real,
    /// accuracy of special points, as a share of the range
    accuracy: Real,
    /// place of the start among the points, counted from 0
    start: usize,
    points: Vec<PointReport>,
    #[serde(rename = "special_points")]
    marks: Vec<MarkReport>,
    ends: [EndReport; 2],
    /// names of all files that were written together
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<String>,
    /// SHA-256 of `branch.csv`
    #[serde(skip_serializing_if = "Option::is_none")]
    table_sha256: Option<String>,
}

#[derive(Debug, Serialize, JsonSchema)]
struct PointReport {
    /// what is varied, at this motion; motions stand in their order along the branch
    value: Real,
    /// which smooth piece of the branch: another one begins where an event of the period appears or vanishes
    piece: usize,
    /// step along x of the figures' body in a period; none where no body is free along x
    step_m: Option<Real>,
    /// how far the step may be off, an estimate of first order, doubled
    step_error_m: Option<Real>,
    /// mean speed along x: step over period
    speed_m_s: Option<Real>,
    /// period common to all waveforms
    period_s: Real,
    /// whether a run that is disturbed a little comes back: no |λ| > 1; 1 or 0 in branch.csv
    stable: bool,
    /// Floquet multipliers, real and imaginary part, the largest first; of a pair the one above
    multipliers: Vec<[Real; 2]>,
    /// how many numbers the map of a period has
    unknowns: usize,
}

#[derive(Debug, Serialize, JsonSchema)]
struct MarkReport {
    /// `fold` (the branch turns back), `period doubling` (λ = -1), `Neimark-Sacker` (a pair with |λ| = 1), `branching` (another
    /// branch crosses), `break` (multipliers jump) or `event` (something appears in a period or vanishes)
    kind: &'static str,
    /// what is varied, there
    value: Real,
    /// how far that may be off: half of the bracket in which it lies
    half_width: Real,
    /// step there
    step_m: Option<Real>,
    /// whether motions are stable on the side of smaller and on that of larger values; of a fold before it and after it along
    /// the branch
    stable: [bool; 2],
    /// drive periods of the oscillation that neither decays nor grows; of Neimark-Sacker only
    #[serde(skip_serializing_if = "Option::is_none")]
    oscillation_periods: Option<Real>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    changes: Vec<ChangeReport>,
    /// what happens, in words
    #[serde(rename = "text")]
    words: String,
}

#[derive(Debug, Serialize, JsonSchema)]
struct ChangeReport {
    /// contact or block whose event it is
    source: String,
    /// the event
    event: String,
    /// how often it happens in a period below the place
    below: usize,
    /// how often above it
    above: usize,
}

#[derive(Debug, Serialize, JsonSchema)]
struct EndReport {
    /// what is varied, at the first and at the last motion
    value: Real,
    /// `range` (its end), `shakedown` (beyond, a contact never slips grossly: a whole family of motions), `slides away` (what
    /// pulls a body is as much as friction holds: any speed does), `rounded` (rounding leaves nothing of what friction does in
    /// a period), `lost` (no motion was found beyond), `refused` (the scenario allows no value beyond), `points` (as many as
    /// were allowed) or `interrupted`
    kind: &'static str,
    /// the same in words
    #[serde(rename = "text")]
    words: String,
}

impl PointReport {
    fn of(point: &Point) -> Self {
        Self {
            value: Real(point.value),
            piece: point.piece,
            step_m: point.step.map(Real),
            step_error_m: point.step.map(|_| Real(point.bound)),
            speed_m_s: point.speed().map(Real),
            period_s: Real(point.period),
            stable: point.is_stable(),
            multipliers: point.multipliers.iter().map(|m| [Real(m.re), Real(m.im)]).collect(),
            unknowns: point.unknowns,
        }
    }
}

impl MarkReport {
    fn of(mark: &Mark) -> Self {
        let change = |change: &Change| ChangeReport {
            source: change.source.clone(),
            event: change.kind.clone(),
            below: change.below,
            above: change.above,
        };
        let (beat, changes) = match &mark.kind {
            Bifurcation::NeimarkSacker { beat } => (Some(Real(*beat)), Vec::new()),
            Bifurcation::Event(changes) => (None, changes.iter().map(change).collect()),
            Bifurcation::Fold
            | Bifurcation::PeriodDoubling
            | Bifurcation::Branching
            | Bifurcation::Break(_) => (None, Vec::new()),
        };
        Self {
            kind: mark.kind.name(),
            value: Real(mark.value),
            half_width: Real(mark.half_width),
            step_m: mark.step.map(Real),
            stable: mark.stable,
            oscillation_periods: beat,
            changes,
            words: mark.kind.words(),
        }
    }
}

impl End {
    /// Its word in files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Range => "range",
            Self::Shakedown(_) => "shakedown",
            Self::SlidesAway(_) => "slides away",
            Self::Rounded(_) => "rounded",
            Self::Lost(_) => "lost",
            Self::Refused(_) => "refused",
            Self::Points => "points",
            Self::Interrupted => "interrupted",
        }
    }

    /// In words.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Range => "the end of the range".to_owned(),
            Self::Shakedown(contacts) => format!(
                "beyond, {} never slips grossly: steady motions are a whole family (a shakedown), and no one branch goes on",
                contacts.join(", ")
            ),
            Self::SlidesAway(body) => format!(
                "what pulls {body} is as much here as friction holds: any speed does, and beyond it slides away"
            ),
            Self::Rounded(lengths) => format!(
                "a period leads {lengths:.1e} times as far as contacts move before they slip: of that, numbers of 16 digits leave nothing beyond"
            ),
            Self::Lost(why) => format!("no motion was found beyond: {why}"),
            Self::Refused(why) => {
                format!("the scenario allows no value beyond: {}", why.lines().next().unwrap_or_default())
            }
            Self::Points => "as many points as were allowed: more (--points) lead on".to_owned(),
            Self::Interrupted => "it was interrupted here".to_owned(),
        }
    }
}

/// As CSV: what is varied and the motion there, along the branch. Numbers have as many digits as it takes to read the same bits
/// back; a cell is empty where there is no such number.
#[must_use]
pub fn csv(of: &Continuation, branch: &Branch) -> String {
    let mut table = of.head();
    table.push_str(",piece,step_m,step_error_m,speed_m_s,period_s,stable,largest_multiplier,oscillation_periods,unknowns\n");
    for point in &branch.points {
        let _ = write!(table, "{:e},{}", point.value, point.piece);
        let cells = [point.step, point.step.map(|_| point.bound), point.speed(), Some(point.period)];
        cells.into_iter().for_each(|n| number(&mut table, n));
        let _ = write!(table, ",{}", u8::from(point.is_stable()));
        let largest = point.multipliers.first();
        number(&mut table, Some(point.radius()));
        number(&mut table, largest.and_then(super::super::Multiplier::beat));
        let _ = writeln!(table, ",{}", point.unknowns);
    }
    table
}

fn number(table: &mut String, number: Option<f64>) {
    let _ = match number {
        Some(number) => write!(table, ",{number:e}"),
        None => write!(table, ","),
    };
}

/// All numbers on one line of JSON.
#[must_use]
pub fn json(of: &Continuation, branch: &Branch, accuracy: [f64; 2]) -> String {
    // Numbers and strings only: there is nothing that JSON could refuse.
    serde_json::to_string(&report(of, branch, accuracy)).unwrap_or_default()
}

/// Writes the table, `branch.json` and pictures into a folder; pictures of the names `stale` that are not among them go. What was
/// interrupted is written to `branch-partial.csv` and `branch-partial.json`, and goes with the next whole branch. `accuracy` is the
/// tolerance of the runs and that of places. Returns the names.
///
/// # Errors
/// What the system says; nothing that was there is gone then, unless it says so while names are given.
pub fn write(
    folder: Folder,
    (of, branch): (&Continuation, &Branch),
    accuracy: [f64; 2],
    (pictures, stale): (&[(String, Vec<u8>)], Vec<String>),
) -> io::Result<Vec<String>> {
    let table = csv(of, branch);
    let report = |files, table_sha256| Report {
        files,
        table_sha256: Some(table_sha256),
        ..report(of, branch, accuracy)
    };
    published::publish(folder, (&NAMES, branch.is_cut()), (&table, report), (pictures, stale))
}

fn report<'a>(of: &'a Continuation, branch: &Branch, [tolerance, accuracy]: [f64; 2]) -> Report<'a> {
    let at = |point: Option<&Point>| Real(point.map_or(f64::NAN, |point| point.value));
    let values = [at(branch.points.first()), at(branch.points.last())];
    let end =
        |k: usize| EndReport { value: values[k], kind: branch.ends[k].name(), words: branch.ends[k].words() };
    Report {
        scenario: &of.job.name,
        scenario_sha256: &of.job.hash,
        program: &of.job.program,
        status: published::status(branch.is_cut()),
        varied: &of.path,
        unit: of.unit,
        present: Real(of.present),
        from: Real(of.range[0]),
        to: Real(of.range[1]),
        tolerance: Real(tolerance),
        accuracy: Real(accuracy),
        start: branch.start,
        points: branch.points.iter().map(PointReport::of).collect(),
        marks: branch.marks.iter().map(MarkReport::of).collect(),
        ends: [end(0), end(1)],
        files: Vec::new(),
        table_sha256: None,
    }
}

/// What every key of `branch.json` and every column of `branch.csv` is.
pub(crate) fn definitions() -> Vec<Definition> {
    let columns = stickslip_quantity::report::<PointReport>(NAMES[0][0]);
    let columns = columns.into_iter().filter(|one| !["value", "multipliers"].contains(&one.name.as_ref()));
    columns
        .chain(columns::BRANCH.definitions())
        .chain(stickslip_quantity::report::<Report<'_>>(BRANCH))
        .collect()
}
