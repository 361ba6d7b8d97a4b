//! `stickslip-lab gallery`: all pictures of all scenarios of a folder, and the page that shows them.

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

/// Name of the page.
const PAGE: &str = "README.md";

/// Why the gallery is not complete.
#[derive(Debug, Error)]
enum GalleryFailure {
    /// A scenario.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A folder without scenarios.
    #[error("{}: has no scenarios, files NAME.json\n   help: name another folder with --scenarios", .0.display())]
    Nothing(PathBuf),
    /// No folder of scenarios.
    #[error("{}: expected a folder of scenarios: {}\n   help: name one with --scenarios", .path.display(), words(.source))]
    NoFolder { path: PathBuf, source: io::Error },
    /// Pictures that are not there.
    #[error(transparent)]
    Gallery(#[from] GalleryError),
}

/// Draws the gallery. Its page is written when all its pictures are there.
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
    // All are read before the first is run.
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
    let text = gallery::page(&exhibits, &arguments.scenarios, &arguments.out).map_err(failed)?;
    folder.write(PAGE, text.as_bytes()).and_then(|()| folder.publish()).map_err(failed)?;
    Ok(exhibits)
}

/// The scenarios of a folder, by name.
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
