//! The limit of memory: what a run would keep, before it starts, and what it keeps while it goes on.

use crate::info::Expectation;
use crate::job::Job;
use crate::kept::grows;
use stickslip_quantity::Real;
use stickslip_quantity::quantity;
use stickslip_scenario::{PlotName, ScenarioError};
use thiserror::Error;

/// What to try where a run keeps too much.
pub(crate) const ADVICE: &str = "raise run.limits.memory, draw fewer pictures (plots), or write fewer rows and events (output.every, window, events)";

/// A run that keeps more than it may.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("at t = {t:?} s the run keeps {} of rows, events and cycles in memory, more than the {} of run.limits.memory", quantity(Real(*.kept), "B"), quantity(Real(*.limit), "B"))]
pub struct Excess {
    /// Time reached, s.
    pub t: f64,
    /// What it keeps, B.
    pub kept: f64,
    /// What it may keep, B.
    pub limit: f64,
}

impl Excess {
    /// What to try.
    pub fn advice(&self) -> &'static str {
        ADVICE
    }
}

/// Refuses a run that would keep more than it may.
pub(crate) fn check(job: &Job) -> Result<(), ScenarioError> {
    let Some(limit) = job.scenario.memory_limit else { return Ok(()) };
    let expected = Expectation::of(job);
    let kept = expected.kept.0;
    // Whatever cannot be estimated is bounded while the run goes on.
    let is_more = kept > limit;
    if !is_more {
        return Ok(());
    }
    let plots = job.scenario.plots.iter().filter(|plot| grows(**plot));
    let plots: Vec<&str> = plots.copied().map(PlotName::name).collect();
    let (rows, events, size) = (expected.rows.0, expected.events_written.0, quantity(Real(kept), "B"));
    let message = format!(
        "the run would keep {size} in memory, expected at most {}: {rows:.3e} rows and some {events:.1e} events for its pictures ({})",
        quantity(Real(limit), "B"),
        plots.join(", ")
    );
    Err(job.scenario.locate("run.limits.memory", message, Some(ADVICE.to_owned())))
}
