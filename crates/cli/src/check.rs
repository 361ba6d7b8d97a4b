//! `stickslip check`: everything that a run would refuse, and no run.

use crate::arguments::CheckArguments;
use crate::job::{Job, Refusal};
use crate::verdict::Verdict;
use serde::Serialize;
use std::io::Write;
use std::path::Path;

/// What is found of a file, for machines.
#[derive(Debug, Serialize)]
struct Finding<'a> {
    file: &'a Path,
    ok: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Fault>,
}

/// What is wrong, and where. Lines and columns count from 1, columns in characters.
#[derive(Debug, Default, Serialize)]
struct Fault {
    /// The argument of `--set` that line and column count in, where one is to blame.
    #[serde(rename = "override", skip_serializing_if = "Option::is_none")]
    assignment: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<usize>,
    /// Characters that are to blame.
    #[serde(skip_serializing_if = "Option::is_none")]
    width: Option<usize>,
    /// Key path; empty for the file as a whole.
    path: String,
    message: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    help: Option<String>,
}

/// Checks all files and says of each what it found: "ok" on stdout, errors on stderr; with `--json` all on stdout.
pub(crate) fn check(arguments: &CheckArguments) -> Verdict {
    let mut worst = Verdict::Done;
    for file in &arguments.files {
        let refusal = Job::prepare(file, &arguments.set, Path::new("")).err();
        if refusal.is_some() {
            worst = Verdict::BadInput;
        }
        tell(arguments, file, refusal.as_ref());
    }
    worst
}

/// A closed pipe does not change what was found.
fn tell(arguments: &CheckArguments, file: &Path, refusal: Option<&Refusal>) {
    let mut stdout = std::io::stdout();
    if arguments.json {
        let finding = Finding { file, ok: refusal.is_none(), error: refusal.map(Fault::of) };
        // A path that is not Unicode is the only thing that JSON has no words for.
        let line = serde_json::to_string(&finding);
        let _ = writeln!(stdout, "{}", line.unwrap_or_else(|_| format!("{{\"ok\":{}}}", refusal.is_none())));
        return;
    }
    match refusal {
        Some(refusal) => {
            let _ = writeln!(std::io::stderr(), "{refusal}");
        }
        None if arguments.quiet => {}
        None => {
            let _ = writeln!(stdout, "{}: ok", file.display());
        }
    }
}

impl Fault {
    fn of(refusal: &Refusal) -> Self {
        let Refusal::Scenario(report) = refusal else {
            return Self { message: refusal.to_string(), ..Self::default() };
        };
        let excerpt = report.excerpt.as_ref();
        Self {
            assignment: report.is_override.then(|| report.file.clone()),
            line: excerpt.map(|e| e.line),
            column: excerpt.map(|e| e.column),
            width: excerpt.map(|e| e.marker.len()),
            path: report.path.clone(),
            message: report.message.clone(),
            help: report.help.clone(),
        }
    }
}
