//! Errors of a map.

use crate::sweep::StudyError;
use std::path::PathBuf;
use stickslip_run::Refusal;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Reason why there is no map.
#[derive(Debug, Error)]
pub enum MapError {
    /// The scenario is invalid or does not have a parameter.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The scenario is rejected.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A range is invalid.
    #[error("{option}  {message}")]
    Range {
        /// Command-line option.
        option: &'static str,
        /// Error message.
        message: String,
    },
    /// Both axes have the same parameter.
    #[error("--y  expected another parameter than {0}, which is on the x axis")]
    SamePath(String),
    /// The result cannot be mapped.
    #[error("--of {of}  {message}{help}")]
    Of {
        /// Name of the result.
        of: String,
        /// Error message.
        message: String,
        /// Suggestion as a separate line.
        help: String,
    },
    /// Measured points cannot be read.
    #[error("{}: {message}", .path.display())]
    Overlay {
        /// File of the table.
        path: PathBuf,
        /// Error message.
        message: String,
    },
    /// The study with the grid of runs failed.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// No point has a result.
    #[error("no point of the map has the result {of}{}", if .why.is_empty() { String::new() } else { format!(": {}", .why) })]
    Nothing {
        /// Name of the result.
        of: String,
        /// Most frequent reason.
        why: String,
    },
    /// The caller interrupted the map.
    #[error("interrupted: finished runs of the grid are kept, and the same command resumes")]
    Interrupted,
}
