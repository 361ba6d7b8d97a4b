//! `stickslip import`: shows how a measured table is read.

use crate::arguments::ImportArguments;
use std::io;
use std::path::PathBuf;
use stickslip_console::answer::{complain, say, say_json};
use stickslip_console::table;
use stickslip_console::verdict::Verdict;
use stickslip_record::{Encoding, Record, RecordError};
use stickslip_run::complaint::words;
use stickslip_run::folder;
use thiserror::Error;

/// Error that stops the command.
#[derive(Debug, Error)]
enum ImportFailure {
    /// The table cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The recipe cannot be written.
    #[error("{}: {}", .path.display(), words(.source))]
    Write { path: PathBuf, source: io::Error },
}

/// Reads a table, shows its interpretation and writes the recipe.
pub(crate) fn import(arguments: &ImportArguments) -> Verdict {
    match answer(arguments) {
        Ok(()) => Verdict::Done,
        Err(failure) => {
            complain(format_args!("{failure}"));
            match failure {
                ImportFailure::Record(_) => Verdict::BadInput,
                ImportFailure::Write { .. } => Verdict::Stopped,
            }
        }
    }
}

fn answer(arguments: &ImportArguments) -> Result<(), ImportFailure> {
    let record = Record::read(&arguments.file, &arguments.reading.recipe()?, &[])?;
    let recipe = record.recipe();
    if arguments.json {
        // The recipe consists of numbers and strings, for which JSON has no errors.
        say_json(&serde_json::to_string(&recipe).unwrap_or_default());
    } else {
        tell(&record);
    }
    if let Some(path) = &arguments.out {
        let text = serde_json::to_string_pretty(&recipe).unwrap_or_default() + "\n";
        folder::write(path, text.as_bytes())
            .map_err(|source| ImportFailure::Write { path: path.clone(), source })?;
        if !arguments.json {
            say(format_args!("recipe: {}", path.display()));
        }
    }
    Ok(())
}

fn tell(record: &Record) {
    let layout = &record.layout;
    let mut columns = table::plain(["column", "name", "unit", "read as", "rows", "", ""]);
    for (place, column) in layout.columns.iter().enumerate() {
        let read = match record.role(place) {
            Some((role, unit)) => format!("{} in {unit}", role.word()),
            None if column.is_number => "not used".to_owned(),
            None => "not numbers".to_owned(),
        };
        let cell =
            |row: usize| layout.rows.get(row).and_then(|cells| cells.get(place)).cloned().unwrap_or_default();
        let unit = column.unit.clone().unwrap_or_default();
        columns.add_row([
            (place + 1).to_string(),
            column.name.clone(),
            unit,
            read,
            cell(0),
            cell(1),
            cell(2),
        ]);
    }
    say(format_args!("{columns}"));
    let encoding = match layout.encoding {
        Encoding::Utf8 => "UTF-8",
        Encoding::Utf16 => "UTF-16",
        Encoding::Latin1 => "Latin-1",
    };
    let delimiter = match layout.delimiter {
        '\t' => "tab".to_owned(),
        ' ' => "spaces".to_owned(),
        sign => format!("\"{sign}\""),
    };
    let thousands =
        layout.thousands.map_or_else(String::new, |sign| format!(", digits grouped by \"{sign}\""));
    say(format_args!(
        "{encoding}, delimiter {delimiter}, decimal sign \"{}\"{thousands}, lines before the first row: {}, rows: {}",
        layout.decimal, layout.skip, record.rows
    ));
    if let Some([start, increment]) = layout.pace {
        say(format_args!("times: {start:e} s in the first row, {increment:e} s between rows"));
    }
    record.notes.iter().for_each(|note| say(format_args!("note: {note}")));
}
