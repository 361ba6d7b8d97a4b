//! Output of a branch: `branch.csv` and `branch.json`.

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

/// File names of table and report for complete and for interrupted branches. The files of an interrupted branch do not replace those of a
/// complete branch.
const NAMES: Names = [["branch.csv", BRANCH], ["branch-partial.csv", PARTIAL_BRANCH]];

/// Returns the names of all files of a branch except plots.
pub fn all_files() -> impl Iterator<Item = String> {
    NAMES.into_iter().flatten().map(str::to_owned)
}

/// Content of `branch.json`. It is written last.
#[derive(Debug, Serialize, JsonSchema)]
struct Report<'a> {
    /// name of the scenario
    scenario: &'a str,
    /// SHA-256 of the complete scenario at the start of the branch
    scenario_sha256: &'a str,
    /// name and version of the program
    program: &'a str,
    /// end of the computation: `done` or `interrupted`. An interrupted branch is in `branch-partial.json`.
    status: &'static str,
    /// path of the varied parameter. With its unit, it is the name of the first column of branch.csv.
    varied: &'a str,
    /// SI unit of the parameter, empty for a plain number
    unit: &'static str,
    /// value of the parameter in the scenario, where the branch starts
    #[serde(rename = "scenario_value")]
    present: Real,
    /// start of the range of the parameter
    from: Real,
    /// end of the range of the parameter
    to: Real,
    /// local error per time step relative to the natural scales
    tolerance: Real,
    /// accuracy of special points relative to the range
    accuracy: Real,
    /// index of the start in `points`, from 0
    start: usize,
    points: Vec<PointReport>,
    #[serde(rename = "special_points")]
    marks: Vec<MarkReport>,
    ends: [EndReport; 2],
    /// names of all files that were written together
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<String>,
    /// SHA-256 of branch.csv
    #[serde(skip_serializing_if = "Option::is_none")]
    table_sha256: Option<String>,
}

#[derive(Debug, Serialize, JsonSchema)]
struct PointReport {
    /// value of the parameter at an orbit. Orbits are listed in their order along the branch.
    value: Real,
    /// number of the smooth piece of the branch. A new piece begins where an event of the period appears or vanishes.
    piece: usize,
    /// step length: displacement along x of the body named in `figures` in one period. Empty or null if no body is free
    /// along x.
    step_m: Option<Real>,
    /// uncertainty of the step length: a first-order estimate, doubled
    step_error_m: Option<Real>,
    /// mean velocity: step length divided by period
    speed_m_s: Option<Real>,
    /// period of the orbit: common period of all waveforms
    period_s: Real,
    /// whether the orbit is stable: no Floquet multiplier has |λ| > 1. In branch.csv 1 or 0.
    stable: bool,
    /// Floquet multipliers as real and imaginary part, the largest modulus first. A complex pair has one entry, with
    /// positive imaginary part.
    multipliers: Vec<[Real; 2]>,
    /// number of unknowns of the Poincaré map
    unknowns: usize,
}

#[derive(Debug, Serialize, JsonSchema)]
struct MarkReport {
    /// kind of the special point: `fold` (the branch turns back), `period doubling` (λ = -1), `Neimark-Sacker` (complex
    /// pair with |λ| = 1), `branching` (another branch crosses), `break` (multipliers jump) or `event` (an event of the
    /// period appears or vanishes)
    kind: &'static str,
    /// value of the parameter at the special point
    value: Real,
    /// uncertainty of the parameter value at the special point: half of the bracket in which it lies
    half_width: Real,
    /// step length at the special point. null if no body is free along x.
    step_m: Option<Real>,
    /// whether the orbits are stable below and above the parameter value of the special point. At a fold: before and
    /// after it along the branch.
    stable: [bool; 2],
    /// period of the neutral oscillation at a `Neimark-Sacker` point, in drive periods. Absent at other points.
    #[serde(skip_serializing_if = "Option::is_none")]
    oscillation_periods: Option<Real>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    changes: Vec<ChangeReport>,
    /// sentence about the special point
    #[serde(rename = "text")]
    words: String,
}

#[derive(Debug, Serialize, JsonSchema)]
struct ChangeReport {
    /// name of the contact or block whose event appears or vanishes
    source: String,
    /// kind of the event that appears or vanishes
    event: String,
    /// number of such events in a period at parameter values below the special point
    below: usize,
    /// number of such events in a period at parameter values above the special point
    above: usize,
}

#[derive(Debug, Serialize, JsonSchema)]
struct EndReport {
    /// value of the parameter at an end of the branch: at the first and at the last orbit
    value: Real,
    /// reason for an end of the branch: `range` (end of the range), `shakedown` (beyond, a contact never slips grossly,
    /// and orbits form a family), `slides away` (the load equals the friction limit; any velocity is possible),
    /// `rounded` (friction acts on displacements below the rounding error), `lost` (no orbit found beyond), `refused`
    /// (the scenario is invalid beyond), `points` (largest number of points reached) or `interrupted`
    kind: &'static str,
    /// sentence about an end of the branch
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
    /// Returns the name of the end reason in output files.
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

    /// Returns a sentence that describes the end reason.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Range => "the end of the range".to_owned(),
            Self::Shakedown(contacts) => format!(
                "no gross slip in {} beyond this value: the periodic orbits are a family (shakedown), and the branch ends",
                contacts.join(", ")
            ),
            Self::SlidesAway(body) => format!(
                "the load on {body} equals the friction limit: the speed is arbitrary, and beyond this value the body slides away"
            ),
            Self::Rounded(lengths) => format!(
                "the displacement per period is {lengths:.1e} gross slip displacements: double precision does not resolve the contacts"
            ),
            Self::Lost(why) => format!("no orbit was found beyond this value: {why}"),
            Self::Refused(why) => {
                format!("the scenario is invalid beyond: {}", why.lines().next().unwrap_or_default())
            }
            Self::Points => "the maximum number of points was reached; --points increases it".to_owned(),
            Self::Interrupted => "interrupted".to_owned(),
        }
    }
}

/// Returns the table of the orbits along the branch as CSV. Numbers have enough digits to restore all bits. Unknown
/// values are empty.
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

/// Returns all numbers in one line of JSON.
#[must_use]
pub fn json(of: &Continuation, branch: &Branch, accuracy: [f64; 2]) -> String {
    // Numbers and strings only: serialisation cannot fail.
    serde_json::to_string(&report(of, branch, accuracy)).unwrap_or_default()
}

/// Writes the table, `branch.json` and plots into a folder, and deletes plots named in `stale` that are not written again. Returns the
/// names of the written files.
///
/// An interrupted branch is written to `branch-partial.csv` and `branch-partial.json`; the next complete branch deletes these partial
/// files. `accuracy` contains the tolerance of the runs and the accuracy of special points.
///
/// # Errors
/// Returns an error of the operating system. Existing files remain unchanged, unless the error occurs while new files are renamed to their
/// final names.
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

/// Returns the definitions of all keys of `branch.json` and of all columns of `branch.csv`.
pub(crate) fn definitions() -> Vec<Definition> {
    let columns = stickslip_quantity::report::<PointReport>(NAMES[0][0]);
    let columns = columns.into_iter().filter(|one| !["value", "multipliers"].contains(&one.name.as_ref()));
    columns
        .chain(columns::BRANCH.definitions())
        .chain(stickslip_quantity::report::<Report<'_>>(BRANCH))
        .collect()
}
