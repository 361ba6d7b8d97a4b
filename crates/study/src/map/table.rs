//! Output of a map: `map.csv` and `map.json`.

use super::{Border, Field, Map};
use crate::published::{self, Names};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;
use std::io;
use stickslip_quantity::{Definition, columns};
use stickslip_run::Real;
use stickslip_run::files::MAP;
use stickslip_run::folder::Folder;

/// Names of table and report. An interrupted map writes no files.
const NAMES: Names = [["map.csv", MAP]; 2];

/// Returns the names of all files of a map except plots.
pub fn all_files() -> impl Iterator<Item = String> {
    NAMES[0].into_iter().map(str::to_owned)
}

/// Content of `map.json`. It is written last.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FieldReport<'a> {
    /// name of the scenario
    scenario: &'a str,
    /// SHA-256 of the complete scenario, before the parameters are varied
    scenario_sha256: &'a str,
    /// name and version of the program
    program: &'a str,
    /// Horizontal axis.
    x: AxisReport<'a>,
    /// Vertical axis.
    y: AxisReport<'a>,
    /// name of the result
    of: &'a str,
    /// SI unit of the result, empty for a word or a plain number
    unit: &'a str,
    /// number of runs. 0 if waveforms prescribe the motion of the contact, because its slip regime then needs no run.
    runs: usize,
    /// number of grid points without a result
    failed: usize,
    /// Borders between slip regimes.
    borders: Vec<BorderReport<'a>>,
    /// names of all files that were written together
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<String>,
    /// SHA-256 of map.csv
    #[serde(skip_serializing_if = "Option::is_none")]
    table_sha256: Option<String>,
}

/// Axis of a map.
#[derive(Debug, Serialize, JsonSchema)]
struct AxisReport<'a> {
    /// path of the parameter along the axis
    path: &'a str,
    /// SI unit of the parameter, empty for a plain number
    unit: &'a str,
    /// smallest and largest value of the axis, SI
    range: [Real; 2],
    /// number of grid points along the axis
    points: usize,
    /// whether the axis is logarithmic
    logarithmic: bool,
}

/// Border between two slip regimes.
#[derive(Debug, Serialize, JsonSchema)]
struct BorderReport<'a> {
    /// slip regimes on both sides of the border: `open`, `stick`, `partial` or `gross`, the one with less slip first
    between: [&'a str; 2],
    /// points (x, y) along the border, SI. The first and last point of a closed border are equal.
    points: Vec<[Real; 2]>,
}

fn report<'a>(map: &'a Map, field: &'a Field) -> FieldReport<'a> {
    let axis = |place: usize| {
        let axis = &map.axes[place];
        let (range, points) = (axis.range.map(Real), map.points[place]);
        AxisReport { path: &axis.path, unit: axis.unit, range, points, logarithmic: axis.is_logarithmic }
    };
    let border = |border: &Border| BorderReport {
        between: border.between.map(super::Regime::word),
        points: border.points.iter().map(|point| point.map(Real)).collect(),
    };
    FieldReport {
        scenario: &map.job.name,
        scenario_sha256: &map.job.hash,
        program: &map.job.program,
        x: axis(0),
        y: axis(1),
        of: &map.of,
        unit: map.unit,
        runs: field.runs,
        failed: field.values.iter().filter(|value| value.is_nan()).count(),
        borders: field.borders.iter().map(border).collect(),
        files: Vec::new(),
        table_sha256: None,
    }
}

/// Returns the table of the grid as CSV, one row per point. The second parameter changes fastest.
fn csv(field: &Field) -> String {
    let mut table = columns::MAP.names.join(",");
    table.push('\n');
    for (k, value) in field.values.iter().enumerate() {
        let [x, y] = [field.xs[k / field.ys.len()], field.ys[k % field.ys.len()]];
        let word = field.words.as_ref().and_then(|words| words.get(*value as usize));
        let cell = match word {
            _ if value.is_nan() => String::new(),
            Some(word) => word.clone(),
            None => format!("{value:?}"),
        };
        let _ = writeln!(table, "{x:?},{y:?},{cell}");
    }
    table
}

/// Returns a map in one line of JSON.
#[must_use]
pub fn json(map: &Map, field: &Field) -> String {
    // Numbers and strings only: serialisation cannot fail.
    serde_json::to_string(&report(map, field)).unwrap_or_default()
}

/// Writes the table, the plots and, last, `map.json` into a folder, and deletes plots named in `stale` that are not written again. Returns
/// the names of all files.
///
/// # Errors
/// Error of the operating system.
pub fn write(
    folder: Folder,
    (map, field): (&Map, &Field),
    pictures: &[(String, Vec<u8>)],
    stale: Vec<String>,
) -> io::Result<Vec<String>> {
    let table = csv(field);
    let told = |files, hash| FieldReport { files, table_sha256: Some(hash), ..report(map, field) };
    published::publish(folder, (&NAMES, false), (&table, told), (pictures, stale))
}

/// Returns the definitions of all columns and keys.
pub(crate) fn definitions() -> Vec<Definition> {
    columns::MAP.definitions().chain(stickslip_quantity::report::<FieldReport<'_>>(MAP)).collect()
}
