//! Reads the summary of a results folder with the seals of its tables.

use crate::checkpoint;
use crate::complaint::words;
use crate::files::{CYCLES, EVENTS, INSIDES, PULSES, SCENARIO, STEPS, SUMMARY, TRACE};
use crate::folder;
use crate::guard;
use crate::seal::{Seal, SealedTable};
use serde_json::Value;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Error text for folders without results.
pub const NO_RESULTS: &str = "expected a folder of results, as `stickslip run` writes one for each scenario";

/// Maximum size of a name or word in a summary, in bytes.
const MOST_WORD: usize = 1024;
/// Maximum total size of the full names of all values, in bytes.
const MOST_NAMES: usize = 128 << 20;

/// Contents of the file `summary.json`.
#[derive(Debug, Clone, PartialEq)]
pub struct Synopsis {
    folder: PathBuf,
    /// Contents of the file as a JSON value.
    pub summary: Value,
}

/// Error of reading a summary.
#[derive(Debug, Error)]
pub enum SynopsisError {
    /// The folder does not exist or contains no results.
    #[error("{}: {NO_RESULTS}", .0.display())]
    NoResults(PathBuf),
    /// The run is in progress, or was killed before its results were published.
    #[error("{}: no results: the run was killed before it published them, or is still running\n   help: {}", .0.display(), again(.0))]
    Unpublished(PathBuf),
    /// The run was killed while its results were published.
    #[error("{}: incomplete: the run was killed while it published its results\n   help: {}", .0.display(), again(.0))]
    Incomplete(PathBuf),
    /// The file cannot be read.
    #[error("{}: cannot be read: {}", .path.display(), words(.source))]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Cause.
        source: io::Error,
    },
    /// The file is not the summary of a run.
    #[error("{}: is not the summary of a run: {key} is missing", .path.display())]
    NoSummary {
        /// Path of the file.
        path: PathBuf,
        /// Missing key.
        key: &'static str,
    },
    /// The summary contains names or words that no run writes.
    #[error("{}: {message}", .path.display())]
    Words {
        /// Path of the file.
        path: PathBuf,
        /// Description of the error.
        message: String,
    },
    /// The summary has no seal of a table.
    #[error("{}: has no checksum of {name}: an older version of the program wrote this file, or it was changed\n   help: run the scenario again", .path.display())]
    NoSeal {
        /// Path of the file.
        path: PathBuf,
        /// Name of the table.
        name: String,
    },
}

/// Returns the advice to run the scenario again if the results of a folder are incomplete.
fn again(folder: &Path) -> String {
    let resume = if checkpoint::exists(folder) {
        format!(", or resume it from its checkpoint with `stickslip run --resume {}`", folder.display())
    } else {
        String::new()
    };
    format!("run the scenario again{resume}")
}

impl Synopsis {
    /// Reads the summary of a folder.
    ///
    /// # Errors
    /// The summary is missing, unreadable or invalid.
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

    /// Returns the path of the summary.
    pub fn path(&self) -> PathBuf {
        self.folder.join(SUMMARY)
    }

    /// Returns a string by its JSON pointer. Returns an empty string if the value does not exist.
    pub fn text(&self, pointer: &str) -> &str {
        self.summary.pointer(pointer).and_then(Value::as_str).unwrap_or_default()
    }

    /// Returns a number by its JSON pointer.
    pub fn number(&self, pointer: &str) -> Option<f64> {
        self.summary.pointer(pointer).and_then(Value::as_f64)
    }

    /// Returns a count by its JSON pointer.
    pub fn count(&self, pointer: &str) -> Option<u64> {
        self.summary.pointer(pointer).and_then(Value::as_u64)
    }

    /// Returns whether a key has the value `true`.
    pub fn says(&self, key: &str) -> bool {
        self.summary.get(key).and_then(Value::as_bool).unwrap_or(false)
    }

    /// Returns the error for a missing key.
    pub fn lacks(&self, key: &'static str) -> SynopsisError {
        SynopsisError::NoSummary { path: self.path(), key }
    }

    /// Returns the names of the tables with seals.
    pub fn tables(&self) -> impl Iterator<Item = &str> {
        let tables = self.summary.get("tables").and_then(Value::as_object);
        tables.into_iter().flatten().map(|(name, _)| name.as_str())
    }

    /// Returns the path and the seal of a table.
    ///
    /// # Errors
    /// The summary has no seal of the table.
    pub fn table(&self, name: &str) -> Result<SealedTable, SynopsisError> {
        let seal = self.summary.get("tables").and_then(|tables| tables.get(name));
        let seal: Option<Seal> = seal.and_then(|seal| serde_json::from_value(seal.clone()).ok());
        let unsealed = || SynopsisError::NoSeal { path: self.path(), name: name.to_owned() };
        Ok(SealedTable { path: self.folder.join(name), seal: Some(seal.ok_or_else(unsealed)?) })
    }
}

/// Tables that every run may write. Tables about the interior of contacts are not included.
const SEALED: [&str; 5] = [TRACE, EVENTS, CYCLES, STEPS, PULSES];

/// Returns a description of invalid names or words in a summary. Returns `None` if all names and words are valid.
fn fault(summary: &Value) -> Option<String> {
    // These keys are not printed by other commands, so they are not checked.
    const UNTOLD: [&str; 3] = ["title", "error", "notes"];
    let mut words = Words::default();
    let entries = summary.as_object().into_iter().flatten();
    entries
        .filter(|(key, _)| !UNTOLD.contains(&key.as_str()))
        .for_each(|(key, value)| words.read(key, value, 0));
    let tables = summary.get("tables").and_then(Value::as_object).into_iter().flatten();
    // Only known tables are allowed, so that no path outside of the folder is read.
    let unknown =
        tables.map(|(name, _)| name).find(|name| !SEALED.iter().chain(&INSIDES).any(|known| known == name));
    if words.has_control {
        Some("has control characters in names or words".to_owned())
    } else if words.longest > MOST_WORD {
        Some(format!("has a name or word of {} bytes, expected at most {MOST_WORD}", words.longest))
    } else if words.names > MOST_NAMES {
        Some(format!("the full names of its results have more than {MOST_NAMES} bytes"))
    } else {
        unknown
            .map(|name| format!("has a checksum of a table \"{}\" that no run writes", name.escape_debug()))
    }
}

/// Sizes of the names and words in a summary.
#[derive(Debug, Default)]
struct Words {
    has_control: bool,
    /// Size of the longest name or word, in bytes.
    longest: usize,
    /// Total size of the full names of all values, such as `steps.steady.step_m`, in bytes.
    names: usize,
}

impl Words {
    /// Adds a value and all values that it contains. `before` is the size of the prefix of its full name, in bytes.
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

/// Returns the error for a folder without a summary.
fn absent(folder: &Path) -> SynopsisError {
    let names = [&[TRACE, EVENTS, SCENARIO][..], &INSIDES].concat();
    let folder = folder.to_owned();
    // A scenario file alone does not indicate results.
    if [TRACE, EVENTS].iter().any(|name| folder.join(name).exists()) {
        SynopsisError::Incomplete(folder)
    } else if folder::has_drafts(&folder, &names) || checkpoint::exists(&folder) {
        SynopsisError::Unpublished(folder)
    } else {
        SynopsisError::NoResults(folder)
    }
}

/// Checks that the results of a folder were published completely. Folders without results are accepted.
///
/// # Errors
/// The run was killed while its results were published.
pub fn check_published(folder: &Path) -> Result<(), SynopsisError> {
    match absent(folder) {
        error @ SynopsisError::Incomplete(_) if !folder.join(SUMMARY).exists() => Err(error),
        _ => Ok(()),
    }
}
