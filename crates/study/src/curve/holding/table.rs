//! Output of holding forces: `curve.csv` and `curve.json`.

use super::{Held, Holding, NAME, Point};
use crate::curve::table::{Report, one_line, publish};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;
use std::io;
use stickslip_quantity::Definition;
use stickslip_run::files::CURVE;
use stickslip_run::folder::Folder;
use stickslip_run::{Real, Warning};

#[derive(Debug, Serialize, JsonSchema)]
struct PointReport<'a> {
    /// value of the parameter at a point of the curve
    value: Real,
    /// arguments of `--set` that change the scenario to the point of the curve
    set: Vec<String>,
    warnings: &'a [Warning],
    along_x: WayReport,
    against_x: WayReport,
}

/// Holding force in one direction.
#[derive(Debug, Serialize, JsonSchema)]
struct WayReport {
    /// holding force: the largest additional load along +x (`along_x`) or -x (`against_x`) on the body named in `figures`
    /// at which the drive stays at rest
    #[serde(rename = "force_N")]
    force: Option<Real>,
    /// uncertainty of the holding force: half of the bracket in which it lies, plus the accuracy of the equilibrium
    #[serde(rename = "half_width_N")]
    half_width: Option<Real>,
    /// what fails above the holding force: a body slides away, lifts off or, if free to pitch, slides or tips over
    #[serde(skip_serializing_if = "Option::is_none")]
    gives_way: Option<String>,
    /// number of equilibria computed for the holding force
    #[serde(skip_serializing_if = "Option::is_none")]
    runs: Option<u32>,
    /// why there is no holding force: the drive does not hold even without the additional load, or something other than
    /// friction holds any load
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<String>,
}

impl WayReport {
    fn of(way: &Result<Held, super::Holdless>) -> Self {
        let held = way.as_ref().ok();
        Self {
            force: held.map(|held| Real(held.force)),
            half_width: held.map(|held| Real(held.half_width)),
            gives_way: held.map(|held| held.lost.words()),
            runs: held.map(|held| held.runs),
            fault: way.as_ref().err().map(ToString::to_string),
        }
    }
}

/// Returns the table as CSV: parameter, then holding force, uncertainty, failure and error for both directions. Numbers
/// have enough digits to restore all bits.
#[must_use]
pub fn csv(holding: &Holding, points: &[Point]) -> String {
    let mut table = holding.variation.head();
    for way in ["along_x", "against_x"] {
        let _ = write!(table, ",{way}_N,{way}_half_width_N,{way}_gives_way,{way}_fault");
    }
    table.push('\n');
    for point in points {
        let _ = write!(table, "{:e}", point.value);
        for way in &point.ways {
            let _ = match way {
                Ok(held) => {
                    let Held { force, half_width, lost, .. } = held;
                    write!(table, ",{force:e},{half_width:e},{},", quoted(&lost.words()))
                }
                Err(fault) => write!(table, ",,,,{}", quoted(&fault.to_string())),
            };
        }
        table.push('\n');
    }
    table
}

/// Returns the first line of a text in quotes.
fn quoted(text: &str) -> String {
    format!("\"{}\"", one_line(text).replace('"', "\"\""))
}

/// Returns all numbers in one line of JSON.
#[must_use]
pub fn json(holding: &Holding, points: &[Point]) -> String {
    // Numbers and strings only: serialisation cannot fail.
    serde_json::to_string(&report(holding, points)).unwrap_or_default()
}

/// Writes the table, `curve.json` and plots into a folder, as [`crate::curve::write`] does. Returns the file names.
///
/// # Errors
/// Returns an error of the operating system. Existing files remain unchanged, unless the error occurs while new files are renamed to their
/// final names.
pub fn write(
    folder: Folder,
    (holding, points): (&Holding, &[Point]),
    pictures: &[(String, Vec<u8>)],
    stale: Vec<String>,
) -> io::Result<Vec<String>> {
    publish(folder, (&csv(holding, points), report(holding, points)), pictures, stale)
}

fn report<'a>(holding: &'a Holding, points: &'a [Point]) -> Report<'a, PointReport<'a>> {
    let told = points.iter().map(|point| PointReport {
        value: Real(point.value),
        set: point.set.iter().map(|(path, value)| format!("{path}={value}")).collect(),
        warnings: &point.warnings,
        along_x: WayReport::of(&point.ways[0]),
        against_x: WayReport::of(&point.ways[1]),
    });
    let is_cut = !points.iter().all(Point::is_done);
    let mut report = Report::of(&holding.job, &holding.variation, (NAME, is_cut), told.collect());
    report.on = Some(holding.on());
    report
}

/// Returns the definitions of all keys of `curve.json`.
pub(crate) fn definitions() -> Vec<Definition> {
    stickslip_quantity::report::<Report<'_, PointReport<'_>>>(CURVE)
}
