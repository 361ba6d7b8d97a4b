//! `summary.json`: what a run came to, in numbers.

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

/// Most numbers that are not finite of which a note gives the names.
const NAMED: usize = 5;
/// What to try where there is no room for the results.
const UNWRITTEN_ADVICE: &str = "make room, choose another place with --out, or write fewer rows";

/// The summary of a run. Everything but `timing` is the same whenever the same scenario is run.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Summary {
    /// the scenario's
    #[serde(skip_serializing_if = "String::is_empty")]
    title: String,
    program: Program,
    /// SHA-256 of scenario.json beside the summary
    scenario_sha256: String,
    stepper: Stepper,
    /// `done`, `stopped` (by itself, before its time) or `interrupted`
    pub status: Status,
    /// Why the run did not come to its end, and what to try.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Stop>,
    /// time reached
    #[serde(rename = "simulated_s")]
    pub simulated: Real,
    /// periods after which the run ended, as run.until_steady asked
    #[serde(rename = "steady_after_periods", skip_serializing_if = "Option::is_none")]
    pub steady_after: Option<usize>,
    counts: Counts,
    /// what the number of a state of trace.csv and events.csv means, with output.states as numbers
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-name" = "CODE"))]
    states: Option<Parts<&'static str>>,
    /// By name.
    #[schemars(extend("x-name" = "CONTACT"))]
    pub contacts: Parts<ContactSummary>,
    /// Steps of the drive; none without a free body driven by a periodic waveform.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<DriveSummary>,
    /// The motion that it would settle on if its waveforms never ended; whoever has looked for it tells.
    #[serde(skip_serializing_if = "Option::is_none")]
    steady_motion: Option<Outlook>,
    energy: Balance,
    /// Driver electronics by the names of their stacks.
    #[serde(skip_serializing_if = "Parts::is_empty")]
    #[schemars(extend("x-name" = "ACTUATOR"))]
    drivers: Parts<DriverSummary>,
    /// What the results are not worth, and what is odd about their scenario; empty where there is nothing to say.
    pub warnings: Vec<Warning>,
    /// what is missing, and why
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<String>,
    /// files beside the summary
    files: Vec<String>,
    /// What the tables among them hold, by their names: readers refuse others.
    #[serde(skip_serializing_if = "Parts::is_empty")]
    #[schemars(extend("x-name" = "FILE"))]
    tables: Parts<Seal>,
    /// whether the tables end before the run did, for lack of room
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    cut: bool,
    /// What differs from run to run.
    timing: Timing,
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// At its time, or when its steps had become constant, if it was to end then.
    Done,
    /// By itself, before its time.
    Stopped,
    /// By a signal.
    Interrupted,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Program {
    /// the program that computed the results
    name: &'static str,
    /// its version
    version: &'static str,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Stepper {
    /// the stepper that was taken
    name: &'static str,
    /// its tolerance: local error per step, relative to the scales of the contacts
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<Real>,
    /// its step, where that is fixed
    #[serde(rename = "step_s", skip_serializing_if = "Option::is_none")]
    step: Option<Real>,
}

#[derive(Debug, Serialize, JsonSchema)]
struct Stop {
    /// why the run stopped early
    message: String,
    /// what to try
    advice: &'static str,
}

impl Stop {
    /// A disk without room ends a run in whatever words it is told to stop.
    fn of(outcome: &Outcome) -> Option<Self> {
        let unwritten = |failure: &io::Error| Self {
            message: format!("the results could not be written any further: {}", words(failure)),
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
    /// accepted steps
    steps: u64,
    /// steps whose error estimate missed the tolerance, taken again
    rejected: u64,
    /// evaluations of all forces
    evaluations: u64,
    /// located events
    events: u64,
    /// events in events.csv, where output.events, a window or thinning left some out, or rows of springs told of gross slip
    /// that no event located
    #[serde(skip_serializing_if = "Option::is_none")]
    events_written: Option<u64>,
    /// time until which events.csv has all that were asked for; ever fewer of those that follow
    #[serde(rename = "events_whole_until_s", skip_serializing_if = "Option::is_none")]
    events_whole_until: Option<Real>,
    /// intervals of step doubling on the full force law, where events accumulated
    #[serde(rename = "step_doublings", skip_serializing_if = "is_none")]
    detours: u64,
    /// steps of these that missed the tolerance
    #[serde(rename = "missed_tolerance", skip_serializing_if = "is_none")]
    missed: u64,
    /// rows of trace.csv
    rows: u64,
}

/// What is said of events that were thinned.
fn thinned(events: TakenEvents) -> Option<String> {
    let TakenEvents { seen, taken, whole_until } = events;
    let whole = quantity(Real(whole_until?), "s");
    Some(format!(
        "{EVENTS} has {taken} of {seen} events: all until {whole}, ever fewer of those that follow; output.events asks for more, or for none"
    ))
}

/// Whether nothing of a kind has happened.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "the serialiser asks by reference")]
fn is_none(count: &u64) -> bool {
    *count == 0
}

#[derive(Debug, Serialize, JsonSchema)]
struct Timing {
    /// wall-clock time of the run
    #[serde(rename = "wall_s")]
    wall: Real,
    /// simulated time over the wall-clock time of stepping
    simulated_s_per_s: Real,
}

impl Summary {
    /// Of each driver that a limit held back, for how much of the run.
    pub fn driver_limits(&self) -> impl Iterator<Item = String> {
        self.drivers.0.iter().filter_map(|(name, driver)| driver.line(name))
    }

    /// The summary of a run, still without its list of files.
    pub fn new(job: &Job, outcome: &Outcome) -> Self {
        let mut notes = Vec::new();
        if outcome.kept.left_out > 0 {
            let left_out = outcome.kept.left_out;
            notes.push(format!("{left_out} events found no room in memory: pictures are without them"));
        }
        if outcome.tally.left_out() > 0 {
            let left_out = outcome.tally.left_out();
            notes.push(format!(
                "{left_out} moments found no room in memory: cycles that they belong to are not told"
            ));
        }
        let unwritten = outcome.absent.iter();
        notes.extend(unwritten.map(|name| format!("{name} is not there: nothing of it could be written")));
        let mut warnings = warning::of_scenario(job);
        warnings.extend(warning::of_run(job, outcome));
        let simulated = outcome.state.time();
        let (name, word, value) = job.stepper();
        let value_if = |wanted| (word == wanted).then_some(Real(value));
        let (counts, taken) = (outcome.state.counts(), outcome.events);
        notes.extend(thinned(taken));
        // Of a row of springs the run located no gross slip that its record tells; steppers of fixed steps locate nothing.
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

    /// Says what the drive would settle on. Steps that have settled on it are at least as far off as they are from it.
    pub fn set_outlook(&mut self, outlook: Option<Outlook>) {
        if let (Some(steps), Some(Outlook::Found(motion))) = (&mut self.steps, &outlook) {
            steps.compare(motion);
        }
        self.steady_motion = outlook;
    }

    /// What the drive would settle on.
    pub fn outlook(&self) -> Option<&Outlook> {
        self.steady_motion.as_ref()
    }

    /// Says what is missing, and why.
    pub fn note(&mut self, note: String) {
        self.notes.push(note);
    }

    /// Names the files beside the summary.
    pub fn set_files(&mut self, files: Vec<String>) {
        self.files = files;
    }

    /// Says what the tables hold.
    pub fn set_tables(&mut self, seals: Vec<(String, Seal)>) {
        self.tables = Parts(seals);
    }

    /// Why the run did not come to its end, and what to try.
    pub fn stop(&self) -> Option<(&str, &'static str)> {
        self.error.as_ref().map(|stop| (stop.message.as_str(), stop.advice))
    }

    /// The notes for the terminal: on events that were thinned without having been asked to be, and why no step is reported.
    pub fn printed_notes(&self) -> impl Iterator<Item = &str> {
        let is_printed = |note: &&str| note.starts_with(EVENTS) || note.starts_with(steps::NO_STEP);
        self.notes.iter().map(String::as_str).filter(is_printed)
    }

    /// The files beside the summary.
    pub fn files(&self) -> &[String] {
        &self.files
    }

    /// As JSON for people and machines.
    pub fn pretty(&self) -> io::Result<String> {
        let text = serde_json::to_string_pretty(self)?;
        Ok(match self.noted(&text)? {
            Some(noted) => serde_json::to_string_pretty(&noted)?,
            None => text,
        } + "\n")
    }

    /// As JSON in one line.
    pub fn line(&self) -> io::Result<String> {
        let text = serde_json::to_string(self)?;
        Ok(self.noted(&text)?.map_or(text, |noted| noted.to_string()))
    }

    /// The same with a note where numbers are not finite; none where all are.
    fn noted(&self, text: &str) -> io::Result<Option<Value>> {
        // A name may have the word as well.
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

/// Names of all that is null, such as `steps.steady.step_m`.
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
