//! What a contact is doing.
//!
//! s₊ is the speed at which the lower edge of the wedge moves forward through the anchors, -s₋ that of the upper edge
//! backward. Of the four combinations of signs one, s₊ ≤ 0 ≤ s₋ under a growing indentation, drags nothing: what a stepper
//! has to know is which edge drags, or that none does.

use super::Curve;
use crate::Interface;

/// What a contact is doing, from the signs of s₊ = u̇-κḋ and s₋ = u̇+κḋ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Course {
    /// No contact.
    #[default]
    Open,
    /// The contact grows in full stick: s₊ ≤ 0 ≤ s₋; its force depends on the path and is a state.
    // The other three need no such state: chords are exact for them. Here a chord is of second order, and an embedded error
    // estimate does not see it: Dopri5 at a tolerance of 1e-11 still ends 2e-5 off.
    Grow,
    /// The lower edge of the wedge drags: s₊ > 0.
    Forward,
    /// The upper edge of the wedge drags: s₋ < 0.
    Backward,
}

impl Course {
    /// +1 forward, -1 backward, 0 otherwise.
    pub fn sense(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
            Self::Open | Self::Grow => 0.0,
        }
    }
}

impl Curve {
    /// The course of a contact in motion, from the signs of s₊ = u̇-κḋ and s₋ = u̇+κḋ. Where both edges close in
    /// on a shrinking contact, the side decides on which the path leaves the curve.
    pub fn course(&self, law: &Interface, dd: f64, du: f64) -> Course {
        let limit = law.stick_slope() * dd;
        if self.apex.d < 0.0 || self.apex.d == 0.0 && dd <= 0.0 {
            Course::Open
        } else if dd > 0.0 && du.abs() <= limit {
            Course::Grow
        } else if du.abs() > -limit {
            if du > 0.0 { Course::Forward } else { Course::Backward }
        } else {
            // Read off the curve and not off its last chord: a path of growth may lie there in several pieces.
            let slope = self.knots.last().map_or(0.0, |k| k.slope);
            if du > slope * dd { Course::Forward } else { Course::Backward }
        }
    }
}
