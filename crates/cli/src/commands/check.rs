//! `stickslip check`: everything that a run would refuse, and no run.

use crate::arguments::CheckArguments;
use schemars::JsonSchema;
use serde::Serialize;
use std::path::Path;
use stickslip_console::answer::warn;
use stickslip_console::answer::{complain, say, say_json};
use stickslip_console::verdict::Verdict;
use stickslip_run::{Job, Refusal};
use stickslip_scenario::Report;

/// What is found of a file, for machines.
#[derive(Debug, Serialize, JsonSchema)]
struct Finding<'a> {
    /// the file as it was named
    file: &'a Path,
    /// whether a run would take it
    ok: bool,
    /// the first of `errors`, with the same keys
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<bool>")]
    error: Option<Fault>,
    /// Everything that is wrong and no consequence of something else, in the order of the file; at most twenty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<Fault>,
    /// `true` where there are more errors than the twenty listed
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    more: bool,
    /// what was not judged, or not all of it, because of the errors: `form` (keys, units, ranges), `meaning` (what parts are to
    /// each other), `equilibrium` (whether there is one to start from), `limits` (rows, lines and memory of a run); more may be
    /// wrong there
    #[serde(skip_serializing_if = "Vec::is_empty")]
    not_checked: Vec<&'static str>,
    /// What is allowed and probably not meant.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<Fault>,
}

/// What is wrong, and where. Lines and columns count from 1, columns in characters.
#[derive(Debug, Default, Serialize, JsonSchema)]
struct Fault {
    /// of warnings: what it is about, one word for machines
    #[serde(skip_serializing_if = "Option::is_none")]
    kind: Option<&'static str>,
    /// the table that line and column count in, where one that the scenario names is to blame
    #[serde(skip_serializing_if = "Option::is_none")]
    table: Option<String>,
    /// the argument of --set that line and column count in, where one is to blame
    #[serde(rename = "override", skip_serializing_if = "Option::is_none")]
    assignment: Option<String>,
    /// line, from 1
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    /// column in characters, from 1
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<usize>,
    /// characters that are to blame
    #[serde(skip_serializing_if = "Option::is_none")]
    width: Option<usize>,
    /// key path such as `contacts.ball.friction`; empty for the file as a whole
    path: String,
    /// what was expected and what came
    message: String,
    /// what to try
    #[serde(skip_serializing_if = "Option::is_none")]
    help: Option<String>,
}

/// Checks all files and says of each what it found: "ok" on stdout, errors on stderr; with `--json` all on stdout.
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
        // A path that is not Unicode is the only thing that JSON has no words for.
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

/// What every key of `check --json` is.
pub(super) fn definitions() -> Vec<stickslip_quantity::Definition> {
    stickslip_quantity::report::<Finding<'_>>("check --json")
}
