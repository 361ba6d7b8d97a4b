//! The slip front: where the springs at their limit begin.
//!
//! Springs stick up to the front and slip beyond it, out to the edge of the contact: limits fall with height, and the wedge
//! has one edge that drags at a time.

use crate::{ContactState, Interface};

/// Where the springs at their limit begin after the last move that was not zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Front {
    /// +1 forward, -1 backward, 0 none at its limit.
    pub(super) sense: f64,
    /// Springs higher than this are at their limit; -∞ in gross slip.
    pub(super) height: f64,
}

impl Front {
    /// No spring at its limit.
    pub(super) const STICK: Self = Self { sense: 0.0, height: f64::INFINITY };

    /// State and stick radius (m) of a contact of indentation d.
    // Lengths decide and not heights: between two springs of a list a front may lie anywhere, and all that touch still stick.
    pub(super) fn zone(&self, law: &Interface, d: f64) -> (ContactState, f64) {
        let profile = law.profile();
        if d <= 0.0 {
            (ContactState::Open, 0.0)
        } else if self.sense == 0.0
            || (self.height > 0.0 && profile.reduced_stiffness(self.height) >= profile.reduced_stiffness(d))
        {
            (ContactState::Stick, profile.radius(d))
        } else if self.height <= 0.0 {
            (ContactState::Slip, 0.0)
        } else {
            (ContactState::Partial, profile.radius(self.height))
        }
    }
}
