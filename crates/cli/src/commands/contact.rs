//! `stickslip contact`: solution of the contact theory for one contact, without a run.

mod page;

use crate::arguments::ContactArguments;
use std::path::Path;
use stickslip_console::answer::{complain, say, say_json};
use stickslip_console::verdict::Verdict;
use stickslip_contact::TangentialGiven;
use stickslip_figures::FigureError;
use stickslip_figures::theory;
use stickslip_run::complaint::words;
use stickslip_run::folder::{Folder, sweep};
use stickslip_run::theory::{
    Beside, CONTACT, Corner, History, Sheet, Subject, Tangential, TheoryError, Walk, json, table_files, write,
};
use stickslip_run::{Job, Refusal};
use thiserror::Error;

/// Number of rows in printed and in written tables.
const PRINTED: usize = 11;
const WRITTEN: usize = 201;

/// Error that stops the command.
#[derive(Debug, Error)]
enum ContactFailure {
    /// The scenario is rejected.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The contact or the load is invalid.
    #[error(transparent)]
    Theory(#[from] TheoryError),
    /// A plot fails.
    #[error(transparent)]
    Figure(#[from] FigureError),
}

/// Solves a contact and prints or writes the results.
pub(crate) fn contact(arguments: &ContactArguments) -> Verdict {
    match answer(arguments) {
        Ok(()) => Verdict::Done,
        Err(failure) => {
            complain(format_args!("{failure}"));
            failure.verdict()
        }
    }
}

fn answer(arguments: &ContactArguments) -> Result<(), ContactFailure> {
    let job = Job::prepare(&arguments.file, &arguments.set, Path::new(""))?;
    let subject = Subject::find(&job, arguments.contact.as_deref())?;
    let own = ['.', ':'].map(|end| format!("contacts.{}{end}", subject.name));
    let is_own = |text: &String| own.iter().any(|own| text.contains(own));
    for text in job.warnings().iter().map(ToString::to_string).filter(is_own) {
        complain(format_args!("warning: {text}"));
    }
    let normal = arguments.pressed.given().unwrap_or_else(|| subject.pressed());
    let pushed = arguments.pushed.given();
    let history = history(arguments)?;
    let sheet = Sheet::of(&subject, normal, pushed, PRINTED)?;
    let asked = match (&history, &sheet.loading) {
        // A first loading is a history with one corner.
        (None, Some(found)) if arguments.out.is_some() => {
            let tangential = Tangential::Displacement(found.u.0);
            Some(History { corners: vec![Corner { normal: None, tangential }] })
        }
        (None, None) if arguments.out.is_some() => Some(History { corners: Vec::new() }),
        _ => history,
    };
    let walk = asked.map(|history| Walk::of(&subject, normal, &history, arguments.animate)).transpose()?;
    if let Some(warning) = walk.as_ref().and_then(|walk| walk.warning(subject.law)) {
        complain(format_args!("warning: {warning}"));
    }
    if arguments.json {
        say_json(&json(&sheet, walk.as_ref()));
    } else if !arguments.quiet {
        // With a history, its corners replace the curves.
        let shown = if walk.is_some() { sheet.without_curves() } else { sheet };
        say(format_args!("{}", page::text(&shown)));
    }
    let Some(walk) = walk else { return Ok(()) };
    let out =
        arguments.out.clone().unwrap_or_else(|| Path::new("results").join(format!("{}-contact", job.name)));
    let names = files(arguments, (&subject, &walk), pushed, &out)?;
    if !arguments.quiet && !arguments.json {
        say(format_args!("\n{}\n\n{}: {}", page::corners(&walk), out.display(), names.join(", ")));
    }
    Ok(())
}

/// Returns the requested loading history: from a CSV file if the text ends in ".csv", otherwise from corners in the text.
fn history(arguments: &ContactArguments) -> Result<Option<History>, TheoryError> {
    let Some(text) = &arguments.history else { return Ok(None) };
    let path = Path::new(text);
    let is_table = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
    let history = if is_table { History::read(path) } else { History::parse(text) };
    history.map(Some)
}

/// Writes tables and plots. Returns their names.
fn files(
    arguments: &ContactArguments,
    (subject, walk): (&Subject<'_>, &Walk),
    pushed: Option<TangentialGiven>,
    out: &Path,
) -> Result<Vec<String>, ContactFailure> {
    let failed =
        |source| TheoryError::Write { path: out.display().to_string(), words: words(&source), source };
    let normal = arguments.pressed.given().unwrap_or_else(|| subject.pressed());
    let sheet = Sheet::of(subject, normal, pushed, WRITTEN)?;
    let (mut pictures, mut notes) = (Vec::new(), Vec::new());
    if !sheet.constants.axisymmetric {
        notes.push(
            "a list of springs or a normal law has no shape in three dimensions: fields and friction work per area are not computed"
                .to_owned(),
        );
    }
    for drawn in theory::draw(subject, &sheet, walk, (&arguments.look.look(), arguments.animate)) {
        pictures.extend(drawn?);
    }
    let folder = Folder::make(out).map_err(failed)?;
    // An interrupted command may have left temporary files.
    let stale = theory::all_files();
    let tables = table_files().into_iter().map(str::to_owned).chain([CONTACT.to_owned()]);
    sweep(out, &tables.chain(stale.iter().cloned()).collect::<Vec<_>>());
    Ok(write(folder, &sheet, walk, Beside { pictures: &pictures, stale, notes }).map_err(failed)?)
}

impl ContactFailure {
    fn verdict(&self) -> Verdict {
        match self {
            Self::Theory(TheoryError::Write { .. }) | Self::Figure(_) => Verdict::Stopped,
            Self::Refused(_) | Self::Theory(_) => Verdict::BadInput,
        }
    }
}
