//! All pictures of a scenario, and the page that shows those of many.

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

pub use page::{Exhibit, page};

/// An SVG of more bytes is left out: a page of many pictures should not weigh tens of megabytes.
const LARGEST_SVG: usize = 100_000;

/// Why the pictures of a scenario are not there.
#[derive(Debug, Error)]
pub enum GalleryError {
    /// A run that did not come to its end.
    #[error("{name}: {source}\n   help: {}", .source.advice())]
    Stopped {
        /// The scenario.
        name: String,
        /// What the run says.
        source: RunError,
    },
    /// A run that kept too much.
    #[error("{name}: {source}\n   help: {}", .source.advice())]
    Full {
        /// The scenario.
        name: String,
        /// How much.
        source: Excess,
    },
    /// A picture.
    #[error("{name}: {source}")]
    Figure {
        /// The scenario.
        name: String,
        /// What is wrong with it.
        source: Box<FigureError>,
    },
    /// Writing.
    #[error("{}: cannot be written: {}\n   help: choose another place with --out", .path.display(), words(.source))]
    File {
        /// Which file or folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// Runs a scenario and draws its pictures in all looks of the gallery; its tables are kept for as long as that takes.
///
/// # Errors
/// A run that did not come to its end, a picture that cannot be drawn, tables that cannot be written.
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
    // Such a run says that it was interrupted.
    if let Some(source) = outcome.excess {
        return Err(GalleryError::Full { name: job.name.clone(), source });
    }
    if let Some(source) = outcome.error {
        return Err(GalleryError::Stopped { name: job.name.clone(), source });
    }
    drafts.into_iter().try_for_each(|draft| folder.stage(draft.name, draft.file)).map_err(failed)?;
    let sources = Sources { job, kept: &outcome.kept, insides: InsideTables::drafted(&folder) };
    let light =
        Look { formats: vec![Format::Png, Format::Svg], themes: vec![Colours::Light], scale: 1, width: None };
    let dark = Look { formats: vec![Format::Png], themes: vec![Colours::Dark], scale: 1, width: None };
    let mut pictures = Vec::new();
    let undrawn = |source| GalleryError::Figure { name: job.name.clone(), source: Box::new(source) };
    for drawn in [light, dark].iter().flat_map(|look| pictures::draw(&sources, look)) {
        pictures.extend(drawn.map_err(undrawn)?);
    }
    pictures.retain(|(name, bytes)| !name.ends_with(".svg") || bytes.len() <= LARGEST_SVG);
    Ok(pictures)
}

/// Writes the pictures of a scenario in place of those that were there; returns their names.
///
/// # Errors
/// What the system says.
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

    /// It was told as an interruption, with advice to be patient.
    #[test]
    fn a_run_that_keeps_too_much_is_told_as_one() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/p1.json");
        let set = [("run.cycles", "2000"), ("output.every", "\"20 us\"")];
        let set = set.map(|(key, value)| (key.to_owned(), value.to_owned()));
        let mut job = Job::prepare(&file, &set, Path::new("")).unwrap();
        // Less than its pictures take: the estimate beforehand would have refused it.
        job.scenario.memory_limit = Some(1e6);
        let drawn = draw(&job, &());
        assert!(matches!(drawn, Err(GalleryError::Full { .. })));
        let Err(error) = drawn else { return };
        let said = error.to_string();
        assert!(said.starts_with("p1: at t = ") && said.contains("help: raise run.limits.memory"), "{said}");
    }
}
