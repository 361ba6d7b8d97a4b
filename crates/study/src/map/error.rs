//! Why there is no map.

use crate::sweep::StudyError;
use std::path::PathBuf;
use stickslip_run::Refusal;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Why there is no map.
#[derive(Debug, Error)]
pub enum MapError {
    /// The scenario, or a number that it does not have.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A file that makes no job.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A range that is none.
    #[error("{option}  {message}")]
    Range {
        /// Where it stands on the command line.
        option: &'static str,
        /// What is wrong with it.
        message: String,
    },
    /// One number on both axes.
    #[error("--y  expected another number than on the x axis, which is {0}, too")]
    SamePath(String),
    /// A result that cannot be mapped.
    #[error("--of {of}  {message}{help}")]
    Of {
        /// Its name.
        of: String,
        /// What is wrong with it.
        message: String,
        /// What could have been meant, as a line of its own.
        help: String,
    },
    /// Measured points that cannot be read.
    #[error("{}: {message}", .path.display())]
    Overlay {
        /// The table.
        path: PathBuf,
        /// What is wrong with it.
        message: String,
    },
    /// The parts of the grid.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// No point has a result.
    #[error("no point of the map has the result {of}{}", if .why.is_empty() { String::new() } else { format!(": {}", .why) })]
    Nothing {
        /// The result.
        of: String,
        /// The most frequent reason.
        why: String,
    },
    /// Somebody interrupted it.
    #[error("interrupted: finished runs of a grid stay, and the same command continues")]
    Interrupted,
}
