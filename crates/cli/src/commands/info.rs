//! `stickslip info`: what a scenario means, before it runs.

pub(super) mod columns;
pub(super) mod digits;
pub(super) mod tables;

use crate::arguments::InfoArguments;
use std::path::Path;
use std::time::Instant;
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::verdict::Verdict;
use stickslip_run::Job;
use stickslip_study::Info;

/// Reads and builds a scenario and prints what it means.
pub(crate) fn info(arguments: &InfoArguments) -> Verdict {
    let job = match Job::prepare(&arguments.file, &arguments.set, Path::new("")) {
        Ok(job) => job,
        Err(refusal) => {
            complain(format_args!("{refusal}"));
            return Verdict::BadInput;
        }
    };
    warn(&job);
    let begun = Instant::now();
    let wall = job.scenario.plan.limits.wall.unwrap_or(f64::INFINITY);
    let info = Info::of(&job, &|| begun.elapsed().as_secs_f64() < wall);
    // Numbers and strings only: there is nothing that JSON could refuse.
    if arguments.json {
        say_json(&serde_json::to_string(&info).unwrap_or_default());
    } else {
        say(format_args!("{}", tables::text(&info)));
    }
    Verdict::Done
}
