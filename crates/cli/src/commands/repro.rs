//! `stickslip repro`: repeats the run stored in a plot file and compares the results.

use crate::arguments::ReproArguments;
use crate::commands::run;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_console::answer::{complain, say};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::verdict::Verdict;
use stickslip_drive::RunError;
use stickslip_figures::{Origin, OriginError};
use stickslip_run::complaint::words;
use stickslip_run::fingerprint::{Difference, Differing, Fingerprint};
use stickslip_run::folder::Folder;
use stickslip_run::program::this_program;
use stickslip_run::{Recorder, SynopsisError, check_published};
use thiserror::Error;

/// Maximum number of differences shown per table.
const SHOWN: usize = 5;

/// Reason why nothing was compared.
#[derive(Debug, Error)]
enum ReproFailure {
    /// The plot file cannot be read.
    #[error(transparent)]
    Origin(#[from] OriginError),
    /// The folder of the plot has incomplete results.
    #[error(transparent)]
    Folder(#[from] SynopsisError),
    /// The results cannot be written.
    #[error("{}: the results cannot be written: {}", .folder.display(), words(.source))]
    Write { folder: PathBuf, source: io::Error },
    /// The run reached its time limit.
    #[error("{}: {error}, nothing compared\n   help: allow more time with --wall", .picture.display())]
    OutOfTime { picture: PathBuf, error: RunError },
    /// The run was interrupted.
    #[error("{}: interrupted, nothing compared", .0.display())]
    Interrupted(PathBuf),
}

/// Repeats the run of a plot file and compares the results.
pub(crate) fn repro(arguments: &ReproArguments) -> Verdict {
    match compare(arguments) {
        Ok(true) => Verdict::Done,
        Ok(false) => Verdict::Differs,
        Err(failure) => {
            complain(format_args!("{failure}"));
            match failure {
                ReproFailure::Origin(_) | ReproFailure::Folder(_) => Verdict::BadInput,
                ReproFailure::Write { .. } | ReproFailure::OutOfTime { .. } => Verdict::Stopped,
                ReproFailure::Interrupted(_) => Verdict::Interrupted,
            }
        }
    }
}

fn compare(arguments: &ReproArguments) -> Result<bool, ReproFailure> {
    let file = &arguments.file;
    // In a folder with incomplete results, the plot may be from an earlier run.
    check_published(file.parent().unwrap_or(Path::new("")))?;
    let mut origin = Origin::read(file, arguments.out.as_deref())?;
    origin.job.scenario.plan.limits.wall = arguments.wall;
    let this = this_program();
    if origin.program != this {
        complain(format_args!("{}: note: computed by {}, this is {this}", file.display(), origin.program));
    }
    let again = run_again(&origin, arguments)?;
    let (trace, events) = (&origin.fingerprint.trace, &origin.fingerprint.events);
    let found = [
        lines(&trace.differences(&again.trace), "channel ", "rows"),
        lines(&events.differences(&again.events), "events' ", "events"),
    ];
    let found = found.concat();
    if !arguments.quiet {
        let end = if origin.is_whole() { String::new() } else { format!(" until t = {} s", origin.end) };
        let count =
            format!("{} rows of {} channels, {} events{end}", trace.rows, trace.columns.len(), events.rows);
        let said = if found.is_empty() { format!("identical: {count}") } else { found.join("\n   ") };
        say(format_args!("{}: {said}", file.display()));
    }
    Ok(found.is_empty())
}

/// Runs the job and writes its results if requested.
fn run_again(origin: &Origin, arguments: &ReproArguments) -> Result<Fingerprint, ReproFailure> {
    let job = &origin.job;
    let (interrupt, progress) = (Interrupt::install(), Progress::new(!arguments.quiet));
    let bar = progress.start(&job.name, [0.0, job.scenario.plan.duration], &interrupt);
    let mut recorder = Recorder::new(job, &bar);
    if !origin.is_whole() {
        recorder = recorder.until(origin.end);
    }
    let written = |source| ReproFailure::Write { folder: job.folder.clone(), source };
    let folder = arguments.out.as_deref().map(Folder::make).transpose().map_err(written)?;
    let recorder = match &folder {
        Some(folder) => recorder.fingerprinted().with_tables(folder),
        None => recorder.only_fingerprinted(),
    };
    let recorder = recorder.map_err(written)?;
    let (outcome, drafts) = job.run_recorded(recorder).map_err(written)?;
    drop(bar);
    if let Some(mut folder) = folder {
        folder.forget_checkpoint();
        run::write(job, (&arguments.look.look(), &|| true), folder, (&outcome, drafts)).map_err(written)?;
    }
    if let Some(source) = outcome.failure {
        return Err(written(source));
    }
    if interrupt.is_raised() {
        return Err(ReproFailure::Interrupted(arguments.file.clone()));
    }
    if let Some(error @ RunError::OutOfTime { .. }) = outcome.error {
        return Err(ReproFailure::OutOfTime { picture: arguments.file.clone(), error });
    }
    Ok(outcome.kept.fingerprint())
}

/// Describes the differences of a table. `of` precedes the name of a column.
fn lines(differences: &[Difference], of: &str, rows: &str) -> Vec<String> {
    let line = |difference: &Difference| {
        let what = match &difference.what {
            Differing::Column(name) => format!("{of}{name}"),
            Differing::Missing(name) => format!("{of}{name}, which is not in the run,"),
            Differing::Added(name) => format!("{of}{name}, which is not in the plot file,"),
            Differing::Rows(before, now) => format!("{now} {rows} instead of {before}"),
        };
        format!("differs: {what} from t = {} s, within {} {rows}", difference.from, difference.within)
    };
    let mut lines: Vec<String> = differences.iter().take(SHOWN).map(line).collect();
    if differences.len() > SHOWN {
        lines.push(format!("and {} more columns of {rows}", differences.len() - SHOWN));
    }
    lines
}
