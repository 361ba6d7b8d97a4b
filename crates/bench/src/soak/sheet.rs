//! Output of findings: counts by kind, exceptions by seed, and a table.

use super::finding::{Finding, Verdict};
use std::io;

/// Name of the table of all findings.
pub const TABLE: &str = "soak.csv";

/// Returns the number of findings of a kind and a verdict.
pub fn count(findings: &[Finding], kind: Option<&str>, verdict: Verdict) -> usize {
    let same =
        |finding: &&Finding| kind.is_none_or(|kind| finding.kind == kind) && finding.verdict == verdict;
    findings.iter().filter(same).count()
}

/// Returns a line for each finding that is neither right nor warned.
pub fn exceptions(findings: &[Finding]) -> Vec<String> {
    let odd = findings.iter().filter(|finding| finding.verdict > Verdict::Warned);
    let mut odd: Vec<&Finding> = odd.collect();
    odd.sort_by_key(|finding| (std::cmp::Reverse(finding.verdict), finding.seed));
    odd.iter().map(|f| format!("{}: {} ({}): {}", f.seed, f.verdict.name(), f.kind, f.note)).collect()
}

/// Returns all findings as CSV.
///
/// # Errors
/// An error of the CSV writer.
pub fn table(findings: &[Finding]) -> io::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record([
        "seed",
        "kind",
        "verdict",
        "error_1e-6",
        "error_1e-8",
        "growth",
        "books",
        "row_error",
        "row_own_error",
        "runs",
        "wall_s",
        "longest_s",
        "detours",
        "note",
    ])?;
    for f in findings {
        let (runs, wall, longest) = f.runs;
        writer.write_record([
            f.seed.to_string(),
            f.kind.to_owned(),
            f.verdict.name().to_owned(),
            number(f.errors[0]),
            number(f.errors[1]),
            number(f.growth),
            number(f.books),
            number(f.row[0]),
            number(f.row[1]),
            runs.to_string(),
            number(wall),
            number(longest),
            f.detours.to_string(),
            f.note.clone(),
        ])?;
    }
    writer.into_inner().map_err(|error| io::Error::other(error.to_string()))
}

/// Formats a number; NaN gives an empty text.
fn number(value: f64) -> String {
    if value.is_nan() { String::new() } else { format!("{value:.3e}") }
}
