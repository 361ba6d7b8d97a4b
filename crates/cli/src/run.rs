//! One job from start to files.

use crate::figures;
use crate::folder::Folder;
use crate::interrupt::Interrupt;
use crate::job::Job;
use crate::progress::Progress;
use crate::record::{Kept, Recorder};
use crate::report::Report;
use crate::summary::Summary;
use std::io;
use std::time::Instant;
use stickslip_drive::{RunError, State};

/// Name of the resolved scenario among the results.
const SCENARIO: &str = "scenario.json";
/// Name of the summary among the results.
pub(crate) const SUMMARY: &str = "summary.json";

/// What came of a run.
pub(crate) struct Outcome {
    /// Why it ended before its time.
    pub(crate) error: Option<RunError>,
    /// The state at the end.
    pub(crate) state: State,
    pub(crate) kept: Kept,
    /// Wall-clock time of the run alone, s.
    pub(crate) wall: f64,
}

/// Runs a job and writes its results, also those of a run that did not come to its end.
pub(crate) fn run(job: &Job, interrupt: &Interrupt, progress: &Progress) -> Report {
    let folder = match Folder::make(&job.folder) {
        Ok(folder) => folder,
        Err(error) => return Report::no_folder(job, &error),
    };
    match simulate(job, folder, interrupt, progress) {
        Ok(report) => report,
        Err(error) => Report::not_written(job, &error),
    }
}

fn simulate(job: &Job, mut folder: Folder, interrupt: &Interrupt, progress: &Progress) -> io::Result<Report> {
    let bar = progress.start(&job.name, job.scenario.plan.duration);
    let mut recorder = Recorder::new(job, interrupt, &bar, &folder)?;
    let mut state = job.start.clone();
    let begun = Instant::now();
    let result = stickslip_drive::run(&job.model, &job.scenario.plan, &mut state, &mut recorder);
    let wall = begun.elapsed().as_secs_f64();
    let kept = recorder.finish(&mut folder)?;
    drop(bar);
    let outcome = Outcome { error: result.err(), state, kept, wall };
    folder.write(SCENARIO, job.resolved.as_bytes())?;
    let mut summary = Summary::new(job, &outcome);
    for (name, picture) in figures::draw(job, &outcome) {
        match picture {
            Ok(bytes) => folder.write(name, &bytes)?,
            Err(error) => summary.note(format!("{name} was not drawn: {error}")),
        }
    }
    let names = folder.names().into_iter().chain([SUMMARY]).map(str::to_owned).collect();
    summary.set_files(names);
    folder.write(SUMMARY, summary.pretty()?.as_bytes())?;
    folder.publish()?;
    Report::ended(job, &outcome, &summary)
}
