//! All pictures of all scenarios of a folder, and the page that shows them.

mod page;

use crate::answer::say;
use crate::arguments::GalleryArguments;
use crate::figures::{self, FigureError, Sources};
use crate::interrupt::Interrupt;
use crate::look::{Colours, Format, Look, Picture};
use crate::progress::Progress;
use crate::verdict::Verdict;
use page::Exhibit;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use stickslip_drive::RunError;
use stickslip_results::Recorder;
use stickslip_results::complaint::words;
use stickslip_results::files::{MEMORY, SPRINGS};
use stickslip_results::folder::Folder;
use stickslip_results::{Job, Refusal};
use thiserror::Error;

/// Name of the page.
const PAGE: &str = "README.md";
/// An SVG of more bytes is left out: a page of many pictures should not weigh tens of megabytes.
const LARGEST_SVG: usize = 100_000;

/// Why the gallery is not complete.
#[derive(Debug, Error)]
enum GalleryFailure {
    /// A scenario.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A folder without scenarios.
    #[error("{}: has no scenarios, files NAME.json\n   help: name another folder with --scenarios", .0.display())]
    Nothing(PathBuf),
    /// A run that did not come to its end.
    #[error("{name}: {source}\n   help: {}", .source.advice())]
    Stopped { name: String, source: RunError },
    /// A picture.
    #[error("{name}: {source}")]
    Figure { name: String, source: Box<FigureError> },
    /// No folder of scenarios.
    #[error("{}: expected a folder of scenarios: {}\n   help: name one with --scenarios", .path.display(), words(.source))]
    NoFolder { path: PathBuf, source: io::Error },
    /// Writing.
    #[error("{}: cannot be written: {}\n   help: choose another place with --out", .path.display(), words(.source))]
    File { path: PathBuf, source: io::Error },
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
            let _ = writeln!(io::stderr(), "{failure}");
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
        let pictures = draw(job, &interrupt, &progress)?;
        let failed = |source| GalleryFailure::File { path: job.folder.clone(), source };
        let names = write(&job.folder, &pictures).map_err(failed)?;
        exhibits.push(Exhibit::new(job, file, names));
    }
    let failed = |source| GalleryFailure::File { path: arguments.out.join(PAGE), source };
    let mut folder = Folder::make(&arguments.out).map_err(failed)?;
    let text = page::text(&exhibits, arguments).map_err(failed)?;
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

/// Runs a scenario and draws its pictures in all looks of the gallery; its tables are kept for as long as that takes.
fn draw(job: &Job, interrupt: &Interrupt, progress: &Progress) -> Result<Vec<Picture>, GalleryFailure> {
    let failed = |source| GalleryFailure::File { path: job.folder.clone(), source };
    let tables = tempfile::tempdir().map_err(failed)?;
    let mut folder = Folder::make(tables.path()).map_err(failed)?;
    let bar = progress.start(&job.name, job.scenario.plan.duration, interrupt);
    let recorder = Recorder::new(job, &bar).fingerprinted();
    let recorder = recorder.with_tables(&folder).map_err(failed)?;
    let (outcome, drafts) = job.run_recorded(recorder).map_err(failed)?;
    drop(bar);
    if let Some(source) = outcome.error {
        return Err(GalleryFailure::Stopped { name: job.name.clone(), source });
    }
    drafts.into_iter().try_for_each(|(name, draft)| folder.stage(name, draft)).map_err(failed)?;
    let (springs, memory) = (folder.place(SPRINGS), folder.place(MEMORY));
    let sources = Sources { job, kept: &outcome.kept, springs, memory };
    let light = Look { formats: vec![Format::Png, Format::Svg], theme: Colours::Light, scale: 1 };
    let dark = Look { formats: vec![Format::Png], theme: Colours::Dark, scale: 1 };
    let mut pictures = Vec::new();
    let undrawn = |source| GalleryFailure::Figure { name: job.name.clone(), source: Box::new(source) };
    for drawn in [light, dark].iter().flat_map(|look| figures::draw(&sources, look)) {
        pictures.extend(drawn.map_err(undrawn)?);
    }
    pictures.retain(|(name, bytes)| !name.ends_with(".svg") || bytes.len() <= LARGEST_SVG);
    Ok(pictures)
}

/// Writes the pictures of a scenario in place of those that were there.
fn write(path: &Path, pictures: &[Picture]) -> io::Result<Vec<String>> {
    let mut folder = Folder::make(path)?;
    pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes))?;
    folder.forget(Look::all_files());
    let names = folder.names();
    folder.publish()?;
    Ok(names)
}

impl GalleryFailure {
    fn verdict(&self) -> Verdict {
        match self {
            Self::Refused(_) | Self::Nothing(_) | Self::NoFolder { .. } => Verdict::BadInput,
            Self::Stopped { source: RunError::Interrupted { .. }, .. } => Verdict::Interrupted,
            Self::Stopped { .. } | Self::Figure { .. } | Self::File { .. } => Verdict::Stopped,
        }
    }
}
