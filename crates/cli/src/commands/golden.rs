//! `stickslip golden`: regression tests of scenarios; commands `record`, `check` and `accept`.

mod junit;

use crate::arguments::golden::{AcceptArguments, CheckArguments, GoldenCommand, RecordArguments};
use crate::commands::run::{Beginning, Conduct, run_job};
use rayon::prelude::*;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_compare::golden::{Golden, GoldenError, Goldens, PICTURE};
use stickslip_compare::{CompareError, Comparison, Results, Terms, Verdict as Outcome};
use stickslip_console::answer::{complain, say};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::verdict::Verdict;
use stickslip_figures::Look;
use stickslip_figures::comparison::{Form, draw};
use stickslip_run::Job;
use stickslip_run::complaint::words;
use stickslip_run::folder::{self, sweep};
use tempfile::TempDir;
use thiserror::Error;

/// Tolerance of recorded runs. At larger tolerances, rounding can change the time steps.
const TOLERANCE: f64 = 1e-12;

/// Error of recording or checking a golden result.
#[derive(Debug, Error)]
enum Fault {
    #[error(transparent)]
    Golden(#[from] GoldenError),
    #[error("{0}")]
    Compare(#[from] CompareError),
    /// A run stopped early; with its exit status and message.
    #[error("{1}")]
    Run(Verdict, String),
    #[error("no temporary folder for the results: {}", words(.0))]
    Room(io::Error),
}

impl Fault {
    fn verdict(&self) -> Verdict {
        match self {
            Self::Golden(GoldenError::Gone(_) | GoldenError::Format { .. } | GoldenError::Recipe { .. })
            | Self::Golden(GoldenError::Damaged(_))
            | Self::Compare(_) => Verdict::Differs,
            Self::Golden(GoldenError::File { .. }) | Self::Room(_) => Verdict::Stopped,
            Self::Golden(_) => Verdict::BadInput,
            Self::Run(verdict, _) => *verdict,
        }
    }
}

/// Result of a check.
struct Finding {
    outcome: Outcome,
    /// Text after the verdict.
    words: String,
}

/// Environment of the runs: temporary folder, interruption and progress.
struct Workshop {
    room: TempDir,
    interrupt: Interrupt,
    progress: Progress,
}

pub(crate) fn golden(command: &GoldenCommand) -> Verdict {
    let result = match command {
        GoldenCommand::Record(arguments) => record(arguments),
        GoldenCommand::Check(arguments) => check(arguments),
        GoldenCommand::Accept(arguments) => accept(arguments),
    };
    result.unwrap_or_else(|fault| {
        complain(format_args!("{fault}"));
        fault.verdict()
    })
}

fn record(arguments: &RecordArguments) -> Result<Verdict, Fault> {
    let goldens = Goldens::new(&arguments.out);
    let set: Vec<String> = arguments.set.iter().map(|(path, value)| format!("{path}={value}")).collect();
    let plan = |file: &PathBuf| {
        let mut golden = goldens.plan(file, set.clone(), arguments.ignore.clone())?;
        if !file.exists() {
            // Use the error message of `run`, which lists the existing files.
            Job::prepare(file, &[], Path::new(""))?;
        }
        let (stepper, of, value) = golden.job(Path::new(""))?.stepper();
        if (stepper, of) == ("event", "tolerance") && value > TOLERANCE && !arguments.own_tolerance {
            golden.recipe.set.push(format!("run.stepper.event.tolerance={TOLERANCE:e}"));
        }
        Ok(golden)
    };
    // Read all scenarios before the first run.
    let planned = arguments.files.iter().map(plan).collect::<Result<Vec<Golden>, GoldenError>>()?;
    if let Some((_, second)) =
        planned.iter().enumerate().find(|(i, golden)| planned[..*i].iter().any(|it| it.name == golden.name))
    {
        let (root, name) = (arguments.out.clone(), second.name.clone());
        return Err(GoldenError::Exists { root, name }.into());
    }
    let workshop = Workshop::open()?;
    let (recorded, worst) = workshop.keep(&planned.iter().collect::<Vec<_>>());
    if !recorded.is_empty() {
        goldens.log(&recorded, "first recorded")?;
    }
    Ok(worst)
}

fn check(arguments: &CheckArguments) -> Result<Verdict, Fault> {
    let goldens = Goldens::new(&arguments.root);
    let names = goldens.names(&arguments.names)?;
    let workshop = Workshop::open()?;
    let found = workshop.check_all(&goldens, &names);
    for (name, finding) in names.iter().zip(&found) {
        say(format_args!("{name}: {}", line(finding)));
    }
    if let Some(file) = &arguments.junit {
        let cases: Vec<(&str, Option<String>)> = names
            .iter()
            .zip(&found)
            .map(|(name, finding)| (name.as_str(), (!is_good(finding)).then(|| line(finding))))
            .collect();
        let text = junit::suite(&cases);
        // Write into pipes, devices and links instead of replacing them.
        let is_other = fs::symlink_metadata(file).is_ok_and(|found| !found.is_file());
        let written = if is_other { fs::write(file, text) } else { folder::write(file, text.as_bytes()) };
        written.map_err(|source| GoldenError::File { path: file.clone(), source })?;
    }
    Ok(found.iter().map(verdict).max().unwrap_or(Verdict::Done))
}

fn accept(arguments: &AcceptArguments) -> Result<Verdict, Fault> {
    Goldens::check_reason(&arguments.reason)?;
    let goldens = Goldens::new(&arguments.root);
    let names = goldens.names(&arguments.names)?;
    let workshop = Workshop::open()?;
    let found = workshop.check_all(&goldens, &names);
    // A scenario named explicitly is renewed if it is not identical.
    let is_wanted = |finding: &Result<Finding, Fault>| match finding {
        Ok(finding) => {
            finding.outcome == Outcome::Differs
                || (!arguments.names.is_empty() && finding.outcome == Outcome::Equal)
        }
        // Damaged results are renewed if the recipe is known.
        Err(fault) => fault.verdict() == Verdict::Differs,
    };
    let mut worst = Verdict::Done;
    let mut wanted = Vec::new();
    for (name, finding) in names.iter().zip(&found) {
        if let (true, Ok(golden)) = (is_wanted(finding), goldens.golden(name)) {
            wanted.push(golden);
        } else if let Err(fault) = finding {
            complain(format_args!("{name}: {fault}"));
            worst = worst.max(fault.verdict());
        }
    }
    let (accepted, kept) = workshop.keep(&wanted.iter().collect::<Vec<_>>());
    if accepted.is_empty() {
        let nothing = if worst.max(kept) == Verdict::Done { "nothing to accept" } else { "nothing accepted" };
        say(format_args!("{nothing}"));
    } else {
        goldens.log(&accepted, &arguments.reason)?;
    }
    Ok(worst.max(kept))
}

fn is_good(finding: &Result<Finding, Fault>) -> bool {
    verdict(finding) == Verdict::Done
}

fn verdict(finding: &Result<Finding, Fault>) -> Verdict {
    match finding {
        Ok(Finding { outcome: Outcome::Differs, .. }) => Verdict::Differs,
        Ok(_) => Verdict::Done,
        Err(fault) => fault.verdict(),
    }
}

fn line(finding: &Result<Finding, Fault>) -> String {
    match finding {
        Ok(Finding { outcome: Outcome::Identical, .. }) => Outcome::Identical.word().to_owned(),
        Ok(Finding { outcome, words }) => format!("{}; {words}", outcome.word()),
        Err(fault) => fault.to_string(),
    }
}

impl Workshop {
    fn open() -> Result<Self, Fault> {
        let room = tempfile::tempdir().map_err(Fault::Room)?;
        Ok(Self { room, interrupt: Interrupt::install(), progress: Progress::new(true) })
    }

    /// Runs the current scenario of a golden result. Returns the changes of the scenario and the folder of the results.
    fn run(&self, golden: &Golden, place: usize) -> Result<(Vec<String>, PathBuf), Fault> {
        let job = golden.job(&self.room.path().join(place.to_string()))?;
        let look = Look::default();
        let (interrupt, progress) = (&self.interrupt, &self.progress);
        if interrupt.is_raised() {
            return Err(Fault::Run(Verdict::Interrupted, "not run: interrupted".to_owned()));
        }
        let report =
            run_job(&job, Beginning::Plain, &Conduct { look: &look, interrupt, progress, realtime: false });
        match report.verdict {
            Verdict::Done => Ok((golden.changes(&job), job.folder)),
            // The temporary results are deleted with this command.
            verdict => Err(Fault::Run(verdict, without_place(&report.error, &golden.name))),
        }
    }

    /// Runs scenarios in parallel and stores their results. Returns the names of the stored ones and the worst exit status.
    fn keep(&self, goldens: &[&Golden]) -> (Vec<String>, Verdict) {
        let keep = |(place, golden): (usize, &&Golden)| {
            let (_, results) = self.run(golden, place)?;
            golden.write(&results)?;
            let _ = fs::remove_dir_all(results);
            Ok::<_, Fault>(())
        };
        let kept: Vec<_> = goldens.par_iter().enumerate().with_max_len(1).map(keep).collect();
        let (mut names, mut worst) = (Vec::new(), Verdict::Done);
        for (golden, kept) in goldens.iter().zip(kept) {
            match kept {
                Ok(()) => {
                    say(format_args!("{}: kept in {}", golden.name, golden.folder.display()));
                    names.push(golden.name.clone());
                }
                Err(fault) => {
                    complain(format_args!("{}: {fault}", golden.name));
                    worst = worst.max(fault.verdict());
                }
            }
        }
        (names, worst)
    }

    fn check_all(&self, goldens: &Goldens, names: &[String]) -> Vec<Result<Finding, Fault>> {
        let check = |(place, name): (usize, &String)| self.check(&goldens.golden(name)?, place);
        names.par_iter().enumerate().with_max_len(1).map(check).collect()
    }

    fn check(&self, golden: &Golden, place: usize) -> Result<Finding, Fault> {
        let picture = golden.folder.join(PICTURE);
        sweep(&golden.folder, &[PICTURE]);
        let recorded = Results::read(&golden.folder).map_err(GoldenError::Damaged)?;
        golden.check_scenario(recorded.text("/scenario_sha256"))?;
        let (changes, folder) = self.run(golden, place)?;
        let results = Results::read(&folder).map_err(GoldenError::Damaged)?;
        let terms = Terms { ignore: golden.recipe.ignore.clone(), ..Terms::default() };
        let (comparison, rows) = Comparison::new(&recorded, &results, &terms)?;
        let mut words = changes_in_words(&changes);
        words.push(comparison.finding());
        let mut outcome = comparison.verdict;
        if !changes.is_empty() {
            outcome = Outcome::Differs;
        }
        if comparison.verdict == Outcome::Differs {
            // A plot that cannot be drawn does not affect the check.
            let drawn = draw((&recorded, &results), &comparison, &rows, Form::Png)
                .map_err(|error| error.to_string())
                .and_then(|(bytes, _)| folder::write(&picture, &bytes).map_err(|error| self::words(&error)));
            words.push(match drawn {
                Ok(()) => format!("see {}", picture.display()),
                Err(error) => format!("{} could not be drawn: {error}", picture.display()),
            });
        } else {
            let _ = fs::remove_file(&picture);
        }
        let _ = fs::remove_dir_all(folder);
        Ok(Finding { outcome, words: words.join("; ") })
    }
}

/// Returns the message of a run without its name and the folder of its results.
fn without_place(said: &str, name: &str) -> String {
    let said = said.strip_prefix(&format!("{name}: ")).unwrap_or(said);
    let lines = said.lines().map(|line| line.split("the results so far").next().unwrap_or_default());
    lines
        .map(|line| line.trim_end().trim_end_matches(';'))
        .filter(|line| !line.is_empty())
        .collect::<Vec<_>>()
        .join("\n")
}

/// Describes the first few changes of a scenario.
fn changes_in_words(changes: &[String]) -> Vec<String> {
    const SHOWN: usize = 3;
    let shown = changes.iter().take(SHOWN).cloned().collect::<Vec<_>>().join(", ");
    match changes.len() {
        0 => Vec::new(),
        count if count > SHOWN => {
            vec![format!("the scenario has changed: {shown} and {} more", count - SHOWN)]
        }
        _ => vec![format!("the scenario has changed: {shown}")],
    }
}
