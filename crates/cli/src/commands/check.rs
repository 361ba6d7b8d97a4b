//! `stickslip check`: reports all errors that a run would report, without a run.

use crate::arguments::CheckArguments;
use schemars::JsonSchema;
use serde::Serialize;
use std::path::Path;
use stickslip_console::answer::warn;
use stickslip_console::answer::{complain, say, say_json};
use stickslip_console::verdict::Verdict;
use stickslip_run::{Job, Refusal};
use stickslip_scenario::Report;

/// Result of the check of a file, for JSON.
#[derive(Debug, Serialize, JsonSchema)]
struct Finding<'a> {
    /// name of the file, as given
    file: &'a Path,
    /// whether a run would accept the file
    ok: bool,
    /// first entry of `errors`, with the same keys. Absent if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<bool>")]
    error: Option<Fault>,
    /// Errors in the order of the file, without consequences of other errors; at most twenty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<Fault>,
    /// true if there are more errors than the twenty listed. Absent otherwise.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    more: bool,
    /// checks that the errors prevented, completely or in part: `form` (keys, units, ranges), `meaning` (relations
    /// between parts), `equilibrium` (existence of a static start), `limits` (rows, lines and memory of a run). They
    /// may reveal more errors. Absent if all were done.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    not_checked: Vec<&'static str>,
    /// Warnings: valid but implausible values.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<Fault>,
}

/// Error or warning with its position. Lines and columns count from 1, columns in characters.
#[derive(Debug, Default, Serialize, JsonSchema)]
struct Fault {
    /// kind of a warning, one word for programs. Absent in errors.
    #[serde(skip_serializing_if = "Option::is_none")]
    kind: Option<&'static str>,
    /// name of the table that contains line and column. Absent if they are in the scenario file.
    #[serde(skip_serializing_if = "Option::is_none")]
    table: Option<String>,
    /// argument of `--set` that contains line and column. Absent if they are in a file.
    #[serde(rename = "override", skip_serializing_if = "Option::is_none")]
    assignment: Option<String>,
    /// line of the position, from 1. Absent without a position.
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    /// column of the position in characters, from 1. Absent without a position.
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<usize>,
    /// number of characters to which the message refers. Absent without a position.
    #[serde(skip_serializing_if = "Option::is_none")]
    width: Option<usize>,
    /// path of the key, such as `contacts.ball.friction`. Empty for the file as a whole.
    path: String,
    /// expected and given value, or what is implausible
    message: String,
    /// advice. Absent if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    help: Option<String>,
}

/// Checks all files. Prints "ok" on stdout or errors on stderr for each; with `--json`, prints everything on stdout.
pub(crate) fn check(arguments: &CheckArguments) -> Verdict {
    let mut worst = Verdict::Done;
    for file in &arguments.files {
        let job = Job::prepare(file, &arguments.set, Path::new(""));
        if job.is_err() {
            worst = Verdict::BadInput;
        }
        tell(arguments, file, &job);
    }
    worst
}

fn tell(arguments: &CheckArguments, file: &Path, job: &Result<Job, Refusal>) {
    if arguments.json {
        let odd = job.as_ref().map_or_else(|_| Vec::new(), |job| job.warnings());
        let finding = Finding {
            file,
            ok: job.is_ok(),
            error: job.as_ref().err().and_then(|refusal| Fault::all(refusal, file).into_iter().next()),
            errors: job.as_ref().err().map_or_else(Vec::new, |refusal| Fault::all(refusal, file)),
            more: matches!(job, Err(Refusal::Scenario(error)) if error.has_more()),
            not_checked: match job {
                Err(Refusal::Scenario(error)) => error.left_out().iter().map(|stage| stage.word()).collect(),
                _ => Vec::new(),
            },
            warnings: odd.iter().map(|odd| Fault { kind: Some(odd.kind), ..Fault::at(odd, file) }).collect(),
        };
        // Only a path that is not Unicode cannot be serialised.
        let line = serde_json::to_string(&finding);
        say_json(&line.unwrap_or_else(|_| format!("{{\"ok\":{}}}", job.is_ok())));
        return;
    }
    match job {
        Err(refusal) => {
            complain(format_args!("{refusal}"));
        }
        Ok(_) if arguments.quiet => {}
        Ok(job) => {
            warn(job);
            say(format_args!("{}: ok", file.display()));
        }
    }
}

impl Fault {
    fn all(refusal: &Refusal, file: &Path) -> Vec<Self> {
        match refusal {
            Refusal::Scenario(error) => error.reports().map(|report| Self::at(report, file)).collect(),
            other => vec![Self { message: other.to_string(), ..Self::default() }],
        }
    }

    fn at(report: &Report, file: &Path) -> Self {
        let excerpt = report.excerpt.as_ref();
        let elsewhere = !report.is_override && Path::new(&report.file) != file;
        Self {
            kind: None,
            table: elsewhere.then(|| report.file.clone()),
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

/// Returns the definitions of all keys of `check --json`.
pub(super) fn definitions() -> Vec<stickslip_quantity::Definition> {
    stickslip_quantity::report::<Finding<'_>>("check --json")
}
