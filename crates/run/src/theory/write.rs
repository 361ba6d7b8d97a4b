//! Output files of the solution of a contact.

use super::state::contact_word;
use super::{Sheet as Constants, Walk};
use crate::folder::Folder;
use crate::insides::state_name;
use crate::seal::Seal;
use crate::sheet::Sheet;
use schemars::JsonSchema;
use serde::Serialize;
use std::io;
use stickslip_quantity::{Columns, Real, columns};

/// Name of the file with all numbers. This file is written last and contains the row counts and SHA-256 of the tables.
pub const CONTACT: &str = "contact.json";
/// Columns of the tables. The documentation name `contact: history.csv` stands for the file `history.csv`.
pub const TABLES: [Columns; 6] = [
    columns::CONTACT_HISTORY,
    columns::CONTACT_FIELDS,
    columns::CONTACT_LINE,
    columns::CONTACT_FRICTION,
    columns::CONTACT_NORMAL,
    columns::CONTACT_UNIVERSAL,
];
/// Number of columns of `line.csv`.
pub(crate) const LINE_WIDTH: usize = columns::CONTACT_LINE.names.len();

/// Returns the file names of the tables.
pub fn table_files() -> [&'static str; 6] {
    TABLES.map(|table| table.file.trim_start_matches("contact: "))
}

/// Plots, files to be deleted and notes that are written together with the tables.
#[derive(Debug, Default)]
pub struct Beside<'a> {
    /// Names and contents of plots.
    pub pictures: &'a [(String, Vec<u8>)],
    /// Names of files of an earlier call that are deleted.
    pub stale: Vec<String>,
    /// Notes for `contact.json`.
    pub notes: Vec<String>,
}

/// Function that fills a table.
type Fill<'a> = &'a dyn Fn(&mut Sheet);

/// All numbers in `contact.json`. Empty parts are absent.
#[derive(Serialize, JsonSchema)]
pub(super) struct Report<'a> {
    #[serde(flatten)]
    constants: &'a Constants,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    corners: Vec<CornerReport>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    tables: Vec<TableReport>,
    /// names of the files in the same folder
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<String>,
    /// missing results with the reason
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<String>,
}

#[derive(Serialize, JsonSchema)]
struct CornerReport {
    /// d, indentation at a corner of the history. The first entry is the start.
    #[serde(rename = "indentation_m")]
    d: Real,
    /// u, tangential displacement at the corner of the history
    #[serde(rename = "displacement_m")]
    u: Real,
    /// F_N, normal force at the corner of the history
    #[serde(rename = "normal_force_N")]
    normal_force: Real,
    /// F_x, tangential force at the corner of the history
    #[serde(rename = "tangential_force_N")]
    force: Real,
    /// a, contact radius at the corner of the history
    #[serde(rename = "contact_radius_m")]
    a: Real,
    /// c, stick radius at the corner of the history: springs within it do not slip
    #[serde(rename = "stick_radius_m")]
    c: Real,
    /// state of the contact at the corner of the history: `open`, `stick`, `partial` or `slip`
    state: &'static str,
    /// elastic energy of the tangential deformation at the corner of the history
    #[serde(rename = "tangential_energy_J")]
    elastic: Real,
    /// friction work from the start of the history to the corner (4.40)
    #[serde(rename = "friction_work_J")]
    friction: Real,
}

#[derive(Serialize, JsonSchema)]
struct TableReport {
    /// name of a table in the same folder
    name: &'static str,
    /// number of rows of the table, without the header
    rows: u64,
    /// SHA-256 of the table
    sha256: String,
}

/// Returns all numbers in one line of JSON. The curves are included only if there is no load history.
pub fn json(constants: &Constants, walk: Option<&Walk>) -> String {
    let (constants, corners) = match walk {
        Some(walk) => (&constants.without_curves(), corners(walk)),
        None => (constants, Vec::new()),
    };
    // Serialisation of numbers and strings cannot fail.
    let report = Report { constants, corners, tables: Vec::new(), files: Vec::new(), notes: Vec::new() };
    serde_json::to_string(&report).unwrap_or_default()
}

fn corners(walk: &Walk) -> Vec<CornerReport> {
    walk.moments.iter().map(|moment| CornerReport::of(&moment.stop)).collect()
}

/// Writes the tables, the plots and `contact.json` into a folder. Deletes files of an earlier call that are not written again. Returns the
/// names of the written files.
///
/// # Errors
/// Error of the operating system. Existing files remain unchanged, unless the error occurs while the new files are renamed.
pub fn write(
    mut folder: Folder,
    constants: &Constants,
    walk: &Walk,
    beside: Beside<'_>,
) -> io::Result<Vec<String>> {
    let fills: [Fill<'_>; 6] = [
        &|sheet| history(sheet, walk),
        &|sheet| fields(sheet, walk),
        &|sheet| line(sheet, constants, walk),
        &|sheet| friction(sheet, walk),
        &|sheet| normal(sheet, constants),
        &|sheet| universal(sheet, constants),
    ];
    let mut reports = Vec::new();
    for ((table, name), fill) in TABLES.iter().zip(table_files()).zip(fills) {
        let mut sheet = Sheet::new(folder.draft(name)?, table.names.iter().copied());
        fill(&mut sheet);
        let written = sheet.finish()?;
        if let Some(failure) = written.failure {
            return Err(failure);
        }
        let Seal { rows, sha256 } = written.seal;
        // Empty tables, such as the fields of a list of springs, are not written.
        if rows > 0 {
            folder.stage(name, written.file)?;
            reports.push(TableReport { name, rows, sha256 });
        }
    }
    beside.pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes))?;
    let mut files = folder.names();
    files.push(CONTACT.to_owned());
    folder.forget(table_files().into_iter().map(str::to_owned).chain(beside.stale).collect());
    let constants = &constants.without_curves();
    let report = Report {
        constants,
        corners: corners(walk),
        tables: reports,
        files: files.clone(),
        notes: beside.notes,
    };
    let mut json = serde_json::to_vec_pretty(&report).map_err(io::Error::other)?;
    json.push(b'\n');
    folder.write(CONTACT, &json)?;
    folder.publish()?;
    Ok(files)
}

fn whole(sheet: &mut Sheet, number: usize) {
    sheet.word(&number.to_string());
}

fn numbers<const N: usize>(sheet: &mut Sheet, values: [f64; N]) {
    values.into_iter().for_each(|value| sheet.number(value));
}

fn history(sheet: &mut Sheet, walk: &Walk) {
    for stop in &walk.stops {
        whole(sheet, stop.corner);
        let apex = stop.apex;
        numbers(sheet, [stop.share, apex.d, apex.u, stop.normal_force, stop.force, stop.a, stop.c]);
        sheet.word(contact_word(stop.state));
        numbers(sheet, [stop.elastic, stop.friction]);
        sheet.end_line();
    }
}

fn fields(sheet: &mut Sheet, walk: &Walk) {
    for moment in &walk.moments {
        for field in &moment.fields {
            whole(sheet, moment.stop.corner);
            numbers(sheet, [field.r, field.pressure, field.shear, field.displacement]);
            numbers(sheet, [field.slip, field.deflection]);
            sheet.word(state_name(field.state));
            sheet.end_line();
        }
    }
}

fn line(sheet: &mut Sheet, constants: &Constants, walk: &Walk) {
    let moduli = [&constants.constants.normal_modulus, &constants.constants.tangential_modulus];
    for moment in &walk.moments {
        for spring in &moment.springs {
            whole(sheet, moment.stop.corner);
            let forces = [spring.normal_force, spring.tangential_force];
            let spring_length = spring.spring.length;
            numbers(sheet, [spring.spring.x, spring_length, spring.spring.height]);
            numbers(sheet, moduli.map(|modulus| modulus.0 * spring_length));
            numbers(sheet, [forces[0], forces[1], spring.limit].map(|force| force / spring_length));
            numbers(sheet, [forces[0], forces[1], spring.spring.stretch]);
            sheet.word(state_name(spring.spring.state));
            sheet.end_line();
        }
    }
}

fn friction(sheet: &mut Sheet, walk: &Walk) {
    let Some(course) = &walk.friction else { return };
    for step in &course.steps {
        for ((r, work), way) in course.radii.iter().zip(&step.work).zip(&step.way) {
            whole(sheet, step.corner);
            numbers(sheet, [step.share, *r, *work, *way]);
            sheet.end_line();
        }
    }
}

fn normal(sheet: &mut Sheet, constants: &Constants) {
    for row in &constants.normal {
        numbers(sheet, [row.d.0, row.a.0, row.normal_force.0, row.normal_stiffness.0, row.gross_slip.0]);
        sheet.end_line();
    }
}

fn universal(sheet: &mut Sheet, constants: &Constants) {
    for row in &constants.universal {
        let loading = &row.loading;
        numbers(sheet, [row.stick_share.0, row.displacement_share.0, row.force_share.0, loading.c.0]);
        numbers(sheet, [loading.u.0, loading.tangential_force.0, loading.by_integral.0]);
        sheet.number(loading.friction_work.0);
        sheet.end_line();
    }
}

impl CornerReport {
    fn of(stop: &super::Stop) -> Self {
        Self {
            d: Real(stop.apex.d),
            u: Real(stop.apex.u),
            normal_force: Real(stop.normal_force),
            force: Real(stop.force),
            a: Real(stop.a),
            c: Real(stop.c),
            state: contact_word(stop.state),
            elastic: Real(stop.elastic),
            friction: Real(stop.friction),
        }
    }
}
