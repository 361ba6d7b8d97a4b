//! The gap itself, for those who want to see it.

use super::kappa::kappa;
use super::{Profile, Shape};

impl Profile {
    /// f(r), m: the gap at the distance r ≥ 0 (m) from the axis before anything is pressed; none beyond a flat punch or a
    /// sphere, and for a foundation given spring by spring, which no axisymmetric gap need belong to.
    ///
    /// Of a power law f = g/`κ_n` (4.20): r²/2R for the paraboloid.
    pub fn gap(&self, r: f64) -> Option<f64> {
        match &self.shape {
            _ if r.is_nan() || r < 0.0 => None,
            Shape::Flat { radius } => (r <= *radius).then_some(0.0),
            Shape::Power(shape) => Some(shape.depth(r) / kappa(shape.exponent())),
            Shape::Sphere(shape) => shape.gap(r),
            Shape::Foundation(_) => None,
        }
    }
}
