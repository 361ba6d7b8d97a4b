//! What a variant of a scenario comes to: a run in memory, and steady motion where it is asked for.

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

/// How often something happened, by who and what.
pub(super) type Happened = BTreeMap<(String, String), usize>;

/// What a variant came to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Sample {
    /// The figures in their order; none where there is no such figure.
    pub(super) figures: Vec<Option<f64>>,
    /// Events of the run; none where none was asked for.
    #[serde(with = "crate::journal::pairs")]
    pub(super) happened: Happened,
}

/// Why there is none.
#[derive(Debug, Clone, PartialEq, Error, Serialize, Deserialize)]
pub enum Missing {
    /// Nobody computed it: the command was interrupted before.
    #[error("not run")]
    NotRun,
    /// The value makes no scenario.
    #[error("refused: {0}")]
    Refused(String),
    /// The run stopped itself.
    #[error("stopped: {0}")]
    Stopped(String),
    /// The figure is not there.
    #[error("the figure is not there")]
    Absent,
    /// Values that no smooth curve leads through, however near.
    #[error("no smooth change is seen")]
    Rough,
}

/// What a run leaves.
pub(super) struct Ran {
    pub(super) summary: Value,
    end: HashMap<String, f64>,
    happened: Happened,
}

/// Events this near to the end of a run, as a share of it, are at its end, on one side of it or the other.
const END: f64 = 1e-9;

impl Ran {
    /// The last value of a channel.
    pub(super) fn at_end(&self, channel: &str) -> Option<f64> {
        self.end.get(channel).copied()
    }

    /// What happened.
    pub(super) fn happened(self) -> Happened {
        self.happened
    }

    /// Runs a job.
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
        // A summary is numbers and strings: there is nothing that JSON could refuse.
        let summary = serde_json::to_value(Summary::new(job, &outcome)).unwrap_or_default();
        Ok(Self { summary, end, happened })
    }
}

/// A scenario as derivatives are taken of it: by the stepper that locates events, with nothing written, for as long as it takes.
pub(super) fn ready(mut scenario: Scenario, name: &str, tolerance: f64) -> Result<Job, ScenarioError> {
    scenario.plan.stepper = Stepper::Event { tolerance };
    scenario.plan.limits.wall = None;
    (scenario.springs, scenario.memory, scenario.fields) = (None, None, None);
    // Moments of events are kept for whoever draws them.
    scenario.plots = vec![PlotName::Events];
    scenario.own_plots.clear();
    scenario.written.digits = None;
    scenario.written.window = [0.0, f64::INFINITY];
    let events = &mut scenario.written.events;
    (events.kinds, events.contacts, events.most) = (None, None, u64::MAX);
    Job::new(scenario, name.to_owned(), PathBuf::new())
}

/// A job with a number at another value.
pub(super) fn variant(job: &Job, path: &str, value: f64, tolerance: f64) -> Result<Job, Missing> {
    // Whatever is a default in the file stands in the resolved scenario, and the points of tables.
    let value = format!("{value:e}");
    let scenario = Scenario::from_str_with(&job.resolved, &job.name, "", &[(path, &value)]);
    let refused = |error: ScenarioError| Missing::Refused(one_line(&error.to_string()).to_owned());
    ready(scenario.map_err(refused)?, &job.name, tolerance).map_err(refused)
}

/// A job with rows at its beginning and its end alone.
pub(super) fn without_rows(mut job: Job) -> Job {
    job.scenario.plan.every = Some(job.scenario.plan.duration);
    job
}

impl Sample {
    /// Reads figures of a job.
    pub(super) fn of(
        job: &Job,
        figures: &[Figure],
        tolerance: f64,
        watcher: &dyn Watcher,
    ) -> Result<Self, Missing> {
        // What is read and built before a run takes its time, too.
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

/// Step, m, and speed, m/s, of steady motion; none where it is not found.
fn steadily(job: &Job, tolerance: f64, watcher: &dyn Watcher) -> Result<Option<[f64; 2]>, Missing> {
    match find_steady(job, tolerance, watcher) {
        Ok(found) => Ok(found),
        Err(SteadyError::Interrupted(_)) => Err(Missing::NotRun),
        Err(_) => Ok(None),
    }
}

/// The same with the reason.
pub(super) fn find_steady(
    job: &Job,
    tolerance: f64,
    watcher: &dyn Watcher,
) -> Result<Option<[f64; 2]>, SteadyError> {
    let goes_on = || watcher.goes_on();
    let options = Options { tolerance, goes_on: &goes_on, ..Options::default() };
    let found = steady::find(job, &options)?;
    // Of a step that is none the derivatives are those of what it may be off.
    if found.step.is_some() && !found.steps() {
        return Err(SteadyError::NoStep { least: found.bound });
    }
    Ok(found.step.zip(found.speed()).map(|(step, speed)| [step, speed]))
}

/// What is wrong without the excerpt of the file and the help, which stand below it.
fn one_line(fault: &str) -> &str {
    fault.lines().next().unwrap_or_default()
}
