//! `summary.json`: the results of a run.

mod contacts;
mod drivers;
mod fretting;
mod losses;
mod period;
mod steps;
mod why;

use crate::complaint::words;
use crate::excess::{self, Excess};
use crate::files::EVENTS;
use crate::job::Job;
use crate::outcome::Outcome;
use crate::outlook::Outlook;
use crate::parts::Parts;
use crate::program;
use crate::seal::Seal;
use crate::selection::TakenEvents;
use crate::states::legend;
use crate::warning;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use std::io;
use stickslip_drive::RunError;
use stickslip_measure::Warning;
use stickslip_measure::books::Balance;
use stickslip_quantity::Real;
use stickslip_quantity::quantity;

pub use contacts::ContactSummary;
pub use drivers::DriverSummary;
pub use fretting::Fretting;
pub use losses::Losses;
pub use period::{ContactPeriod, LastPeriod, PeriodWork, Way, load};
pub(crate) use steps::flight;
pub use steps::{DriveSummary, SettlingSummary, Steady, step_bounds};
pub use stickslip_measure::contact_cycles::JudgedCycle;

/// Maximum number of keys that the note about values that are not finite names.
const NAMED: usize = 5;
/// Advice for a disk without space.
const UNWRITTEN_ADVICE: &str = "free disk space, choose another folder with --out, or write fewer rows";

/// Summary of a run. Everything except `timing` is identical whenever the same scenario is run.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Summary {
    /// title of the scenario. Absent if it has none.
    #[serde(skip_serializing_if = "String::is_empty")]
    title: String,
    program: Program,
    /// SHA-256 of scenario.json in the same folder
    scenario_sha256: String,
    stepper: Stepper,
    /// end of the run: `done` (as planned), `stopped` (early, see error) or `interrupted` (by the user)
    pub status: Status,
    /// Reason of an early end, and advice.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Stop>,
    /// simulated time at the end of the run
    #[serde(rename = "simulated_s")]
    pub simulated: Real,
    /// number of periods after which run.until_steady ended the run. Absent if it did not.
    #[serde(rename = "steady_after_periods", skip_serializing_if = "Option::is_none")]
    pub steady_after: Option<usize>,
    counts: Counts,
    /// meaning of the number of a contact state in trace.csv and events.csv. Absent unless output.states is `numbers`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-name" = "CODE"))]
    states: Option<Parts<&'static str>>,
    /// Contacts by name.
    #[schemars(extend("x-name" = "CONTACT"))]
    pub contacts: Parts<ContactSummary>,
    /// Steps of the drive. Absent without a free body and a periodic waveform.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<DriveSummary>,
    /// Periodic orbit of the drive with endless waveforms, if the caller searched for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    steady_motion: Option<Outlook>,
    energy: Balance,
    /// Driver electronics by name of the stack.
    #[serde(skip_serializing_if = "Parts::is_empty")]
    #[schemars(extend("x-name" = "ACTUATOR"))]
    drivers: Parts<DriverSummary>,
    /// Warnings about the scenario and the results.
    pub warnings: Vec<Warning>,
    /// missing results with the reason, and notes on numbers that are not finite
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<String>,
    /// names of the files that the run wrote
    files: Vec<String>,
    /// Row counts and SHA-256 of the tables by file name. Readers reject a table that differs.
    #[serde(skip_serializing_if = "Parts::is_empty")]
    #[schemars(extend("x-name" = "FILE"))]
    tables: Parts<Seal>,
    /// true if the tables end before the run did, because a table could not be written further. Absent otherwise.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    cut: bool,
    /// Wall-clock times. They differ from run to run.
    timing: Timing,
}

/// End of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// At the planned time, or when run.until_steady was satisfied.
    Done,
    /// Early, by an error or a limit.
    Stopped,
    /// By a signal.
    Interrupted,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Program {
    /// name of the program that computed the results
    name: &'static str,
    /// version of the program that computed the results
    version: &'static str,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Stepper {
    /// name of the time integrator (key run.stepper)
    name: &'static str,
    /// tolerance of the time integrator: local error per time step relative to the natural scales of the contacts
    /// (contacts.NAME.scales). Absent for fixed time steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<Real>,
    /// fixed time step. Absent for adaptive time integrators.
    #[serde(rename = "step_s", skip_serializing_if = "Option::is_none")]
    step: Option<Real>,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Stop {
    /// reason why the run ended early. Absent otherwise.
    message: String,
    /// advice for avoiding the early end of the run. Absent otherwise.
    advice: &'static str,
}

impl Stop {
    /// Returns the reason why a run ended early. A write error takes precedence over all other reasons.
    fn of(outcome: &Outcome) -> Option<Self> {
        let unwritten = |failure: &io::Error| Self {
            message: format!("the results could not be written completely: {}", words(failure)),
            advice: UNWRITTEN_ADVICE,
        };
        let stopped = |error: &RunError| Self { message: error.to_string(), advice: error.advice() };
        let full = |excess: Excess| Self { message: excess.to_string(), advice: excess::ADVICE };
        let failure = outcome.failure.as_ref().map(unwritten).or_else(|| outcome.excess.map(full));
        failure.or_else(|| outcome.error.as_ref().map(stopped))
    }
}

#[derive(Debug, Serialize, JsonSchema)]
struct Counts {
    /// number of accepted time steps
    steps: u64,
    /// number of rejected time steps: their error estimate exceeded the tolerance, and they were repeated
    rejected: u64,
    /// number of evaluations of the forces
    evaluations: u64,
    /// number of located events
    events: u64,
    /// number of rows of events.csv. Absent if it equals the number of located events.
    #[serde(skip_serializing_if = "Option::is_none")]
    events_written: Option<u64>,
    /// time until which events.csv has all requested events. Later events are thinned out. Absent if none are.
    #[serde(rename = "events_whole_until_s", skip_serializing_if = "Option::is_none")]
    events_whole_until: Option<Real>,
    /// number of intervals that were integrated by step doubling on the full force law, because events accumulated.
    /// Absent if 0.
    #[serde(rename = "step_doublings", skip_serializing_if = "is_none")]
    detours: u64,
    /// number of time steps in step doubling that missed the tolerance. Absent if 0.
    #[serde(rename = "missed_tolerance", skip_serializing_if = "is_none")]
    missed: u64,
    /// number of rows of trace.csv
    rows: u64,
}

/// Returns the note about events that were thinned out.
fn thinned(events: TakenEvents) -> Option<String> {
    let TakenEvents { seen, taken, whole_until } = events;
    let whole = quantity(Real(whole_until?), "s");
    Some(format!(
        "{EVENTS} has {taken} of {seen} events: all until {whole}, then an increasingly thinned selection; set output.events to change this"
    ))
}

/// Returns whether a count is 0.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "the serialiser asks by reference")]
fn is_none(count: &u64) -> bool {
    *count == 0
}

#[derive(Debug, Serialize, JsonSchema)]
struct Timing {
    /// wall-clock time of the run
    #[serde(rename = "wall_s")]
    wall: Real,
    /// simulated time divided by the wall-clock time of the integration
    simulated_s_per_s: Real,
}

impl Summary {
    /// Returns one sentence for each driver that a limit restricted, with the fraction of the time.
    pub fn driver_limits(&self) -> impl Iterator<Item = String> {
        self.drivers.0.iter().filter_map(|(name, driver)| driver.line(name))
    }

    /// Creates the summary of a run, without the list of files.
    pub fn new(job: &Job, outcome: &Outcome) -> Self {
        let mut notes = Vec::new();
        if outcome.kept.left_out > 0 {
            let left_out = outcome.kept.left_out;
            notes.push(format!("{left_out} events did not fit into memory; plots are drawn without them"));
        }
        if outcome.tally.left_out() > 0 {
            let left_out = outcome.tally.left_out();
            notes.push(format!(
                "{left_out} samples of loops did not fit into memory; their cycles are left out"
            ));
        }
        let unwritten = outcome.absent.iter();
        notes.extend(unwritten.map(|name| format!("{name} is missing: it could not be written")));
        let mut warnings = warning::of_scenario(job);
        warnings.extend(warning::of_run(job, outcome));
        let simulated = outcome.state.time();
        let (name, word, value) = job.stepper();
        let value_if = |wanted| (word == wanted).then_some(Real(value));
        let (counts, taken) = (outcome.state.counts(), outcome.events);
        notes.extend(thinned(taken));
        // The record contains gross slip events of spring rows, which the run does not count; fixed time steps locate no events.
        let others = word == "tolerance" && taken.taken != counts.events;
        let drivers = drivers::of(job, &outcome.state);
        Self {
            title: job.scenario.title.clone(),
            program: Program { name: program::NAME, version: program::VERSION },
            scenario_sha256: job.hash.clone(),
            stepper: Stepper { name, tolerance: value_if("tolerance"), step: value_if("step_s") },
            status: Status::of(outcome),
            error: Stop::of(outcome),
            simulated: Real(simulated),
            steady_after: steps::steady_after(job, outcome),
            counts: Counts {
                steps: counts.steps,
                rejected: counts.rejected,
                evaluations: counts.evaluations,
                events: counts.events,
                events_written: (taken.taken != taken.seen || others).then_some(taken.taken),
                events_whole_until: taken.whole_until.map(Real),
                detours: counts.detours,
                missed: counts.missed,
                rows: outcome.rows,
            },
            states: job.scenario.written.state_numbers.then(|| Parts(legend())),
            contacts: contacts::of(job, outcome),
            steps: steps::of(job, outcome, &drivers, &mut notes),
            steady_motion: None,
            energy: outcome.books.balance(),
            drivers,
            warnings,
            notes,
            files: Vec::new(),
            tables: Parts(Vec::new()),
            cut: outcome.failure.is_some(),
            timing: Timing { wall: Real(outcome.wall), simulated_s_per_s: Real(simulated / outcome.wall) },
        }
    }

    /// Sets the periodic orbit. The error of a steady step length then includes its distance from the orbit.
    pub fn set_outlook(&mut self, outlook: Option<Outlook>) {
        if let (Some(steps), Some(Outlook::Found(motion))) = (&mut self.steps, &outlook) {
            steps.compare(motion);
        }
        self.steady_motion = outlook;
    }

    /// Returns the periodic orbit, if the caller searched for it.
    pub fn outlook(&self) -> Option<&Outlook> {
        self.steady_motion.as_ref()
    }

    /// Adds a note.
    pub fn note(&mut self, note: String) {
        self.notes.push(note);
    }

    /// Sets the list of files.
    pub fn set_files(&mut self, files: Vec<String>) {
        self.files = files;
    }

    /// Sets row counts and SHA-256 of the tables.
    pub fn set_tables(&mut self, seals: Vec<(String, Seal)>) {
        self.tables = Parts(seals);
    }

    /// If the run ended early, returns the reason and advice.
    pub fn stop(&self) -> Option<(&str, &'static str)> {
        self.error.as_ref().map(|stop| (stop.message.as_str(), stop.advice))
    }

    /// Returns the notes for the terminal: about thinned events, and about the reason for missing steps.
    pub fn printed_notes(&self) -> impl Iterator<Item = &str> {
        let is_printed = |note: &&str| note.starts_with(EVENTS) || note.starts_with(steps::NO_STEP);
        self.notes.iter().map(String::as_str).filter(is_printed)
    }

    /// Returns the list of files.
    pub fn files(&self) -> &[String] {
        &self.files
    }

    /// Returns the summary as indented JSON.
    pub fn pretty(&self) -> io::Result<String> {
        let text = serde_json::to_string_pretty(self)?;
        Ok(match self.noted(&text)? {
            Some(noted) => serde_json::to_string_pretty(&noted)?,
            None => text,
        } + "\n")
    }

    /// Returns the summary as one line of JSON.
    pub fn line(&self) -> io::Result<String> {
        let text = serde_json::to_string(self)?;
        Ok(self.noted(&text)?.map_or(text, |noted| noted.to_string()))
    }

    /// Returns the summary with a note about values that are not finite. Returns `None` if all values are finite.
    fn noted(&self, text: &str) -> io::Result<Option<Value>> {
        // A name may also contain the word "null".
        if !text.contains("null") {
            return Ok(None);
        }
        let mut value = serde_json::to_value(self)?;
        let mut names = Vec::new();
        nulls(String::new(), &value, &mut names);
        let (count, some) = (names.len(), names.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", "));
        if count == 0 {
            return Ok(None);
        }
        let more = if count > NAMED { format!(" and {} more", count - NAMED) } else { String::new() };
        let note = Value::String(format!("null stands for a number that is not finite: {some}{more}"));
        match value.get_mut("notes").and_then(Value::as_array_mut) {
            Some(notes) => notes.push(note),
            None => value["notes"] = Value::Array(vec![note]),
        }
        Ok(Some(value))
    }
}

/// Collects the paths of all values that are null, such as `steps.steady.step_m`.
fn nulls(name: String, value: &Value, names: &mut Vec<String>) {
    let dot = if name.is_empty() { "" } else { "." };
    match value {
        Value::Null => names.push(name),
        Value::Object(entries) => {
            entries.iter().for_each(|(key, value)| nulls(format!("{name}{dot}{key}"), value, names));
        }
        Value::Array(entries) => {
            entries.iter().enumerate().for_each(|(i, value)| nulls(format!("{name}[{i}]"), value, names));
        }
        _ => {}
    }
}

impl Status {
    fn of(outcome: &Outcome) -> Self {
        let has_ended = outcome.failure.is_none() && outcome.excess.is_none();
        match (has_ended, &outcome.error) {
            (true, None) => Self::Done,
            (true, Some(RunError::Interrupted { .. })) => Self::Interrupted,
            _ => Self::Stopped,
        }
    }
}
