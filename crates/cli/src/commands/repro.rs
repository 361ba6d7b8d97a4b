//! Runs again what a picture carries, and tells whether the same comes out.

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

/// Most differences of a table that are shown.
const SHOWN: usize = 5;

/// Why nothing was compared.
#[derive(Debug, Error)]
enum ReproFailure {
    /// The picture.
    #[error(transparent)]
    Origin(#[from] OriginError),
    /// The folder where it lies.
    #[error(transparent)]
    Folder(#[from] SynopsisError),
    /// The results cannot be written.
    #[error("{}: the results cannot be written: {}", .folder.display(), words(.source))]
    Write { folder: PathBuf, source: io::Error },
    /// The run takes too long.
    #[error("{}: {error}, nothing compared\n   help: give it longer with --wall", .picture.display())]
    OutOfTime { picture: PathBuf, error: RunError },
    /// Somebody interrupted the run.
    #[error("{}: interrupted, nothing compared", .0.display())]
    Interrupted(PathBuf),
}

/// Runs what a picture carries and compares.
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
    // Beside results that were not published whole it may be of this run or of one before.
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

/// Runs the job, and writes its results where that is asked for.
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

/// What is told of a table's differences; `of` comes before the name of a column.
fn lines(differences: &[Difference], of: &str, rows: &str) -> Vec<String> {
    let line = |difference: &Difference| {
        let what = match &difference.what {
            Differing::Column(name) => format!("{of}{name}"),
            Differing::Missing(name) => format!("{of}{name}, which the run has no more,"),
            Differing::Added(name) => format!("{of}{name}, which the picture does not know,"),
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
