//! Output folder and journal of a study, and their errors.

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

/// Error that prevents output files.
#[derive(Debug, Error)]
pub(crate) enum OutputFailure {
    /// A plot fails.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The output folder is not usable.
    #[error(transparent)]
    Folder(#[from] Unwritable),
    /// A file cannot be read or written.
    #[error("{}: {}", .path.display(), words(.source))]
    File { path: PathBuf, source: io::Error },
}

/// Output folder of a study.
pub(crate) struct Output {
    pub(crate) path: PathBuf,
    folder: Folder,
}

impl Output {
    /// Prepares the requested folder, or `results/` with the name `own`. Called before the first run, so that errors are found early.
    pub(crate) fn ready(asked: Option<&Path>, own: &str) -> Result<Self, OutputFailure> {
        let path = asked.map_or_else(|| Path::new("results").join(own), Path::to_owned);
        let folder = place::ready(&path)?;
        Ok(Self { path, folder })
    }

    /// Opens the journal of a study whose results depend on `of`. The same command resumes from it after an interruption.
    pub(crate) fn journal(
        &self,
        name: &str,
        of: &impl Serialize,
        is_fresh: bool,
    ) -> Result<Journal, OutputFailure> {
        let path = self.path.join(format!("{name}.journal"));
        Journal::open(path.clone(), of, is_fresh).map_err(|source| OutputFailure::File { path, source })
    }

    /// Writes the files with `write`, which receives the folder and old files to delete. `names` lists all possible
    /// names; temporary files with these names are deleted.
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
