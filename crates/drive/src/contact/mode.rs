//! What a contact is doing.
//!
//! A mode is a law and not a state of slip: at constant indentation partial slip and gross slip are both a
//! branch. It is set at events alone, from the committed memory, and stays smooth beyond the event that ends
//! it.

use super::{Contact, Guard, Motion, Press};
use stickslip_contact::{Branch, Change, Course, Lull, Memory, Slack, SpringRow};

/// What a contact is doing, set at the last event: the smooth law that is integrated until the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Mode {
    /// No contact.
    Open,
    /// Grows in full stick; its force is a state.
    Grow,
    /// Slip spreads along one branch of the curve.
    Slip(Branch),
    /// A row of springs until the next of them touches, parts, slips or sticks.
    Lull {
        /// Its law.
        lull: Lull,
        /// Sense of sliding.
        sense: f64,
    },
    /// The whole law from the committed memory, kinks and all, in one sense of sliding: a stepper without events, or a
    /// contact without friction.
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
            Self::Whole { sense } | Self::Lull { sense, .. } => *sense,
        }
    }

    /// Counts displacements from another origin, `by` (m) further back: a law lies where the memory that it was made of does.
    pub(crate) fn shift(&mut self, by: f64) {
        match self {
            Self::Slip(branch) => branch.shift(by),
            Self::Lull { lull, .. } => lull.shift(by),
            Self::Open | Self::Grow | Self::Whole { .. } => {}
        }
    }

    /// Whether all springs slip.
    pub(crate) fn is_gross(&self) -> bool {
        matches!(self, Self::Slip(branch) if branch.is_gross())
    }

    /// Whether a contact in this mode holds nothing more: apart, or all springs slip.
    pub(crate) fn has_given_way(&self, contact: &Contact) -> bool {
        match self {
            Self::Open => true,
            Self::Slip(branch) => branch.is_gross(),
            Self::Lull { lull, .. } => lull.stiffness(&contact.interface) == 0.0,
            Self::Grow | Self::Whole { .. } => false,
        }
    }

    /// Whether a contact in this mode has springs that stick.
    pub(crate) fn holds(&self) -> bool {
        !self.is_gross() && *self != Self::Open
    }

    /// The mode of a course from the committed memory. `slack` as in [`stickslip_contact::Curve::branch`].
    ///
    /// `slack`, m: a piece of memory of which no more is left counts as used up.
    pub(crate) fn of(
        contact: &Contact,
        memory: &Memory,
        (course, at): (Course, &Motion),
        slack: f64,
        tolerance: f64,
    ) -> Self {
        match (memory.branching(), course) {
            // Nothing to press and nothing to hold: it is as good as apart for ever.
            _ if contact.inert && contact.coupling().is_none() => Self::Open,
            // Whatever is remembered: apart, springs are unstretched.
            (_, Course::Open) => Self::Open,
            // A row of springs has no branches, but lulls.
            (None, course) => {
                Self::Whole { sense: course.sense() }.lull(contact, memory, (at, Change::Any, 0.0), tolerance)
            }
            // Without friction there is nothing to remember, but the bodies still press on each other.
            _ if contact.inert => Self::Whole { sense: 0.0 },
            (Some(_), Course::Grow) => Self::Grow,
            (Some(branching), Course::Forward | Course::Backward) => {
                Self::Slip(branching.branch(&contact.interface, course.sense(), slack))
            }
        }
    }

    /// The mode of a row that moves as `at` by this mode, after a change of its springs. Where rounding, of time or of a
    /// displacement that has travelled far, has stopped short of the change, what is `left` (m) counts as gone.
    // Without `left` a foot on two rows that slides at 20 mm/s finds 3e-19 m left, in less than the last place of t, for ever.
    pub(crate) fn lull(
        &self,
        contact: &Contact,
        memory: &Memory,
        (at, change, left): (&Motion, Change, f64),
        tolerance: f64,
    ) -> Self {
        let sense = self.sense();
        let Memory::Row(SpringRow { row, springs }) = memory else { return Self::Whole { sense } };
        if !contact.has_lulls() {
            return Self::Whole { sense };
        }
        let near = |guard: Guard| guard.bands(contact, tolerance, at.u).1;
        let mut slack = Slack { d: near(Guard::Rise), u: near(Guard::Forward) };
        match change {
            Change::Touches | Change::Parts => slack.d += left,
            Change::Slips(_) => slack.u += left,
            Change::Sticks | Change::Any => {}
        }
        let touched = if let Self::Lull { lull, .. } = self { lull.touch() } else { 0.0 };
        let force = matches!(contact.press, Press::Force(_)).then_some(touched);
        let lull = row.lull(springs, &contact.interface, (at, change), slack, force);
        Self::Lull { lull, sense }
    }
}
