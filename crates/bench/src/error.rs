//! Errors of a benchmark.

use crate::contestant::Stop;
use crate::problem::ProblemError;
use std::io;
use std::path::PathBuf;
use stickslip_plot::PlotError;
use stickslip_run::complaint::words;
use thiserror::Error;

/// Error of a benchmark.
#[derive(Debug, Error)]
pub enum BenchError {
    /// Scenario that is not suitable for a benchmark.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// Error of a run.
    #[error("{name}: {why}")]
    Stopped {
        /// Name of the benchmark.
        name: String,
        /// Error message of the run.
        why: String,
    },
    /// Interrupted by the watcher.
    #[error("{0}: interrupted; no results were written")]
    Interrupted(String),
    /// Error while drawing a plot.
    #[error("{name}: {source}")]
    Picture {
        /// Name of the benchmark.
        name: String,
        /// Error of the plot.
        source: PlotError,
    },
    /// Error of reading or writing.
    #[error("{}: {}", .path.display(), words(.source))]
    File {
        /// File or folder.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
}

impl BenchError {
    /// Converts the reason why the runs of a scenario stopped.
    pub(crate) fn of_stop(stop: Stop, name: &str) -> Self {
        let name = name.to_owned();
        match stop {
            Stop::Interrupted => Self::Interrupted(name),
            Stop::Failed(why) => Self::Stopped { name, why },
            Stop::Slow => Self::Stopped { name, why: "a run exceeded its time limit".to_owned() },
        }
    }
}
