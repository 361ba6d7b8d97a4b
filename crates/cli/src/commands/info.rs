//! `stickslip info`: properties of a scenario before a run.

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

/// Builds the model of a scenario and prints its properties.
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
    // The report consists of numbers and strings, for which JSON has no errors.
    if arguments.json {
        say_json(&serde_json::to_string(&info).unwrap_or_default());
    } else {
        say(format_args!("{}", tables::text(&info)));
    }
    Verdict::Done
}
