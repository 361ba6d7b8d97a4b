//! Benchmark of one scenario, from the reference solution to the output files.

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

/// Benchmarks one scenario and writes the results into the job's folder. Returns the chapter of the page, if requested. `known` are known
/// coordinates at the end. The watcher receives the seconds of the budget that have passed.
///
/// # Errors
/// A scenario that is not suitable, a reference that fails, a file that cannot be written, or an interruption by the watcher.
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
    let failed = |source| BenchError::File { path: job.folder.clone(), source };
    let mut table = Vec::new();
    sheet::write(&mut table, &families, problem.duration).map_err(failed)?;
    publish(job, &String::from_utf8_lossy(&table))?;
    let chapter = |page: &PathBuf| {
        let work = Work::of(&problem, &families, file, request);
        Chapter::new((job, file), &problem, (&families, work), page)
    };
    request.page.as_ref().map(chapter).transpose().map_err(failed)
}

/// Draws the diagram of a scenario from the existing table in the job's folder.
///
/// # Errors
/// A table that cannot be read, a plot that cannot be drawn, or a file that cannot be written.
pub fn redraw(job: &Job) -> Result<(), BenchError> {
    let path = job.folder.join(TABLE);
    let table = std::fs::read_to_string(&path).map_err(|source| BenchError::File { path, source })?;
    publish(job, &table)
}

/// Writes the table of the runs and its diagram.
fn publish(job: &Job, table: &str) -> Result<(), BenchError> {
    let pictures =
        picture::draw(job, table).map_err(|source| BenchError::Picture { name: job.name.clone(), source })?;
    let failed = |source| BenchError::File { path: job.folder.clone(), source };
    let mut folder = Folder::make(&job.folder).map_err(failed)?;
    folder.write(TABLE, table.as_bytes()).map_err(failed)?;
    pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes)).map_err(failed)?;
    folder.publish().map_err(failed)
}
