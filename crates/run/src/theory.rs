//! Solution of a single contact of a scenario without a run, by section 4.4 of the *Handbook of Contact Mechanics*.
//!
//! In reading order: [`Subject`] (the contact); [`Sheet`] (its constants and curves) with [`Loading`] (one first loading); [`History`] (a
//! load history) and [`Walk`] (its forces, fields, springs and friction work); [`write()`] (the output files).
//!
//! All values follow from the exact curve of the slip memory, even if the scenario selects a row of springs.

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

/// Default extent of fields, springs and profiles, relative to the largest contact radius.
pub const BEYOND: f64 = 1.5;

/// Returns the definitions of all keys of `contact.json` and of all columns of the accompanying tables.
#[must_use]
pub fn definitions() -> Vec<stickslip_quantity::Definition> {
    let tables = TABLES.iter().flat_map(stickslip_quantity::Columns::definitions);
    stickslip_quantity::report::<write::Report<'_>>(CONTACT).into_iter().chain(tables).collect()
}
