//! Runs: a model and a plan move a state, a record watches.
//!
//! A [`Run`] is one that its caller holds; [`run`] is the same to the end of its plan.

mod bounds;
mod chords;
mod fixed;
mod held;
mod horizon;
mod ledger;
mod located;
mod output;
mod reference;
mod steady;
mod stored;
mod variants;

pub use held::Run;
pub use variants::{VariantError, Variants};

use crate::contact::Contact;
use crate::record::Record;
use crate::{Model, Plan, RunError, State, Stepper};

/// Moves `state` along `plan` to its end: its duration, or earlier where it asks for no more than steady steps. What was
/// computed before an error is in `state` and `record`.
///
/// Never inlined: profilers find here all that a run costs.
#[inline(never)]
pub fn run(model: &Model, plan: &Plan, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
    if let Stepper::Dopri5 { tolerance } = model.effective(plan.stepper) {
        return reference::run(model, plan, tolerance, state, record);
    }
    held::to_the_end(model, plan, state, record)
}

impl Model {
    /// The stepper that a run really takes. Where nothing is free there is nothing to integrate: the contacts are
    /// walked along their prescribed path from event to event, whatever was asked for.
    pub fn effective(&self, asked: Stepper) -> Stepper {
        if self.free.is_empty() && !asked.locates_events() {
            return Stepper::Event { tolerance: WALK_TOLERANCE };
        }
        match asked {
            // Places without mass are solved for, to rounding: their events are found as well, and nothing is gained by less.
            Stepper::Event { tolerance } if !self.balanced.is_empty() => {
                Stepper::Event { tolerance: tolerance.min(WALK_TOLERANCE) }
            }
            asked => asked,
        }
    }

    /// Whether a run by this stepper tells turns of u of contact `index` as [`EventKind::Turn`](crate::EventKind::Turn): between
    /// located events, under a normal that varies, slip on the curve. Everywhere else they are its reversals and ends of gross slip.
    pub fn tells_turns(&self, asked: Stepper, index: usize) -> bool {
        self.effective(asked).locates_events() && self.contacts.get(index).is_some_and(Contact::turns_unseen)
    }
}

/// Tolerance of a quasi-static walk where its scenario names a stepper without one.
pub const WALK_TOLERANCE: f64 = 1e-10;
