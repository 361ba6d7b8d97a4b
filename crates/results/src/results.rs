//! A folder of results read back: the job that was run, and what was kept of it.

use crate::complaint::words;
use crate::files::{EVENTS, SCENARIO, SUMMARY, TRACE};
use crate::frame::FrameError;
use crate::job::{Job, hash};
use crate::kept::Kept;
use crate::program::this_program;
use crate::replay::{self, LastRow};
use serde::Deserialize;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_scenario::{PlotName, Scenario, ScenarioError};
use thiserror::Error;

/// Results on disk.
pub struct Results {
    /// What was run.
    pub job: Job,
    /// What came of it.
    pub kept: Kept,
}

/// What is said of anything else, by all who read results.
pub const NO_RESULTS: &str = "expected a folder of results, as `stickslip run` writes one for each scenario";

/// Why a folder cannot be read as results.
#[derive(Debug, Error)]
pub enum ResultsError {
    /// Its scenario.
    #[error("{error}{}", other_program(.program))]
    Scenario {
        /// What is wrong with it.
        error: Box<ScenarioError>,
        /// The program that wrote it.
        program: String,
    },
    /// Not what a run writes.
    #[error("{}: {NO_RESULTS}", .0.display())]
    NoResults(PathBuf),
    /// A file that cannot be read at all.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Which file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A summary that is none.
    #[error("{}: expected the summary of a run: {source}", .path.display())]
    Summary {
        /// Which file.
        path: PathBuf,
        /// What the reader says.
        source: serde_json::Error,
    },
    /// A scenario that is not the one of the results.
    #[error("{}: was changed after the run: its SHA-256 is not that of the summary beside it\n   help: run it again, or draw other pictures with --plots", .0.display())]
    Changed(PathBuf),
    /// A damaged table.
    #[error("{source}{}", advice(.source))]
    Table {
        /// Which, and how.
        source: FrameError,
    },
    /// A table without rows.
    #[error("{}: has no rows", .0.display())]
    Empty(PathBuf),
}

/// What of the summary is read back.
#[derive(Debug, Deserialize)]
struct Origin {
    program: Program,
    scenario_sha256: String,
    #[serde(default)]
    status: Option<String>,
}

#[derive(Debug, Deserialize)]
struct Program {
    name: String,
    version: String,
}

impl Results {
    /// Reads the results that a run wrote into a folder, with what pictures need: these, or where there are
    /// none those of the scenario.
    ///
    /// # Errors
    /// A folder of something else, a file that cannot be read or was changed, a damaged table.
    pub fn read(folder: &Path, plots: &[PlotName]) -> Result<Self, ResultsError> {
        let (mut job, last) = job(folder)?;
        if !plots.is_empty() {
            job.scenario.plots = plots.to_vec();
        }
        let tables = (&*folder.join(TRACE), &*folder.join(EVENTS));
        let kept = replay::read(tables, &job.columns, (&job.scenario.plots, last))?;
        Ok(Self { job, kept })
    }

    /// The program that computed the results, where it is another one.
    pub fn other_program(&self) -> Option<&str> {
        (self.job.program != this_program()).then_some(self.job.program.as_str())
    }
}

/// The job that was run, under the folder's name, and what its last row shows.
fn job(folder: &Path) -> Result<(Job, LastRow), ResultsError> {
    if ![SUMMARY, SCENARIO].iter().any(|name| folder.join(name).is_file()) {
        return Err(ResultsError::NoResults(folder.to_owned()));
    }
    let origin = origin(&folder.join(SUMMARY))?;
    let program = match &origin {
        Some(Origin { program, .. }) => format!("{} {}", program.name, program.version),
        None => this_program(),
    };
    let is_done = origin.as_ref().and_then(|origin| origin.status.as_deref()).is_none_or(|s| s == "done");
    let last = if is_done { LastRow::End } else { LastRow::Stop };
    let path = folder.join(SCENARIO);
    let refused =
        |error: ScenarioError| ResultsError::Scenario { error: Box::new(error), program: program.clone() };
    let scenario = Scenario::load(&path).map_err(refused)?;
    let text =
        fs::read_to_string(&path).map_err(|source| ResultsError::Read { path: path.clone(), source })?;
    if origin.is_some_and(|origin| origin.scenario_sha256 != hash(&text)) {
        return Err(ResultsError::Changed(path));
    }
    // "." has a name, too.
    let place = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let name = place.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let job = Job::new(scenario, name, folder.to_owned()).map_err(refused)?;
    Ok((job.with_origin(text, program), last))
}

/// Where results come from; none without a summary.
fn origin(path: &Path) -> Result<Option<Origin>, ResultsError> {
    match fs::read(path) {
        Ok(bytes) => match serde_json::from_slice(&bytes) {
            Ok(origin) => Ok(Some(origin)),
            Err(source) => Err(ResultsError::Summary { path: path.to_owned(), source }),
        },
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(source) => Err(ResultsError::Read { path: path.to_owned(), source }),
    }
}

/// What to try with a table of other columns.
fn advice(error: &FrameError) -> &'static str {
    match error {
        FrameError::Head { .. } => {
            "\n   help: the table is not of the scenario.json beside it, or of another version of the program; run the \
             scenario again"
        }
        _ => "",
    }
}

/// Another program may write what this one does not read.
fn other_program(program: &str) -> String {
    let this = this_program();
    if program == this { String::new() } else { format!("\n   note: written by {program}, this is {this}") }
}
