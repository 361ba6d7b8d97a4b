//! Checkpoints: interrupted runs can be resumed.
//!
//! A run with checkpoints has a folder [`FOLDER`] in its results folder. This folder contains the resolved scenario, the `journal` with all
//! recorded data, and the state of the run with the journal length (`stub`). The state file is replaced atomically. A resumed run reads the
//! state, replays the journal up to this length to a new recorder, truncates the rest and continues. Resumed and uninterrupted runs have
//! identical results. Checkpoints are written between two time steps and shorten no step.
//!
//! [`Keeper`] writes checkpoints, [`Resumption`] reads them. [`model_key`] identifies scenarios whose states are compatible.

mod course;
mod error;
mod journal;
mod keeper;
mod key;
mod playback;
mod resumption;
mod stub;
#[cfg(test)]
mod tests;

pub use error::CheckpointError;
pub use keeper::Keeper;
pub use key::model_key;
pub use resumption::Resumption;

use crate::files::SCENARIO;
use crate::folder::sweep;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Name of the checkpoint folder in the results folder.
pub const FOLDER: &str = "checkpoint";
/// Name of the file with the state of the run. A checkpoint replaces this file last and atomically.
const STATE: &str = "state";
/// File with all recorded data.
const JOURNAL: &str = "journal";

/// Returns the path of the checkpoint folder.
fn place(results: &Path) -> PathBuf {
    results.join(FOLDER)
}

/// Returns whether a results folder contains a checkpoint.
pub(crate) fn exists(results: &Path) -> bool {
    place(results).join(STATE).is_file()
}

/// Checks that a path is a regular file. Reading a pipe would block, and a device may have no end.
fn plain(path: &Path) -> io::Result<()> {
    let kind = fs::metadata(path)?.file_type();
    match (kind.is_file(), kind.is_dir()) {
        (true, _) => Ok(()),
        (_, true) => Err(io::ErrorKind::IsADirectory.into()),
        _ => Err(io::Error::new(io::ErrorKind::InvalidInput, "not a regular file")),
    }
}

/// Removes the checkpoint of a results folder, if there is one. Other files in the checkpoint folder are kept.
///
/// # Errors
/// The operating system returns an error.
pub fn remove(results: &Path) -> io::Result<()> {
    let place = place(results);
    // A folder of this name without these files is not a checkpoint.
    if ![STATE, JOURNAL].iter().any(|name| place.join(name).is_file()) {
        return Ok(());
    }
    sweep(&place, &[STATE, SCENARIO]);
    // The state is removed first, because a checkpoint is only valid with it.
    for name in [STATE, JOURNAL, SCENARIO] {
        match fs::remove_file(place.join(name)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
    }
    match fs::remove_dir(&place) {
        Err(error) if error.kind() != io::ErrorKind::DirectoryNotEmpty => Err(error),
        _ => Ok(()),
    }
}
