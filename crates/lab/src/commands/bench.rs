//! `stickslip-lab bench`: measures computing time versus error.

use crate::arguments::BenchArguments;
use stickslip_bench::{BenchError, Known, ProblemError, TABLE, frames, growth, instructions, picture};
use stickslip_console::answer::{complain, say};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::verdict::Verdict;
use stickslip_drive::RunError;
use stickslip_run::{Job, Refusal};
use thiserror::Error;

/// Error that stops the command.
#[derive(Debug, Error)]
enum BenchFailure {
    /// A scenario is rejected.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The name after `--known` is unknown.
    #[error("--known {0}: expected the name of a scenario of the command")]
    Unknown(String),
    /// The measurement fails.
    #[error(transparent)]
    Bench(#[from] BenchError),
}

/// Measures scenarios one after another.
pub(crate) fn bench(arguments: &BenchArguments) -> Verdict {
    match measure_all(arguments) {
        Ok(()) => Verdict::Done,
        Err(failure) => {
            complain(format_args!("{failure}"));
            failure.verdict()
        }
    }
}

fn measure_all(arguments: &BenchArguments) -> Result<(), BenchFailure> {
    let (interrupt, progress) = (Interrupt::install(), Progress::new(!arguments.quiet));
    if cfg!(debug_assertions) && !arguments.quiet {
        complain(format_args!(
            "this program was built without --release: its times do not apply to a release build"
        ));
    }
    let request = arguments.request();
    let jobs = prepare(arguments)?;
    if let Some(what) = arguments.counted {
        let run = |job: &Job| instructions::counted(job, what);
        let stopped = |source: RunError| BenchError::Stopped { name: String::new(), why: source.to_string() };
        return Ok(jobs.iter().try_for_each(run).map_err(stopped)?);
    }
    if arguments.redraw {
        return Ok(jobs.iter().try_for_each(stickslip_bench::redraw)?);
    }
    if arguments.realtime {
        return measure_frames(arguments, &jobs, &progress, &interrupt);
    }
    let mut chapters = Vec::new();
    for (job, file) in jobs.iter().zip(&request.files) {
        let known = request.known.iter().filter(|(name, _)| *name == job.name);
        let known: Vec<Known> = known.map(|(_, known)| known.clone()).collect();
        let bar = progress.budget(&job.name, request.budget, &interrupt);
        chapters.extend(stickslip_bench::measure((job, file), &known, &request, &bar)?);
        drop(bar);
        if !arguments.quiet {
            say(format_args!("{}: {}: {TABLE}, {}.png", job.name, job.folder.display(), picture::NAME));
        }
    }
    if request.growth {
        let bar = progress.budget(growth::PICTURE, f64::from(growth::TURNS), &interrupt);
        growth::measure(&request.out, &bar)?;
        drop(bar);
        if !arguments.quiet {
            let (out, table, name) = (request.out.display(), growth::TABLE, growth::PICTURE);
            say(format_args!("growth: {out}: {table}, {name}.png"));
        }
    }
    let Some(page) = &request.page else { return Ok(()) };
    Ok(stickslip_bench::write_page(&chapters, &request, page)?)
}

/// Measures computing times of frames in real time.
fn measure_frames(
    arguments: &BenchArguments,
    jobs: &[Job],
    progress: &Progress,
    interrupt: &Interrupt,
) -> Result<(), BenchFailure> {
    let request = arguments.frames_request();
    let bar = progress.budget(frames::PICTURE, frames::turns(&request), interrupt);
    frames::measure(jobs, &request, &bar)?;
    drop(bar);
    if !arguments.quiet {
        let names = [frames::TABLE, frames::WORST, frames::HISTOGRAMS, frames::ACCURACY].join(", ");
        say(format_args!("frames: {}: {names}, {}.png", request.out.display(), frames::PICTURE));
    }
    Ok(())
}

/// Reads all scenarios before the first run.
fn prepare(arguments: &BenchArguments) -> Result<Vec<Job>, BenchFailure> {
    let job = |file| Ok(Job::prepare(file, &arguments.set, &arguments.out)?);
    let jobs = arguments.files.iter().map(|file| job(file)).collect::<Result<Vec<Job>, BenchFailure>>()?;
    match arguments.known.iter().find(|(name, _)| jobs.iter().all(|job| job.name != *name)) {
        Some((name, _)) => Err(BenchFailure::Unknown(name.clone())),
        None => Ok(jobs),
    }
}

impl BenchFailure {
    fn verdict(&self) -> Verdict {
        match self {
            Self::Refused(_) | Self::Unknown(_) => Verdict::BadInput,
            Self::Bench(
                BenchError::Problem(ProblemError::Reference { source: RunError::Interrupted { .. }, .. })
                | BenchError::Interrupted(_),
            ) => Verdict::Interrupted,
            Self::Bench(BenchError::Problem(ProblemError::Reference { .. })) => Verdict::Stopped,
            Self::Bench(BenchError::Problem(_)) => Verdict::BadInput,
            Self::Bench(
                BenchError::Stopped { .. } | BenchError::Picture { .. } | BenchError::File { .. },
            ) => Verdict::Stopped,
        }
    }
}
