//! Runs: a model and a plan move a state, a record watches.

mod bounds;
mod chords;
mod fixed;
mod horizon;
mod ledger;
mod located;
mod output;
mod reference;
mod steady;

use crate::record::Record;
use crate::{Model, Plan, RunError, State, Stepper};
use stickslip_stepper::{Rk4, Verlet};

/// Moves `state` along `plan` to its end: its duration, or earlier where it asks for no more than steady steps. What was
/// computed before an error is in `state` and `record`.
///
/// Never inlined: profilers find here all that a run costs.
#[inline(never)]
pub fn run(model: &Model, plan: &Plan, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
    match model.effective(plan.stepper) {
        Stepper::Event { tolerance } => located::run(model, plan, tolerance, state, record),
        Stepper::Verlet { step } => fixed::run::<Verlet>(model, plan, step, state, record),
        Stepper::Rk4 { step } => fixed::run::<Rk4>(model, plan, step, state, record),
        Stepper::Dopri5 { tolerance } => reference::run(model, plan, tolerance, state, record),
    }
}

impl Model {
    /// The stepper that a run really takes. Where nothing is free there is nothing to integrate: the contacts are
    /// walked along their prescribed path from event to event, whatever was asked for.
    pub fn effective(&self, asked: Stepper) -> Stepper {
        if self.free.is_empty() && !asked.locates_events() {
            return Stepper::Event { tolerance: WALK_TOLERANCE };
        }
        asked
    }
}

/// Tolerance of a quasi-static walk where its scenario names a stepper without one.
const WALK_TOLERANCE: f64 = 1e-10;
