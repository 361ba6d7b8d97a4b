//! Reads tables of instruments: rigs, oscilloscopes, tribometers and profilometers.
//!
//! In reading order:
//!
//! * [`Recipe`] – how to read a file; missing settings are detected from the file;
//! * `cell` – numbers, clock times and missing values; `unit` – units in headings;
//! * `layout` – delimiter, decimal sign, heading lines and first row;
//! * `roles` – which column is the time, the displacement or the force;
//! * [`Record`] – the columns in SI units and the number of skipped lines.

mod cell;
mod error;
mod layout;
mod noise;
mod recipe;
mod record;
mod roles;
mod sheet;
mod unit;

pub use error::RecordError;
pub use layout::{Column, Layout};
pub use noise::{noise, smoothed};
pub use recipe::{ColumnRecipe, Encoding, Named, Place, Recipe, Role, recipe_schema};
pub use record::{Passed, Record};
pub use unit::Kind;
