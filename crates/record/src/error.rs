//! What is wrong with a table of an instrument.

use crate::recipe::Role;
use std::io;
use thiserror::Error;

/// Why a table is not read.
#[derive(Debug, Error)]
pub enum RecordError {
    /// A spreadsheet that cannot be read.
    #[error("{file}: no spreadsheet that can be read: {why}")]
    Sheet {
        /// The file.
        file: String,
        /// Why not.
        why: String,
    },
    /// The file.
    #[error("{file}: cannot be read: {source}")]
    File {
        /// Its name.
        file: String,
        /// Why.
        source: io::Error,
    },
    /// The recipe.
    #[error("{file}: not a recipe: {why}")]
    Recipe {
        /// Its name.
        file: String,
        /// Why.
        why: String,
    },
    /// Nothing that looks like rows of numbers.
    #[error(
        "{file}: no rows of numbers were found{why}\n   help: a recipe says how the file is to be read: `stickslip import FILE --out RECIPE.json`"
    )]
    NoRows {
        /// Its name.
        file: String,
        /// What is there instead.
        why: String,
    },
    /// A column that is not there.
    #[error("{file}: there is no column {wanted} for the {}\n   help: its columns are {known}", .role.word())]
    NoColumn {
        /// The file.
        file: String,
        /// What it was to be.
        role: Role,
        /// Its name or number.
        wanted: String,
        /// All columns.
        known: String,
    },
    /// No column that would do.
    #[error("{file}: no column is a {} by its name or unit\n   help: name it with --{0}, by name or number and with a unit, such as --{0} \"3:{1}\"; the columns are {known}", .role.word(), .role.si())]
    Unknown {
        /// The file.
        file: String,
        /// What is missing.
        role: Role,
        /// All columns.
        known: String,
    },
    /// A unit that is none, or of something else.
    #[error("{file}: \"{unit}\" is no unit of a {}\n   help: units here: {known}", .role.word())]
    Unit {
        /// The file.
        file: String,
        /// What the column is.
        role: Role,
        /// The unit.
        unit: String,
        /// Units that would do.
        known: String,
    },
    /// One column for two things.
    #[error("{file}: column {column} stands for the {} and for the {}", .roles[0].word(), .roles[1].word())]
    Twice {
        /// The file.
        file: String,
        /// Its number.
        column: usize,
        /// What it was to be.
        roles: [Role; 2],
    },
    /// A column without numbers.
    #[error("{file}: column {column} has no number in any row: the {} cannot be read", .role.word())]
    NoNumbers {
        /// The file.
        file: String,
        /// Its number.
        column: usize,
        /// What it was to be.
        role: Role,
    },
}
