//! What is told of a curve: a table, and all of it in JSON.

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

/// Names of the table and of what is told of all: of a curve, and of one that was interrupted, beside which a finished one stays.
const NAMES: Names = [["curve.csv", CURVE], ["curve-partial.csv", PARTIAL_CURVE]];

/// Names of all files that any curve is written to, its pictures apart.
pub fn all_files() -> impl Iterator<Item = String> {
    NAMES.into_iter().flatten().map(str::to_owned)
}

/// All numbers of a curve; written last.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Report<'a, P> {
    /// name of the scenario
    scenario: &'a str,
    /// SHA-256 of the resolved scenario, as it is without what the curve varies
    scenario_sha256: &'a str,
    /// name and version of the program
    program: &'a str,
    /// `done`, or `interrupted`: then the file is `curve-partial.json`
    status: &'static str,
    /// name of the curve; `vary` of a number by its path
    curve: &'static str,
    /// what is varied; it heads the first column of `curve.csv`, with its unit
    varied: &'a str,
    /// its SI unit; empty of a plain number
    unit: &'static str,
    /// what it is in the scenario
    #[serde(rename = "scenario_value")]
    present: Option<Real>,
    /// in which direction of x the drive steps without load, against which loads act
    #[serde(skip_serializing_if = "Option::is_none")]
    against: Option<&'static str>,
    /// the same of the backward direction
    #[serde(skip_serializing_if = "Option::is_none")]
    against_backward: Option<&'static str>,
    /// body that is loaded; of `holding-force`
    #[serde(rename = "body", skip_serializing_if = "Option::is_none")]
    pub(super) on: Option<&'a str>,
    points: Vec<P>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    landmarks: Vec<LandmarkReport>,
    /// names of all files that were written together
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<String>,
    /// SHA-256 of the table
    #[serde(skip_serializing_if = "Option::is_none")]
    table_sha256: Option<String>,
}

impl<'a, P: Serialize> Report<'a, P> {
    /// Of a curve by its name, whole or cut.
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
    /// what is varied, at this point
    value: Real,
    /// with `--both`: `forward`, as the scenario is, or `backward`, its waveforms reversed in time
    #[serde(rename = "direction", skip_serializing_if = "Option::is_none")]
    sense: Option<&'static str>,
    /// what `--set` takes to make a scenario of this point
    set: Vec<String>,
    warnings: &'a [Warning],
    #[serde(flatten)]
    figures: Option<Figures>,
    /// why there is no motion at this value
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<String>,
}

/// What is told of a place with a name.
#[derive(Debug, Serialize, JsonSchema)]
struct LandmarkReport {
    /// `zero_step` (S₀, largest amplitude without a step; with `beyond_by` largest amplitude with one), `stall` (least load
    /// against which there is none), `best_speed`, `best_power` or `best_step`
    name: &'static str,
    /// with `--both`: `forward`, as the scenario is, or `backward`, its waveforms reversed in time
    #[serde(rename = "direction", skip_serializing_if = "Option::is_none")]
    sense: Option<&'static str>,
    /// what is varied, there
    at: Option<Real>,
    /// how far that may be off: half of the bracket in which it lies, and what the errors of the steps there add
    half_width: Option<Real>,
    /// of S₀ where all points of the curve step: the smallest amplitude of them
    #[serde(skip_serializing_if = "Option::is_none")]
    below: Option<Real>,
    /// of the largest amplitude with a step: `window` where the driver's window cuts the command beyond it, `current` where a
    /// driver has a largest current, `other`
    #[serde(skip_serializing_if = "Option::is_none")]
    beyond_by: Option<&'static str>,
    /// speed in m/s, power in W or step in m there; of best points only
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<Real>,
    /// points that were computed for it, beside those of the curve
    runs: u32,
    /// true of S₀ where the drive steps back at smaller amplitudes, so that its step changes its sign there
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    turns: bool,
    /// why it is not known
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

/// What is told of a motion.
#[derive(Debug, Serialize, JsonSchema)]
struct Figures {
    /// step along x of the figures' body in a period of the figures' waveform, in steady motion; the mean of steps that swing
    #[serde(rename = "step_m")]
    step: Real,
    /// how far the step may be off, an estimate: of what was left of the way to it, and of the run's tolerance; of steps that
    /// swing how far the mean of endlessly many may lie from it, by 95 %
    #[serde(rename = "step_error_m")]
    error: Real,
    /// by how much steps swing about their mean from period to period; 0 of steady ones
    #[serde(rename = "step_spread_m")]
    spread: Real,
    /// mean speed along x: step over period
    #[serde(rename = "speed_m_s")]
    speed: Real,
    /// load times mean speed, above 0 where the drive moves against the load, 0 where there is no step; of loads only
    #[serde(rename = "power_W", skip_serializing_if = "Option::is_none")]
    power: Option<Real>,
    /// period of the figures' waveform
    #[serde(rename = "period_s")]
    period: Real,
    /// `steady`, `no step` (steady, and the step is no longer than it may be off, or than a hundred-thousandth of u_c), `oscillates`
    /// (steps swing about a mean) or `irregular`
    motion: &'static str,
    /// |λ|, modulus of the largest Floquet multiplier: by how much a disturbance is smaller after a period; none of motions
    /// that were waited for
    #[serde(rename = "largest_multiplier")]
    multiplier: Option<Real>,
    /// drive periods in which that disturbance oscillates once; none where it does not
    oscillation_periods: Option<Real>,
    /// periods that were computed
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

/// A curve with its points, in one sense.
pub type Way<'a> = (&'a Curve, &'a Traced);

/// As CSV: what is varied, of a curve in both senses in which, the figures of the motion there, and what is wrong with it. Numbers have
/// as many digits as it takes to read the same bits back; a cell is empty where there is no such number.
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

/// What is wrong without the excerpt of the file and the help, which stand below it.
pub(super) fn one_line(fault: &str) -> &str {
    fault.lines().next().unwrap_or_default()
}

/// All numbers on one line of JSON.
#[must_use]
pub fn json(ways: &[Way<'_>]) -> String {
    // Numbers and strings only: there is nothing that JSON could refuse.
    report(ways).and_then(|report| serde_json::to_string(&report).ok()).unwrap_or_default()
}

/// Writes the table, `curve.json` and pictures into a folder; pictures of the names `stale` that are not among them go. What was
/// interrupted is written to `curve-partial.csv` and `curve-partial.json`, and goes with the next whole curve. Returns the names; none
/// of no curve.
///
/// # Errors
/// What the system says; nothing that was there is gone then, unless it says so while names are given.
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

/// Writes a table with what is told of all, and pictures.
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

/// What every key of `curve.json` and every column of `curve.csv` is.
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
