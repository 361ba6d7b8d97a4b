//! `stickslip compare`: two folders of results, channel by channel, event by event, figure by figure.

mod account;

use crate::arguments::CompareArguments;
use std::io;
use std::path::PathBuf;
use stickslip_compare::{CompareError, Comparison, Results, Verdict as Outcome};
use stickslip_console::answer::{complain, say, say_json};
use stickslip_console::verdict::Verdict;
use stickslip_figures::comparison::{self, Form};
use stickslip_plot::PlotError;
use stickslip_run::complaint::words;
use thiserror::Error;

/// Why two folders are not compared, or not drawn.
#[derive(Debug, Error)]
enum CompareFailure {
    /// What the comparison says; it names what was asked as the options do.
    #[error("{}{error}", dashes(.error))]
    Compare { error: CompareError },
    /// A picture of a form that is not drawn.
    #[error("--plot {}  expected a file name that ends in .png or .svg", .0.display())]
    NoPicture(PathBuf),
    /// The picture cannot be drawn.
    #[error("the picture cannot be drawn: {0}")]
    Plot(#[from] PlotError),
    /// The picture cannot be written.
    #[error("--plot {}  cannot be written: {}", .path.display(), words(.source))]
    NotWritten { path: PathBuf, source: io::Error },
}

/// Compares two folders and prints what was found.
pub(crate) fn run(arguments: &CompareArguments) -> Verdict {
    match compare(arguments) {
        Ok(comparison) => {
            match arguments {
                CompareArguments { json: true, .. } => {
                    say_json(&serde_json::to_string(&comparison).unwrap_or_default());
                }
                CompareArguments { quiet: true, .. } => {}
                _ => say(format_args!("{}", account::text(&comparison))),
            }
            if comparison.verdict == Outcome::Differs { Verdict::Differs } else { Verdict::Done }
        }
        Err(error) => {
            complain(format_args!("{error}"));
            Verdict::BadInput
        }
    }
}

impl From<CompareError> for CompareFailure {
    fn from(error: CompareError) -> Self {
        Self::Compare { error }
    }
}

fn compare(arguments: &CompareArguments) -> Result<Comparison, CompareFailure> {
    // Before anything is read: a large comparison for nothing helps nobody.
    let form = |file: &PathBuf| Form::of(file).ok_or_else(|| CompareFailure::NoPicture(file.clone()));
    let form = arguments.plot.as_ref().map(form).transpose()?;
    let read =
        |folder| Results::read(folder).map_err(|error| CompareFailure::from(CompareError::from(error)));
    let (a, b) = (read(&arguments.a)?, read(&arguments.b)?);
    let (mut comparison, rows) = Comparison::new(&a, &b, &arguments.terms())?;
    if let (Some(file), Some(form)) = (&arguments.plot, form) {
        let (bytes, names) = comparison::draw((&a, &b), &comparison, &rows, form)?;
        stickslip_run::folder::write(file, &bytes)
            .map_err(|source| CompareFailure::NotWritten { path: file.clone(), source })?;
        comparison.notes.push(format!("drawn in {}: {}", file.display(), names.join(", ")));
    }
    Ok(comparison)
}

/// What makes the name of a term that of an option.
fn dashes(error: &CompareError) -> &'static str {
    match error {
        CompareError::UnknownName { .. } | CompareError::Absolute { .. } => "--",
        CompareError::Results(_) | CompareError::JudgedExcerpt(_) | CompareError::NoCommonRow => "",
    }
}
