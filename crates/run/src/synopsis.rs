//! The summary of a folder of results, read back: what it says of the files beside it.

use crate::checkpoint;
use crate::complaint::words;
use crate::files::{CYCLES, EVENTS, INSIDES, SCENARIO, STEPS, SUMMARY, TRACE};
use crate::folder;
use crate::guard;
use crate::seal::{Seal, SealedTable};
use serde_json::Value;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// What is said of anything else, by all who read results.
pub const NO_RESULTS: &str = "expected a folder of results, as `stickslip run` writes one for each scenario";

/// Most bytes of a name or word in a summary.
const MOST_WORD: usize = 1024;
/// Most bytes of the names of all its values: a million periods have 24 million, ten thousand contacts 30 million.
const MOST_NAMES: usize = 128 << 20;

/// What a summary says.
#[derive(Debug, Clone, PartialEq)]
pub struct Synopsis {
    folder: PathBuf,
    /// All of it.
    pub summary: Value,
}

/// Why a folder has no summary that could be read.
#[derive(Debug, Error)]
pub enum SynopsisError {
    /// It is no folder, or of something else.
    #[error("{}: {NO_RESULTS}", .0.display())]
    NoResults(PathBuf),
    /// Its run did not come to give its files their names, or is under way.
    #[error("{}: there are no results: a run was ended before it had published them, or is under way\n   help: {}", .0.display(), again(.0))]
    Unpublished(PathBuf),
    /// Its run was ended while it gave its files their names.
    #[error("{}: incomplete: a run was ended while its results were published\n   help: {}", .0.display(), again(.0))]
    Incomplete(PathBuf),
    /// A summary that cannot be read.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Which file.
        path: PathBuf,
        /// What the system or the reader says.
        source: io::Error,
    },
    /// A summary of something else.
    #[error("{}: is no summary of a run: there is no {key}", .path.display())]
    NoSummary {
        /// Which file.
        path: PathBuf,
        /// What it should have.
        key: &'static str,
    },
    /// A summary of words that no run has.
    #[error("{}: {message}", .path.display())]
    Words {
        /// Which file.
        path: PathBuf,
        /// What is wrong with them.
        message: String,
    },
    /// A summary without seals.
    #[error("{}: does not say what is in {name}: an older version of the program has written it, or it was changed\n   help: run the scenario again", .path.display())]
    NoSeal {
        /// Which file.
        path: PathBuf,
        /// The table.
        name: String,
    },
}

/// How a folder gets its results.
fn again(folder: &Path) -> String {
    let resume = if checkpoint::exists(folder) {
        format!(", or go on from its checkpoint with `stickslip run --resume {}`", folder.display())
    } else {
        String::new()
    };
    format!("run it again{resume}")
}

impl Synopsis {
    /// Reads the summary in a folder. Without one no other file there is worth a look.
    pub fn read(folder: &Path) -> Result<Self, SynopsisError> {
        let path = folder.join(SUMMARY);
        match guard::json(&path) {
            Ok(summary) => match fault(&summary) {
                None => Ok(Self { folder: folder.to_owned(), summary }),
                Some(message) => Err(SynopsisError::Words { path, message }),
            },
            Err(source)
                if matches!(source.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) =>
            {
                Err(absent(folder))
            }
            Err(source) => Err(SynopsisError::Read { path, source }),
        }
    }

    /// Which file it is.
    pub fn path(&self) -> PathBuf {
        self.folder.join(SUMMARY)
    }

    /// A text by JSON pointer; empty where there is none.
    pub fn text(&self, pointer: &str) -> &str {
        self.summary.pointer(pointer).and_then(Value::as_str).unwrap_or_default()
    }

    /// A number by JSON pointer.
    pub fn number(&self, pointer: &str) -> Option<f64> {
        self.summary.pointer(pointer).and_then(Value::as_f64)
    }

    /// A count by JSON pointer.
    pub fn count(&self, pointer: &str) -> Option<u64> {
        self.summary.pointer(pointer).and_then(Value::as_u64)
    }

    /// Whether it says yes to something, in so many words.
    pub fn says(&self, key: &str) -> bool {
        self.summary.get(key).and_then(Value::as_bool).unwrap_or(false)
    }

    /// Refuses a summary of something else.
    pub fn lacks(&self, key: &'static str) -> SynopsisError {
        SynopsisError::NoSummary { path: self.path(), key }
    }

    /// Names of the tables that it seals.
    pub fn tables(&self) -> impl Iterator<Item = &str> {
        let tables = self.summary.get("tables").and_then(Value::as_object);
        tables.into_iter().flatten().map(|(name, _)| name.as_str())
    }

    /// A table beside it, with its seal.
    pub fn table(&self, name: &str) -> Result<SealedTable, SynopsisError> {
        let seal = self.summary.get("tables").and_then(|tables| tables.get(name));
        let seal: Option<Seal> = seal.and_then(|seal| serde_json::from_value(seal.clone()).ok());
        let unsealed = || SynopsisError::NoSeal { path: self.path(), name: name.to_owned() };
        Ok(SealedTable { path: self.folder.join(name), seal: Some(seal.ok_or_else(unsealed)?) })
    }
}

/// Tables that runs write, beside those of the insides.
const SEALED: [&str; 4] = [TRACE, EVENTS, CYCLES, STEPS];

/// What is wrong with what is told of a summary: a version, a status, the name of a contact.
fn fault(summary: &Value) -> Option<String> {
    // Sentences of the run and its title are not told.
    const UNTOLD: [&str; 3] = ["title", "error", "notes"];
    let mut words = Words::default();
    let entries = summary.as_object().into_iter().flatten();
    entries
        .filter(|(key, _)| !UNTOLD.contains(&key.as_str()))
        .for_each(|(key, value)| words.read(key, value, 0));
    let tables = summary.get("tables").and_then(Value::as_object).into_iter().flatten();
    // Files anywhere else are none of a stranger's business.
    let unknown =
        tables.map(|(name, _)| name).find(|name| !SEALED.iter().chain(&INSIDES).any(|known| known == name));
    if words.has_control {
        Some("has control characters in its names or words".to_owned())
    } else if words.longest > MOST_WORD {
        Some(format!("has a name or word of {} bytes, expected at most {MOST_WORD}", words.longest))
    } else if words.names > MOST_NAMES {
        Some(format!("the full names of its figures have more than {MOST_NAMES} bytes"))
    } else {
        unknown.map(|name| format!("seals a table \"{}\" that no run writes", name.escape_debug()))
    }
}

/// The names and words of a summary.
#[derive(Debug, Default)]
struct Words {
    has_control: bool,
    /// Bytes of the longest.
    longest: usize,
    /// Bytes of the names of all values, such as `steps.steady.step_m`.
    names: usize,
}

impl Words {
    /// Takes a value whose name has the name of what it is part of, so many bytes, before it.
    fn read(&mut self, name: &str, value: &Value, before: usize) {
        self.word(name);
        let before = before + name.len() + 1;
        match value {
            Value::Object(entries) => entries.iter().for_each(|(key, value)| self.read(key, value, before)),
            Value::Array(entries) => entries.iter().for_each(|value| self.read("[0000]", value, before)),
            Value::String(text) => self.word(text),
            _ => {}
        }
        self.names = self.names.saturating_add(before);
    }

    fn word(&mut self, text: &str) {
        self.has_control |= text.contains(char::is_control);
        self.longest = self.longest.max(text.len());
    }
}

/// What there is instead.
fn absent(folder: &Path) -> SynopsisError {
    let names = [&[TRACE, EVENTS, SCENARIO][..], &INSIDES].concat();
    let folder = folder.to_owned();
    // A scenario may lie beside anything.
    if [TRACE, EVENTS].iter().any(|name| folder.join(name).exists()) {
        SynopsisError::Incomplete(folder)
    } else if folder::has_drafts(&folder, &names) || checkpoint::exists(&folder) {
        SynopsisError::Unpublished(folder)
    } else {
        SynopsisError::NoResults(folder)
    }
}

/// Refuses a folder of results without a summary; one of something else is none of this.
///
/// # Errors
/// Results whose run was ended while they were published.
pub fn check_published(folder: &Path) -> Result<(), SynopsisError> {
    match absent(folder) {
        error @ SynopsisError::Incomplete(_) if !folder.join(SUMMARY).exists() => Err(error),
        _ => Ok(()),
    }
}
