//! What two bodies share where they touch: moduli, profile, coefficient of friction. Constant.

use crate::{Pair, Profile, Springs};
use std::sync::Arc;
use thiserror::Error;

/// The constants of one contact: with a memory of where it has been, all that its forces follow from. Functions that take
/// it call it the contact's `law`.
#[derive(Debug, Clone, PartialEq)]
pub struct Interface {
    pair: Pair,
    /// μ.
    friction: f64,
    /// κ = μE\*/G\*.
    slope: f64,
    profile: Profile,
    damping: f64,
    /// What presses in place of the profile.
    springs: Option<Arc<Springs>>,
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
        let mut interface = Self { pair, friction: 0.0, slope: 0.0, profile, damping: 0.0, springs: None };
        interface.set_friction(friction)?;
        Ok(interface)
    }

    /// Another coefficient μ, all else being as it is: for whoever runs one scene with many of them.
    ///
    /// # Errors
    /// One out of [0, [`Self::MAX_FRICTION`]]; the former one stays.
    pub fn set_friction(&mut self, friction: f64) -> Result<(), FrictionError> {
        if !(0.0..=Self::MAX_FRICTION).contains(&friction) {
            return Err(FrictionError(friction));
        }
        self.friction = friction;
        self.slope = friction * self.pair.normal_modulus() / self.pair.tangential_modulus();
        Ok(())
    }

    /// The same without friction.
    #[must_use]
    pub fn frictionless(self) -> Self {
        Self { friction: 0.0, slope: 0.0, ..self }
    }

    /// The same with stuck springs that carry βG\*ṡ beside G\*s, ṡ the rate of their stretch; β in s, at least 0.
    ///
    /// Only the elastic part G\*s decides what slips, so |F_x| may exceed μF_N by up to βG\*m(c)|u̇|, c the radius that sticks;
    /// in gross slip nothing sticks and |F_x| = μF_N. F_x jumps where u̇ jumps, and where a loop closes at u̇ ≠ 0, because c
    /// jumps there: loops in the plane of u and F_x close in their elastic part only. A mass on a stuck contact of resonance ω
    /// has the damping ratio βω/2.
    #[must_use]
    pub fn with_damping(self, damping: f64) -> Self {
        Self { damping, ..self }
    }

    /// The same pressed on a row of springs: normal force, stiffness and energy, and what is asked of them backwards, are the
    /// sums over its springs, which differ from those of the profile by the size of the cells.
    // The profile's own M(d) would do for a smooth one, and did: then a row and the curve could not differ in F_N, and neither
    // was a test of the other. It also gave a bent contact force to a law whose springs are straight.
    #[must_use]
    pub fn on_springs(self, springs: Arc<Springs>) -> Self {
        Self { springs: Some(springs), ..self }
    }

    /// Time constant β of the stuck springs, s.
    pub fn damping(&self) -> f64 {
        self.damping
    }

    /// What springs of a stiffness (N/m) that stick oppose to a rate, N s/m: β times it.
    pub fn viscosity(&self, stuck: f64) -> f64 {
        self.damping * stuck
    }

    /// The effective moduli and the mismatch of the two bodies.
    pub fn pair(&self) -> Pair {
        self.pair
    }

    /// Effective modulus E\*, Pa.
    pub fn normal_modulus(&self) -> f64 {
        self.pair.normal_modulus()
    }

    /// Effective shear modulus G\*, Pa.
    pub fn tangential_modulus(&self) -> f64 {
        self.pair.tangential_modulus()
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

    /// M(d), m²: the normal force over E\*, of the profile or of the row that it is pressed on.
    #[inline(always)]
    pub fn reduced_force(&self, d: f64) -> f64 {
        match &self.springs {
            None => self.profile.reduced_force(d),
            Some(springs) => springs.reduced_force(d),
        }
    }

    /// m(d), m: the normal stiffness over E\*, likewise.
    fn reduced_stiffness(&self, d: f64) -> f64 {
        match &self.springs {
            None => self.profile.reduced_stiffness(d),
            Some(springs) => springs.reduced_stiffness(d),
        }
    }

    /// Normal force F_N = E\* M(d), N (4.26); zero while the contact is open (d ≤ 0).
    pub fn normal_force(&self, d: f64) -> f64 {
        if d > 0.0 { self.normal_modulus() * self.reduced_force(d) } else { 0.0 }
    }

    /// Normal stiffness ∂F_N/∂d = E\* m(d), N/m.
    pub fn normal_stiffness(&self, d: f64) -> f64 {
        if d > 0.0 { self.normal_modulus() * self.reduced_stiffness(d) } else { 0.0 }
    }

    /// Elastic energy of the normal deformation E\* N(d), J.
    pub fn normal_energy(&self, d: f64) -> f64 {
        let reduced_energy = match &self.springs {
            _ if d.is_nan() || d <= 0.0 => return 0.0,
            None => self.profile.reduced_energy(d),
            Some(springs) => springs.reduced_energy(d),
        };
        self.normal_modulus() * reduced_energy
    }

    /// Tangential stiffness of full stick G\* m(d), N/m; 2G\*a for a convex profile.
    pub fn stick_stiffness(&self, d: f64) -> f64 {
        if d > 0.0 { self.tangential_modulus() * self.reduced_stiffness(d) } else { 0.0 }
    }

    /// u_c = κd, m: displacement at which gross slip starts, the same for every profile (4.28).
    pub fn gross_slip_displacement(&self, d: f64) -> f64 {
        self.slope * d.max(0.0)
    }

    /// Indentation d that carries the normal force, m: the inverse of [`Self::normal_force`]; at 0 N it is 0, on a row of
    /// springs the height of the lowest of them.
    pub fn indentation(&self, normal_force: f64) -> f64 {
        let reduced_force = normal_force / self.normal_modulus();
        match &self.springs {
            None => self.profile.height_of_reduced_force(reduced_force),
            Some(springs) => springs.height_of_reduced_force(reduced_force),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coefficient_of_friction_out_of_range_is_refused() {
        let law = |friction| {
            Interface::new(Pair::from_moduli(3.0, 2.0).unwrap(), Profile::paraboloid(1.0).unwrap(), friction)
        };
        for friction in [-0.2, -f64::MIN_POSITIVE, 1000.1, f64::INFINITY, f64::NAN] {
            assert!(law(friction).is_err(), "{friction}");
        }
        assert_eq!(law(-0.2), Err(FrictionError(-0.2)));
        assert!(law(0.0).is_ok() && law(Interface::MAX_FRICTION).is_ok());
    }
}
