//! A folder of results, read back.

use crate::complaint::words;
use crate::files::{EVENTS, SUMMARY, TRACE};
use crate::frame::{Frame, FrameError};
use crate::results::NO_RESULTS;
use serde_json::Value;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// What a run left behind.
pub struct Results {
    /// Where they are.
    pub folder: PathBuf,
    /// Rows over time.
    pub trace: Frame,
    /// What the run came to.
    pub summary: Value,
    events: Frame,
    /// Time reached, s.
    pub end: f64,
    /// The stepper that ran.
    pub stepper: Stepper,
}

/// The stepper that ran.
#[derive(Debug, Clone, PartialEq)]
pub struct Stepper {
    name: String,
    pub exactness: Exactness,
}

/// What a stepper was asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exactness {
    /// Relative to the scene's natural scales.
    Tolerance(f64),
    /// s.
    Step(f64),
}

/// An event in a list.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EventRow<'a> {
    /// s.
    pub time: f64,
    pub source: &'a str,
    pub kind: &'a str,
}

/// Why a folder holds no results.
#[derive(Debug, Error)]
pub enum ResultsError {
    /// It is no folder, or of something else.
    #[error("{}: {NO_RESULTS}", .0.display())]
    NoFolder(PathBuf),
    /// One of its tables.
    #[error(transparent)]
    Table(#[from] FrameError),
    /// A table lacks a column.
    #[error("{}: there is no column \"{column}\"", .path.display())]
    NoColumn {
        /// Which table.
        path: PathBuf,
        /// What it should have.
        column: &'static str,
    },
    /// The summary cannot be read.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Summary {
        /// Which file.
        path: PathBuf,
        /// What the system or the reader says.
        source: io::Error,
    },
    /// The summary is of something else.
    #[error("{}: is no summary of a run: there is no {key}", .path.display())]
    NoSummary {
        /// Which file.
        path: PathBuf,
        /// What it should have.
        key: &'static str,
    },
}

impl Results {
    /// Reads a folder.
    ///
    /// # Errors
    /// A folder of something else, a table or a summary that cannot be read or lacks what every run writes.
    pub fn read(folder: &Path) -> Result<Self, ResultsError> {
        let path = folder.join(SUMMARY);
        if !path.is_file() && !folder.join(TRACE).is_file() {
            return Err(ResultsError::NoFolder(folder.to_owned()));
        }
        let summary =
            read_summary(&path).map_err(|source| ResultsError::Summary { path: path.clone(), source })?;
        let missing = |key| ResultsError::NoSummary { path: path.clone(), key };
        let end = summary.get("simulated_s").and_then(Value::as_f64).ok_or_else(|| missing("simulated_s"))?;
        let stepper = Stepper::of(&summary).ok_or_else(|| missing("stepper"))?;
        let (trace, events) = (Frame::read(&folder.join(TRACE))?, Frame::read(&folder.join(EVENTS))?);
        let results = Self { folder: folder.to_owned(), trace, summary, events, end, stepper };
        results.check()?;
        Ok(results)
    }

    fn check(&self) -> Result<(), ResultsError> {
        let lacks = |name: &str, column| ResultsError::NoColumn { path: self.folder.join(name), column };
        if self.trace.numbers("time_s").is_none() {
            return Err(lacks(TRACE, "time_s"));
        }
        if self.events.numbers("time_s").is_none() {
            return Err(lacks(EVENTS, "time_s"));
        }
        let word = ["source", "kind"].into_iter().find(|column| self.events.words(column).is_none());
        word.map_or(Ok(()), |column| Err(lacks(EVENTS, column)))
    }

    /// Times of the rows, s.
    pub fn time(&self) -> &[f64] {
        self.trace.numbers("time_s").unwrap_or_default()
    }

    /// The list of events.
    pub fn events(&self) -> impl Iterator<Item = EventRow<'_>> {
        let times = self.events.numbers("time_s").unwrap_or_default();
        let (sources, kinds) = (self.events.words("source"), self.events.words("kind"));
        times.iter().enumerate().map(move |(row, &time)| EventRow {
            time,
            source: sources.and_then(|words| words.get(row)).unwrap_or_default(),
            kind: kinds.and_then(|words| words.get(row)).unwrap_or_default(),
        })
    }

    /// A text in the summary by JSON pointer.
    pub fn text(&self, pointer: &str) -> &str {
        self.summary.pointer(pointer).and_then(Value::as_str).unwrap_or_default()
    }

    /// How the run ended.
    pub fn status(&self) -> &str {
        self.text("/status")
    }
}

fn read_summary(path: &Path) -> io::Result<Value> {
    Ok(serde_json::from_slice(&std::fs::read(path)?)?)
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

    /// In a sentence.
    pub fn words(&self) -> String {
        match self.exactness {
            Exactness::Tolerance(tolerance) => format!("{} at a tolerance of {tolerance:e}", self.name),
            Exactness::Step(step) => format!("{} at a step of {step:e} s", self.name),
        }
    }
}
