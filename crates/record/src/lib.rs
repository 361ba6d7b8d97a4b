//! Tables of instruments: logs of rigs, scopes and tribometers, lines of profilometers.
//!
//! In reading order: [`Recipe`] (how a file is to be read; what it does not say is guessed), `cell` (numbers, clock times, missing values),
//! `unit` (units in heads), `layout` (delimiter, decimal sign, head lines, first row, from the beginning of a file), `roles` (which
//! column is the time, the displacement, the force), [`Record`] (the columns, in SI, with all that was passed over).

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
