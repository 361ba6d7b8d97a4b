//! Memory limit of a run (`run.limits.memory`): checked before the start and during the run.

use crate::info::Expectation;
use crate::job::Job;
use crate::kept::grows;
use stickslip_quantity::Real;
use stickslip_quantity::quantity;
use stickslip_scenario::{PlotName, ScenarioError};
use thiserror::Error;

/// Advice for runs that exceed the memory limit.
pub(crate) const ADVICE: &str = "increase run.limits.memory, draw fewer plots, or write fewer rows and events (output.every, window, events)";

/// Error: a run exceeds its memory limit.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("at t = {t:?} s the run keeps {} of rows, events and cycles in memory, more than run.limits.memory, {}", quantity(Real(*.kept), "B"), quantity(Real(*.limit), "B"))]
pub struct Excess {
    /// Time reached, s.
    pub t: f64,
    /// Memory used, B.
    pub kept: f64,
    /// Memory limit, B.
    pub limit: f64,
}

impl Excess {
    /// Returns advice on reducing the memory.
    pub fn advice(&self) -> &'static str {
        ADVICE
    }
}

/// Checks the expected memory of a run before its start.
///
/// # Errors
/// The expected memory exceeds the limit.
pub(crate) fn check(job: &Job) -> Result<(), ScenarioError> {
    let Some(limit) = job.scenario.memory_limit else { return Ok(()) };
    let expected = Expectation::of(job);
    let kept = expected.kept.0;
    // If the memory cannot be estimated (NaN), it is checked during the run.
    let is_more = kept > limit;
    if !is_more {
        return Ok(());
    }
    let plots = job.scenario.plots.iter().filter(|plot| grows(**plot));
    let plots: Vec<&str> = plots.copied().map(PlotName::name).collect();
    let (rows, events, size) = (expected.rows.0, expected.events_written.0, quantity(Real(kept), "B"));
    let message = format!(
        "the run would keep {size} in memory, expected at most {}: {rows:.3e} rows and about {events:.1e} events for its plots ({})",
        quantity(Real(limit), "B"),
        plots.join(", ")
    );
    Err(job.scenario.locate("run.limits.memory", message, Some(ADVICE.to_owned())))
}
