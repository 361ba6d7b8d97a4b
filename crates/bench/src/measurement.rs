//! The measurement of one scenario, from its reference to its files.

use crate::error::BenchError;
use crate::page::Chapter;
use crate::problem::{Known, Problem};
use crate::request::Request;
use crate::work::Work;
use crate::{family, picture, sheet, turns};
use std::path::{Path, PathBuf};
use stickslip_run::folder::Folder;
use stickslip_run::{Job, Watcher};

/// Name of the table.
pub const TABLE: &str = "bench.csv";

/// Measures one scenario and writes what was found into the job's folder; gives its chapter of the page, where one is asked
/// for. `known` are coordinates at its end; the watcher is told the seconds of the budget that are spent.
///
/// # Errors
/// A scenario without anything to measure, a reference that cannot be computed, a file that cannot be written, or the
/// watcher's wish.
pub fn measure(
    (job, file): (&Job, &Path),
    known: &[Known],
    request: &Request,
    watcher: &dyn Watcher,
) -> Result<Option<Chapter>, BenchError> {
    let problem = Problem::new(job, known, watcher)?;
    let mut families = family::families(&problem);
    turns::measure(&problem, &mut families, request.budget, watcher)
        .map_err(|stop| BenchError::of_stop(stop, &job.name))?;
    let pictures = picture::draw(job, &problem, &families)
        .map_err(|source| BenchError::Picture { name: job.name.clone(), source })?;
    let failed = |source| BenchError::File { path: job.folder.clone(), source };
    let mut folder = Folder::make(&job.folder).map_err(failed)?;
    let mut table = folder.draft(TABLE).map_err(failed)?;
    sheet::write(&mut table, &families, problem.duration).map_err(failed)?;
    folder.stage(TABLE, table).map_err(failed)?;
    pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes)).map_err(failed)?;
    folder.publish().map_err(failed)?;
    let chapter = |page: &PathBuf| {
        let work = Work::of(&problem, &families, file, request);
        Chapter::new((job, file), &problem, (&families, work), page)
    };
    request.page.as_ref().map(chapter).transpose().map_err(failed)
}
