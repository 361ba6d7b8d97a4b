//! Truncated paraboloid, a worn sphere: flat up to a radius b, beyond it f = (r²-b²)/2R.
//!
//! With w = √(x²-b²) for x ≥ b (handbook 2.5.9):
//!
//! * g = xw/R, g′ = (x²+w²)/(wR); w² = [√(b⁴+4R²h²) - b²]/2,
//! * M = 2w(2w²+3b²)/(3R),
//! * N = (2/3R²)(x-b)[(4/5)(x⁴+x³b+x²b²+xb³) - b⁴/5].
//!
//! For b → 0 the functions approach the paraboloid, at small h a flat punch.

use super::angle::Place;
use super::error::positive;
use super::kind::{Kind, Peak};
use super::{Profile, ProfileError, Shape};

/// Paraboloid of radius of curvature R (m), truncated to a flat of radius b (m).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TruncatedParaboloid {
    border: [f64; 1],
    radius: f64,
}

impl Profile {
    /// Creates a truncated paraboloid, a worn sphere: a flat of radius b (m), beyond it f = (r²-b²)/2R, from b and R (m).
    ///
    /// # Errors
    ///
    /// Fails for a radius that is not above 0 or not finite.
    pub fn truncated_paraboloid(flat: f64, radius: f64) -> Result<Self, ProfileError> {
        let border = [positive(flat, ProfileError::Flat)?];
        let radius = positive(radius, ProfileError::Radius)?;
        Ok(Self { shape: Shape::TruncatedParaboloid(TruncatedParaboloid { border, radius }) })
    }
}

impl TruncatedParaboloid {
    /// Returns w at h > 0, m, from w²(b²+w²) = R²h².
    fn w(&self, h: f64) -> f64 {
        let ([b], rh) = (self.border, self.radius * h);
        rh * (2.0 / (b * b + math::hypot(b * b, 2.0 * rh))).sqrt()
    }

    /// Returns M divided by its factor: w³ + (3/2)b²w.
    fn cubic(&self, w: f64) -> f64 {
        let [b] = self.border;
        w * (w * w + 1.5 * b * b)
    }
}

impl Kind for TruncatedParaboloid {
    #[inline]
    fn reduced_stiffness(&self, h: f64) -> f64 {
        2.0 * math::hypot(self.border[0], self.w(h))
    }

    #[inline]
    fn reduced_force(&self, h: f64) -> f64 {
        4.0 / (3.0 * self.radius) * self.cubic(self.w(h))
    }

    fn reduced_energy(&self, h: f64) -> f64 {
        let place = Place::beyond(self.border[0], self.w(h));
        let Place { border: b, x, .. } = place;
        let bracket = 0.8 * x * (b + x) * (b * b + x * x) - 0.2 * (b * b) * (b * b);
        2.0 / (3.0 * self.radius * self.radius) * place.excess() * bracket
    }

    /// Returns the real root of a cubic by hyperbolic functions, with one Newton step as a correction.
    fn height_of_reduced_force(&self, force: f64) -> f64 {
        let ([b], wanted) = (self.border, 0.75 * self.radius * force);
        let unit = b * std::f64::consts::FRAC_1_SQRT_2;
        let w = 2.0 * unit * math::sinh(math::asinh(0.5 * wanted / (unit * unit * unit)) / 3.0);
        let w = w - (self.cubic(w) - wanted) / (3.0 * w * w + 1.5 * b * b);
        w * math::hypot(b, w) / self.radius
    }

    fn depth(&self, a: f64) -> f64 {
        let [b] = self.border;
        if a > b { a * ((a - b) * (a + b)).sqrt() / self.radius } else { 0.0 }
    }

    fn depth_slope(&self, a: f64) -> f64 {
        let [b] = self.border;
        if a <= b {
            return 0.0;
        }
        let w = ((a - b) * (a + b)).sqrt();
        (a * (a / w) + w) / self.radius
    }

    fn gap(&self, r: f64) -> Option<f64> {
        let [b] = self.border;
        Some((r - b).max(0.0) * (r + b) / (2.0 * self.radius))
    }

    fn borders(&self) -> &[f64] {
        &self.border
    }

    /// Returns that the pressure is unbounded at the edge of the flat, where it has a logarithmic singularity.
    fn peak(&self) -> Option<Peak> {
        Some(Peak::Unbounded)
    }

    fn is_strictly_convex(&self) -> bool {
        false
    }
}
