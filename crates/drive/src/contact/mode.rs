//! What a contact is doing.
//!
//! A mode is a law and not a state of slip: at constant indentation partial slip and gross slip are both a
//! branch. It is set at events alone, from the committed memory, and stays smooth beyond the event that ends
//! it.

use super::Contact;
use stickslip_contact::{Branch, Course, Memory};

/// What a contact is doing, set at the last event: the smooth law that is integrated until the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Mode {
    /// No contact.
    Open,
    /// Grows in full stick; its force is a state.
    Grow,
    /// Slip spreads along one branch of the curve.
    Slip(Branch),
    /// The whole law from the committed memory, kinks and all, in one sense of sliding: a row of springs, or a
    /// stepper without events.
    Whole {
        /// Sense of sliding.
        sense: f64,
    },
}

impl Mode {
    /// +1 forward, -1 backward, 0 otherwise.
    pub(crate) fn sense(&self) -> f64 {
        match self {
            Self::Open | Self::Grow => 0.0,
            Self::Slip(branch) => branch.sense(),
            Self::Whole { sense } => *sense,
        }
    }

    /// Whether all springs slip.
    pub(crate) fn is_gross(&self) -> bool {
        matches!(self, Self::Slip(branch) if branch.is_gross())
    }

    /// Whether a contact in this mode has springs that stick.
    pub(crate) fn holds(&self) -> bool {
        !self.is_gross() && *self != Self::Open
    }

    /// The mode of a course from the committed memory. `slack` as in [`stickslip_contact::Curve::branch`].
    ///
    /// `slack`, m: a piece of memory of which no more is left counts as used up.
    pub(crate) fn of(contact: &Contact, memory: &Memory, course: Course, slack: f64) -> Self {
        match (memory.branching(), course) {
            // Nothing to press and nothing to hold: it is as good as apart for ever.
            _ if contact.inert && contact.coupling().is_none() => Self::Open,
            // Whatever is remembered: apart, springs are unstretched.
            (_, Course::Open) => Self::Open,
            // Without friction there is nothing to remember, but the bodies still press on each other.
            _ if contact.inert => Self::Whole { sense: 0.0 },
            // A row of springs has no branches.
            (None, course) => Self::Whole { sense: course.sense() },
            (Some(_), Course::Grow) => Self::Grow,
            (Some(branching), Course::Forward | Course::Backward) => {
                Self::Slip(branching.branch(&contact.interface, course.sense(), slack))
            }
        }
    }
}
