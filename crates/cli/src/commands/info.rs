//! `stickslip info`: what a scenario means, before it runs.

pub(super) mod columns;
pub(super) mod digits;
pub(super) mod tables;

use crate::arguments::InfoArguments;
use serde::Serialize;
use std::path::Path;
use std::time::Instant;
use stickslip_console::answer::{complain, say, say_json, warn};
use stickslip_console::verdict::Verdict;
use stickslip_run::Job;
use stickslip_run::Parts;
use stickslip_run::Warning;
use stickslip_run::info::{
    self, BodyInfo, ContactInfo, Expectation, ModeInfo, PiezoInfo, Stepping, Usage, WaveformInfo,
};
use stickslip_run::outlook::Outlook;
use stickslip_study::steady::outlook;

/// Derived numbers of a scenario, in SI.
#[derive(Debug, Serialize)]
struct Info {
    scenario: String,
    #[serde(skip_serializing_if = "String::is_empty")]
    title: String,
    /// SHA-256 of the resolved scenario, as in the summary of a run.
    scenario_sha256: String,
    bodies: Parts<BodyInfo>,
    waveforms: Parts<WaveformInfo>,
    contacts: Parts<ContactInfo>,
    /// Normal modes with all contacts stuck, by rising frequency.
    modes: Vec<ModeInfo>,
    /// Piezo stacks and their drivers.
    actuators: Parts<PiezoInfo>,
    /// What the drive would settle on if its waveforms never ended.
    #[serde(skip_serializing_if = "Option::is_none")]
    steady_motion: Option<Outlook>,
    stepping: Stepping,
    expected: Expectation,
    usage: Usage,
    /// What is odd about the scenario, as in the summary of a run.
    warnings: Vec<Warning>,
}

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
    let info = Info::of(&job);
    // Numbers and strings only: there is nothing that JSON could refuse.
    if arguments.json {
        say_json(&serde_json::to_string(&info).unwrap_or_default());
    } else {
        say(format_args!("{}", info.text()));
    }
    Verdict::Done
}

impl Info {
    fn of(job: &Job) -> Self {
        let modes = info::modes(job);
        let (begun, wall) = (Instant::now(), job.scenario.plan.limits.wall.unwrap_or(f64::INFINITY));
        Self {
            scenario: job.name.clone(),
            title: job.scenario.title.clone(),
            scenario_sha256: job.hash.clone(),
            bodies: info::bodies(job),
            waveforms: info::waveforms(job),
            contacts: info::contacts(job),
            steady_motion: outlook(job, None, &|| begun.elapsed().as_secs_f64() < wall),
            stepping: Stepping::of(job),
            expected: Expectation::of(job),
            actuators: info::piezos(job),
            usage: Usage::of(job),
            warnings: stickslip_run::warning::of_scenario(job),
            modes,
        }
    }
}
