//! Output of a curve: `curve.csv` and `curve.json`.

use super::{Beyond, Curve, Landmark, Motion, Sense, Traced, Variation};
use crate::published::{self, Names};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;
use std::io;
use stickslip_quantity::{Definition, columns};
use stickslip_run::files::{CURVE, PARTIAL_CURVE};
use stickslip_run::folder::Folder;
use stickslip_run::{Job, Real, Warning};

/// File names of table and report for complete and for interrupted curves. The files of an interrupted curve do not replace those of a
/// complete curve.
const NAMES: Names = [["curve.csv", CURVE], ["curve-partial.csv", PARTIAL_CURVE]];

/// Returns the names of all files of a curve except plots.
pub fn all_files() -> impl Iterator<Item = String> {
    NAMES.into_iter().flatten().map(str::to_owned)
}

/// Content of `curve.json`. It is written last.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Report<'a, P> {
    /// name of the scenario
    scenario: &'a str,
    /// SHA-256 of the complete scenario, before the parameter is varied
    scenario_sha256: &'a str,
    /// name and version of the program
    program: &'a str,
    /// end of the computation: `done` or `interrupted`. An interrupted curve is in `curve-partial.json`.
    status: &'static str,
    /// name of the curve, such as `step-amplitude`; `vary` for a parameter given by its path
    curve: &'static str,
    /// name of the varied parameter. With its unit, it is the name of the first column of curve.csv.
    varied: &'a str,
    /// SI unit of the parameter, empty for a plain number
    unit: &'static str,
    /// value of the parameter in the scenario. null if the scenario has none.
    #[serde(rename = "scenario_value")]
    present: Option<Real>,
    /// direction of the steps without load, `+x` or `-x`. Loads act against it. Absent unless the curve is
    /// `force-speed` or `step-load`.
    #[serde(skip_serializing_if = "Option::is_none")]
    against: Option<&'static str>,
    /// direction of the steps without load with reversed waveforms, `+x` or `-x`. Absent without `--both`.
    #[serde(skip_serializing_if = "Option::is_none")]
    against_backward: Option<&'static str>,
    /// name of the body on which the load acts. Absent unless the curve is `holding-force`.
    #[serde(rename = "body", skip_serializing_if = "Option::is_none")]
    pub(super) on: Option<&'a str>,
    points: Vec<P>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    landmarks: Vec<LandmarkReport>,
    /// names of all files that were written together
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<String>,
    /// SHA-256 of curve.csv
    #[serde(skip_serializing_if = "Option::is_none")]
    table_sha256: Option<String>,
}

impl<'a, P: Serialize> Report<'a, P> {
    /// Creates the report of a curve by its name.
    pub(super) fn of(
        job: &'a Job,
        variation: &'a Variation,
        (curve, is_cut): (&'static str, bool),
        points: Vec<P>,
    ) -> Self {
        Self {
            scenario: &job.name,
            scenario_sha256: &job.hash,
            program: &job.program,
            status: published::status(is_cut),
            curve,
            varied: &variation.name,
            unit: variation.unit,
            present: variation.present.map(Real),
            against: None,
            against_backward: None,
            on: None,
            points,
            landmarks: Vec::new(),
            files: Vec::new(),
            table_sha256: None,
        }
    }
}

#[derive(Debug, Serialize, JsonSchema)]
struct PointReport<'a> {
    /// value of the parameter at a point of the curve
    value: Real,
    /// direction of the waveforms with `--both`: `forward` (as in the scenario) or `backward` (reversed in time)
    #[serde(rename = "direction", skip_serializing_if = "Option::is_none")]
    sense: Option<&'static str>,
    /// arguments of `--set` that change the scenario to the point of the curve
    set: Vec<String>,
    warnings: &'a [Warning],
    #[serde(flatten)]
    figures: Option<Figures>,
    /// reason why a point of the curve has no result
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<String>,
}

/// Special point of a curve.
#[derive(Debug, Serialize, JsonSchema)]
struct LandmarkReport {
    /// special point: `zero_step` (S₀, largest amplitude without a step; with `beyond_by`, largest amplitude with a
    /// step), `stall` (smallest load that stops the steps), `best_speed`, `best_power` or `best_step` (maxima)
    name: &'static str,
    /// direction of the waveforms with `--both`: `forward` (as in the scenario) or `backward` (reversed in time)
    #[serde(rename = "direction", skip_serializing_if = "Option::is_none")]
    sense: Option<&'static str>,
    /// value of the parameter at the special point. null if not found.
    at: Option<Real>,
    /// uncertainty of the parameter value at the special point: half of the bracket in which it lies, plus the effect
    /// of the step length errors
    half_width: Option<Real>,
    /// upper bound of S₀ if all points of the curve have steps: their smallest amplitude. Absent otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    below: Option<Real>,
    /// cause of the missing steps above the largest amplitude with a step: `window` (the driver's voltage window cuts
    /// the command), `current` (a driver has a current limit) or `other`. Absent at other special points.
    #[serde(skip_serializing_if = "Option::is_none")]
    beyond_by: Option<&'static str>,
    /// maximum at the special point: velocity in m/s, power in W or step length in m. Absent unless the point is a
    /// maximum.
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<Real>,
    /// number of points computed for the special point, in addition to those of the curve
    runs: u32,
    /// true if the drive steps backwards below S₀, so that the step length changes its sign there. Absent otherwise.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    turns: bool,
    /// reason why the special point was not found. Absent if it was.
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<String>,
}

impl LandmarkReport {
    fn of(landmark: &Landmark, sense: Option<Sense>) -> Self {
        let at = landmark.at.as_ref().ok().copied();
        Self {
            name: landmark.name,
            sense: sense.map(Sense::name),
            at: at.map(Real),
            half_width: at.map(|_| Real(landmark.half_width)),
            below: landmark.below.map(Real),
            beyond_by: landmark.beyond.map(Beyond::name),
            value: landmark.value.map(Real),
            runs: landmark.runs,
            turns: landmark.turns,
            fault: landmark.at.as_ref().err().map(ToString::to_string),
        }
    }
}

/// Result at a point.
#[derive(Debug, Serialize, JsonSchema)]
struct Figures {
    /// step length along x of the body named in `figures`, per period of its waveform, in steady motion. If steps
    /// oscillate, their mean.
    #[serde(rename = "step_m")]
    step: Real,
    /// uncertainty of the step length: remaining change plus integration error. If steps oscillate: 95 % confidence
    /// half-width of their long-term mean.
    #[serde(rename = "step_error_m")]
    error: Real,
    /// amplitude of the oscillation of the steps from period to period. 0 for a steady drive.
    #[serde(rename = "step_spread_m")]
    spread: Real,
    /// mean velocity along x: step length divided by period
    #[serde(rename = "speed_m_s")]
    speed: Real,
    /// mean power: load times mean velocity. Positive if the drive moves against the load, 0 without steps. Only in
    /// curves over a load.
    #[serde(rename = "power_W", skip_serializing_if = "Option::is_none")]
    power: Option<Real>,
    /// period of the waveform named in `figures`
    #[serde(rename = "period_s")]
    period: Real,
    /// type of motion: `steady`, `no step` (steady, with a step length below its error or below 1e-5 u_c), `oscillates`
    /// (steps oscillate about a mean) or `irregular`
    motion: &'static str,
    /// |λ|, modulus of the largest Floquet multiplier: factor by which a disturbance changes per period. Empty or null
    /// if the motion was found by simulation instead of shooting.
    #[serde(rename = "largest_multiplier")]
    multiplier: Option<Real>,
    /// period of the oscillation of the disturbance with the largest multiplier, in drive periods. Empty or null if it
    /// does not oscillate.
    oscillation_periods: Option<Real>,
    /// number of simulated periods
    work_periods: u32,
}

impl Figures {
    fn of(motion: &Motion, load: Option<f64>) -> Self {
        Self {
            step: Real(motion.step),
            error: Real(motion.error),
            spread: Real(motion.spread),
            speed: Real(motion.speed()),
            power: load.map(|load| Real(motion.power(load))),
            period: Real(motion.period),
            motion: motion.word(),
            multiplier: motion.multiplier.map(|multiplier| Real(multiplier.modulus())),
            oscillation_periods: motion.multiplier.and_then(|multiplier| multiplier.beat()).map(Real),
            work_periods: motion.work,
        }
    }
}

/// A curve with its points, in one direction of the waveforms.
pub type Way<'a> = (&'a Curve, &'a Traced);

/// Returns the table of a curve, or of both directions, as CSV. Numbers have enough digits to restore all bits. Unknown
/// values are empty.
#[must_use]
pub fn csv(ways: &[Way<'_>]) -> String {
    let Some((curve, _)) = ways.first() else { return String::new() };
    let mut table = curve.variation.head();
    table.push_str(if curve.sense.is_some() { ",direction" } else { "" });
    table.push_str(",step_m,step_error_m,step_spread_m,speed_m_s");
    table.push_str(if curve.kind.is_of_load() { ",power_W" } else { "" });
    table.push_str(",period_s,motion,largest_multiplier,oscillation_periods,work_periods,fault\n");
    for (curve, traced) in ways {
        (0..traced.points.len()).for_each(|place| row(&mut table, (curve, traced), place));
    }
    table
}

fn row(table: &mut String, (curve, traced): Way<'_>, place: usize) {
    let point = &traced.points[place];
    let _ = write!(table, "{:e}", point.value);
    let _ = curve.sense.map_or(Ok(()), |sense| write!(table, ",{}", sense.name()));
    match &point.motion {
        Ok(motion) => {
            let power = traced.power(curve, place);
            let multiplier = motion.multiplier.map(|multiplier| multiplier.modulus());
            let beat = motion.multiplier.and_then(|multiplier| multiplier.beat());
            let cells = [motion.step, motion.error, motion.spread, motion.speed()].map(Some);
            let power = curve.kind.is_of_load().then_some(power);
            cells.into_iter().chain(power).chain([Some(motion.period)]).for_each(|n| number(table, n));
            let _ = write!(table, ",{}", motion.word());
            [multiplier, beat].into_iter().for_each(|n| number(table, n));
            let _ = write!(table, ",{},", motion.work);
        }
        Err(fault) => {
            let empty = if curve.kind.is_of_load() { 10 } else { 9 };
            (0..empty).for_each(|_| table.push(','));
            let _ = write!(table, ",\"{}\"", one_line(&fault.to_string()).replace('"', "\"\""));
        }
    }
    table.push('\n');
}

fn number(table: &mut String, number: Option<f64>) {
    let _ = match number {
        Some(number) => write!(table, ",{number:e}"),
        None => write!(table, ","),
    };
}

/// Returns the first line of an error message, without excerpt and help.
pub(super) fn one_line(fault: &str) -> &str {
    fault.lines().next().unwrap_or_default()
}

/// Returns all numbers in one line of JSON.
#[must_use]
pub fn json(ways: &[Way<'_>]) -> String {
    // Numbers and strings only: serialisation cannot fail.
    report(ways).and_then(|report| serde_json::to_string(&report).ok()).unwrap_or_default()
}

/// Writes the table, `curve.json` and plots into a folder, and deletes plots named in `stale` that are not written again. Returns the names
/// of the written files, or no names without a curve.
///
/// An interrupted curve is written to `curve-partial.csv` and `curve-partial.json`; the next complete curve deletes these partial files.
///
/// # Errors
/// Returns an error of the operating system. Existing files remain unchanged, unless the error occurs while new files are renamed to their
/// final names.
pub fn write(
    folder: Folder,
    ways: &[Way<'_>],
    pictures: &[(String, Vec<u8>)],
    stale: Vec<String>,
) -> io::Result<Vec<String>> {
    match report(ways) {
        Some(report) => publish(folder, (&csv(ways), report), pictures, stale),
        None => Ok(Vec::new()),
    }
}

/// Writes a table, its report and plots.
pub(super) fn publish<P: Serialize>(
    folder: Folder,
    (table, report): (&str, Report<'_, P>),
    pictures: &[(String, Vec<u8>)],
    stale: Vec<String>,
) -> io::Result<Vec<String>> {
    let is_cut = report.status == published::status(true);
    let all = |files, table_sha256| Report { files, table_sha256: Some(table_sha256), ..report };
    published::publish(folder, (&NAMES, is_cut), (table, all), (pictures, stale))
}

fn report<'a>(ways: &[Way<'a>]) -> Option<Report<'a, PointReport<'a>>> {
    let (first, _) = ways.first()?;
    let points = ways.iter().flat_map(|(curve, traced)| {
        traced.points.iter().map(|point| {
            let load = curve.kind.is_of_load().then_some(traced.direction * point.value);
            PointReport {
                value: Real(point.value),
                sense: curve.sense.map(Sense::name),
                set: point.set.iter().map(|(path, value)| format!("{path}={value}")).collect(),
                warnings: &point.warnings,
                figures: point.motion.as_ref().ok().map(|motion| Figures::of(motion, load)),
                fault: point.motion.as_ref().err().map(ToString::to_string),
            }
        })
    });
    let landmarks = ways.iter().flat_map(|(curve, traced)| {
        traced.landmarks.iter().map(|landmark| LandmarkReport::of(landmark, curve.sense))
    });
    let against = |way: usize| {
        let (curve, traced) = ways.get(way)?;
        let sense = if traced.direction < 0.0 { "-x" } else { "+x" };
        curve.kind.is_of_load().then_some(sense)
    };
    let is_cut = ways.iter().any(|(_, traced)| traced.is_cut());
    Some(Report {
        against: against(0),
        against_backward: against(1),
        landmarks: landmarks.collect(),
        ..Report::of(&first.job, &first.variation, (first.kind.name(), is_cut), points.collect())
    })
}

/// Returns the definitions of all keys of `curve.json` and of all columns of `curve.csv`.
pub(crate) fn definitions() -> Vec<Definition> {
    let [points, figures] = [
        stickslip_quantity::report::<PointReport<'_>>(NAMES[0][0]),
        stickslip_quantity::report::<Figures>(NAMES[0][0]),
    ];
    let columns =
        points.into_iter().filter(|one| ["direction", "fault"].contains(&one.name.as_ref())).chain(figures);
    let holding = super::holding::definitions();
    columns::CURVE
        .definitions()
        .chain(columns)
        .chain(stickslip_quantity::report::<Report<'_, PointReport<'_>>>(CURVE))
        .chain(holding)
        .collect()
}
