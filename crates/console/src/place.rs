//! Output folder of a command that writes files only at its end.

use std::io;
use std::path::{Path, PathBuf};
use stickslip_run::complaint::words;
use stickslip_run::folder::Folder;
use thiserror::Error;

/// Disk space reserved in advance, in bytes. The space suffices for the results of a curve with a few hundred points and its plot.
const RESERVE: usize = 1 << 18;

/// Error for a folder that cannot be written to.
#[derive(Debug, Error)]
#[error("{}: this folder cannot be written: {}\n   help: choose another folder with --out", .path.display(), words(.source))]
pub struct Unwritable {
    path: PathBuf,
    source: io::Error,
}

/// Creates an output folder and checks that it is writable before the computation starts.
///
/// # Errors
/// The folder cannot be written to.
pub fn ready(path: &Path) -> Result<Folder, Unwritable> {
    Folder::ready(path, RESERVE).map_err(|source| Unwritable { path: path.to_owned(), source })
}
