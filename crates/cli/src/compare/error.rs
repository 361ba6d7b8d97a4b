//! Why two folders cannot be compared.

use super::results::ResultsError;
use crate::complaint::words;
use std::io;
use std::path::PathBuf;
use stickslip_plot::PlotError;
use thiserror::Error;

/// Something in the input of a comparison.
#[derive(Debug, Error)]
pub(crate) enum CompareError {
    /// A folder.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// Nothing was written at the same time.
    #[error(
        "A and B have no row at a common time\n   help: run one of them again with the other's output.every"
    )]
    NoCommonRow,
    /// A name that neither run has.
    #[error("{option} {name}  there is no {what} \"{}\"{}", .name.escape_debug(), advice(.help.as_deref()))]
    UnknownName {
        /// The option that has it.
        option: &'static str,
        /// What it should name.
        what: &'static str,
        /// What stands there.
        name: String,
        /// Nearest name, or all of them.
        help: Option<String>,
    },
    /// A tolerance that is none.
    #[error("--absolute {name}={text}  {message}")]
    Absolute {
        /// Channel or figure.
        name: String,
        /// What stands there.
        text: String,
        /// What is wrong with it.
        message: String,
    },
    /// A picture of a form that is not drawn.
    #[error("--plot {}  expected a file name that ends in .png or .svg", .0.display())]
    NoPicture(PathBuf),
    /// The picture cannot be drawn.
    #[error("the picture cannot be drawn: {0}")]
    Plot(#[from] PlotError),
    /// The picture cannot be written.
    #[error("--plot {}  cannot be written: {}", .path.display(), words(.source))]
    NotWritten {
        /// Which file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

fn advice(help: Option<&str>) -> String {
    help.map(|help| format!("\n   help: {help}")).unwrap_or_default()
}
