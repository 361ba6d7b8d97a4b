//! Reads two columns of a CSV file that is not part of a scenario, such as a loading history.

use super::head::{Column, Head};
use super::sheet;
use crate::error::{Report, ScenarioError};
use crate::excerpt::Excerpt;
use crate::units::{self, Kind};
use crate::{syntax, text};
use std::ops::Range;
use std::path::Path;

/// Two columns of a table, in SI. If the table has only the second column, both are equal.
#[derive(Debug, Clone, PartialEq)]
pub struct Pairs {
    /// Index of the name that the first column has, or `None` if the table has no such column.
    pub first: Option<usize>,
    /// Index of the name that the second column has.
    pub second: usize,
    /// Numbers of each row.
    pub values: Vec<[f64; 2]>,
}

/// Reads two columns of a CSV file. Each column has one of the given names (case-insensitive); each name has an SI unit. Headers may
/// contain a unit, as in `u (nm)`; numbers without a unit are in SI. The first column may be missing.
///
/// # Errors
/// A file that cannot be read or is not a table. A missing second column, two columns for one role, or a unit of another dimension.
pub fn pairs(path: &Path, first: &[(&str, &str)], second: &[(&str, &str)]) -> Result<Pairs, ScenarioError> {
    let name = path.display().to_string();
    let read = text::read(path, syntax::MAX_BYTES);
    // The list of similar file names contains only scenarios, so it is not shown.
    let bytes = read.map_err(|error| at_file(&name, (text::unreadable(path, &error).0, None)))?;
    let most = syntax::MAX_BYTES;
    let bytes = bytes.ok_or_else(|| at_file(&name, (format!("a table has at most {most} bytes"), None)))?;
    let text = text::decode(bytes).map_err(|garbled| {
        in_text(&name, &garbled.text, garbled.range, (garbled.message, Some(garbled.help)))
    })?;
    let slipped = |slip: sheet::Slip| in_text(&name, &text, slip.range, (slip.message, slip.help));
    let header: Vec<Head> =
        sheet::header(&text).map_err(slipped)?.iter().map(|head| Head::new(head)).collect();
    let table = Table { name: &name, text: &text, header: &header };
    let (given, found) = (table.column(first)?, table.column(second)?);
    let Some((second_place, second_name)) = found else {
        let names: Vec<&str> = second.iter().map(|(name, _)| *name).collect();
        let message = format!("expected a column {}", names.join(" or "));
        let help = super::help(names[0], &header);
        return Err(in_text(&name, &text, sheet::head(&text, 0), (message, help)));
    };
    let first_place = given.map_or(second_place, |(place, _)| place);
    let unit = |place: usize, name: usize, names: &[(&str, &str)]| table.scale(place, names[name].1);
    let second_scale = unit(second_place, second_name, second)?;
    let first_scale = given.map_or(Ok(second_scale), |(place, name)| unit(place, name, first))?;
    let columns = [(first_place, first_scale), (second_place, second_scale)];
    let values = sheet::numbers(&text, columns, header.len()).map_err(slipped)?;
    Ok(Pairs { first: given.map(|(_, name)| name), second: second_name, values })
}

/// Table with its headers.
struct Table<'a> {
    name: &'a str,
    text: &'a str,
    header: &'a [Head],
}

impl Table<'_> {
    /// Returns the index of the column with one of these names, and the index of the name.
    fn column(&self, names: &[(&str, &str)]) -> Result<Option<(usize, usize)>, ScenarioError> {
        let goes_by = |head: &Head, (name, _): &(&str, &str)| {
            let is = |text: &str| text.eq_ignore_ascii_case(name);
            is(&head.full) || is(head.bare())
        };
        let named = |head: &Head| names.iter().position(|name| goes_by(head, name));
        let mut found =
            self.header.iter().enumerate().filter_map(|(place, head)| Some((place, named(head)?)));
        let column = found.next();
        match found.next() {
            None => Ok(column),
            Some((place, _)) => {
                let message = "another column already has this role".to_owned();
                Err(self.fault(place, (message, Some("keep one of them".to_owned()))))
            }
        }
    }

    /// Returns the conversion of a column to SI.
    fn scale(&self, place: usize, si: &str) -> Result<units::Scale, ScenarioError> {
        let Some(wanted) = units::of_si(si) else { return Ok(units::Scale::Ten(0)) };
        let column = if wanted == Kind::Time { Column::Time } else { Column::Value };
        let measure = self.header[place].measure(column);
        match measure {
            Ok(measure) if measure.kind.is_none_or(|kind| kind == wanted) => Ok(measure.scale),
            _ => {
                let symbols: Vec<&str> = units::symbols(Some(wanted)).collect();
                let message = format!("expected the unit of {}", Kind::article(wanted));
                let help = format!("units here: {}", symbols.join(", "));
                Err(self.fault(place, (message, Some(help))))
            }
        }
    }

    fn fault(&self, place: usize, words: (String, Option<String>)) -> ScenarioError {
        in_text(self.name, self.text, sheet::head(self.text, place), words)
    }
}

/// Returns an error about a whole file.
fn at_file(file: &str, (message, help): (String, Option<String>)) -> ScenarioError {
    let (file, path) = (file.to_owned(), String::new());
    Report { file, is_override: false, word: "", excerpt: None, path, message, help }.into()
}

/// Returns an error at a position in the text of a file.
fn in_text(
    file: &str,
    text: &str,
    range: Range<usize>,
    (message, help): (String, Option<String>),
) -> ScenarioError {
    let (file, path) = (file.to_owned(), String::new());
    let excerpt = Some(Excerpt::of(text, range));
    Report { file, is_override: false, word: "", excerpt, path, message, help }.into()
}
