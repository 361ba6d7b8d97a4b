//! Why two folders cannot be compared.

use super::results::ResultsError;
use std::path::PathBuf;
use thiserror::Error;

/// Something in the input of a comparison.
#[derive(Debug, Error)]
pub enum CompareError {
    /// A folder.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// An excerpt in the place of the run that is judged.
    #[error("{}: is an excerpt of a run: it can be compared with as A, and not be judged as B", .0.display())]
    JudgedExcerpt(PathBuf),
    /// Nothing was written at the same time.
    #[error(
        "A and B have no row at a common time\n   help: run one of them again with the other's output.every"
    )]
    NoCommonRow,
    /// A name that neither run has.
    #[error("{term} {name}  there is no {what} \"{}\"{}", .name.escape_debug(), advice(.help.as_deref()))]
    UnknownName {
        /// The field of [`Terms`](super::Terms) that has it.
        term: &'static str,
        /// What it should name.
        what: &'static str,
        /// What stands there.
        name: String,
        /// Nearest name, or all of them.
        help: Option<String>,
    },
    /// A tolerance that is none.
    #[error("absolute {name}={text}  {message}")]
    Absolute {
        /// Channel or figure.
        name: String,
        /// What stands there.
        text: String,
        /// What is wrong with it.
        message: String,
    },
}

fn advice(help: Option<&str>) -> String {
    help.map(|help| format!("\n   help: {help}")).unwrap_or_default()
}
