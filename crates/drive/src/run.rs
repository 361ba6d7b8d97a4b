//! Runs of a model.
//!
//! [`run`] simulates to the end of a plan; a [`Run`] advances on request.

mod advance;
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
mod stretch;
mod variants;

pub use held::Run;
pub use variants::{VariantError, Variants};

use crate::contact::Contact;
use crate::record::Record;
use crate::{Model, Plan, RunError, State, Stepper};

/// Advances `state` to the end of `plan`: after its duration, or earlier at a steady step length if the plan allows it. After an error,
/// `state` and `record` contain the results before the error.
///
/// # Errors
///
/// [`RunError`]: the reason why the run stopped.
///
/// Never inlined, so that profilers attribute all cost to it.
#[inline(never)]
pub fn run(model: &Model, plan: &Plan, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
    if let Stepper::Dopri5 { tolerance } = model.effective(plan.stepper) {
        return reference::run(model, plan, tolerance, state, record);
    }
    held::to_the_end(model, plan, state, record)
}

impl Model {
    /// Returns the stepper that a run uses. Without free coordinates the contacts follow their prescribed path from event to
    /// event, whatever stepper is requested.
    pub fn effective(&self, asked: Stepper) -> Stepper {
        if self.free.is_empty() && !asked.locates_events() {
            return Stepper::Event { tolerance: WALK_TOLERANCE };
        }
        match asked {
            // Balanced positions are solved to rounding, so a larger tolerance would save nothing.
            Stepper::Event { tolerance } if !self.balanced.is_empty() => {
                Stepper::Event { tolerance: tolerance.min(WALK_TOLERANCE) }
            }
            asked => asked,
        }
    }

    /// Whether a run with this stepper reports reversals of u of contact `index` as [`EventKind::Turn`](crate::EventKind::Turn). Such
    /// reports require event location, a varying normal load and a memory curve. In other cases reversals of u are reported as the events
    /// `reversal` and `gross slip ends`.
    pub fn tells_turns(&self, asked: Stepper, index: usize) -> bool {
        self.effective(asked).locates_events() && self.contacts.get(index).is_some_and(Contact::turns_unseen)
    }
}

/// Tolerance of a run along a prescribed (quasi-static) path if the requested stepper has no tolerance.
pub const WALK_TOLERANCE: f64 = 1e-10;
