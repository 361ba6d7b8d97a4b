//! Errors of reading a table of an instrument.

use crate::recipe::Role;
use std::io;
use thiserror::Error;

/// Error of reading a table.
#[derive(Debug, Error)]
pub enum RecordError {
    /// The spreadsheet cannot be read.
    #[error("{file}: not a readable spreadsheet: {why}")]
    Sheet {
        /// Name of the file.
        file: String,
        /// Cause.
        why: String,
    },
    /// The file cannot be read.
    #[error("{file}: cannot be read: {source}")]
    File {
        /// Name of the file.
        file: String,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file is not a valid recipe.
    #[error("{file}: not a recipe: {why}")]
    Recipe {
        /// Name of the file.
        file: String,
        /// Cause.
        why: String,
    },
    /// The file contains no rows of numbers.
    #[error(
        "{file}: no rows of numbers were found{why}\n   help: describe the file with a recipe: `stickslip import FILE --out RECIPE.json`"
    )]
    NoRows {
        /// Name of the file.
        file: String,
        /// Description of the content of the file.
        why: String,
    },
    /// A requested column does not exist.
    #[error("{file}: there is no column {wanted} for the {}\n   help: its columns are {known}", .role.word())]
    NoColumn {
        /// Name of the file.
        file: String,
        /// Role of the column.
        role: Role,
        /// Name or number of the column.
        wanted: String,
        /// All columns of the file.
        known: String,
    },
    /// No column has this role by its name or unit.
    #[error("{file}: no column is the {} by its name or unit\n   help: select it with --{0}, by name or number and with a unit, such as --{0} \"3:{1}\"; the columns are {known}", .role.word(), .role.si())]
    Unknown {
        /// Name of the file.
        file: String,
        /// The missing role.
        role: Role,
        /// All columns of the file.
        known: String,
    },
    /// The unit is unknown or does not fit the role.
    #[error("{file}: \"{unit}\" is not a unit of a {}\n   help: possible units: {known}", .role.word())]
    Unit {
        /// Name of the file.
        file: String,
        /// Role of the column.
        role: Role,
        /// The invalid unit.
        unit: String,
        /// Possible units.
        known: String,
    },
    /// One column is selected for two roles.
    #[error("{file}: column {column} is selected for the {} and for the {}", .roles[0].word(), .roles[1].word())]
    Twice {
        /// Name of the file.
        file: String,
        /// Number of the column, from 1.
        column: usize,
        /// The two roles.
        roles: [Role; 2],
    },
    /// A column contains no numbers.
    #[error("{file}: column {column}, the {}, has no number in any row", .role.word())]
    NoNumbers {
        /// Name of the file.
        file: String,
        /// Number of the column, from 1.
        column: usize,
        /// Role of the column.
        role: Role,
    },
}
