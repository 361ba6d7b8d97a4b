//! Errors of a comparison.

use super::results::ResultsError;
use std::path::PathBuf;
use thiserror::Error;

/// Invalid input of a comparison.
#[derive(Debug, Error)]
pub enum CompareError {
    /// A folder of results cannot be read.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// Run B is an excerpt, but only the reference A may be an excerpt.
    #[error("{}: is an excerpt of a run; give it as the reference A, not as B", .0.display())]
    JudgedExcerpt(PathBuf),
    /// The runs have no row at a common time.
    #[error("A and B have no row at a common time\n   help: run both scenarios with the same output.every")]
    NoCommonRow,
    /// Neither run has a channel, summary value or part of this name.
    #[error("{term} {name}  there is no {what} \"{}\"{}", .name.escape_debug(), advice(.help.as_deref()))]
    UnknownName {
        /// Field of [`Terms`](super::Terms) that contains the name.
        term: &'static str,
        /// Kind of object that the name should refer to.
        what: &'static str,
        /// The unknown name.
        name: String,
        /// Nearest known name, or all known names.
        help: Option<String>,
    },
    /// An absolute tolerance is invalid.
    #[error("absolute {name}={text}  {message}")]
    Absolute {
        /// Name of the channel or summary value.
        name: String,
        /// The invalid text.
        text: String,
        /// Description of the error.
        message: String,
    },
}

fn advice(help: Option<&str>) -> String {
    help.map(|help| format!("\n   help: {help}")).unwrap_or_default()
}
