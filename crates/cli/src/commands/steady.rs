//! `stickslip steady`: finds a periodic orbit and its stability.

mod page;

use crate::arguments::SteadyArguments;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::place::{self, Unwritable};
use stickslip_console::progress::Progress;
use stickslip_console::verdict::Verdict;
use stickslip_figures::{FigureError, steady as picture};
use stickslip_run::checkpoint::{self, Keeper};
use stickslip_run::complaint::words;
use stickslip_run::files::STEADY;
use stickslip_run::folder::{Folder, sweep};
use stickslip_run::{Job, Refusal, Watcher};
use stickslip_study::steady::{Aftermath, Options, Orbit, Report, Steady, SteadyError, find};
use thiserror::Error;

/// Wall time between two checkpoints of a resumed run, s.
const EVERY: f64 = 30.0;

/// Error that stops the command.
#[derive(Debug, Error)]
enum SteadyFailure {
    /// The scenario is rejected.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// No periodic orbit was found.
    #[error("{name}: {source}")]
    NotFound { name: String, source: SteadyError },
    /// A plot fails.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The output folder is not usable.
    #[error(transparent)]
    Folder(#[from] Unwritable),
    /// A file cannot be written.
    #[error("{}: cannot be written: {}", .folder.display(), words(.source))]
    Write { folder: PathBuf, source: io::Error },
}

/// Finds the periodic orbit of a scenario.
pub(crate) fn steady(arguments: &SteadyArguments) -> Verdict {
    match answer(arguments) {
        Ok(verdict) => verdict,
        Err(failure) => {
            complain(format_args!("{failure}"));
            failure.verdict()
        }
    }
}

fn answer(arguments: &SteadyArguments) -> Result<Verdict, SteadyFailure> {
    let interrupt = Interrupt::install();
    let job = Job::prepare(&arguments.search.file, &arguments.search.set, Path::new(""))?;
    if !arguments.search.quiet {
        warn(&job);
    }
    let not_found = |source| SteadyFailure::NotFound { name: job.name.clone(), source };
    let out =
        arguments.out.clone().unwrap_or_else(|| Path::new("results").join(format!("{}-steady", job.name)));
    // Before the first period, because the search may take thousands of periods.
    let folder = place::ready(&out)?;
    let (found, aftermath) = search(arguments, &job, &interrupt).map_err(not_found)?;
    let orbit = found.orbit(&job, picture::ROWS).map_err(not_found)?;
    let lasting = found.job(&job, out.clone()).map_err(not_found)?;
    let aftermath = aftermath.as_ref();
    let report = write(arguments, (&job, &lasting), (&found, aftermath, &orbit), folder)?;
    if arguments.search.json {
        say_json(&report.line());
    } else if !arguments.search.quiet {
        say(format_args!(
            "{}\n\n{}: {}",
            page::text(&job, &found, aftermath),
            out.display(),
            report.files.join(", ")
        ));
        report.notes.iter().for_each(|note| say(format_args!("  {note}")));
    }
    Ok(if interrupt.is_raised() { Verdict::Interrupted } else { Verdict::Done })
}

/// Searches for the orbit with a progress display. For an unstable orbit it also computes the motion after leaving it.
fn search(
    arguments: &SteadyArguments,
    job: &Job,
    interrupt: &Interrupt,
) -> Result<(Steady, Option<Aftermath>), SteadyError> {
    let progress = Progress::new(!arguments.search.quiet);
    progress.tell(format_args!("{}: searching for the periodic orbit", job.name));
    let line = progress.count(&job.name, "periods", interrupt);
    let options = Options {
        tolerance: arguments.search.tolerance,
        periods: arguments.search.periods,
        goes_on: &|| line.goes_on(),
        told: &|periods| line.reached(f64::from(periods)),
        ..Options::default()
    };
    let found = find(job, &options)?;
    progress.tell(format_args!("{}: found in {} periods", job.name, found.work));
    let aftermath = match found.aftermath(job, &options) {
        // The orbit is valid even if this simulation is interrupted.
        Err(SteadyError::Interrupted(_)) => None,
        other => other?,
    };
    Ok((found, aftermath))
}

/// Writes the results, the plots and the checkpoint of the job with endless waveforms.
fn write(
    arguments: &SteadyArguments,
    (job, lasting): (&Job, &Job),
    (found, aftermath, orbit): (&Steady, Option<&Aftermath>, &Orbit),
    mut folder: Folder,
) -> Result<Report, SteadyFailure> {
    let pictures = picture::draw(job, found, &orbit.series, &arguments.search.look.look())?;
    let mut report = Report::of(job, found, aftermath);
    let keeps = lasting.check_checkpoints().is_ok();
    if !keeps {
        let stepper = lasting.stepper().0;
        report.notes.push(format!("no checkpoint was written: the stepper \"{stepper}\" has no checkpoints"));
    }
    let failed = |source| SteadyFailure::Write { folder: lasting.folder.clone(), source };
    let write = || -> io::Result<()> {
        folder.release();
        // An interrupted command may have left temporary files.
        let stale = picture::all_files();
        sweep(&lasting.folder, &stale.iter().cloned().chain([STEADY.to_owned()]).collect::<Vec<_>>());
        pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes))?;
        report.files = folder.names();
        report.files.push(STEADY.to_owned());
        if keeps {
            report.files.push(format!("{}/", checkpoint::FOLDER));
        }
        folder.forget(stale);
        folder.write(STEADY, report.file().as_bytes())?;
        // Delete the checkpoint of an earlier orbit.
        checkpoint::remove(&lasting.folder)?;
        folder.publish()?;
        if keeps {
            Keeper::begin_with(lasting, &orbit.start, EVERY)?;
        }
        Ok(())
    };
    write().map_err(failed)?;
    Ok(report)
}

impl SteadyFailure {
    fn verdict(&self) -> Verdict {
        match self {
            Self::Refused(_) | Self::Folder(_) => Verdict::BadInput,
            Self::NotFound { source, .. } => verdict(source),
            Self::Figure(_) | Self::Write { .. } => Verdict::Stopped,
        }
    }
}

/// Returns the exit status of an unsuccessful search. A scenario without a period is bad input; a search without convergence is not.
pub(super) fn verdict(error: &SteadyError) -> Verdict {
    match error {
        SteadyError::Interrupted(_) => Verdict::Interrupted,
        SteadyError::Run(_)
        | SteadyError::NoConvergence { .. }
        | SteadyError::Shakedown { .. }
        | SteadyError::Flies { .. } => Verdict::Stopped,
        _ => Verdict::BadInput,
    }
}
