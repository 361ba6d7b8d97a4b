//! What is told of a curve: a table, and all of it in JSON.

use super::{Beyond, Curve, Landmark, Motion, Sense, Traced, Variation};
use crate::published::{self, Names};
use serde::Serialize;
use std::fmt::Write;
use std::io;
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
#[derive(Debug, Serialize)]
pub(super) struct Report<'a, P> {
    scenario: &'a str,
    scenario_sha256: &'a str,
    program: &'a str,
    status: &'static str,
    curve: &'static str,
    varied: &'a str,
    unit: &'static str,
    present: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    against: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    against_backward: Option<&'static str>,
    /// Name of the body that is loaded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) on: Option<&'a str>,
    points: Vec<P>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    landmarks: Vec<LandmarkReport>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<String>,
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

#[derive(Debug, Serialize)]
struct PointReport<'a> {
    value: Real,
    #[serde(skip_serializing_if = "Option::is_none")]
    sense: Option<&'static str>,
    set: Vec<String>,
    warnings: &'a [Warning],
    #[serde(flatten)]
    figures: Option<Figures>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<String>,
}

/// What is told of a place with a name.
#[derive(Debug, Serialize)]
struct LandmarkReport {
    name: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    sense: Option<&'static str>,
    at: Option<Real>,
    half_width: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    below: Option<Real>,
    #[serde(skip_serializing_if = "Option::is_none")]
    beyond_by: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<Real>,
    runs: u32,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    turns: bool,
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
#[derive(Debug, Serialize)]
struct Figures {
    #[serde(rename = "step_m")]
    step: Real,
    #[serde(rename = "step_error_m")]
    error: Real,
    #[serde(rename = "step_spread_m")]
    spread: Real,
    #[serde(rename = "speed_m_s")]
    speed: Real,
    #[serde(rename = "power_W", skip_serializing_if = "Option::is_none")]
    power: Option<Real>,
    #[serde(rename = "period_s")]
    period: Real,
    motion: &'static str,
    multiplier: Option<Real>,
    beat_periods: Option<Real>,
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
            beat_periods: motion.multiplier.and_then(|multiplier| multiplier.beat()).map(Real),
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
    table.push_str(if curve.sense.is_some() { ",sense" } else { "" });
    table.push_str(",step_m,step_error_m,step_spread_m,speed_m_s");
    table.push_str(if curve.kind.is_of_load() { ",power_W" } else { "" });
    table.push_str(",period_s,motion,multiplier,beat_periods,work_periods,fault\n");
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
