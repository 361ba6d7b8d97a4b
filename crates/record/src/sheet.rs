//! Reads the first non-empty sheet of a spreadsheet as tab-separated text.

use crate::error::RecordError;
#[cfg(not(target_family = "wasm"))]
use calamine::{Data, Reader, open_workbook_auto_from_rs};
use std::path::Path;
#[cfg(not(target_family = "wasm"))]
use std::{fmt::Write, io::Cursor};

/// File name extensions of spreadsheets.
const ENDINGS: [&str; 5] = ["xlsx", "xlsm", "xlsb", "xls", "ods"];

/// Returns whether a file is a spreadsheet, by its extension.
pub(crate) fn is_sheet(name: &str) -> bool {
    let ending = Path::new(name).extension().map(|ending| ending.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str()))
}

/// Returns the first non-empty sheet as tab-separated text.
///
/// # Errors
/// The file is not a readable spreadsheet or has no cells.
#[cfg(not(target_family = "wasm"))]
pub(crate) fn text(name: &str, bytes: &[u8]) -> Result<String, RecordError> {
    let failed = |why: &dyn ToString| RecordError::Sheet { file: name.to_owned(), why: why.to_string() };
    let mut book = open_workbook_auto_from_rs(Cursor::new(bytes)).map_err(|error| failed(&error))?;
    for page in book.sheet_names() {
        let sheet = book.worksheet_range(&page).map_err(|error| failed(&error))?;
        if sheet.is_empty() {
            continue;
        }
        let mut text = String::new();
        for row in sheet.rows() {
            for (place, cell) in row.iter().enumerate() {
                let start = if place == 0 { "" } else { "\t" };
                // The stored number is used, not its displayed form.
                let _ = match cell {
                    Data::Float(number) => write!(text, "{start}{number}"),
                    other => write!(text, "{start}{}", other.to_string().replace(['\t', '\n', '\r'], " ")),
                };
            }
            text.push('\n');
        }
        return Ok(text);
    }
    Err(failed(&"the sheet has no cells"))
}

/// In a browser there are no files.
#[cfg(target_family = "wasm")]
pub(crate) fn text(name: &str, _: &[u8]) -> Result<String, RecordError> {
    Err(RecordError::Sheet { file: name.to_owned(), why: "there are no files here".to_owned() })
}
