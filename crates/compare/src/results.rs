//! Reads a folder of results for a comparison.

use super::asked::Asked;
use super::soundness::{Extent, Soundness};
use serde_json::Value;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_quantity::columns;
use stickslip_run::SealedTable;
use stickslip_run::complaint::words;
use stickslip_run::files::{EVENTS, STEPS, TRACE};
use stickslip_run::frame::{Frame, FrameError};
use stickslip_run::rows::Rows;
use stickslip_run::synopsis::{Synopsis, SynopsisError};
use thiserror::Error;

/// Name of the step lengths among the summary values, and index of the step length column in [`columns::STEPS`].
pub(crate) const LENGTHS: &str = "lengths_m";
const LENGTH: usize = 3;

/// Results of a run, read from a folder.
pub struct Results {
    /// Folder of the results.
    pub folder: PathBuf,
    /// Table of the rows over time (`trace.csv`).
    pub trace: Frame,
    /// Contents of `summary.json`.
    pub summary: Value,
    events: Frame,
    /// SHA-256 of the table of rows and of the table of events.
    hashes: [Option<String>; 2],
    /// Simulated time at the end of the run, s.
    pub end: f64,
    /// Integrator of the run.
    pub stepper: Stepper,
    /// Whether the tables contain the whole run, its beginning or an excerpt.
    extent: Extent,
    /// Time up to which all requested events were written, s. Infinite if no events were thinned.
    pub events_until: f64,
    /// Settings of the scenario that select the written events and rows.
    pub(super) asked: Asked,
    /// Names of tables that the run wrote but that are missing in the folder. Missing tables are not compared.
    pub absent: Vec<String>,
}

/// Integrator of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Stepper {
    name: String,
    pub exactness: Exactness,
}

/// Accuracy setting of an integrator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exactness {
    /// Tolerance, relative to the natural scales of the model.
    Tolerance(f64),
    /// Fixed time step, s.
    Step(f64),
}

/// One row of the event table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EventRow<'a> {
    /// Time, s.
    pub time: f64,
    pub source: &'a str,
    pub kind: &'a str,
}

/// Error for a folder that contains no valid results.
#[derive(Debug, Error)]
pub enum ResultsError {
    /// The summary is missing or invalid.
    #[error(transparent)]
    Synopsis(#[from] SynopsisError),
    /// A table cannot be read.
    #[error(transparent)]
    Table(#[from] FrameError),
    /// A table lacks a column.
    #[error("{}: there is no column \"{column}\"", .path.display())]
    NoColumn {
        /// Path of the table.
        path: PathBuf,
        /// Name of the missing column.
        column: &'static str,
    },
    /// The files of the folder contradict each other.
    #[error("{}{}  {message}", .path.display(), .line.map(|line| format!(":{line}")).unwrap_or_default())]
    Unsound {
        /// Path of the file.
        path: PathBuf,
        /// Line number, from 1.
        line: Option<usize>,
        /// Description of the error.
        message: String,
    },
    /// A file cannot be read.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
}

impl Results {
    /// Reads a folder of results and checks that its files are consistent.
    ///
    /// # Errors
    /// Fails if the folder contains no results, a table or the summary is unreadable or incomplete, or the files contradict each other.
    pub fn read(folder: &Path) -> Result<Self, ResultsError> {
        let synopsis = Synopsis::read(folder)?;
        let end = synopsis.number("/simulated_s").ok_or_else(|| synopsis.lacks("simulated_s"))?;
        let stepper = Stepper::of(&synopsis.summary).ok_or_else(|| synopsis.lacks("stepper"))?;
        let extent = Extent::of(&synopsis);
        let tables = [synopsis.table(TRACE)?, synopsis.table(EVENTS)?];
        let (trace, events) = (Frame::read(&tables[0])?, Frame::read(&tables[1])?);
        // For an excerpt, the hashes of the complete tables of the recorded run are used.
        let hashes = match synopsis.summary.get("excerpt_of") {
            Some(of) => [TRACE, EVENTS].map(|name| Some(of.get(name)?.as_str()?.to_owned())),
            None => tables.map(|table| table.seal.map(|seal| seal.sha256)),
        };
        let soundness = Soundness { folder: folder.to_owned(), synopsis: &synopsis, extent, end };
        soundness.check(&trace, &events)?;
        let others = synopsis.tables().filter(|name| ![TRACE, EVENTS].contains(name));
        let (mut absent, mut lengths) = (Vec::new(), None);
        for name in others {
            let table = synopsis.table(name)?;
            // Tables that are not compared may be missing. If such a table exists, its checksum is verified.
            if table.path.symlink_metadata().is_err() {
                absent.push(name.to_owned());
            } else if name == STEPS {
                lengths = Some(step_lengths(&table)?);
            } else {
                let mut rows = Rows::open(&table)?;
                while rows.advance()? {}
            }
        }
        let events_until = synopsis.number("/counts/events_whole_until_s").unwrap_or(f64::INFINITY);
        let asked = Asked::of(folder);
        let mut summary = synopsis.summary;
        // The step lengths from the table are compared under the name that they have in a summary.
        if let (Some(lengths), Some(Value::Object(steps))) = (lengths, summary.get_mut("steps")) {
            steps.entry(LENGTHS).or_insert(lengths.into());
        }
        let mut results = Self {
            folder: folder.to_owned(),
            trace,
            summary,
            events,
            hashes,
            end,
            stepper,
            extent,
            events_until,
            asked,
            absent,
        };
        if extent == Extent::Cut {
            results.end = results.last_written();
        }
        let word = ["source", "kind"].into_iter().find(|column| results.events.words(column).is_none());
        let lacks = |column| ResultsError::NoColumn { path: folder.join(EVENTS), column };
        word.map_or(Ok(results), |column| Err(lacks(column)))
    }

    /// Returns the time up to which both tables are complete, s.
    fn last_written(&self) -> f64 {
        let counted = self.summary.pointer("/counts/events").and_then(Value::as_u64);
        let events = self.events.numbers("time_s").and_then(|times| times.last());
        let is_cut = counted.is_some_and(|counted| counted > self.events.rows() as u64);
        let ends = [self.time().last(), events.filter(|_| is_cut)];
        ends.into_iter().flatten().copied().fold(self.end, f64::min)
    }

    /// Returns whether the tables are an excerpt of a run.
    pub fn is_excerpt(&self) -> bool {
        self.extent == Extent::Excerpt
    }

    /// Returns the SHA-256 of the tables of rows and of events.
    pub fn hashes(&self) -> &[Option<String>; 2] {
        &self.hashes
    }

    /// Returns whether the tables of rows and events are byte-identical to the tables of other results.
    pub fn has_tables_of(&self, other: &Self) -> bool {
        self.hashes == other.hashes && self.hashes.iter().all(Option::is_some)
    }

    /// Returns whether the tables end before the end of the run.
    pub fn is_cut(&self) -> bool {
        self.extent == Extent::Cut
    }

    /// Returns the times of the rows, s.
    pub fn time(&self) -> &[f64] {
        self.trace.numbers("time_s").unwrap_or_default()
    }

    /// Iterates over the events.
    pub fn events(&self) -> impl Iterator<Item = EventRow<'_>> {
        let times = self.events.numbers("time_s").unwrap_or_default();
        let (sources, kinds) = (self.events.words("source"), self.events.words("kind"));
        times.iter().enumerate().map(move |(row, &time)| EventRow {
            time,
            source: sources.and_then(|words| words.get(row)).unwrap_or_default(),
            kind: kinds.and_then(|words| words.get(row)).unwrap_or_default(),
        })
    }

    /// Returns a string of the summary by its JSON pointer, or an empty string if the summary lacks the string.
    pub fn text(&self, pointer: &str) -> &str {
        self.summary.pointer(pointer).and_then(Value::as_str).unwrap_or_default()
    }

    /// Returns the status of the run at its end.
    pub fn status(&self) -> &str {
        self.text("/status")
    }
}

/// Reads the step lengths of a run, m.
fn step_lengths(table: &SealedTable) -> Result<Vec<f64>, FrameError> {
    let mut rows = Rows::open(table)?;
    rows.check_head(columns::STEPS.names)?;
    let mut lengths = Vec::new();
    while rows.advance()? {
        lengths.push(rows.number(LENGTH, columns::STEPS.names[LENGTH])?);
    }
    Ok(lengths)
}

impl Stepper {
    fn of(summary: &Value) -> Option<Self> {
        let stepper = summary.get("stepper")?;
        let number = |key| stepper.get(key).and_then(Value::as_f64);
        let exactness = match number("tolerance") {
            Some(tolerance) => Exactness::Tolerance(tolerance),
            None => Exactness::Step(number("step_s")?),
        };
        Some(Self { name: stepper.get("name")?.as_str()?.to_owned(), exactness })
    }

    /// Returns the integrator and its accuracy setting as text.
    pub fn words(&self) -> String {
        match self.exactness {
            Exactness::Tolerance(tolerance) => format!("{}, tolerance {tolerance:e}", self.name),
            Exactness::Step(step) => format!("{}, time step {step:e} s", self.name),
        }
    }
}
