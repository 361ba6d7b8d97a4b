//! The files of a map: a table of the grid, and all of it in JSON.

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

/// Names of the table and of what is told of all: nothing is written of a map that was interrupted.
const NAMES: Names = [["map.csv", MAP]; 2];

/// Names of all files that a map is written to, its pictures apart.
pub fn all_files() -> impl Iterator<Item = String> {
    NAMES[0].into_iter().map(str::to_owned)
}

/// All of a map; written last.
#[derive(Debug, Serialize, JsonSchema)]
pub struct FieldReport<'a> {
    /// name of the scenario
    scenario: &'a str,
    /// SHA-256 of the resolved scenario, as it is without what the map varies
    scenario_sha256: &'a str,
    /// name and version of the program
    program: &'a str,
    /// horizontal axis
    x: AxisReport<'a>,
    /// vertical axis
    y: AxisReport<'a>,
    /// name of the result
    of: &'a str,
    /// its SI unit; empty of a word or a plain number
    unit: &'a str,
    /// number of runs; 0 where waveforms prescribe the motion of the contact and its regime needs none
    runs: usize,
    /// number of points of the grid without a result
    failed: usize,
    /// borders between the regimes of a contact
    borders: Vec<BorderReport<'a>>,
    /// names of all files that were written together
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<String>,
    /// SHA-256 of `map.csv`
    #[serde(skip_serializing_if = "Option::is_none")]
    table_sha256: Option<String>,
}

/// An axis of a map.
#[derive(Debug, Serialize, JsonSchema)]
struct AxisReport<'a> {
    /// key path of the number along the axis
    path: &'a str,
    /// its SI unit; empty of a plain number
    unit: &'a str,
    /// ends of the axis, SI
    range: [Real; 2],
    /// number of points of the grid along it
    points: usize,
    /// whether equal distances along it are equal ratios
    logarithmic: bool,
}

/// A border between regimes.
#[derive(Debug, Serialize, JsonSchema)]
struct BorderReport<'a> {
    /// regimes on its two sides: `open`, `stick`, `partial` or `gross`, the lesser slip first
    between: [&'a str; 2],
    /// points (x, y) along it, SI; a closed border ends where it begins
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

/// The table of the grid: a row for each point, the second number changing fastest.
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

/// A map in one line of JSON.
#[must_use]
pub fn json(map: &Map, field: &Field) -> String {
    // Numbers and texts: there is nothing that JSON could refuse.
    serde_json::to_string(&report(map, field)).unwrap_or_default()
}

/// Writes table, pictures and, last, the JSON; pictures of the names `stale` that are not among them go. Returns the names of all files.
///
/// # Errors
/// What the system says.
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

/// What the columns and keys are.
pub(crate) fn definitions() -> Vec<Definition> {
    columns::MAP.definitions().chain(stickslip_quantity::report::<FieldReport<'_>>(MAP)).collect()
}
