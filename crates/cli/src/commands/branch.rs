//! `stickslip branch`: continuation of a periodic orbit over a parameter.

use super::output::{Output, OutputFailure};
use super::steady::verdict;
use crate::arguments::BranchArguments;
use std::path::Path;
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::interrupt::Interrupt;
use stickslip_console::progress::Progress;
use stickslip_console::table;
use stickslip_console::verdict::Verdict;
use stickslip_figures::branch as picture;
use stickslip_run::{Job, Real, Refusal, Watcher, quantity};
use stickslip_study::curve::Range;
use stickslip_study::steady::Options;
use stickslip_study::steady::continuation::{
    self, Branch, Continuation, ContinuationError, Course, End, Mark,
};
use thiserror::Error;

/// Error that stops the command.
#[derive(Debug, Error)]
enum BranchFailure {
    /// The scenario is rejected.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The request is invalid, or there is no periodic orbit at the start.
    #[error(transparent)]
    Branch(#[from] ContinuationError),
    /// The range is invalid.
    #[error("--vary  {0}")]
    Range(String),
    /// The files cannot be written.
    #[error(transparent)]
    Output(#[from] OutputFailure),
}

/// Follows a branch and writes the results.
pub(crate) fn branch(arguments: &BranchArguments) -> Verdict {
    answer(arguments).unwrap_or_else(|failure| {
        complain(format_args!("{failure}"));
        failure.verdict()
    })
}

fn answer(arguments: &BranchArguments) -> Result<Verdict, BranchFailure> {
    let (path, range) = &arguments.vary;
    let job = Job::prepare(&arguments.search.file, &arguments.search.set, Path::new(""))?;
    let unit = job.scenario.parameter(path).map_err(ContinuationError::Path)?.unit;
    let mut of = Continuation::new(job, path, Range::ends(range, unit).map_err(BranchFailure::Range)?)?;
    if !arguments.search.quiet {
        warn(&of.job);
    }
    let interrupt = Interrupt::install();
    // Before the first orbit, which may take long.
    let output = Output::ready(arguments.out.as_deref(), &format!("{}-branch", of.job.name))?;
    let out = output.path.clone();
    let BranchArguments { accuracy, points, search, fresh, .. } = arguments;
    let asked = (&of.job.hash, &of.path, of.range, [search.tolerance, *accuracy], search.periods, points);
    of.journal = output.journal("branch", &asked, *fresh)?;
    let progress = Progress::new(!arguments.search.quiet);
    let line = progress.count(&of.path, "motions", &interrupt);
    let course = Course {
        steady: Options {
            tolerance: arguments.search.tolerance,
            periods: arguments.search.periods,
            goes_on: &|| line.goes_on(),
            ..Options::default()
        },
        accuracy: arguments.accuracy,
        points: arguments.points,
        told: &|count| line.reached(count as f64),
    };
    let branch = of.follow(&course)?;
    drop(line);
    let accuracy = [arguments.search.tolerance, arguments.accuracy];
    let names = write(arguments, output, (&of, &branch), accuracy)?;
    if arguments.search.json {
        say_json(&continuation::json(&of, &branch, accuracy));
    } else if !arguments.search.quiet {
        tell(&of, &branch);
        say(format_args!("\n{}: {}", out.display(), names.join(", ")));
    }
    if branch.is_cut() {
        return Ok(Verdict::Interrupted);
    }
    of.journal.remove();
    Ok(Verdict::Done)
}

fn write(
    arguments: &BranchArguments,
    output: Output,
    (of, branch): (&Continuation, &Branch),
    accuracy: [f64; 2],
) -> Result<Vec<String>, OutputFailure> {
    let pictures = picture::draw(of, branch, &arguments.search.look.look())?;
    output.write(continuation::all_files(), picture::all_files(branch.is_cut()), |folder, stale| {
        continuation::write(folder, (of, branch), accuracy, (&pictures, stale))
    })
}

/// Prints the ends of the branch and its special points in order.
fn tell(of: &Continuation, branch: &Branch) {
    let mut table = table::plain([of.path.as_str(), "\u{b1}", "step", "stable", "what"]);
    let step = |step: Option<f64>| step.map_or(String::new(), |step| quantity(Real(step), "m"));
    let word = |stable: bool| if stable { "yes" } else { "no" };
    let end = |place: usize| {
        let point = if place == 0 { branch.points.first() } else { branch.points.last() };
        let cells = point.map(|point| (shown(of, point.value), step(point.step), word(point.is_stable())));
        let (value, step, stable) = cells.unwrap_or_default();
        vec![value, String::new(), step, stable.to_owned(), "end".to_owned()]
    };
    let row = |mark: &Mark| {
        let stable = mark.stable.map(word).join(" / ");
        vec![
            shown(of, mark.value),
            shown(of, mark.half_width),
            step(mark.step),
            stable,
            mark.kind.name().to_owned(),
        ]
    };
    table.add_row(end(0)).add_rows(branch.marks.iter().map(row)).add_row(end(1));
    table::to_the_right(&mut table, 0..=2);
    say(format_args!("{}: {} periodic orbits\n\n{table}\n", of.job.name, branch.points.len()));
    let words = branch.marks.iter().map(|mark| (shown(of, mark.value), mark.kind.words()));
    words.for_each(|(value, words)| say(format_args!("{value}: {words}")));
    let both = branch.points.first().zip(branch.points.last());
    let ends = both.map(|(first, last)| [(first, &branch.ends[0]), (last, &branch.ends[1])]);
    for (point, end) in ends.into_iter().flatten().filter(|(_, end)| **end != End::Range) {
        say(format_args!("end at {}: {}", shown(of, point.value), end.words()));
    }
    if branch.is_cut() {
        complain(format_args!("interrupted: the orbits found so far are written"));
    }
}

fn shown(of: &Continuation, value: f64) -> String {
    // A number without a unit has no prefix.
    if of.unit.is_empty() { format!("{value:.4e}") } else { quantity(Real(value), of.unit) }
}

impl BranchFailure {
    fn verdict(&self) -> Verdict {
        match self {
            Self::Refused(_) | Self::Range(_) => Verdict::BadInput,
            Self::Branch(ContinuationError::Interrupted(_)) => Verdict::Interrupted,
            Self::Branch(ContinuationError::NoStart { source, .. }) => verdict(source),
            Self::Branch(ContinuationError::Shakedown { .. } | ContinuationError::NoBranch { .. }) => {
                Verdict::Stopped
            }
            Self::Branch(_) => Verdict::BadInput,
            Self::Output(failure) => failure.verdict(),
        }
    }
}
