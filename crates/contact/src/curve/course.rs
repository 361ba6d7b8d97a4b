//! Kind of motion of a contact: open, growing in full stick, or slipping in one of two directions.
//!
//! The forward limit line slips with the velocity s₊ = u̇-κḋ and the backward one with s₋ = u̇+κḋ. If s₊ ≤ 0 ≤ s₋ and the indentation
//! grows, no spring slips.

use super::Curve;
use crate::Interface;

/// Kind of motion of a contact, from the signs of s₊ = u̇-κḋ and s₋ = u̇+κḋ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Course {
    /// The contact is open.
    #[default]
    Open,
    /// The contact grows in full stick: s₊ ≤ 0 ≤ s₋. The force then depends on the path and is integrated as a state.
    // For the other kinds of motion straight paths are exact. Here, a straight path has an error of second order that estimates miss.
    Grow,
    /// Forward slip: s₊ > 0.
    Forward,
    /// Backward slip: s₋ < 0.
    Backward,
}

impl Course {
    /// Returns slip in a direction: +1 forward, -1 backward.
    pub fn sliding(sense: f64) -> Self {
        if sense > 0.0 { Self::Forward } else { Self::Backward }
    }

    /// Returns the slip direction: +1 forward, -1 backward, 0 otherwise.
    pub fn sense(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
            Self::Open | Self::Grow => 0.0,
        }
    }
}

impl Curve {
    /// Returns the kind of motion of a contact, from the signs of s₊ = u̇-κḋ and s₋ = u̇+κḋ.
    ///
    /// If both limit lines would slip while the contact shrinks, the slip direction is the side of the memory curve on which the path ends.
    pub fn course(&self, law: &Interface, dd: f64, du: f64) -> Course {
        if let Some(kinetic) = law.kinetic().filter(|_| self.slides != 0.0)
            && self.apex.d > 0.0
            && self.slides * du > kinetic.stick_slope() * dd
        {
            return Course::sliding(self.slides);
        }
        let limit = law.stick_slope() * dd;
        if self.apex.d < 0.0 || self.apex.d == 0.0 && dd <= 0.0 {
            Course::Open
        } else if dd > 0.0 && du.abs() <= limit {
            Course::Grow
        } else if du.abs() > -limit {
            if du > 0.0 { Course::Forward } else { Course::Backward }
        } else {
            // The slope of the curve, because a growth path may consist of several pieces.
            let slope = self.knots.last().map_or(0.0, |k| k.slope);
            if du > slope * dd { Course::Forward } else { Course::Backward }
        }
    }
}
