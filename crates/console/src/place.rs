//! Where the files of a command go that come only after long work.

use std::io;
use std::path::{Path, PathBuf};
use stickslip_run::complaint::words;
use stickslip_run::folder::Folder;
use thiserror::Error;

/// Bytes of the disk that are kept for the files from the beginning on: a curve of a few hundred points with its picture.
const RESERVE: usize = 1 << 18;

/// A place that nothing can be written into.
#[derive(Debug, Error)]
#[error("{}: cannot be written into: {}\n   help: choose another place with --out", .path.display(), words(.source))]
pub struct Unwritable {
    path: PathBuf,
    source: io::Error,
}

/// A folder, tried before the work begins whose results it is for.
///
/// # Errors
/// One that nothing can be written into.
pub fn ready(path: &Path) -> Result<Folder, Unwritable> {
    Folder::ready(path, RESERVE).map_err(|source| Unwritable { path: path.to_owned(), source })
}
