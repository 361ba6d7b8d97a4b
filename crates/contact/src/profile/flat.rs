//! Flat punch: the full width touches at once.

use super::error::positive;
use super::kind::{Kind, Peak};
use super::{Profile, ProfileError, Shape};

/// Flat punch of radius b, m.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Flat {
    radius: f64,
}

impl Profile {
    /// Creates a flat punch of radius b (m): g = 0 for |x| < b, so m = 2b for every h > 0.
    pub fn flat(radius: f64) -> Result<Self, ProfileError> {
        Ok(Self { shape: Shape::Flat(Flat { radius: positive(radius, ProfileError::Radius)? }) })
    }
}

impl Kind for Flat {
    #[inline]
    fn reduced_stiffness(&self, _h: f64) -> f64 {
        2.0 * self.radius
    }

    #[inline]
    fn reduced_force(&self, h: f64) -> f64 {
        2.0 * self.radius * h
    }

    #[inline]
    fn reduced_energy(&self, h: f64) -> f64 {
        self.radius * h * h
    }

    fn height_of_reduced_force(&self, force: f64) -> f64 {
        force / (2.0 * self.radius)
    }

    #[inline]
    fn depth(&self, a: f64) -> f64 {
        if a > self.radius { f64::INFINITY } else { 0.0 }
    }

    fn depth_slope(&self, _a: f64) -> f64 {
        0.0
    }

    fn gap(&self, r: f64) -> Option<f64> {
        (r <= self.radius).then_some(0.0)
    }

    /// Returns that the pressure is unbounded at the edge.
    fn peak(&self) -> Option<Peak> {
        Some(Peak::Unbounded)
    }

    fn is_strictly_convex(&self) -> bool {
        false
    }

    fn punch(&self) -> Option<f64> {
        Some(self.radius)
    }
}
