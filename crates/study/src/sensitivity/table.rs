//! Output of derivatives: `sensitivity.csv` and `sensitivity.json`.

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

/// File names of table and report for complete and for interrupted analyses. The files of an interrupted analysis do not replace those of a
/// complete one.
const NAMES: Names = [["sensitivity.csv", SENSITIVITY], ["sensitivity-partial.csv", PARTIAL_SENSITIVITY]];

/// Returns the names of all files of a sensitivity analysis except plots.
pub fn all_files() -> impl Iterator<Item = String> {
    NAMES.into_iter().flatten().map(str::to_owned)
}

/// Content of `sensitivity.json`. It is written last.
#[derive(Debug, Serialize, JsonSchema)]
struct Report<'a> {
    /// name of the scenario
    scenario: &'a str,
    /// SHA-256 of the complete scenario, with all defaults and --set values
    scenario_sha256: &'a str,
    /// name and version of the program
    program: &'a str,
    /// end of the computation: `done` or `interrupted`. Interrupted results are in `sensitivity-partial.json`.
    status: &'static str,
    /// local error per time step of the runs, relative to the natural scales
    tolerance: Real,
    /// number of runs, without that of the unchanged scenario
    runs: usize,
    figures: Vec<FigureReport<'a>>,
    /// names of all files that were written together
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<String>,
    /// SHA-256 of sensitivity.csv
    #[serde(skip_serializing_if = "Option::is_none")]
    table_sha256: Option<String>,
}

#[derive(Debug, Serialize, JsonSchema)]
struct FigureReport<'a> {
    /// name of the result: a number of summary.json, a channel at the end of the run, or a result of the periodic orbit
    name: &'a str,
    /// SI unit of the result, empty for a plain number
    unit: &'a str,
    /// value of the result in the unchanged scenario, computed with the tolerance of the derivatives
    value: Real,
    /// numerical noise of the result: standard deviation of its irregular differences between neighbouring runs. null
    /// if it could not be measured.
    noise: Option<Real>,
    derivatives: Vec<Row<'a>>,
}

/// Derivative, or the reason why there is none.
#[derive(Debug, Serialize, JsonSchema)]
pub(super) struct Row<'a> {
    /// path of the parameter with respect to which the derivative is taken
    quantity: &'a str,
    /// SI unit of the parameter, empty for a plain number
    quantity_unit: &'a str,
    /// value of the parameter in the scenario
    quantity_value: Real,
    /// side of the parameter value on which a one-sided derivative holds: `below` or `above`. Empty or absent if it
    /// holds on both sides.
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<&'static str>,
    /// derivative of the result with respect to the parameter
    derivative: Option<Real>,
    /// uncertainty of the derivative: remaining curvature plus measured noise
    derivative_error: Option<Real>,
    /// unit of derivative and derivative_error
    unit: String,
    /// elasticity: relative change of the result divided by the relative change of the parameter (% per %). Empty or
    /// null if the result is 0.
    elasticity: Option<Real>,
    /// uncertainty of the elasticity
    elasticity_error: Option<Real>,
    /// largest change of the parameter in the runs that were used, in its unit
    #[serde(skip_serializing_if = "Option::is_none")]
    reach: Option<Real>,
    /// difference between both sides: `kink` (the slopes differ), `jump` (the result jumps), `events` (an event appears
    /// or vanishes) or `one_sided` (the other side is invalid, stops or has no such result)
    #[serde(skip_serializing_if = "Option::is_none")]
    split: Option<&'static str>,
    /// reason why the derivative does not exist or differs between both sides
    #[serde(skip_serializing_if = "Option::is_none")]
    note: Option<String>,
}

impl Sensitivity {
    /// Returns the unit of the derivative of a result with respect to a parameter, both given by index.
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

    /// Returns the rows of a result, the largest elasticity first.
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

/// Returns the derivatives of each result as CSV, the largest elasticity first. Numbers have enough digits to restore
/// all bits. Unknown values are empty.
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

/// Returns a text as a CSV cell, quoted if necessary.
fn quoted(text: &str) -> String {
    let is_plain = !text.contains(['"', ',', '\n', '\r']);
    if is_plain { text.to_owned() } else { format!("\"{}\"", text.replace('"', "\"\"")) }
}

/// Returns all numbers in one line of JSON.
#[must_use]
pub fn json(asked: &Sensitivity, taken: &Taken) -> String {
    // Numbers and strings only: serialisation cannot fail.
    serde_json::to_string(&report(asked, taken)).unwrap_or_default()
}

/// Writes the table, `sensitivity.json` and plots into a folder, and deletes plots named in `stale` that are not written again. Returns the
/// names of the written files.
///
/// Interrupted results are written to `sensitivity-partial.csv` and `sensitivity-partial.json`; the next complete results delete these
/// partial files.
///
/// # Errors
/// Returns an error of the operating system. Existing files remain unchanged, unless the error occurs while new files are renamed to their
/// final names.
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

/// Returns the definitions of all keys of `sensitivity.json` and of all columns of `sensitivity.csv`.
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
