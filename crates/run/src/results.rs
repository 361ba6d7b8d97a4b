//! A folder of results read back: the job that was run, and what was kept of it.

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

/// Results on disk.
pub struct Results {
    /// What was run.
    pub job: Job,
    /// What came of it.
    pub kept: Kept,
    /// Where the tables of the contacts' insides lie, if they were written.
    pub insides: InsideTables,
}

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
    /// Its summary.
    #[error(transparent)]
    Synopsis(#[from] SynopsisError),
    /// A file that cannot be read at all.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Which file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
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

impl Results {
    /// Reads the results that a run wrote into a folder, with what pictures need: these, or where there are
    /// none those of the scenario.
    ///
    /// # Errors
    /// A folder of something else, a file that cannot be read or was changed, a damaged table.
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
        // What was not written is not there; what is there must be a plain file that is sealed.
        let optional = |name: &str| match folder.join(name) {
            path if path.exists() => match guard::open(&path) {
                Ok(_) => Ok(synopsis.table(name)?),
                Err(source) => Err(ResultsError::Read { path, source }),
            },
            path => Ok(path.into()),
        };
        Ok(Self { job, kept, insides: InsideTables::find(optional)? })
    }

    /// The program that computed the results, where it is another one.
    pub fn other_program(&self) -> Option<&str> {
        (self.job.program != this_program()).then_some(self.job.program.as_str())
    }
}

/// The job that was run, under the folder's name.
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
    // "." has a name, too.
    let place = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let name = place.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let job = Job::new(scenario, name, folder.to_owned()).map_err(refused)?;
    Ok(job.with_origin(text, program))
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
