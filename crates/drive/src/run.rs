//! Runs: a model and a plan move a state, a record watches.

mod chords;
mod events;
mod fixed;
mod output;
mod reference;
mod watch;

use crate::record::Record;
use crate::{Model, Plan, RunError, State, Stepper};

/// Moves `state` along `plan` to its end. What was computed before an error is in `state` and `record`.
pub fn run(model: &Model, plan: &Plan, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
    match plan.stepper {
        Stepper::Event { tolerance } => events::Run::new(model, plan, tolerance).go(state, record),
        _ if model.free.is_empty() => {
            // Nothing to integrate: the path of the contacts is prescribed, whatever the stepper.
            events::Run::new(model, plan, WALK_TOLERANCE).go(state, record)
        }
        Stepper::Verlet { step } => fixed::run(model, plan, fixed::Method::Verlet, step, state, record),
        Stepper::Rk4 { step } => fixed::run(model, plan, fixed::Method::Rk4, step, state, record),
        Stepper::Dopri5 { tolerance } => reference::run(model, plan, tolerance, state, record),
    }
}

/// Tolerance of a quasi-static walk where its scenario names a stepper without one.
const WALK_TOLERANCE: f64 = 1e-10;
