//! Elastic materials and the effective moduli of a pair.

use thiserror::Error;

/// Linear elastic, isotropic material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Young's modulus E, Pa.
    youngs_modulus: f64,
    /// Poisson's ratio ν.
    poisson_ratio: f64,
}

/// Reason why a material or a pair is invalid.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum MaterialError {
    /// Young's modulus is not above 0 or not finite, Pa.
    #[error("expected a Young's modulus above 0 Pa, got {0}")]
    YoungsModulus(f64),
    /// Poisson's ratio is not in (-1, 0.5].
    #[error("expected a Poisson's ratio in (-1, 0.5], got {0}")]
    PoissonRatio(f64),
    /// An effective modulus is not above 0 or not finite, Pa.
    #[error("expected an effective modulus above 0 Pa, got {0}")]
    EffectiveModulus(f64),
}

impl Material {
    /// Creates a material from Young's modulus E (Pa, above 0) and Poisson's ratio ν in (-1, 0.5].
    pub fn new(youngs_modulus: f64, poisson_ratio: f64) -> Result<Self, MaterialError> {
        if !(youngs_modulus > 0.0 && youngs_modulus.is_finite()) {
            return Err(MaterialError::YoungsModulus(youngs_modulus));
        }
        if !(poisson_ratio > -1.0 && poisson_ratio <= 0.5) {
            return Err(MaterialError::PoissonRatio(poisson_ratio));
        }
        Ok(Self { youngs_modulus, poisson_ratio })
    }

    /// Returns Young's modulus E, Pa.
    pub fn youngs_modulus(&self) -> f64 {
        self.youngs_modulus
    }

    /// Returns Poisson's ratio ν.
    pub fn poisson_ratio(&self) -> f64 {
        self.poisson_ratio
    }

    /// Returns the shear modulus G = E/(2(1+ν)), Pa.
    pub fn shear_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }
}

/// Effective moduli of two half-spaces in contact: 1/E\* = Σ(1-ν²)/E, 1/G\* = Σ(2-ν)/(4G) (4.13).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Effective modulus E\*, Pa.
    normal: f64,
    /// Effective shear modulus G\*, Pa.
    tangential: f64,
    /// Dundurs' constant β.
    mismatch: f64,
}

impl Pair {
    /// Creates the pair of two materials. Their order affects only the sign of Dundurs' constant.
    pub fn new(first: Material, second: Material) -> Self {
        let normal = |m: Material| (1.0 - m.poisson_ratio.powi(2)) / m.youngs_modulus;
        let tangential = |m: Material| (2.0 - m.poisson_ratio) / (4.0 * m.shear_modulus());
        let shear = |m: Material| (1.0 - 2.0 * m.poisson_ratio) / m.shear_modulus();
        let bulk = |m: Material| 2.0 * (1.0 - m.poisson_ratio) / m.shear_modulus();
        Self {
            normal: 1.0 / (normal(first) + normal(second)),
            tangential: 1.0 / (tangential(first) + tangential(second)),
            mismatch: (shear(first) - shear(second)) / (bulk(first) + bulk(second)),
        }
    }

    /// Creates a pair from its effective moduli E\* and G\* (Pa, both above 0), as elastically similar bodies.
    pub fn from_moduli(normal: f64, tangential: f64) -> Result<Self, MaterialError> {
        for modulus in [normal, tangential] {
            if !(modulus > 0.0 && modulus.is_finite()) {
                return Err(MaterialError::EffectiveModulus(modulus));
            }
        }
        Ok(Self { normal, tangential, mismatch: 0.0 })
    }

    /// Returns the effective modulus E\*, Pa.
    pub fn normal_modulus(&self) -> f64 {
        self.normal
    }

    /// Returns the effective shear modulus G\*, Pa.
    pub fn tangential_modulus(&self) -> f64 {
        self.tangential
    }

    /// Returns Dundurs' constant β = [(1-2ν₁)/G₁ - (1-2ν₂)/G₂] / [2(1-ν₁)/G₁ + 2(1-ν₂)/G₂].
    ///
    /// β is 0 for elastically similar bodies, for which the theory is exact.
    pub fn dundurs_beta(&self) -> f64 {
        self.mismatch
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ruby_on_steel_has_the_published_mismatch() {
        // Dundurs' β of ruby (400 GPa, .27) on steel (210 GPa, .30) is 0.076.
        let pair = Pair::new(Material::new(400e9, 0.27).unwrap(), Material::new(210e9, 0.30).unwrap());
        approx::assert_abs_diff_eq!(pair.dundurs_beta().abs(), 0.076, epsilon = 5e-4);
    }

    #[test]
    fn equal_materials_give_half_the_plane_strain_modulus() {
        let m = Material::new(210e9, 0.3).unwrap();
        let pair = Pair::new(m, m);
        approx::assert_relative_eq!(pair.normal_modulus(), 210e9 / (2.0 * 0.91), max_relative = 1e-15);
        approx::assert_relative_eq!(
            pair.tangential_modulus(),
            2.0 * m.shear_modulus() / 1.7,
            max_relative = 1e-15
        );
        assert_eq!(pair.dundurs_beta(), 0.0);
    }

    #[test]
    fn what_is_out_of_range_is_refused() {
        assert_eq!(Material::new(0.0, 0.3), Err(MaterialError::YoungsModulus(0.0)));
        assert_eq!(Material::new(1.0, -1.0), Err(MaterialError::PoissonRatio(-1.0)));
        assert!(Material::new(f64::NAN, 0.3).is_err() && Material::new(1.0, f64::NAN).is_err());
        assert!(Material::new(1.0, 0.5).is_ok() && Material::new(1.0, 0.51).is_err());
    }
}
