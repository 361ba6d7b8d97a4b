//! One case after the other, on one thread.

use super::Study;
use super::quick::{Quick, Shortcut};
use super::wanted::{Place, Wanted};
use crate::report::summary;
use crate::steady::outlook;
use serde_json::Value;
use stickslip_drive::RunError;
use stickslip_run::summary::Status;
use stickslip_run::{Job, Summary, Watcher};
use stickslip_scenario::{Report, ScenarioError};

/// Why a case has no results.
pub(crate) enum Fault {
    /// Somebody interrupted it.
    Interrupted,
    /// Its numbers make no scenario, or its run stopped itself.
    Failed(String),
}

/// Where cases are run.
///
/// What a case comes to depends on its numbers alone. Where [`Shortcut`] knows how, it is run without reading the scenario again; numbers
/// that nobody has read yet are, which makes sure that they are in their ranges, and so is what fails, for the words.
pub(crate) struct Worker<'s> {
    study: &'s Study,
    quick: Option<Quick<'s>>,
    watcher: &'s (dyn Watcher + Sync),
    numbers: Vec<f64>,
    /// Between which values each number was read and found good.
    known: Vec<[f64; 2]>,
    row: Vec<f64>,
}

struct Silent<'s>(&'s (dyn Watcher + Sync));

impl Watcher for Silent<'_> {
    fn reached(&self, _: f64) {}
    fn goes_on(&self) -> bool {
        self.0.goes_on()
    }
}

impl<'s> Worker<'s> {
    pub(crate) fn new(
        study: &'s Study,
        shortcut: Option<&'s Shortcut>,
        watcher: &'s (dyn Watcher + Sync),
    ) -> Self {
        let axes = study.design.axes.len();
        Self {
            study,
            quick: shortcut.map(|shortcut| Quick::new(shortcut, watcher)),
            watcher,
            numbers: vec![0.0; axes],
            known: vec![[f64::INFINITY, f64::NEG_INFINITY]; axes],
            row: Vec::new(),
        }
    }

    /// Appends the results of a case; where it has none, nothing.
    pub(crate) fn run(&mut self, case: u64, results: &mut Vec<f64>) -> Result<(), Fault> {
        self.study.design.write(case, &mut self.numbers);
        let is_known =
            self.numbers.iter().zip(&self.known).all(|(number, [low, high])| (low..=high).contains(&number));
        if let (true, Some(quick)) = (is_known, &mut self.quick)
            && let Some(found) = quick.run(&self.numbers)
        {
            results.extend_from_slice(found);
            return Ok(());
        }
        if !self.watcher.goes_on() {
            return Err(Fault::Interrupted);
        }
        let job = self
            .study
            .job
            .with(&self.study.design.overrides(&self.numbers))
            .map_err(|error| refused(&error))?;
        for (number, [low, high]) in self.numbers.iter().zip(&mut self.known) {
            (*low, *high) = (low.min(*number), high.max(*number));
        }
        if let Some(quick) = &mut self.quick
            && let Some(found) = quick.run(&self.numbers)
        {
            results.extend_from_slice(found);
            return Ok(());
        }
        record(without_output(job), (&self.study.wanted, self.watcher), &mut self.row, results)
    }
}

/// Appends what is wanted of a job, which is run as `stickslip run` does; `row` is room for a row.
pub(crate) fn record(
    mut job: Job,
    (wanted, watcher): (&[Wanted], &(dyn Watcher + Sync)),
    row: &mut Vec<f64>,
    results: &mut Vec<f64>,
) -> Result<(), Fault> {
    let goes_on = || watcher.goes_on();
    if !wanted.iter().any(Wanted::needs_rows) {
        job.scenario.plan.every = Some(job.scenario.plan.duration);
    }
    if wanted.iter().any(Wanted::is_of_motion) {
        // It is asked for: at whatever it costs.
        job.scenario.steady_motion = Some(true);
    }
    if wanted.iter().all(Wanted::is_of_motion) {
        let found = outlook(&job, None, &goes_on);
        if !goes_on() {
            return Err(Fault::Interrupted);
        }
        let told = serde_json::json!({ "steady_motion": found });
        results.extend(wanted.iter().map(|wanted| wanted.of(&told)));
        return Ok(());
    }
    let outcome = job.run(&Silent(watcher));
    if matches!(outcome.error, Some(RunError::Interrupted { .. })) && outcome.excess.is_none() {
        return Err(Fault::Interrupted);
    }
    let summary = if wanted.iter().any(Wanted::needs_outlook) {
        let (summary, gave_up) = summary(&job, &outcome, &goes_on);
        if gave_up && !goes_on() {
            return Err(Fault::Interrupted);
        }
        summary
    } else {
        Summary::new(&job, &outcome)
    };
    if summary.status != Status::Done {
        return Err(Fault::Failed(
            summary.stop().map_or_else(String::new, |(why, _)| format!("stopped: {why}")),
        ));
    }
    // Numbers and texts: there is nothing that JSON could refuse.
    let is_told = wanted.iter().any(|wanted| matches!(wanted.place, Place::Summary(_)));
    let told = if is_told { serde_json::to_value(&summary).unwrap_or_default() } else { Value::Null };
    outcome.state.write_row(&job.model, row);
    results.extend(wanted.iter().map(|wanted| match wanted.place {
        Place::End(place) => row.get(place).copied().unwrap_or(f64::NAN),
        Place::Summary(_) => wanted.of(&told),
    }));
    Ok(())
}

/// A job of which nothing is drawn, and nothing written but what summaries are made of; no clock ends it, whose time is another one on
/// every machine.
pub(crate) fn without_output(mut job: Job) -> Job {
    job.scenario.plots.clear();
    job.scenario.own_plots.clear();
    (job.scenario.springs, job.scenario.memory, job.scenario.fields) = (None, None, None);
    job.scenario.plan.limits.wall = None;
    job
}

/// What is wrong with the numbers of a case, in one line.
pub(crate) fn refused(error: &ScenarioError) -> Fault {
    let Report { path, message, .. } = &**error;
    let message = message.lines().next().unwrap_or_default();
    Fault::Failed(if path.is_empty() { message.to_owned() } else { format!("{path}: {message}") })
}
