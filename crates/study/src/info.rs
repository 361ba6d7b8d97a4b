//! Properties of a scenario before it runs: `stickslip info --json`.

use crate::steady::outlook;
use schemars::JsonSchema;
use serde::Serialize;
use stickslip_run::info::{
    self, BodyInfo, ContactInfo, Expectation, ModeInfo, PiezoInfo, Stepping, Usage, WaveformInfo,
};
use stickslip_run::outlook::Outlook;
use stickslip_run::{Job, Parts, Warning, warning};

/// Derived numbers of a scenario, in SI.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Info {
    /// name of the scenario
    pub scenario: String,
    /// title of the scenario. Absent if it has none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// SHA-256 of the complete scenario, with all defaults and --set values, the same as in summary.json of a run
    pub scenario_sha256: String,
    /// Bodies.
    #[schemars(extend("x-name" = "BODY"))]
    pub bodies: Parts<BodyInfo>,
    /// Waveforms.
    #[schemars(extend("x-name" = "WAVEFORM"))]
    pub waveforms: Parts<WaveformInfo>,
    /// Contacts.
    #[schemars(extend("x-name" = "CONTACT"))]
    pub contacts: Parts<ContactInfo>,
    /// Normal modes with all contacts in full stick, by increasing frequency.
    pub modes: Vec<ModeInfo>,
    /// Piezo stacks and their drivers.
    #[schemars(extend("x-name" = "ACTUATOR"))]
    pub actuators: Parts<PiezoInfo>,
    /// Periodic orbit with endless waveforms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steady_motion: Option<Outlook>,
    /// Time integration.
    pub stepping: Stepping,
    /// Expected output of a run.
    pub expected: Expectation,
    /// Computations of a run, and omitted ones.
    pub usage: Usage,
    /// Warnings about the scenario, as in the summary of a run.
    pub warnings: Vec<Warning>,
}

impl Info {
    /// Computes the properties of a scenario. The search for the periodic orbit calls `goes_on` before every period and stops if `goes_on`
    /// returns `false`.
    #[must_use]
    pub fn of(job: &Job, goes_on: &dyn Fn() -> bool) -> Self {
        let modes = info::modes(job);
        Self {
            scenario: job.name.clone(),
            title: job.scenario.title.clone(),
            scenario_sha256: job.hash.clone(),
            bodies: info::bodies(job),
            waveforms: info::waveforms(job),
            contacts: info::contacts(job),
            steady_motion: outlook(job, None, goes_on),
            stepping: Stepping::of(job),
            expected: Expectation::of(job),
            actuators: info::piezos(job),
            usage: Usage::of(job),
            warnings: warning::of_scenario(job),
            modes,
        }
    }
}
