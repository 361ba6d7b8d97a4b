//! All plots of scenarios, and Markdown pages that show them.

mod page;

use crate::look::{Colours, Format, Look, Picture};
use crate::pictures::{self, FigureError, Sources};
use std::io;
use std::path::{Path, PathBuf};
use stickslip_drive::RunError;
use stickslip_run::complaint::words;
use stickslip_run::files::InsideTables;
use stickslip_run::folder::Folder;
use stickslip_run::{Excess, Job, Recorder, Watcher};
use thiserror::Error;

pub use page::{Exhibit, Page, pages};

/// Maximum size of an SVG, bytes; larger ones are left out to keep the pages small.
const LARGEST_SVG: usize = 100_000;

/// Reason why the plots of a scenario are missing.
#[derive(Debug, Error)]
pub enum GalleryError {
    /// The run ended early.
    #[error("{name}: {source}\n   help: {}", .source.advice())]
    Stopped {
        /// Name of the scenario.
        name: String,
        /// Error of the run.
        source: RunError,
    },
    /// The run exceeded its memory limit.
    #[error("{name}: {source}\n   help: {}", .source.advice())]
    Full {
        /// Name of the scenario.
        name: String,
        /// Amount of memory.
        source: Excess,
    },
    /// A plot was not drawn.
    #[error("{name}: {source}")]
    Figure {
        /// Name of the scenario.
        name: String,
        /// Error of the plot.
        source: Box<FigureError>,
    },
    /// A file cannot be written.
    #[error("{}: cannot be written: {}\n   help: choose another folder with --out", .path.display(), words(.source))]
    File {
        /// File or folder.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
}

/// Runs a scenario and draws its plots in all formats and colours of the gallery. Its tables are temporary.
///
/// # Errors
/// If the run ends early, if a plot cannot be drawn, or if tables cannot be written.
pub fn draw(job: &Job, watcher: &dyn Watcher) -> Result<Vec<Picture>, GalleryError> {
    let failed = |source| GalleryError::File { path: job.folder.clone(), source };
    let tables = tempfile::tempdir().map_err(failed)?;
    let mut folder = Folder::make(tables.path()).map_err(failed)?;
    let recorder = Recorder::new(job, watcher).fingerprinted();
    let recorder = recorder.with_tables(&folder).map_err(failed)?;
    let (outcome, drafts) = job.run_recorded(recorder).map_err(failed)?;
    if let Some(failure) = outcome.failure {
        return Err(failed(failure));
    }
    // A run beyond its memory limit also reports that it was interrupted.
    if let Some(source) = outcome.excess {
        return Err(GalleryError::Full { name: job.name.clone(), source });
    }
    if let Some(source) = outcome.error {
        return Err(GalleryError::Stopped { name: job.name.clone(), source });
    }
    drafts.into_iter().try_for_each(|draft| folder.stage(draft.name, draft.file)).map_err(failed)?;
    let sources = Sources { job, kept: &outcome.kept, insides: InsideTables::drafted(&folder) };
    let light = Look { formats: vec![Format::Png, Format::Svg], ..Look::default() };
    let dark = Look { themes: vec![Colours::Dark], ..Look::default() };
    let mut pictures = Vec::new();
    let undrawn = |source| GalleryError::Figure { name: job.name.clone(), source: Box::new(source) };
    for drawn in [light, dark].iter().flat_map(|look| pictures::draw(&sources, look)) {
        pictures.extend(drawn.map_err(undrawn)?);
    }
    pictures.retain(|(name, bytes)| !name.ends_with(".svg") || bytes.len() <= LARGEST_SVG);
    Ok(pictures)
}

/// Writes the plots of a scenario, replaces earlier ones, and returns the names of the files.
///
/// # Errors
/// If the folder cannot be written.
pub fn write(path: &Path, pictures: &[Picture]) -> io::Result<Vec<String>> {
    let mut folder = Folder::make(path)?;
    pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes))?;
    folder.forget(Look::all_files());
    let names = folder.names();
    folder.publish()?;
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run beyond its memory limit is not reported as interrupted.
    #[test]
    fn a_run_that_keeps_too_much_is_told_as_one() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/p1.json");
        let set = [("run.cycles", "2000"), ("output.every", "\"20 us\"")];
        let set = set.map(|(key, value)| (key.to_owned(), value.to_owned()));
        let mut job = Job::prepare(&file, &set, Path::new("")).unwrap();
        // Less than the plots need. The estimate before the run would have refused it.
        job.scenario.memory_limit = Some(1e6);
        let drawn = draw(&job, &());
        assert!(matches!(drawn, Err(GalleryError::Full { .. })));
        let Err(error) = drawn else { return };
        let said = error.to_string();
        assert!(
            said.starts_with("p1: at t = ") && said.contains("help: increase run.limits.memory"),
            "{said}"
        );
    }
}
