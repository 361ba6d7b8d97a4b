//! `stickslip run`: runs scenarios one after another or in parallel.

mod pace;
mod report;
mod scenario;

use crate::arguments::{ConductArguments, RunArguments};
use rayon::prelude::*;
use std::collections::{HashMap, HashSet};
use std::fmt::Display;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::verdict::Verdict;
use stickslip_run::checkpoint::{CheckpointError, Resumption};
use stickslip_run::{Job, Refusal};

pub(crate) use report::Report;
pub(crate) use scenario::{Beginning, Conduct, run as run_job, write};

/// A job with its kind of start.
pub(crate) type Task = (Job, Beginning);

/// Prepares and runs all scenarios. Returns the worst exit status. A rejected file does not prevent the other runs.
pub(crate) fn run(arguments: &RunArguments) -> Verdict {
    if arguments.resume.is_empty() {
        conduct(&arguments.conduct, arguments.realtime, || prepare(arguments))
    } else {
        conduct(&arguments.conduct, false, || resumptions(arguments))
    }
}

/// Reads and checks all checkpoints before the first run is resumed.
fn resumptions(arguments: &RunArguments) -> Vec<Result<Task, CheckpointError>> {
    let mut taken = HashSet::new();
    let mut prepare = |folder: &PathBuf| {
        let (job, resumption) = Resumption::read(folder, &arguments.set)?;
        // Two runs in one folder would damage each other's journal.
        if !taken.insert(folder.canonicalize().unwrap_or_else(|_| folder.clone())) {
            return Err(CheckpointError::Twice(folder.clone()));
        }
        Ok((job, Beginning::Resumed(Box::new(resumption), arguments.checkpoint_every)))
    };
    arguments.resume.iter().map(&mut prepare).collect()
}

/// Runs all tasks that were not rejected.
fn conduct<E: Display + Send>(
    arguments: &ConductArguments,
    realtime: bool,
    prepare: impl FnOnce() -> Vec<Result<Task, E>>,
) -> Verdict {
    let interrupt = Interrupt::install();
    let progress = Progress::new(!arguments.quiet);
    let tasks = prepare();
    let look = arguments.look.look();
    let console = Console { arguments, progress: &progress, waiting: Mutex::default() };
    let work = |(place, task): (usize, Result<Task, E>)| {
        let report = match task {
            Err(refusal) => Report::refused(&refusal),
            Ok((job, _)) if interrupt.is_raised() => Report::skipped(&job),
            Ok((job, beginning)) => {
                let conduct = Conduct { look: &look, interrupt: &interrupt, progress: &progress, realtime };
                scenario::run(&job, beginning, &conduct)
            }
        };
        let report = if arguments.strict { report.judged_strictly() } else { report };
        let verdict = report.verdict;
        console.print(place, report);
        verdict
    };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = usize::from(arguments.threads).min(cores).min(tasks.len());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let worst = match pool {
        Ok(pool) if threads > 1 => {
            let tasks = tasks.into_par_iter().enumerate().with_max_len(1);
            pool.install(|| tasks.map(work).max())
        }
        // Without threads, the tasks run one after another.
        _ => tasks.into_iter().enumerate().map(work).max(),
    };
    worst.unwrap_or(Verdict::Done)
}

/// Reads and checks all scenarios before the first run.
fn prepare(arguments: &RunArguments) -> Vec<Result<Task, Refusal>> {
    let mut taken: HashMap<PathBuf, PathBuf> = HashMap::new();
    let beginning = |job: &Job| match arguments.checkpoint_every {
        None => Ok(Beginning::Plain),
        Some(every) => job.check_checkpoints().map(|()| Beginning::Checkpoints(every)),
    };
    let prepare = |file: &PathBuf| {
        let job = Job::prepare(file, &arguments.set, &arguments.out)?;
        let beginning = beginning(&job)?;
        if !arguments.conduct.quiet {
            warn(&job);
        }
        match taken.insert(job.folder.clone(), file.clone()) {
            None => Ok((job, beginning)),
            Some(other) => Err(Refusal::SameFolder { file: file.clone(), folder: job.folder, other }),
        }
    };
    arguments.files.iter().map(prepare).collect()
}

/// Prints reports in the order of the files.
struct Console<'a> {
    arguments: &'a ConductArguments,
    progress: &'a Progress,
    waiting: Mutex<Waiting>,
}

#[derive(Default)]
struct Waiting {
    next: usize,
    reports: HashMap<usize, Report>,
}

impl Waiting {
    fn take_next(&mut self) -> Option<Report> {
        let report = self.reports.remove(&self.next)?;
        self.next += 1;
        Some(report)
    }
}

impl Console<'_> {
    fn print(&self, place: usize, report: Report) {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.reports.insert(place, report);
        while let Some(report) = waiting.take_next() {
            self.progress.aside(|| self.write(&report));
        }
    }

    fn write(&self, report: &Report) {
        if !report.warning.is_empty() && (self.arguments.strict || !self.arguments.quiet) {
            complain(format_args!("{}", report.warning));
        }
        if !report.error.is_empty() {
            complain(format_args!("{}", report.error));
        }
        match self.arguments {
            ConductArguments { json: true, .. } if !report.json.is_empty() => say_json(&report.json),
            ConductArguments { json: true, .. } | ConductArguments { quiet: true, .. } => {}
            _ if !report.result.is_empty() => say(format_args!("{}", report.result)),
            _ => {}
        }
    }
}
