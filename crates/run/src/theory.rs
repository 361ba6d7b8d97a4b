//! What the theory says of one contact of a scenario, without a run: section 4.4 of the handbook, answered.
//!
//! In reading order: [`Subject`] (which contact); [`Sheet`] (its constants and curves) with [`Loading`] (one first loading:
//! nine ways to ask for it); [`History`] (where it is to go) and [`Walk`] (what happens on the way: forces, fields, springs,
//! friction); [`write()`] (all that as files).
//!
//! It is the profile's law on the exact curve, whatever engine the scenario names: a row of springs differs from it by the size
//! of its cells.

mod history;
mod loading;
mod route;
mod sheet;
mod state;
mod subject;
mod walk;
mod write;

pub use history::{Corner, History, Normal, Tangential, asked};
pub use loading::Loading;
pub use sheet::{Constants, NormalRow, Pressed, Sheet, UniversalRow};
pub use state::{LoadedSpring, contact_word};
pub use subject::{Subject, TheoryError};
pub use walk::{Frame, FrictionCourse, FrictionStep, Moment, Stop, Walk};
pub(crate) use write::LINE_WIDTH;
pub use write::{Beside, CONTACT, TABLES, json, table_files, write};

/// How far fields, springs and profiles are shown where nothing else is asked for, of the largest contact radius: the surface is
/// displaced beyond the contact, too.
pub const BEYOND: f64 = 1.5;

/// What every key of `contact.json` and every column of the tables beside it is.
#[must_use]
pub fn definitions() -> Vec<stickslip_quantity::Definition> {
    let tables = TABLES.iter().flat_map(stickslip_quantity::Columns::definitions);
    stickslip_quantity::report::<write::Report<'_>>(CONTACT).into_iter().chain(tables).collect()
}
