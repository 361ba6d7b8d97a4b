//! Results of a variant of the scenario: from a run in memory, and from its periodic orbit if requested.

use super::figure::{self, Figure, Reading};
use crate::steady::{self, Options, SteadyError};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;
use stickslip_drive::{RunError, Stepper};
use stickslip_run::{Job, Summary, Watcher};
use stickslip_scenario::{PlotName, Scenario, ScenarioError};
use thiserror::Error;

/// Numbers of events by source and kind.
pub(super) type Happened = BTreeMap<(String, String), usize>;

/// Results of a variant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Sample {
    /// Values of all results in the requested order; `None` for a missing result.
    pub(super) figures: Vec<Option<f64>>,
    /// Numbers of events of the run; empty without a run.
    #[serde(with = "crate::journal::pairs")]
    pub(super) happened: Happened,
}

/// Reason why a result is missing.
#[derive(Debug, Clone, PartialEq, Error, Serialize, Deserialize)]
pub enum Missing {
    /// The command was interrupted before this run.
    #[error("not run")]
    NotRun,
    /// The parameter value gives an invalid scenario.
    #[error("refused: {0}")]
    Refused(String),
    /// The run stopped early.
    #[error("stopped: {0}")]
    Stopped(String),
    /// The run does not have this result.
    #[error("the result does not exist")]
    Absent,
    /// The results do not approach a smooth curve at any distance.
    #[error("the result does not change smoothly")]
    Rough,
}

/// Data of a run.
pub(super) struct Ran {
    pub(super) summary: Value,
    end: HashMap<String, f64>,
    happened: Happened,
}

/// Smallest distance of an event to the end of a run, relative to its duration. Rounding decides whether closer events belong to the run.
const END: f64 = 1e-9;

impl Ran {
    /// Returns the last value of a channel.
    pub(super) fn at_end(&self, channel: &str) -> Option<f64> {
        self.end.get(channel).copied()
    }

    /// Returns the events.
    pub(super) fn happened(self) -> Happened {
        self.happened
    }

    /// Runs a scenario in memory.
    pub(super) fn of(job: &Job, watcher: &dyn Watcher) -> Result<Self, Missing> {
        let outcome = job.run(watcher);
        match &outcome.error {
            Some(RunError::Interrupted { .. }) if outcome.excess.is_none() => return Err(Missing::NotRun),
            Some(error) => return Err(Missing::Stopped(error.to_string())),
            None => {}
        }
        let until = outcome.kept.end() * (1.0 - END);
        let tracks = outcome.kept.tracks.iter().flat_map(|tracks| tracks.all());
        let happened = tracks.filter_map(|track| {
            let count = track.times.partition_point(|t| *t < until);
            (count > 0).then(|| ((track.source.clone(), track.kind.clone()), count))
        });
        let happened = happened.collect();
        let channels = job.model.channels();
        let last = |name: &String| outcome.kept.series.named(name).last().copied();
        let end = channels
            .into_iter()
            .skip(1)
            .filter_map(|channel| Some((channel.name.clone(), last(&channel.name)?)));
        let end = end.collect();
        // Serialisation cannot fail, because the summary consists of numbers and strings.
        let summary = serde_json::to_value(Summary::new(job, &outcome)).unwrap_or_default();
        Ok(Self { summary, end, happened })
    }
}

/// Prepares a scenario for derivatives: integrator with event location, no output files, no limit of wall time.
pub(super) fn ready(mut scenario: Scenario, name: &str, tolerance: f64) -> Result<Job, ScenarioError> {
    scenario.plan.stepper = Stepper::Event { tolerance };
    scenario.plan.limits.wall = None;
    (scenario.springs, scenario.memory, scenario.fields) = (None, None, None);
    // Event times are only kept for runs with a plot of events.
    scenario.plots = vec![PlotName::Events];
    scenario.own_plots.clear();
    scenario.written.digits = None;
    scenario.written.window = [0.0, f64::INFINITY];
    let events = &mut scenario.written.events;
    (events.kinds, events.contacts, events.most) = (None, None, u64::MAX);
    Job::new(scenario, name.to_owned(), PathBuf::new())
}

/// Returns the scenario with another value of a parameter.
pub(super) fn variant(job: &Job, path: &str, value: f64, tolerance: f64) -> Result<Job, Missing> {
    // The resolved scenario contains default values and the points of tables.
    let value = format!("{value:e}");
    let scenario = Scenario::from_str_with(&job.resolved, &job.name, "", &[(path, &value)]);
    let refused = |error: ScenarioError| Missing::Refused(one_line(&error.to_string()).to_owned());
    ready(scenario.map_err(refused)?, &job.name, tolerance).map_err(refused)
}

/// Returns the scenario with output rows only at start and end.
pub(super) fn without_rows(mut job: Job) -> Job {
    job.scenario.plan.every = Some(job.scenario.plan.duration);
    job
}

impl Sample {
    /// Computes the results of a variant.
    pub(super) fn of(
        job: &Job,
        figures: &[Figure],
        tolerance: f64,
        watcher: &dyn Watcher,
    ) -> Result<Self, Missing> {
        // Reading and building a scenario take time before the run.
        if !watcher.goes_on() {
            return Err(Missing::NotRun);
        }
        let runs = figures.iter().any(|figure| figure.reading.is_of_run());
        let ran = if runs { Some(Ran::of(job, watcher)?) } else { None };
        let steady = if figures.iter().all(|figure| figure.reading.is_of_run()) {
            None
        } else {
            steadily(job, tolerance, watcher)?
        };
        let mut leaves = Vec::new();
        if let Some(ran) = &ran {
            figure::numbers(String::new(), &ran.summary, &mut leaves);
        }
        let read = |figure: &Figure| match figure.reading {
            Reading::Summary => {
                leaves.iter().find(|(name, _)| *name == figure.name).and_then(|(_, value)| value.as_f64())
            }
            Reading::End => ran.as_ref()?.at_end(&figure.name),
            Reading::SteadyStep => steady.map(|[step, _]| step),
            Reading::SteadySpeed => steady.map(|[_, speed]| speed),
        };
        let figures = figures.iter().map(read).collect();
        Ok(Self { figures, happened: ran.map(|ran| ran.happened).unwrap_or_default() })
    }
}

/// Returns step length, m, and mean velocity, m/s, of the periodic orbit, or `None` if no orbit is found.
fn steadily(job: &Job, tolerance: f64, watcher: &dyn Watcher) -> Result<Option<[f64; 2]>, Missing> {
    match find_steady(job, tolerance, watcher) {
        Ok(found) => Ok(found),
        Err(SteadyError::Interrupted(_)) => Err(Missing::NotRun),
        Err(_) => Ok(None),
    }
}

/// Returns step length and velocity as [`steadily`] does, or the reason why no orbit is found.
pub(super) fn find_steady(
    job: &Job,
    tolerance: f64,
    watcher: &dyn Watcher,
) -> Result<Option<[f64; 2]>, SteadyError> {
    let goes_on = || watcher.goes_on();
    let options = Options { tolerance, goes_on: &goes_on, ..Options::default() };
    let found = steady::find(job, &options)?;
    // A step length below its error has no meaningful derivative.
    if found.step.is_some() && !found.steps() {
        return Err(SteadyError::NoStep { least: found.bound });
    }
    Ok(found.step.zip(found.speed()).map(|(step, speed)| [step, speed]))
}

/// Returns the first line of an error message, without excerpt and help.
fn one_line(fault: &str) -> &str {
    fault.lines().next().unwrap_or_default()
}
