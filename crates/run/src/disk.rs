//! File system operations for publishing results. The trait [`Disk`] allows tests to simulate failures of the file system.

use std::fmt::Debug;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;
use tempfile::NamedTempFile;

/// File system operations.
pub(crate) trait Disk: Debug + Send {
    /// Writes bytes to a temporary file.
    fn write(&self, file: &mut NamedTempFile, bytes: &[u8]) -> io::Result<()>;
    /// Flushes a file to disk.
    fn sync(&self, file: &File) -> io::Result<()>;
    /// Flushes the entries of a folder to disk.
    fn sync_folder(&self, path: &Path) -> io::Result<()>;
    /// Renames a temporary file and replaces an existing file.
    fn rename(&self, file: NamedTempFile, path: &Path) -> io::Result<()>;
    /// Removes a file.
    fn remove(&self, path: &Path) -> io::Result<()>;
}

/// File system of the operating system.
#[derive(Debug, Clone, Copy)]
pub(crate) struct System;

impl Disk for System {
    fn write(&self, file: &mut NamedTempFile, bytes: &[u8]) -> io::Result<()> {
        file.write_all(bytes)
    }

    fn sync(&self, file: &File) -> io::Result<()> {
        file.sync_all()
    }

    fn sync_folder(&self, path: &Path) -> io::Result<()> {
        // Only Unix systems can open a folder as a file.
        if cfg!(unix) { File::open(path)?.sync_all() } else { Ok(()) }
    }

    fn rename(&self, file: NamedTempFile, path: &Path) -> io::Result<()> {
        file.persist(path).map(|_| ()).map_err(|error| error.error)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }
}
