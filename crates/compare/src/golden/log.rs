//! Log of the changes of goldens, with dates and reasons.

use super::GoldenError;
use std::fs;
use std::path::Path;
use std::time::SystemTime;
use stickslip_run::folder;
use stickslip_run::program::VERSION;

const LOG: &str = "log.md";
const HEAD: &str =
    "# Why golden results changed\n\n| date | version | scenarios | reason |\n| --- | --- | --- | --- |\n";
/// Minimum number of letters of a reason.
const LETTERS: usize = 8;

/// Returns the reason on a single line.
///
/// # Errors
/// Fails if the reason has fewer than eight letters.
pub(super) fn checked(reason: &str) -> Result<String, GoldenError> {
    let letters = reason.chars().filter(|c| c.is_alphabetic()).count();
    let reason = reason.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "/");
    if letters < LETTERS { Err(GoldenError::NoReason) } else { Ok(reason) }
}

/// Appends a line to the log of changes.
pub(super) fn append(root: &Path, names: &[String], reason: &str) -> Result<(), GoldenError> {
    let path = root.join(LOG);
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => HEAD.to_owned(),
        Err(source) => return Err(GoldenError::File { path, source }),
    };
    let now = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
    let line = format!("| {} | {VERSION} | {} | {reason} |\n", &now[..10], names.join(", "));
    folder::write(&path, (text + &line).as_bytes()).map_err(|source| GoldenError::File { path, source })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reason_has_words() {
        for reason in ["", "  ", "...", "1"] {
            assert!(checked(reason).is_err(), "{reason:?}");
        }
        assert_eq!(checked("another  sum |\n of loads").unwrap(), "another sum / of loads");
    }
}
