//! `stickslip view`: scenarios in one interactive HTML file.

use crate::arguments::ViewArguments;
use serde_json::json;
use std::io;
use std::path::{Path, PathBuf};
use stickslip_console::answer::{complain, say};
use stickslip_console::verdict::Verdict;
use stickslip_run::complaint::words;
use stickslip_run::{Job, Refusal, folder};
use thiserror::Error;

/// Name of the page with the engine.
const PAGE: &str = "page.html";
/// Element of the page that contains the scenarios.
const SCENES: [&str; 2] = ["<script id=\"scenes\" type=\"application/json\">", "</script>"];

/// Error that stops the command.
#[derive(Debug, Error)]
enum ViewFailure {
    #[error(transparent)]
    Refused(#[from] Refusal),
    #[error("{}: the page of stickslip is not there\n   help: releases contain it, and `.ci/page` makes it; or give its path with --page", .0.display())]
    NoPage(PathBuf),
    #[error("{}: is not the page of stickslip\n   help: give that of a release or of `.ci/page`", .0.display())]
    OtherPage(PathBuf),
    #[error("{}: {}", .path.display(), words(.source))]
    Read { path: PathBuf, source: io::Error },
    #[error("{}: cannot be written: {}", .path.display(), words(.source))]
    Write { path: PathBuf, source: io::Error },
}

/// Writes the page.
pub(crate) fn view(arguments: &ViewArguments) -> Verdict {
    match write(arguments) {
        Ok(()) => Verdict::Done,
        Err(failure) => {
            complain(format_args!("{failure}"));
            match failure {
                ViewFailure::Write { .. } => Verdict::Stopped,
                _ => Verdict::BadInput,
            }
        }
    }
}

fn write(arguments: &ViewArguments) -> Result<(), ViewFailure> {
    let jobs = arguments.files.iter().map(|file| Job::prepare(file, &arguments.set, Path::new("")));
    let jobs = jobs.collect::<Result<Vec<_>, _>>()?;
    let path = arguments.page.clone().unwrap_or_else(beside);
    if !path.is_file() {
        return Err(ViewFailure::NoPage(path));
    }
    let page =
        std::fs::read_to_string(&path).map_err(|source| ViewFailure::Read { path: path.clone(), source })?;
    let scenes: Vec<_> = jobs.iter().map(|job| json!({ "name": job.name, "text": job.resolved })).collect();
    let page = filled(&page, &json!(scenes).to_string()).ok_or(ViewFailure::OtherPage(path))?;
    let name = jobs.first().map_or("stickslip", |job| job.name.as_str());
    let out = arguments.out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.html")));
    folder::write(&out, page.as_bytes())
        .map_err(|source| ViewFailure::Write { path: out.clone(), source })?;
    let scenarios =
        if jobs.len() == 1 { "1 scenario".to_owned() } else { format!("{} scenarios", jobs.len()) };
    say(format_args!("{}: {scenarios}, {:.2} MB", out.display(), page.len() as f64 / 1e6));
    Ok(())
}

/// Returns the path of the page beside the program.
fn beside() -> PathBuf {
    let program = std::env::current_exe().and_then(std::fs::canonicalize).unwrap_or_default();
    program.parent().unwrap_or(Path::new(".")).join(PAGE)
}

/// Returns the page with these scenarios instead of its own.
fn filled(page: &str, scenes: &str) -> Option<String> {
    let [open, close] = SCENES;
    let (before, rest) = page.split_once(open)?;
    let (_, after) = rest.split_once(close)?;
    // No text of a scenario ends the element.
    let scenes = scenes.replace("</", "<\\/").replace("<!--", "<\\u0021--");
    Some([before, open, &scenes, close, after].concat())
}
