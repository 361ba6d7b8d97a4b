//! Laws (modes) of a contact.
//!
//! A mode is a smooth force law, not a state of slip: under constant indentation partial slip and gross slip have the same mode. A mode
//! changes at events only, follows from the stored slip memory, and stays smooth beyond the event that ends it.

use super::{Contact, Guard, Motion, Press};
use stickslip_contact::{Branch, Change, Course, Lull, Memory, Slack, SpringRow};

/// Law of a contact between two events.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Mode {
    /// No contact.
    Open,
    /// Growth of the contact area in full stick; the tangential force is a state.
    Grow,
    /// Slip that spreads along one branch of the slip-memory curve.
    Slip(Branch),
    /// Linear law of a row of springs until the next spring touches, separates, slips or sticks.
    Lull {
        /// Coefficients of the law.
        lull: Lull,
        /// Sense of sliding.
        sense: f64,
    },
    /// Full force law of the slip memory with its kinks, in one sense of sliding; used without event location, and without friction.
    Whole {
        /// Sense of sliding.
        sense: f64,
    },
}

impl Mode {
    /// Returns +1 for forward, -1 for backward sliding, 0 otherwise.
    pub(crate) fn sense(&self) -> f64 {
        match self {
            Self::Open | Self::Grow => 0.0,
            Self::Slip(branch) => branch.sense(),
            Self::Whole { sense } | Self::Lull { sense, .. } => *sense,
        }
    }

    /// Shifts the origin of displacements by -`by` (m).
    pub(crate) fn shift(&mut self, by: f64) {
        match self {
            Self::Slip(branch) => branch.shift(by),
            Self::Lull { lull, .. } => lull.shift(by),
            Self::Open | Self::Grow | Self::Whole { .. } => {}
        }
    }

    /// Returns whether all springs slip.
    pub(crate) fn is_gross(&self) -> bool {
        matches!(self, Self::Slip(branch) if branch.is_gross())
    }

    /// Returns whether the contact has no tangential stiffness left: open, or in gross slip.
    pub(crate) fn has_given_way(&self, contact: &Contact) -> bool {
        match self {
            Self::Open => true,
            Self::Slip(branch) => branch.is_gross(),
            Self::Lull { lull, .. } => lull.stiffness(&contact.interface) == 0.0,
            Self::Grow | Self::Whole { .. } => false,
        }
    }

    /// Returns whether some springs stick.
    pub(crate) fn holds(&self) -> bool {
        !self.is_gross() && *self != Self::Open
    }

    /// Returns the law for a direction of motion (`course`) of the contact, from the stored slip memory.
    ///
    /// A segment of slip memory with a remaining length of at most `slack` (m) counts as used up; see [`stickslip_contact::Curve::branch`].
    pub(crate) fn of(
        contact: &Contact,
        memory: &Memory,
        (course, at): (Course, &Motion),
        slack: f64,
        tolerance: f64,
    ) -> Self {
        match (memory.branching(), course) {
            // Without load and tangential force it counts as open.
            _ if contact.inert && contact.coupling().is_none() => Self::Open,
            // The springs of an open contact are unstretched.
            (_, Course::Open) => Self::Open,
            // A row of springs has linear laws instead of branches.
            (None, course) => {
                Self::Whole { sense: course.sense() }.lull(contact, memory, (at, Change::Any, 0.0), tolerance)
            }
            // Without friction there is no memory, but the bodies still press.
            _ if contact.inert => Self::Whole { sense: 0.0 },
            (Some(_), Course::Grow) => Self::Grow,
            (Some(branching), Course::Forward | Course::Backward) => {
                Self::Slip(branching.branch(&contact.interface, course.sense(), slack))
            }
        }
    }

    /// Returns the law of a row of springs with the motion `at` after a spring has changed its state. Rounding may stop the motion at a
    /// distance `left` (m) before the change; this distance then counts as covered.
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
