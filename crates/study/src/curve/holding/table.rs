//! What is told of holding forces: a table, and all of it in JSON.

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
    /// what is varied, at this point
    value: Real,
    /// what `--set` takes to make a scenario of this point
    set: Vec<String>,
    warnings: &'a [Warning],
    along_x: WayReport,
    against_x: WayReport,
}

/// What is told of loads one way.
#[derive(Debug, Serialize, JsonSchema)]
struct WayReport {
    /// of `holding-force`: the largest load on the figures' body, along +x or along -x, that the drive holds at rest
    #[serde(rename = "force_N")]
    force: Option<Real>,
    /// how far that may be off: half of the bracket in which it lies, and how far a balance is known
    #[serde(rename = "half_width_N")]
    half_width: Option<Real>,
    /// what gives way beyond: a body that slides away, comes loose or, free to pitch, slides or tips over
    #[serde(skip_serializing_if = "Option::is_none")]
    gives_way: Option<String>,
    /// equilibria that were looked for
    #[serde(skip_serializing_if = "Option::is_none")]
    runs: Option<u32>,
    /// why there is no such force: the drive does not even hold what acts without the load, or something else than friction
    /// holds any
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

/// As CSV: what is varied, and for loads along x and against it what is held, by how much that may be off, what gives way beyond, and
/// what is wrong with it. Numbers have as many digits as it takes to read the same bits back.
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

/// A text as a cell.
fn quoted(text: &str) -> String {
    format!("\"{}\"", one_line(text).replace('"', "\"\""))
}

/// All numbers on one line of JSON.
#[must_use]
pub fn json(holding: &Holding, points: &[Point]) -> String {
    // Numbers and strings only: there is nothing that JSON could refuse.
    serde_json::to_string(&report(holding, points)).unwrap_or_default()
}

/// Writes the table, `curve.json` and pictures into a folder, as [`crate::curve::write`] does. Returns the names.
///
/// # Errors
/// What the system says; nothing that was there is gone then, unless it says so while names are given.
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

/// What every key of `curve.json` is.
pub(crate) fn definitions() -> Vec<Definition> {
    stickslip_quantity::report::<Report<'_, PointReport<'_>>>(CURVE)
}
