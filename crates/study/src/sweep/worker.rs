//! Runs the cases of a study one after another on one thread.

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

/// Reason why a case has no results.
pub(crate) enum Fault {
    /// The watcher interrupted.
    Interrupted,
    /// The scenario is invalid or its run stopped early.
    Failed(String),
}

/// Runs cases of a study.
///
/// The results of a case depend only on its parameter values. If fast runs ([`Shortcut`]) are possible, cases run without reading the
/// scenario again. Otherwise the scenario is read again, as for values outside the range of earlier values and for the error message of a
/// failed case.
pub(crate) struct Worker<'s> {
    study: &'s Study,
    quick: Option<Quick<'s>>,
    watcher: &'s (dyn Watcher + Sync),
    numbers: Vec<f64>,
    /// Range of each parameter within which values are known to be valid.
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

    /// Appends the results of a case.
    ///
    /// # Errors
    /// Fails if the case has no results; `results` then remains unchanged.
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

/// Runs a scenario like `stickslip run` and appends the requested results to `results`. `row` is a buffer.
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
        // The study requests results of the periodic orbit, so the search for it has no limit.
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
    // Serialisation cannot fail, because the summary consists of numbers and strings.
    let is_told = wanted.iter().any(|wanted| matches!(wanted.place, Place::Summary(_)));
    let told = if is_told { serde_json::to_value(&summary).unwrap_or_default() } else { Value::Null };
    outcome.state.write_row(&job.model, row);
    results.extend(wanted.iter().map(|wanted| match wanted.place {
        Place::End(place) => row.get(place).copied().unwrap_or(f64::NAN),
        Place::Summary(_) => wanted.of(&told),
    }));
    Ok(())
}

/// Returns a job without plots, optional output files and limit of wall time. A time limit would change results on slow machines.
pub(crate) fn without_output(mut job: Job) -> Job {
    job.scenario.plots.clear();
    job.scenario.own_plots.clear();
    (job.scenario.springs, job.scenario.memory, job.scenario.fields) = (None, None, None);
    job.scenario.plan.limits.wall = None;
    job
}

/// Returns the error of an invalid case in one line.
pub(crate) fn refused(error: &ScenarioError) -> Fault {
    let Report { path, message, .. } = &**error;
    let message = message.lines().next().unwrap_or_default();
    Fault::Failed(if path.is_empty() { message.to_owned() } else { format!("{path}: {message}") })
}
