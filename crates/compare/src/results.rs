//! A folder of results, read back.

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

/// Name of the lengths of the steps among the figures, and their place in [`columns::STEPS`].
pub(crate) const LENGTHS: &str = "lengths_m";
const LENGTH: usize = 3;

/// What a run left behind.
pub struct Results {
    /// Where they are.
    pub folder: PathBuf,
    /// Rows over time.
    pub trace: Frame,
    /// What the run came to.
    pub summary: Value,
    events: Frame,
    /// SHA-256 of the tables of rows and of events.
    hashes: [Option<String>; 2],
    /// Time reached, s.
    pub end: f64,
    /// The stepper that ran.
    pub stepper: Stepper,
    /// What the tables are to the run.
    extent: Extent,
    /// Until when all its events were written that were asked for, s; infinite where that is to its end.
    pub events_until: f64,
    /// Which events and rows were asked for.
    pub(super) asked: Asked,
    /// Tables that the run wrote, which are not compared and not there.
    pub absent: Vec<String>,
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
    /// Its summary.
    #[error(transparent)]
    Synopsis(#[from] SynopsisError),
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
    /// Files that do not fit together.
    #[error("{}{}  {message}", .path.display(), .line.map(|line| format!(":{line}")).unwrap_or_default())]
    Unsound {
        /// Which file.
        path: PathBuf,
        /// Which line, from 1.
        line: Option<usize>,
        /// What is wrong with it.
        message: String,
    },
    /// A file that cannot be read at all.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Which file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

impl Results {
    /// Reads a folder.
    ///
    /// # Errors
    /// A folder of something else, a table or a summary that cannot be read or lacks what every run writes, files that do
    /// not fit together.
    pub fn read(folder: &Path) -> Result<Self, ResultsError> {
        let synopsis = Synopsis::read(folder)?;
        let end = synopsis.number("/simulated_s").ok_or_else(|| synopsis.lacks("simulated_s"))?;
        let stepper = Stepper::of(&synopsis.summary).ok_or_else(|| synopsis.lacks("stepper"))?;
        let extent = Extent::of(&synopsis);
        let tables = [synopsis.table(TRACE)?, synopsis.table(EVENTS)?];
        let (trace, events) = (Frame::read(&tables[0])?, Frame::read(&tables[1])?);
        // An excerpt has the bytes of the run that it is of, as far as that can be told.
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
            // Whoever has sent the rest may have left them out. One that is there is the run's; of most no more is compared.
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
        // Steps have stood in the summary, and are told by the name that they had there.
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

    /// Until when both tables hold all that happened, s.
    fn last_written(&self) -> f64 {
        let counted = self.summary.pointer("/counts/events").and_then(Value::as_u64);
        let events = self.events.numbers("time_s").and_then(|times| times.last());
        let is_cut = counted.is_some_and(|counted| counted > self.events.rows() as u64);
        let ends = [self.time().last(), events.filter(|_| is_cut)];
        ends.into_iter().flatten().copied().fold(self.end, f64::min)
    }

    /// Whether the tables are some rows of a run, kept to be compared with.
    pub fn is_excerpt(&self) -> bool {
        self.extent == Extent::Excerpt
    }

    /// SHA-256 of the rows and of the events.
    pub fn hashes(&self) -> &[Option<String>; 2] {
        &self.hashes
    }

    /// The same rows and events as those of other results, to the byte.
    pub fn has_tables_of(&self, other: &Self) -> bool {
        self.hashes == other.hashes && self.hashes.iter().all(Option::is_some)
    }

    /// Whether the tables end before the run did.
    pub fn is_cut(&self) -> bool {
        self.extent == Extent::Cut
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

/// Lengths of the steps of a run, m.
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

    /// In a sentence.
    pub fn words(&self) -> String {
        match self.exactness {
            Exactness::Tolerance(tolerance) => format!("{} at a tolerance of {tolerance:e}", self.name),
            Exactness::Step(step) => format!("{} at a step of {step:e} s", self.name),
        }
    }
}
