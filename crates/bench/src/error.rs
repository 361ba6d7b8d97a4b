//! Why there is no measurement.

use crate::contestant::Stop;
use crate::problem::ProblemError;
use std::io;
use std::path::PathBuf;
use stickslip_plot::PlotError;
use stickslip_run::complaint::words;
use thiserror::Error;

/// Why there is no measurement.
#[derive(Debug, Error)]
pub enum BenchError {
    /// A scenario that cannot be measured by.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// A run that stopped without output, but not with it.
    #[error("{name}: {why}")]
    Stopped {
        /// What was measured.
        name: String,
        /// What the run says.
        why: String,
    },
    /// The watcher ended it.
    #[error("{0}: interrupted; nothing is written of it")]
    Interrupted(String),
    /// A picture.
    #[error("{name}: {source}")]
    Picture {
        /// What was measured.
        name: String,
        /// What cannot be drawn.
        source: PlotError,
    },
    /// Reading or writing.
    #[error("{}: {}", .path.display(), words(.source))]
    File {
        /// Which file or folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

impl BenchError {
    /// What became of a scenario whose runs were stopped.
    pub(crate) fn of_stop(stop: Stop, name: &str) -> Self {
        let name = name.to_owned();
        match stop {
            Stop::Interrupted => Self::Interrupted(name),
            Stop::Failed(why) => Self::Stopped { name, why },
            Stop::Slow => Self::Stopped { name, why: "a run found no end".to_owned() },
        }
    }
}
