//! Why a study does not come to its end.

use std::io;
use std::path::PathBuf;
use stickslip_run::complaint::words;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// Why a study does not come to its end.
#[derive(Debug, Error)]
pub enum StudyError {
    /// Something in the study file or the scenario.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A folder with parts of something else.
    #[error("{}: this belongs to another study: {why}\n   help: choose another folder with --out, or remove what is in it", .path.display())]
    Foreign {
        /// The part.
        path: PathBuf,
        /// What differs.
        why: String,
    },
    /// A file or folder that cannot be read or written.
    #[error("{}: {}", .path.display(), words(.source))]
    Disk {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A part that is not a part, found where all are read.
    #[error("{}: {why}", .path.display())]
    Damaged {
        /// The part.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// Parts that are missing where all are needed.
    #[error("{missing} of {of} parts are missing\n   help: `stickslip study run` computes them")]
    Incomplete {
        /// How many.
        missing: u64,
        /// Of how many.
        of: u64,
    },
    /// What the study does not have.
    #[error("{0}")]
    Unasked(String),
    /// No case of a search has the result.
    #[error("all cases failed: {0}")]
    AllFailed(String),
    /// A shard that is none.
    #[error("{0}")]
    Shard(String),
    /// Somebody interrupted it.
    #[error("interrupted: finished parts stay, and the same command continues")]
    Interrupted,
}

impl StudyError {
    /// Whether the input is to blame, not the machine.
    #[must_use]
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::Disk { .. } | Self::Damaged { .. } | Self::AllFailed(_) | Self::Interrupted)
    }
}
