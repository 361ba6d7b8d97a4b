//! `stickslip compare`: two folders of results, channel by channel, event by event, figure by figure.
//!
//! In reading order: [`arguments`]; [`results`] (a folder read back); [`allowance`] with [`scales`] and [`names`] (what
//! may differ by how much); [`channels`]; [`events`] with [`alignment`]; [`figures`]; [`comparison`] (all of it, and what
//! it comes to); [`account`] (what people read); [`picture`]; [`error`].

mod account;
mod alignment;
mod allowance;
mod arguments;
mod channels;
mod comparison;
mod error;
mod events;
mod figures;
mod names;
mod picture;
mod results;
mod scales;

use crate::answer::say;
use crate::verdict::Verdict;
use comparison::Comparison;
use error::CompareError;
use picture::Form;
use results::Results;
use std::io::Write;

pub(crate) use arguments::{ABOUT, CompareArguments, EXAMPLES};

/// Compares two folders and prints what was found.
pub(crate) fn run(arguments: &CompareArguments) -> Verdict {
    match compare(arguments) {
        Ok(comparison) => {
            let text = match arguments {
                CompareArguments { json: true, .. } => serde_json::to_string(&comparison).unwrap_or_default(),
                CompareArguments { quiet: true, .. } => String::new(),
                _ => account::text(&comparison),
            };
            if !text.is_empty() {
                say(format_args!("{text}"));
            }
            if comparison.same { Verdict::Done } else { Verdict::Differs }
        }
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "{error}");
            Verdict::BadInput
        }
    }
}

fn compare(arguments: &CompareArguments) -> Result<Comparison, CompareError> {
    if let Some(file) = &arguments.plot {
        // Before anything is read: a large comparison for nothing helps nobody.
        Form::of(file)?;
    }
    let (a, b) = (Results::read(&arguments.a)?, Results::read(&arguments.b)?);
    let (mut comparison, rows) = Comparison::new(&a, &b, arguments)?;
    if let Some(file) = &arguments.plot {
        let names = picture::draw((&a, &b), &comparison, &rows, file)?;
        comparison.notes.push(format!("drawn in {}: {}", file.display(), names.join(", ")));
    }
    Ok(comparison)
}
