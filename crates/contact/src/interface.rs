//! What two bodies share where they touch: moduli, profile, coefficient of friction. Constant.

use crate::{Pair, Profile};
use thiserror::Error;

/// The constants of one contact: with a memory of where it has been, all that its forces follow from. Functions that take
/// it call it the contact's `law`.
#[derive(Debug, Clone, PartialEq)]
pub struct Interface {
    /// E\*, Pa.
    normal_modulus: f64,
    /// G\*, Pa.
    tangential_modulus: f64,
    /// μ.
    friction: f64,
    /// κ = μE\*/G\*.
    slope: f64,
    profile: Profile,
}

/// Coulomb's coefficient of friction is out of its range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("expected a coefficient of friction between 0 and 1000, got {0}")]
pub struct FrictionError(pub f64);

impl Interface {
    /// The largest coefficient of friction taken: beyond it lies full stick for every practical purpose.
    // Gross slip would begin at a displacement of μE*/G* indentations, beyond what half-spaces allow long before. Infinity is
    // not taken for full stick: κ is in every level and would make them infinite.
    pub const MAX_FRICTION: f64 = 1000.0;

    /// An interface of a pair, a profile and Coulomb's coefficient μ in [0, [`Self::MAX_FRICTION`]].
    pub fn new(pair: Pair, profile: Profile, friction: f64) -> Result<Self, FrictionError> {
        if !(0.0..=Self::MAX_FRICTION).contains(&friction) {
            return Err(FrictionError(friction));
        }
        let (normal, tangential) = (pair.normal_modulus(), pair.tangential_modulus());
        Ok(Self {
            normal_modulus: normal,
            tangential_modulus: tangential,
            friction,
            slope: friction * normal / tangential,
            profile,
        })
    }

    /// Effective modulus E\*, Pa.
    pub fn normal_modulus(&self) -> f64 {
        self.normal_modulus
    }

    /// Effective shear modulus G\*, Pa.
    pub fn tangential_modulus(&self) -> f64 {
        self.tangential_modulus
    }

    /// Coulomb's coefficient of friction μ.
    pub fn friction(&self) -> f64 {
        self.friction
    }

    /// κ = μE\*/G\*: slope of the stick limit. A spring at height h sticks while its stretch is below κ(d-h).
    pub fn stick_slope(&self) -> f64 {
        self.slope
    }

    /// The profile of the gap.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// Normal force F_N = E\* M(d), N (4.26); zero while the contact is open (d ≤ 0).
    pub fn normal_force(&self, d: f64) -> f64 {
        if d > 0.0 { self.normal_modulus * self.profile.reduced_force(d) } else { 0.0 }
    }

    /// Normal stiffness ∂F_N/∂d = E\* m(d), N/m.
    pub fn normal_stiffness(&self, d: f64) -> f64 {
        if d > 0.0 { self.normal_modulus * self.profile.reduced_stiffness(d) } else { 0.0 }
    }

    /// Elastic energy of the normal deformation E\* N(d), J.
    pub fn normal_energy(&self, d: f64) -> f64 {
        if d > 0.0 { self.normal_modulus * self.profile.reduced_energy(d) } else { 0.0 }
    }

    /// Tangential stiffness of full stick G\* m(d), N/m; 2G\*a for a convex profile.
    pub fn stick_stiffness(&self, d: f64) -> f64 {
        if d > 0.0 { self.tangential_modulus * self.profile.reduced_stiffness(d) } else { 0.0 }
    }

    /// u_c = κd, m: displacement at which gross slip starts, the same for every profile (4.28).
    pub fn gross_slip_displacement(&self, d: f64) -> f64 {
        self.slope * d.max(0.0)
    }

    /// Indentation d that carries the normal force, m: the inverse of [`Self::normal_force`]; 0 at 0 N.
    pub fn indentation(&self, normal_force: f64) -> f64 {
        self.profile.height_of_reduced_force(normal_force / self.normal_modulus)
    }
}
