//! One job from start to files.

use crate::books::Books;
use crate::figures::{self, Sources};
use crate::folder::Folder;
use crate::insides::{MEMORY, SPRINGS};
use crate::interrupt::Interrupt;
use crate::job::Job;
use crate::kept::Kept;
use crate::look::Look;
use crate::progress::Progress;
use crate::record::{Draft, Recorded, Recorder};
use crate::report::Report;
use crate::summary::Summary;
use std::io;
use std::time::Instant;
use stickslip_drive::{RunError, State};

/// Name of the resolved scenario among the results.
pub(crate) const SCENARIO: &str = "scenario.json";
/// Name of the summary among the results.
pub(crate) const SUMMARY: &str = "summary.json";

/// What came of a run.
pub(crate) struct Outcome {
    /// Why it ended before its time.
    pub(crate) error: Option<RunError>,
    /// The state at the end.
    pub(crate) state: State,
    pub(crate) kept: Kept,
    /// Energies.
    pub(crate) books: Books,
    /// Number of rows of the trace.
    pub(crate) rows: u64,
    /// Wall-clock time of the run alone, s.
    pub(crate) wall: f64,
}

/// Runs a job and writes its results, also those of a run that did not come to its end.
pub(crate) fn run(job: &Job, look: &Look, interrupt: &Interrupt, progress: &Progress) -> Report {
    let folder = match Folder::make(&job.folder) {
        Ok(folder) => folder,
        Err(error) => return Report::no_folder(job, &error),
    };
    let bar = progress.start(&job.name, job.scenario.plan.duration);
    let recorder = Recorder::new(job, interrupt, &bar);
    let recorder = if job.scenario.plots.is_empty() { recorder } else { recorder.fingerprinted() };
    let report = recorder.with_tables(&folder).and_then(|recorder| {
        let (outcome, drafts) = simulate(job, recorder)?;
        write(job, look, folder, (&outcome, drafts))
    });
    report.unwrap_or_else(|error| Report::not_written(job, &error))
}

/// Runs a job; returns the tables as well, where the recorder writes any.
pub(crate) fn simulate(job: &Job, mut recorder: Recorder<'_>) -> io::Result<(Outcome, Vec<Draft>)> {
    let mut state = job.start.clone();
    let begun = Instant::now();
    let result = stickslip_drive::run(&job.model, &job.scenario.plan, &mut state, &mut recorder);
    let wall = begun.elapsed().as_secs_f64();
    let Recorded { kept, books, rows, drafts } = recorder.finish()?;
    Ok((Outcome { error: result.err(), state, kept, books, rows, wall }, drafts))
}

/// Writes what comes beside the tables, and gives all files their names.
pub(crate) fn write(
    job: &Job,
    look: &Look,
    mut folder: Folder,
    (outcome, drafts): (&Outcome, Vec<Draft>),
) -> io::Result<Report> {
    drafts.into_iter().try_for_each(|(name, draft)| folder.stage(name, draft))?;
    folder.write(SCENARIO, job.resolved.as_bytes())?;
    let mut summary = Summary::new(job, outcome);
    let (springs, memory) = (folder.place(SPRINGS), folder.place(MEMORY));
    for pictures in figures::draw(&Sources { job, kept: &outcome.kept, springs, memory }, look) {
        match pictures {
            Ok(pictures) => pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes))?,
            Err(error) => summary.note(error.to_string()),
        }
    }
    let optional = [SPRINGS, MEMORY].map(str::to_owned);
    folder.forget(optional.into_iter().chain(Look::all_files()).collect());
    let names = folder.names().into_iter().chain([SUMMARY.to_owned()]).collect();
    summary.set_files(names);
    folder.write(SUMMARY, summary.pretty()?.as_bytes())?;
    folder.publish()?;
    Report::ended(job, outcome, &summary)
}
