//! What is told of derivatives: a table, and all of it in JSON.

use super::{Derivative, Missing, Sensitivity, Slope, Split, Taken};
use crate::published::{self, Names};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write;
use std::io;
use stickslip_quantity::{Definition, columns};
use stickslip_run::Real;
use stickslip_run::files::{PARTIAL_SENSITIVITY, SENSITIVITY};
use stickslip_run::folder::Folder;

/// Names of the table and of what is told of all: of derivatives, and of those that were interrupted, beside which finished ones stay.
const NAMES: Names = [["sensitivity.csv", SENSITIVITY], ["sensitivity-partial.csv", PARTIAL_SENSITIVITY]];

/// Names of all files that derivatives are written to, pictures apart.
pub fn all_files() -> impl Iterator<Item = String> {
    NAMES.into_iter().flatten().map(str::to_owned)
}

/// All numbers; written last.
#[derive(Debug, Serialize, JsonSchema)]
struct Report<'a> {
    /// name of the scenario
    scenario: &'a str,
    /// SHA-256 of the resolved scenario
    scenario_sha256: &'a str,
    /// name and version of the program
    program: &'a str,
    /// `done`, or `interrupted`: then the file is `sensitivity-partial.json`
    status: &'static str,
    /// local error per step of the runs, in natural scales
    tolerance: Real,
    /// runs that were done beside that of the scenario as it stands
    runs: usize,
    figures: Vec<FigureReport<'a>>,
    /// names of all files that were written together
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<String>,
    /// SHA-256 of `sensitivity.csv`
    #[serde(skip_serializing_if = "Option::is_none")]
    table_sha256: Option<String>,
}

#[derive(Debug, Serialize, JsonSchema)]
struct FigureReport<'a> {
    /// name of the figure: a number of summary.json, a channel at the end of the run, or one of steady motion
    name: &'a str,
    /// its SI unit; empty of a plain number
    unit: &'a str,
    /// what it is in the scenario as it stands, by the tolerance of the derivatives
    value: Real,
    /// standard deviation of what is no smooth change in it between neighbouring runs; none where it could not be measured
    noise: Option<Real>,
    derivatives: Vec<Row<'a>>,
}

/// A slope, or why there is none.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Row<'a> {
    /// key path of the number that the derivative is with respect to
    quantity: &'a str,
    /// its SI unit; empty of a plain number
    quantity_unit: &'a str,
    /// what it is in the scenario
    quantity_value: Real,
    /// `below` or `above` of slopes that hold on one side of the quantity's value; none of those that hold on both
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<&'static str>,
    /// change of the figure per change of the quantity
    derivative: Option<Real>,
    /// how far that may be off: by bends that the extrapolation misses and by measured noise
    derivative_error: Option<Real>,
    /// unit of both
    unit: String,
    /// by how many per cent the figure changes with one per cent of the quantity; none of figures that are 0
    elasticity: Option<Real>,
    /// how far that may be off
    elasticity_error: Option<Real>,
    /// how far from its value the quantity was in the farthest run that counts, in its unit
    #[serde(skip_serializing_if = "Option::is_none")]
    reach: Option<Real>,
    /// what differs between the sides: `kink` (the slopes), `jump` (the figure itself), `events` (one appears or vanishes),
    /// `one_sided` (the other is refused, stops or has no such figure)
    #[serde(skip_serializing_if = "Option::is_none")]
    split: Option<&'static str>,
    /// why there is none, or why both sides have their own
    #[serde(skip_serializing_if = "Option::is_none")]
    note: Option<String>,
}

impl Sensitivity {
    /// Unit of the derivative of a figure with respect to a quantity, by their places.
    #[must_use]
    pub fn unit(&self, (f, q): (usize, usize)) -> String {
        let (of, to) = (self.figures[f].unit, self.quantities[q].unit);
        match (of, to) {
            (of, "") => of.to_owned(),
            ("", to) => format!("1/{}", bracketed(to)),
            (of, to) => format!("{}/{}", bracketed(of), bracketed(to)),
        }
    }

    fn row(
        &self,
        place: (usize, usize),
        derivative: &Derivative,
        side: (Option<&'static str>, Result<Slope, Missing>),
    ) -> Row<'_> {
        let quantity = &self.quantities[place.1];
        let (side, slope) = side;
        let slope = slope.ok();
        let elasticity = |value: f64| Taken::elasticity(self, place, value).map(Real);
        let reach = slope.map(|slope| Real(slope.reach));
        let split = match derivative {
            Derivative::Split { why, .. } => Some(Split::name(why)),
            Derivative::Known(_) | Derivative::Unknown(_) => None,
        };
        Row {
            quantity: &quantity.path,
            quantity_unit: quantity.unit,
            quantity_value: Real(quantity.value),
            side,
            derivative: slope.map(|slope| Real(slope.value)),
            derivative_error: slope.map(|slope| Real(slope.error)),
            unit: self.unit(place),
            elasticity: slope.and_then(|slope| elasticity(slope.value)),
            elasticity_error: slope
                .and_then(|slope| elasticity(slope.error))
                .map(|error| Real(error.0.abs())),
            reach,
            split,
            note: derivative.words(),
        }
    }

    /// The rows of a figure, the largest elasticity first.
    fn rows(&self, taken: &Taken, f: usize) -> Vec<Row<'_>> {
        let of = |q: usize| {
            let derivative = &taken.derivatives[f][q];
            derivative
                .sides()
                .into_iter()
                .map(move |side| self.row((f, q), derivative, side))
                .collect::<Vec<_>>()
        };
        taken.order(self, f).into_iter().flat_map(of).collect()
    }
}

fn bracketed(unit: &str) -> String {
    if unit.contains(['/', ' ']) { format!("({unit})") } else { unit.to_owned() }
}

/// As CSV: each figure's derivatives, the largest elasticity first. Numbers have as many digits as it takes to read the same bits
/// back; a cell is empty where there is no such number.
#[must_use]
pub fn csv(asked: &Sensitivity, taken: &Taken) -> String {
    let mut table = "figure,figure_unit,figure_value,quantity,quantity_unit,quantity_value,side,derivative,derivative_error,unit,\
                     elasticity,elasticity_error,note\n"
        .to_owned();
    for (f, figure) in asked.figures.iter().enumerate() {
        for row in asked.rows(taken, f) {
            // Writing to a string cannot fail.
            let _ = write!(table, "{},{},{:e}", quoted(&figure.name), figure.unit, figure.value);
            let _ =
                write!(table, ",{},{},{:e}", quoted(row.quantity), row.quantity_unit, row.quantity_value.0);
            let _ = write!(table, ",{}", row.side.unwrap_or_default());
            [row.derivative, row.derivative_error].into_iter().for_each(|n| number(&mut table, n));
            let _ = write!(table, ",{}", row.unit);
            [row.elasticity, row.elasticity_error].into_iter().for_each(|n| number(&mut table, n));
            let note = row.note.map(|note| quoted(&note)).unwrap_or_default();
            let _ = writeln!(table, ",{note}");
        }
    }
    table
}

fn number(table: &mut String, number: Option<Real>) {
    let _ = match number {
        Some(Real(number)) => write!(table, ",{number:e}"),
        None => write!(table, ","),
    };
}

/// A cell: names may have whatever a scenario gives them.
fn quoted(text: &str) -> String {
    let is_plain = !text.contains(['"', ',', '\n', '\r']);
    if is_plain { text.to_owned() } else { format!("\"{}\"", text.replace('"', "\"\"")) }
}

/// All numbers on one line of JSON.
#[must_use]
pub fn json(asked: &Sensitivity, taken: &Taken) -> String {
    // Numbers and strings only: there is nothing that JSON could refuse.
    serde_json::to_string(&report(asked, taken)).unwrap_or_default()
}

/// Writes the table, `sensitivity.json` and pictures into a folder; pictures of the names `stale` that are not among them go. What was
/// interrupted is written to `sensitivity-partial.csv` and `sensitivity-partial.json`, and goes with the next whole one. Returns the names.
///
/// # Errors
/// What the system says; nothing that was there is gone then, unless it says so while names are given.
pub fn write(
    folder: Folder,
    (asked, taken): (&Sensitivity, &Taken),
    pictures: &[(String, Vec<u8>)],
    stale: Vec<String>,
) -> io::Result<Vec<String>> {
    let table = csv(asked, taken);
    let report =
        |files, table_sha256| Report { files, table_sha256: Some(table_sha256), ..report(asked, taken) };
    published::publish(folder, (&NAMES, taken.is_cut()), (&table, report), (pictures, stale))
}

fn report<'a>(asked: &'a Sensitivity, taken: &Taken) -> Report<'a> {
    let figures = asked.figures.iter().enumerate().map(|(f, figure)| FigureReport {
        name: &figure.name,
        unit: figure.unit,
        value: Real(figure.value),
        noise: taken.noise[f].map(Real),
        derivatives: asked.rows(taken, f),
    });
    Report {
        scenario: &asked.job.name,
        scenario_sha256: &asked.job.hash,
        program: &asked.job.program,
        status: published::status(taken.is_cut()),
        tolerance: Real(asked.tolerance),
        runs: taken.runs,
        figures: figures.collect(),
        files: Vec::new(),
        table_sha256: None,
    }
}

/// What every key of `sensitivity.json` and every column of `sensitivity.csv` is.
pub(crate) fn definitions() -> Vec<Definition> {
    let slopes = stickslip_quantity::report::<Row<'_>>(NAMES[0][0])
        .into_iter()
        .filter(|one| !["reach", "split"].contains(&one.name.as_ref()));
    columns::SENSITIVITY
        .definitions()
        .chain(slopes)
        .chain(stickslip_quantity::report::<Report<'_>>(SENSITIVITY))
        .collect()
}
