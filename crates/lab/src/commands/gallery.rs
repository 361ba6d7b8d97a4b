//! `stickslip-lab gallery`: draws all plots of all scenarios in a folder and writes the pages that show them.

use crate::arguments::GalleryArguments;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_console::answer::{complain, say};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::verdict::Verdict;
use stickslip_drive::RunError;
use stickslip_figures::gallery::{self, Exhibit, GalleryError};
use stickslip_run::complaint::words;
use stickslip_run::folder::Folder;
use stickslip_run::{Job, Refusal};
use thiserror::Error;

/// File name of the index page.
const PAGE: &str = "index.md";

/// Error that stops the command.
#[derive(Debug, Error)]
enum GalleryFailure {
    /// A scenario is rejected.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The folder has no scenarios.
    #[error("{}: contains no scenario files NAME.json\n   help: name another folder with --scenarios", .0.display())]
    Nothing(PathBuf),
    /// The folder cannot be read.
    #[error("{}: expected a folder of scenarios: {}\n   help: name one with --scenarios", .path.display(), words(.source))]
    NoFolder { path: PathBuf, source: io::Error },
    /// Plots or pages fail.
    #[error(transparent)]
    Gallery(#[from] GalleryError),
}

/// Draws the gallery. The pages are written when all plots are complete.
pub(crate) fn gallery(arguments: &GalleryArguments) -> Verdict {
    match hang(arguments) {
        Ok(exhibits) => {
            if !arguments.quiet {
                let pictures: usize = exhibits.iter().map(|exhibit| exhibit.plots.len()).sum();
                let (out, scenarios) = (arguments.out.display(), exhibits.len());
                say(format_args!("{out}: {pictures} pictures of {scenarios} scenarios, {PAGE}"));
            }
            Verdict::Done
        }
        Err(failure) => {
            complain(format_args!("{failure}"));
            failure.verdict()
        }
    }
}

fn hang(arguments: &GalleryArguments) -> Result<Vec<Exhibit>, GalleryFailure> {
    let (interrupt, progress) = (Interrupt::install(), Progress::new(!arguments.quiet));
    // Read all scenarios before the first run.
    let jobs = scenarios(&arguments.scenarios)?
        .into_iter()
        .map(|file| Ok((Job::prepare(&file, &[], &arguments.out)?, file)))
        .collect::<Result<Vec<(Job, PathBuf)>, GalleryFailure>>()?;
    let mut exhibits = Vec::new();
    for (job, file) in &jobs {
        let bar = progress.start(&job.name, [0.0, job.scenario.plan.duration], &interrupt);
        let pictures = gallery::draw(job, &bar)?;
        drop(bar);
        let failed = |source| GalleryError::File { path: job.folder.clone(), source };
        let names = gallery::write(&job.folder, &pictures).map_err(failed)?;
        exhibits.push(Exhibit::new(job, file, names));
    }
    let failed = |source| GalleryError::File { path: arguments.out.join(PAGE), source };
    let mut folder = Folder::make(&arguments.out).map_err(failed)?;
    let pages = gallery::pages(&exhibits, &arguments.scenarios, &arguments.out).map_err(failed)?;
    pages.iter().try_for_each(|(name, text)| folder.write(name, text.as_bytes())).map_err(failed)?;
    folder.publish().map_err(failed)?;
    Ok(exhibits)
}

/// Returns the scenario files of a folder, sorted by name.
fn scenarios(folder: &Path) -> Result<Vec<PathBuf>, GalleryFailure> {
    let failed = |source| GalleryFailure::NoFolder { path: folder.to_owned(), source };
    let entries = fs::read_dir(folder).map_err(failed)?.collect::<io::Result<Vec<_>>>().map_err(failed)?;
    let paths = entries.iter().map(fs::DirEntry::path);
    let mut files: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "json")).collect();
    files.sort();
    if files.is_empty() { Err(GalleryFailure::Nothing(folder.to_owned())) } else { Ok(files) }
}

impl GalleryFailure {
    fn verdict(&self) -> Verdict {
        match self {
            Self::Refused(_) | Self::Nothing(_) | Self::NoFolder { .. } => Verdict::BadInput,
            Self::Gallery(GalleryError::Stopped { source: RunError::Interrupted { .. }, .. }) => {
                Verdict::Interrupted
            }
            Self::Gallery(_) => Verdict::Stopped,
        }
    }
}
