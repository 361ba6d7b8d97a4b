//! `stickslip compare`: compares two folders of results by channels, events and summary values.

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

/// Error that stops the command.
#[derive(Debug, Error)]
enum CompareFailure {
    /// The comparison fails. The message names the arguments like options.
    #[error("{}{error}", dashes(.error))]
    Compare { error: CompareError },
    /// The file format of the plot is not supported.
    #[error("--plot {}  expected a file name that ends in .png or .svg", .0.display())]
    NoPicture(PathBuf),
    /// The plot cannot be drawn.
    #[error("the plot cannot be drawn: {0}")]
    Plot(#[from] PlotError),
    /// The plot cannot be written.
    #[error("--plot {}  cannot be written: {}", .path.display(), words(.source))]
    NotWritten { path: PathBuf, source: io::Error },
}

/// Compares two folders and prints the result.
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
    // Check the plot format first, before a long comparison.
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

/// Returns the prefix that makes the name of a term an option.
fn dashes(error: &CompareError) -> &'static str {
    match error {
        CompareError::UnknownName { .. } | CompareError::Absolute { .. } => "--",
        CompareError::Results(_) | CompareError::JudgedExcerpt(_) | CompareError::NoCommonRow => "",
    }
}
