//! Paraboloid on graded half-spaces, whose Young's modulus is E(z) = E (z/z₀)ᵏ at the depth z.
//!
//! The springs of the MDR have stiffnesses proportional to |x|ᵏ (Popov, Heß, Willert, Handbook of Contact Mechanics, 2019, chapter 9):
//! g = x²/((1+k)R), a = √((1+k)Rh), M = 4 `h_N` z₀⁻ᵏ h a^{1+k}/((1+k)(3+k)). Forces are thus those of a power law with the exponent
//! 2/(1+k); the contact radius is another.
//!
//! The ratio of tangential to normal stiffness is taken as that of homogeneous half-spaces of the same materials.

use super::error::positive;
use super::kind::Kind;
use super::power::Power;
use super::{Profile, ProfileError, Shape};
use crate::Material;
use std::f64::consts::{FRAC_PI_2, PI};

/// Paraboloid between bodies whose modulus is a power of the depth.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Graded {
    /// Power law with the same M(h).
    power: Power,
    /// (1+k)R, m.
    scale: f64,
}

impl Profile {
    /// Creates a paraboloid of radius R (m) between bodies with E(z) = E (z/z₀)ᵏ, from R, k in [0, 1), z₀ (m) and the materials, whose
    /// moduli are those at the depth z₀.
    ///
    /// # Errors
    ///
    /// Fails for a radius or depth that is not above 0 or not finite, and for an exponent out of range.
    pub fn graded_paraboloid(
        radius: f64,
        exponent: f64,
        depth: f64,
        materials: [Material; 2],
    ) -> Result<Self, ProfileError> {
        let radius = positive(radius, ProfileError::Radius)?;
        let depth = positive(depth, ProfileError::Depth)?;
        if !(0.0..1.0).contains(&exponent) {
            return Err(ProfileError::Grading(exponent));
        }
        if exponent == 0.0 {
            return Self::paraboloid(radius);
        }
        let compliance = |m: &Material| (1.0 - m.poisson_ratio().powi(2)) / m.youngs_modulus();
        let graded = |m: &Material| compliance(m) / stiffening(exponent, m.poisson_ratio());
        let stiffening =
            materials.iter().map(compliance).sum::<f64>() / materials.iter().map(graded).sum::<f64>();
        let scale = (1.0 + exponent) * radius;
        // m = 2 h_N z₀⁻ᵏ a^{1+k}/(1+k) is 2(sh)^{1/n}.
        let n = 2.0 / (1.0 + exponent);
        let factor = stiffening * math::powf(depth, -exponent) / (1.0 + exponent);
        let power = Power::of_scale(positive(scale * math::powf(factor, n), ProfileError::Depth)?, n);
        Ok(Self { shape: Shape::Graded(Graded { power, scale }) })
    }
}

/// Returns `h_N`(k, ν): the stiffness relative to springs of the modulus E\*(|x|/z₀)ᵏ.
fn stiffening(k: f64, nu: f64) -> f64 {
    let gamma = math::gamma;
    let beta = ((1.0 + k) * (1.0 - k * nu / (1.0 - nu))).sqrt();
    let c = math::exp2(1.0 + k) * gamma(0.5 * (3.0 + k + beta)) * gamma(0.5 * (3.0 + k - beta))
        / (PI * gamma(2.0 + k));
    2.0 * (1.0 + k) * math::cos(k * FRAC_PI_2) * gamma(1.0 + 0.5 * k)
        / (PI.sqrt() * c * beta * math::sin(beta * FRAC_PI_2) * gamma(0.5 * (1.0 + k)))
}

impl Graded {
    /// Returns a(h), m.
    pub(super) fn radius(&self, h: f64) -> f64 {
        (self.scale * h).sqrt()
    }

    /// Returns the height at which the reduced stiffness m (m) is reached, m.
    pub(super) fn height_of_reduced_stiffness(&self, m: f64) -> f64 {
        self.power.depth(0.5 * m)
    }
}

impl Kind for Graded {
    fn reduced_stiffness(&self, h: f64) -> f64 {
        self.power.reduced_stiffness(h)
    }

    fn reduced_force(&self, h: f64) -> f64 {
        self.power.reduced_force(h)
    }

    fn reduced_energy(&self, h: f64) -> f64 {
        self.power.reduced_energy(h)
    }

    fn height_of_reduced_force(&self, force: f64) -> f64 {
        self.power.height_of_reduced_force(force)
    }

    fn depth(&self, a: f64) -> f64 {
        a * a / self.scale
    }

    fn depth_slope(&self, a: f64) -> f64 {
        2.0 * a / self.scale
    }

    fn is_strictly_convex(&self) -> bool {
        true
    }

    fn first_power(&self) -> f64 {
        self.power.first_power()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For ν = 1/(2+k) a point load causes radial stresses (k+3)F cosᵏ⁺¹θ/(2πr²) only, whose strains give the displacement of the surface
    /// and, with the pressure of a flat punch, `h_N` = 2(1+k)² cos(kπ/2)/(2+k).
    #[test]
    fn the_stiffness_is_that_of_radial_stresses() {
        for k in [0.0, 0.1, 0.3, 0.5, 0.9] {
            let known = 2.0 * (1.0 + k) * (1.0 + k) * math::cos(k * FRAC_PI_2) / (2.0 + k);
            let found = stiffening(k, 1.0 / (2.0 + k));
            assert!((found / known - 1.0).abs() < 1e-13, "{k}: {found} {known}");
        }
    }

    /// Homogeneous bodies: `h_N` = 1.
    #[test]
    fn a_homogeneous_body_is_not_stiffened() {
        for nu in [-0.5, 0.0, 0.2, 0.3, 0.5] {
            assert!((stiffening(0.0, nu) - 1.0).abs() < 1e-14, "{nu}");
        }
    }
}
