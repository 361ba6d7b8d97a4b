//! Reads a results folder: the job and the recorded data.

use crate::complaint::words;
use crate::files::{EVENTS, InsideTables, SCENARIO, TRACE};
use crate::frame::FrameError;
use crate::guard;
use crate::job::Job;
use crate::kept::Kept;
use crate::program::this_program;
use crate::replay::{self, LastRow};
use crate::seal::hash;
use crate::synopsis::{Synopsis, SynopsisError};
use std::io;
use std::path::{Path, PathBuf};
use stickslip_scenario::{PlotName, Scenario, ScenarioError};
use thiserror::Error;

/// Results of a run, read from a results folder.
pub struct Results {
    /// Job of the run that wrote the results.
    pub job: Job,
    /// Recorded data.
    pub kept: Kept,
    /// Paths of the tables about the interior of contacts.
    pub insides: InsideTables,
}

/// Error of reading a results folder.
#[derive(Debug, Error)]
pub enum ResultsError {
    /// The scenario is invalid.
    #[error("{error}{}", other_program(.program))]
    Scenario {
        /// Error of the scenario.
        error: Box<ScenarioError>,
        /// Program that wrote the results.
        program: String,
    },
    /// The summary is missing or invalid.
    #[error(transparent)]
    Synopsis(#[from] SynopsisError),
    /// A file cannot be read.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The scenario file differs from the scenario of the run.
    #[error("{}: was changed after the run: its SHA-256 differs from that in summary.json\n   help: run the scenario again, or draw other plots with --plots", .0.display())]
    Changed(PathBuf),
    /// A table is damaged.
    #[error("{source}{}", advice(.source))]
    Table {
        /// Error of the table.
        source: FrameError,
    },
    /// The trace has no rows.
    #[error("{}: has no rows", .0.display())]
    Empty(PathBuf),
}

impl Results {
    /// Reads a results folder with the data that the plots need. If `plots` is empty, the plots of the scenario are used.
    ///
    /// # Errors
    /// The folder contains no results, a file cannot be read or was changed, or a table is damaged.
    pub fn read(folder: &Path, plots: &[PlotName]) -> Result<Self, ResultsError> {
        let synopsis = Synopsis::read(folder)?;
        let mut job = job(folder, &synopsis)?;
        if !plots.is_empty() {
            job.scenario.plots = plots.to_vec();
        }
        let tables = (&synopsis.table(TRACE)?, &synopsis.table(EVENTS)?);
        let last = if synopsis.text("/status") == "done" { LastRow::End } else { LastRow::Stop };
        let mut kept = replay::read(tables, &job.columns, (&job.scenario.plots, last))?;
        kept.whole_until = synopsis.number("/counts/events_whole_until_s");
        // Optional tables may be missing. Existing tables must be regular files with a seal.
        let optional = |name: &str| match folder.join(name) {
            path if path.exists() => match guard::open(&path) {
                Ok(_) => Ok(synopsis.table(name)?),
                Err(source) => Err(ResultsError::Read { path, source }),
            },
            path => Ok(path.into()),
        };
        Ok(Self { job, kept, insides: InsideTables::find(optional)? })
    }

    /// Returns the program that computed the results, if it differs from this program.
    pub fn other_program(&self) -> Option<&str> {
        (self.job.program != this_program()).then_some(self.job.program.as_str())
    }
}

/// Reads the job of the run. The job gets the name of the results folder.
fn job(folder: &Path, synopsis: &Synopsis) -> Result<Job, ResultsError> {
    let of = |pointer: &str, key| match synopsis.text(pointer) {
        "" => Err(synopsis.lacks(key)),
        text => Ok(text),
    };
    let (name, version) = (of("/program/name", "program.name")?, of("/program/version", "program.version")?);
    let (program, sealed) = (format!("{name} {version}"), of("/scenario_sha256", "scenario_sha256")?);
    let path = folder.join(SCENARIO);
    let refused =
        |error: ScenarioError| ResultsError::Scenario { error: Box::new(error), program: program.clone() };
    let scenario = Scenario::load(&path).map_err(refused)?;
    let text = guard::text(&path).map_err(|source| ResultsError::Read { path: path.clone(), source })?;
    if sealed != hash(&text) {
        return Err(ResultsError::Changed(path));
    }
    // The path is resolved first, so that "." has a name.
    let place = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let name = place.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let job = Job::new(scenario, name, folder.to_owned()).map_err(refused)?;
    Ok(job.with_origin(text, program))
}

/// Returns advice for tables with unexpected columns.
fn advice(error: &FrameError) -> &'static str {
    match error {
        FrameError::Head { .. } => {
            "\n   help: the table is not of the scenario.json in its folder, or another version of the \
             program wrote it; run the scenario again"
        }
        _ => "",
    }
}

/// Returns a note if another program wrote the results. The other program may have written keys that this program does not know.
fn other_program(program: &str) -> String {
    let this = this_program();
    if program == this { String::new() } else { format!("\n   note: written by {program}, this is {this}") }
}
