//! Runs that can go on after they were ended, whatever ended them.
//!
//! Beside its results such a run keeps a folder [`FOLDER`] with three files: the scenario, resolved; the `journal`, all
//! that the record was told so far; and the state (in a `stub`), which counts it off and is replaced as a whole. To go on,
//! a run reads the state, tells the journal to a fresh recorder up to where the state counts, cuts off the rest and steps on:
//! nothing of its results knows that it was ever interrupted. The state is taken between two steps, where a run may stand as
//! long as it likes; none is forced for its sake.
//!
//! [`Keeper`] is the run that keeps them, [`Resumption`] the one that goes on; [`model_key`] says which scenarios have states
//! in common.

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

/// Folder of the checkpoint in that of the results.
pub const FOLDER: &str = "checkpoint";
/// The state and what else a run needs to go on: the last file to be written, replaced as a whole.
const STATE: &str = "state";
/// What the record was told.
const JOURNAL: &str = "journal";

/// Where the checkpoint of results lies.
fn place(results: &Path) -> PathBuf {
    results.join(FOLDER)
}

/// Whether there is one in a folder of results.
pub(crate) fn exists(results: &Path) -> bool {
    place(results).join(STATE).is_file()
}

/// Refuses what is there and no plain file: a pipe would be waited for, a device read without end.
fn plain(path: &Path) -> io::Result<()> {
    let kind = fs::metadata(path)?.file_type();
    match (kind.is_file(), kind.is_dir()) {
        (true, _) => Ok(()),
        (_, true) => Err(io::ErrorKind::IsADirectory.into()),
        _ => Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a plain file")),
    }
}

/// Removes the checkpoint of a folder of results, if there is one; whatever else lies beside its files stays.
///
/// # Errors
/// What the system says.
pub fn remove(results: &Path) -> io::Result<()> {
    let place = place(results);
    // A folder of that name may be somebody else's.
    if ![STATE, JOURNAL].iter().any(|name| place.join(name).is_file()) {
        return Ok(());
    }
    sweep(&place, &[STATE, SCENARIO]);
    // Without its state the rest is nothing that could be gone on from.
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
