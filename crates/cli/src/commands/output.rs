//! The files of a study: where they go, the journal beside them, and what may go wrong with both.

use serde::Serialize;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_console::place::{self, Unwritable};
use stickslip_console::verdict::Verdict;
use stickslip_figures::FigureError;
use stickslip_run::complaint::words;
use stickslip_run::folder::{Folder, sweep};
use stickslip_study::Journal;
use thiserror::Error;

/// Why there are no files.
#[derive(Debug, Error)]
pub(crate) enum OutputFailure {
    /// The picture.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// Where the files are to go.
    #[error(transparent)]
    Folder(#[from] Unwritable),
    /// A file.
    #[error("{}: {}", .path.display(), words(.source))]
    File { path: PathBuf, source: io::Error },
}

/// A folder that is to hold the files of a study.
pub(crate) struct Output {
    pub(crate) path: PathBuf,
    folder: Folder,
}

impl Output {
    /// The folder that is asked for, or a folder of results; tried before the first run.
    pub(crate) fn ready(asked: Option<&Path>, own: &str) -> Result<Self, OutputFailure> {
        let path = asked.map_or_else(|| Path::new("results").join(own), Path::to_owned);
        let folder = place::ready(&path)?;
        Ok(Self { path, folder })
    }

    /// The journal of a study whose results depend on `of`, from which the same command continues after a kill.
    pub(crate) fn journal(
        &self,
        name: &str,
        of: &impl Serialize,
        is_fresh: bool,
    ) -> Result<Journal, OutputFailure> {
        let path = self.path.join(format!("{name}.journal"));
        Journal::open(path.clone(), of, is_fresh).map_err(|source| OutputFailure::File { path, source })
    }

    /// Writes the files, which may have any of these names, by what takes the folder and the names that are none of it; drafts that a killed
    /// command has left go.
    pub(crate) fn write(
        mut self,
        names: impl Iterator<Item = String>,
        stale: Vec<String>,
        write: impl FnOnce(Folder, Vec<String>) -> io::Result<Vec<String>>,
    ) -> Result<Vec<String>, OutputFailure> {
        self.folder.release();
        sweep(&self.path, &names.chain(stale.iter().cloned()).collect::<Vec<_>>());
        write(self.folder, stale).map_err(|source| OutputFailure::File { path: self.path, source })
    }
}

impl OutputFailure {
    pub(crate) fn verdict(&self) -> Verdict {
        match self {
            Self::Folder(_) => Verdict::BadInput,
            Self::Figure(_) | Self::File { .. } => Verdict::Stopped,
        }
    }
}
