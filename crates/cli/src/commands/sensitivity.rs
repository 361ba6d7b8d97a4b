//! `stickslip sensitivity`: derivatives of results with respect to parameters.

use super::output::{Output, OutputFailure};
use super::steady;
use crate::arguments::SensitivityArguments;
use std::path::Path;
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::interrupt::{Interrupt, Interrupted};
use stickslip_console::progress::Progress;
use stickslip_console::table;
use stickslip_console::verdict::Verdict;
use stickslip_figures::sensitivity as picture;
use stickslip_run::{Job, Real, quantity};
use stickslip_study::sensitivity::{self, Asked, Sensitivity, SensitivityError, Taken};
use thiserror::Error;

/// Error that stops the command.
#[derive(Debug, Error)]
enum SensitivityFailure {
    /// The request is invalid.
    #[error(transparent)]
    Asked(#[from] SensitivityError),
    /// The files cannot be written.
    #[error(transparent)]
    Output(#[from] OutputFailure),
}

/// Computes derivatives and writes the results.
pub(crate) fn sensitivity(arguments: &SensitivityArguments) -> Verdict {
    answer(arguments).unwrap_or_else(|failure| {
        complain(format_args!("{failure}"));
        match failure {
            SensitivityFailure::Asked(error) => verdict(&error),
            SensitivityFailure::Output(failure) => failure.verdict(),
        }
    })
}

/// Returns the exit status of an error.
fn verdict(error: &SensitivityError) -> Verdict {
    match error {
        SensitivityError::Interrupted => Verdict::Interrupted,
        SensitivityError::Stopped { .. } => Verdict::Stopped,
        SensitivityError::NotSteady { source, .. } => steady::verdict(source),
        _ => Verdict::BadInput,
    }
}

fn answer(arguments: &SensitivityArguments) -> Result<Verdict, SensitivityFailure> {
    let interrupt = Interrupt::install();
    let SensitivityArguments { of, to, steady, tolerance, .. } = arguments;
    let asked = Asked { of: of.clone(), to: to.clone(), steady: *steady, tolerance: *tolerance };
    let job = Job::prepare(&arguments.file, &arguments.set, Path::new("")).map_err(SensitivityError::from)?;
    let mut asked = Sensitivity::new(job, &asked, &Interrupted(&interrupt))?;
    if !arguments.quiet {
        warn(&asked.job);
    }
    // Before the first run.
    let (name, runs) = (asked.job.name.clone(), asked.runs());
    let output = Output::ready(arguments.out.as_deref(), &format!("{name}-sensitivity"))?;
    let out = output.path.clone();
    let figures: Vec<&str> = asked.figures.iter().map(|figure| figure.name.as_str()).collect();
    asked.journal = output.journal("sensitivity", &(&asked.job.hash, figures), arguments.work.fresh)?;
    let progress = Progress::new(!arguments.quiet);
    progress.tell(format_args!("{name}: derivatives, {runs} runs"));
    let bar = progress.budget(&name, runs as f64, &interrupt);
    let taken = asked.take(arguments.work.threads.count(), &bar);
    drop(bar);
    let all = asked.figures.len() * asked.quantities.len();
    progress.tell(format_args!("{name}: {} of {all} derivatives are known", all - taken.faults()));
    let names = write(arguments, (&asked, &taken), output)?;
    if arguments.json {
        say_json(&sensitivity::json(&asked, &taken));
    } else if !arguments.quiet {
        tell(&asked, &taken);
        say(format_args!("{}: {}", out.display(), names.join(", ")));
    }
    let faults = taken.faults();
    if !interrupt.is_raised() {
        asked.journal.remove();
    }
    Ok(match () {
        () if interrupt.is_raised() => Verdict::Interrupted,
        () if faults == all => Verdict::Stopped,
        () => Verdict::Done,
    })
}

fn write(
    arguments: &SensitivityArguments,
    (asked, taken): (&Sensitivity, &Taken),
    output: Output,
) -> Result<Vec<String>, OutputFailure> {
    let pictures = match picture::draw((asked, taken), &arguments.look.look()) {
        // If the command was interrupted early, there may be nothing to draw.
        Err(_) if taken.is_cut() => Vec::new(),
        drawn => drawn?,
    };
    output.write(sensitivity::all_files(), picture::all_files(taken.is_cut()), |folder, stale| {
        sensitivity::write(folder, (asked, taken), &pictures, stale)
    })
}

/// Prints a table for each result, with notes.
fn tell(asked: &Sensitivity, taken: &Taken) {
    for (f, figure) in asked.figures.iter().enumerate() {
        say(format_args!("{} = {}", figure.name, shown(figure.value, figure.unit)));
        let mut table = table::plain(["quantity", "% per %", "\u{b1}", "derivative", "\u{b1}", ""]);
        let mut notes = Vec::new();
        for q in taken.order(asked, f) {
            let derivative = &taken.derivatives[f][q];
            let path = &asked.quantities[q].path;
            for (side, slope) in derivative.sides() {
                let name = side.map_or_else(|| path.clone(), |side| format!("{path}, {side}"));
                let Ok(slope) = slope else { continue };
                let elasticity = |value: f64| Taken::elasticity(asked, (f, q), value);
                let shares = elasticity(slope.value).zip(elasticity(slope.error));
                let [share, doubt] = shares.map_or([const { String::new() }; 2], |(share, doubt)| {
                    known((share, doubt.abs()), |places| format!("{share:+.*}", places.clamp(0, 4) as usize))
                });
                let size = math::log10(slope.value.abs()).floor() as i32;
                let [value, error] = known((slope.value, slope.error), |places| {
                    format!("{:.*e}", places.saturating_add(size).clamp(0, 5) as usize, slope.value)
                });
                table.add_row([name, share, doubt, value, error, asked.unit((f, q))]);
            }
            notes.extend(derivative.words().map(|words| format!("  {path}: {words}")));
        }
        table::to_the_right(&mut table, 1..=4);
        say(format_args!("{table}"));
        notes.iter().for_each(|note| say(format_args!("{note}")));
        say(format_args!(""));
    }
}

/// Formats a value with as many digits as its error allows, and the error. A value below its error is shown as an upper bound.
fn known((value, error): (f64, f64), digits: impl Fn(i32) -> String) -> [String; 2] {
    match error {
        0.0 => [digits(i32::MAX), format!("{error:.0e}")],
        _ if error >= value.abs() => [format!("< {:.0e}", value.abs() + error), String::new()],
        _ => [digits(-math::log10(error).floor() as i32), format!("{error:.0e}")],
    }
}

fn shown(value: f64, unit: &str) -> String {
    // A number without a unit has no prefix.
    if unit.is_empty() { format!("{value:.4}") } else { quantity(Real(value), unit) }
}
