//! What accuracy costs: every stepper on both engines, errors over time and evaluations.
//!
//! In reading order: [`arguments`]; [`problem`] (a scenario with its reference), [`norm`] and [`samples`] (how far off a run
//! is); [`contestant`], [`family`] and [`steps`] (who runs, at what tolerances and steps), [`baseline`] (what others
//! would do); [`turns`] and [`clock`] (the
//! measurement);
//! [`front`] (what an error costs); [`sheet`], [`picture`] and
//! [`page`] (what is written), [`machine`]; [`growth`] (what more of something
//! costs).

mod arguments;
mod baseline;
mod clock;
mod contestant;
mod family;
mod front;
mod growth;
mod machine;
mod norm;
mod page;
mod picture;
mod problem;
mod samples;
mod sheet;
mod steps;
mod turns;

pub(crate) use arguments::{ABOUT, BenchArguments, EXAMPLES};

use crate::answer::say;
use crate::interrupt::Interrupt;
use crate::progress::Progress;
use crate::verdict::Verdict;
use contestant::Stop;
use page::Chapter;
use problem::{Known, Problem, ProblemError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use stickslip_drive::RunError;
use stickslip_plot::PlotError;
use stickslip_results::complaint::words;
use stickslip_results::folder::{self, Folder};
use stickslip_results::{Job, Refusal};
use thiserror::Error;

/// Name of the table.
const TABLE: &str = "bench.csv";

/// Why there is no measurement.
#[derive(Debug, Error)]
enum BenchFailure {
    /// A scenario.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A scenario that cannot be measured by.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// A name after `--known`.
    #[error("--known {0}: expected the name of one of the scenarios")]
    Unknown(String),
    /// A run that stopped without output, but not with it.
    #[error("{name}: {why}")]
    Stopped { name: String, why: String },
    /// Ctrl-C.
    #[error("{0}: interrupted; nothing is written of it")]
    Interrupted(String),
    /// A picture.
    #[error("{name}: {source}")]
    Picture { name: String, source: PlotError },
    /// Reading or writing.
    #[error("{}: {}", .path.display(), words(.source))]
    File { path: PathBuf, source: io::Error },
}

/// Measures scenarios, one after the other.
pub(crate) fn bench(arguments: &BenchArguments) -> Verdict {
    match measure_all(arguments) {
        Ok(()) => Verdict::Done,
        Err(failure) => {
            let _ = writeln!(io::stderr(), "{failure}");
            failure.verdict()
        }
    }
}

fn measure_all(arguments: &BenchArguments) -> Result<(), BenchFailure> {
    let (interrupt, progress) = (Interrupt::install(), Progress::new(!arguments.quiet));
    if cfg!(debug_assertions) && !arguments.quiet {
        let _ = writeln!(io::stderr(), "this program was built without --release: its times tell little");
    }
    // All are read before the first is run.
    let jobs = arguments
        .files
        .iter()
        .map(|file| Ok(Job::prepare(file, &arguments.set, &arguments.out)?))
        .collect::<Result<Vec<Job>, BenchFailure>>()?;
    if let Some((name, _)) = arguments.known.iter().find(|(name, _)| jobs.iter().all(|job| job.name != *name))
    {
        return Err(BenchFailure::Unknown(name.clone()));
    }
    let mut chapters = Vec::new();
    for (job, file) in jobs.iter().zip(&arguments.files) {
        let known = arguments.known.iter().filter(|(name, _)| *name == job.name);
        let known: Vec<Known> = known.map(|(_, known)| known.clone()).collect();
        chapters.extend(measure((job, file), &known, arguments, &interrupt, &progress)?);
        if !arguments.quiet {
            say(format_args!("{}: {}: {TABLE}, {}.png", job.name, job.folder.display(), picture::NAME));
        }
    }
    if arguments.growth {
        growth::measure(&arguments.out, &interrupt, &progress)?;
        if !arguments.quiet {
            let (out, table, name) = (arguments.out.display(), growth::TABLE, growth::PICTURE);
            say(format_args!("growth: {out}: {table}, {name}.png"));
        }
    }
    let Some(page) = &arguments.page else { return Ok(()) };
    let failed = |source| BenchFailure::File { path: page.clone(), source };
    let text = page::text(&chapters, arguments, page).map_err(failed)?;
    folder::write(page, text.as_bytes()).map_err(failed)
}

/// Measures one scenario and writes what was found; gives its chapter of the page, where one is asked for.
fn measure(
    (job, file): (&Job, &Path),
    known: &[Known],
    arguments: &BenchArguments,
    interrupt: &Interrupt,
    progress: &Progress,
) -> Result<Option<Chapter>, BenchFailure> {
    let problem = Problem::new(job, known, interrupt)?;
    let mut families = family::families(&problem);
    let bar = progress.budget(&job.name, arguments.budget, interrupt);
    turns::measure(&problem, &mut families, arguments.budget, &bar, interrupt).map_err(
        |stop| match stop {
            Stop::Interrupted => BenchFailure::Interrupted(job.name.clone()),
            Stop::Failed(why) => BenchFailure::Stopped { name: job.name.clone(), why },
            Stop::Slow => {
                BenchFailure::Stopped { name: job.name.clone(), why: "a run found no end".to_owned() }
            }
        },
    )?;
    drop(bar);
    let pictures = picture::draw(job, &problem, &families)
        .map_err(|source| BenchFailure::Picture { name: job.name.clone(), source })?;
    let failed = |source| BenchFailure::File { path: job.folder.clone(), source };
    let mut folder = Folder::make(&job.folder).map_err(failed)?;
    let mut table = folder.draft(TABLE).map_err(failed)?;
    sheet::write(&mut table, &families, problem.duration).map_err(failed)?;
    folder.stage(TABLE, table).map_err(failed)?;
    pictures.iter().try_for_each(|(name, bytes)| folder.write(name, bytes)).map_err(failed)?;
    folder.publish().map_err(failed)?;
    let chapter = |page: &PathBuf| Chapter::new((job, file), &problem, &families, page);
    arguments.page.as_ref().map(chapter).transpose().map_err(failed)
}

impl BenchFailure {
    fn verdict(&self) -> Verdict {
        match self {
            Self::Problem(ProblemError::Reference { source: RunError::Interrupted { .. }, .. })
            | Self::Interrupted(_) => Verdict::Interrupted,
            Self::Problem(ProblemError::Reference { .. }) => Verdict::Stopped,
            Self::Refused(_) | Self::Problem(_) | Self::Unknown(_) => Verdict::BadInput,
            Self::Stopped { .. } | Self::Picture { .. } | Self::File { .. } => Verdict::Stopped,
        }
    }
}
