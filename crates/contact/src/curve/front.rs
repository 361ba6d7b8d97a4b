//! Slip front: the height that separates sticking from slipping springs.
//!
//! Springs below the front stick and springs above it slip, because the friction limit decreases with height.

use crate::{ContactState, Interface};

/// Slip front after the last move of non-zero length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Front {
    /// Slip direction: +1 forward, -1 backward, 0 for no slip.
    pub(super) sense: f64,
    /// Height of the front, m: higher springs slip; -∞ in gross slip.
    pub(super) height: f64,
}

impl Front {
    /// Full stick.
    pub(super) const STICK: Self = Self { sense: 0.0, height: f64::INFINITY };

    /// Returns state and stick radius (m) of a contact at indentation d.
    // The comparison uses lengths, not heights: a front between two springs of a list may be above all springs in contact.
    pub(super) fn zone(&self, law: &Interface, d: f64) -> (ContactState, f64) {
        let profile = law.profile();
        if d <= 0.0 {
            (ContactState::Open, 0.0)
        } else if self.sense == 0.0
            || (self.height > 0.0 && profile.reduced_stiffness(self.height) >= profile.reduced_stiffness(d))
        {
            (ContactState::Stick, profile.radius(d))
        } else if self.height <= profile.lowest() {
            (ContactState::Slip, 0.0)
        } else {
            (ContactState::Partial, profile.radius(self.height))
        }
    }
}
