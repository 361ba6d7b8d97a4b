//! One job from start to files.

use super::report::Report;
use crate::console::interrupt::Interrupt;
use crate::console::progress::Progress;
use std::io;
use stickslip_figures::{Look, Sources};
use stickslip_results::files::{MEMORY, SCENARIO, SPRINGS, SUMMARY};
use stickslip_results::folder::Folder;
use stickslip_results::{Draft, Job, Outcome, Recorder, Summary};

/// Runs a job and writes its results, also those of a run that did not come to its end.
pub(crate) fn run(job: &Job, look: &Look, interrupt: &Interrupt, progress: &Progress) -> Report {
    let folder = match Folder::make(&job.folder) {
        Ok(folder) => folder,
        Err(error) => return Report::no_folder(job, &error),
    };
    let bar = progress.start(&job.name, job.scenario.plan.duration, interrupt);
    let recorder = Recorder::new(job, &bar);
    let recorder = if job.scenario.plots.is_empty() { recorder } else { recorder.fingerprinted() };
    let report = recorder.with_tables(&folder).and_then(|recorder| {
        let (outcome, drafts) = job.run_recorded(recorder)?;
        write(job, look, folder, (&outcome, drafts))
    });
    report.unwrap_or_else(|error| Report::not_written(job, &error))
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
    for pictures in stickslip_figures::draw(&Sources { job, kept: &outcome.kept, springs, memory }, look) {
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
