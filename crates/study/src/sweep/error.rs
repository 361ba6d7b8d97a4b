//! Errors of a study.

use std::io;
use std::path::PathBuf;
use stickslip_run::complaint::words;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Reason why a study fails.
#[derive(Debug, Error)]
pub enum StudyError {
    /// The study file or the scenario is invalid.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The folder has parts of another study.
    #[error("{}: the folder has parts of another study: {why}\n   help: choose another folder with --out, or empty this one", .path.display())]
    Foreign {
        /// Path of the part.
        path: PathBuf,
        /// Difference between the studies.
        why: String,
    },
    /// A file or folder cannot be read or written.
    #[error("{}: {}", .path.display(), words(.source))]
    Disk {
        /// Path of the file or folder.
        path: PathBuf,
        /// Reason for the error.
        source: io::Error,
    },
    /// A part is damaged.
    #[error("{}: {why}", .path.display())]
    Damaged {
        /// Path of the part.
        path: PathBuf,
        /// Kind of damage.
        why: String,
    },
    /// Parts are missing although all parts are needed.
    #[error("{missing} of {of} parts are missing\n   help: `stickslip study run` computes them")]
    Incomplete {
        /// Number of missing parts.
        missing: u64,
        /// Number of parts of the study.
        of: u64,
    },
    /// The request does not fit the study.
    #[error("{0}")]
    Unasked(String),
    /// No case of an optimisation has the result.
    #[error("all cases failed: {0}")]
    AllFailed(String),
    /// The shard is invalid.
    #[error("{0}")]
    Shard(String),
    /// The watcher interrupted.
    #[error("interrupted: finished parts are kept, and the same command resumes")]
    Interrupted,
}

impl StudyError {
    /// Returns whether the error is due to the input, not to the file system or the runs.
    #[must_use]
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::Disk { .. } | Self::Damaged { .. } | Self::AllFailed(_) | Self::Interrupted)
    }
}
