//! Constant data of a contact: effective moduli, profile and friction coefficients.

use crate::{Pair, Profile, Springs};
use std::sync::Arc;
use thiserror::Error;

/// Constant data of a contact. Functions that receive an interface name the argument `law`.
#[derive(Debug, Clone, PartialEq)]
pub struct Interface {
    pair: Pair,
    /// Friction coefficient μ.
    friction: f64,
    /// Slope of the friction limit, κ = μE\*/G\*.
    slope: f64,
    profile: Profile,
    damping: f64,
    /// Row of springs that replaces the profile in the normal direction.
    springs: Option<Arc<Springs>>,
    /// The same interface with the kinetic friction coefficient μ_k as its only one, if μ_k is below μ.
    kinetic: Option<Arc<Interface>>,
    /// Growth of the static coefficient at rest.
    growth: Option<Growth>,
}

/// Growth of the static friction coefficient μ_s with the time at rest t, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Growth {
    /// μ_s = μ + Δ(1 - e^{-t/τ}).
    Exponential {
        /// Largest growth Δ.
        rise: f64,
        /// Time constant τ, s.
        time: f64,
    },
    /// μ_s = μ + b ln(1 + t/τ).
    Logarithmic {
        /// Growth b for each factor of e in time.
        rise: f64,
        /// Time constant τ, s.
        time: f64,
    },
}

impl Growth {
    /// Number of stairs in which the coefficient grows by Δ or b.
    const STAIRS: f64 = 1024.0;

    /// Returns the growth on a stair. Between two stairs the coefficient keeps the value of the lower one.
    pub(crate) fn height(self, stair: u32) -> f64 {
        let (Self::Exponential { rise, .. } | Self::Logarithmic { rise, .. }) = self;
        rise * f64::from(stair) / Self::STAIRS
    }

    /// Returns the time at rest at which a stair begins, s; ∞ for a stair that is never reached.
    pub(crate) fn time(self, stair: u32) -> f64 {
        let share = f64::from(stair) / Self::STAIRS;
        match self {
            Self::Exponential { time, .. } if share < 1.0 => -time * math::ln_1p(-share),
            Self::Exponential { .. } => f64::INFINITY,
            Self::Logarithmic { time, .. } => time * math::exp_m1(share),
        }
    }

    /// Returns the stair after a time at rest t (s).
    pub(crate) fn stair(self, t: f64) -> u32 {
        let share = match self {
            Self::Exponential { time, .. } => -math::exp_m1(-t / time),
            Self::Logarithmic { time, .. } => math::ln_1p(t / time),
        };
        // The last stair of exponential growth is never reached, but rounding may name it.
        let last = if matches!(self, Self::Exponential { .. }) {
            Self::STAIRS - 1.0
        } else {
            f64::from(u32::MAX - 2)
        };
        (share * Self::STAIRS).clamp(0.0, last) as u32
    }
}

/// Error: a friction coefficient is out of its range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum FrictionError {
    /// The coefficient is out of [0, [`Interface::MAX_FRICTION`]].
    #[error("expected a coefficient of friction between 0 and 1000, got {0}")]
    Range(f64),
    /// A growth at rest that is negative or not finite, or a time constant that is not above 0.
    #[error("expected growth at rest of 0 to 1000 with a time above 0, got {rise} with {time} s")]
    Growth {
        /// Growth that was given.
        rise: f64,
        /// Time constant that was given, s.
        time: f64,
    },
    /// The kinetic coefficient is above the static one.
    #[error("expected a kinetic coefficient of friction of at most the static one, {most}, got {kinetic}")]
    Kinetic {
        /// Kinetic coefficient that was given.
        kinetic: f64,
        /// Static coefficient.
        most: f64,
    },
}

impl Interface {
    /// Largest friction coefficient. Larger values would practically mean full stick.
    // An infinite μ is not possible because κ would be infinite, too.
    pub const MAX_FRICTION: f64 = 1000.0;

    /// Creates an interface from a pair, a profile and a friction coefficient μ in [0, [`Self::MAX_FRICTION`]].
    pub fn new(pair: Pair, profile: Profile, friction: f64) -> Result<Self, FrictionError> {
        let mut interface = Self {
            pair,
            friction: 0.0,
            slope: 0.0,
            profile,
            damping: 0.0,
            springs: None,
            kinetic: None,
            growth: None,
        };
        interface.set_friction(friction)?;
        Ok(interface)
    }

    /// Sets the friction coefficient μ, the static one where there are two. A kinetic coefficient keeps its ratio to it.
    ///
    /// # Errors
    /// A value out of [0, [`Self::MAX_FRICTION`]]; the old value then remains.
    pub fn set_friction(&mut self, friction: f64) -> Result<(), FrictionError> {
        if !(0.0..=Self::MAX_FRICTION).contains(&friction) {
            return Err(FrictionError::Range(friction));
        }
        if let Some(kinetic) = self.kinetic.as_mut().map(Arc::make_mut) {
            kinetic.set_friction(kinetic.friction * (friction / self.friction))?;
        }
        if let Some(Growth::Exponential { rise, .. } | Growth::Logarithmic { rise, .. }) = &mut self.growth {
            *rise *= friction / self.friction;
        }
        self.friction = friction;
        self.slope = friction * self.pair.normal_modulus() / self.pair.tangential_modulus();
        Ok(())
    }

    /// Sets the kinetic friction coefficient μ_k in [0, μ]. μ is then the static coefficient μ_s.
    ///
    /// Partial slip obeys μ_s. When the last spring reaches its limit, the contact breaks loose: the limits of all springs fall to μ_k
    /// at once. When it stops, partial slip obeys μ_s again, from the stretches at which it stopped.
    ///
    /// # Errors
    /// A value above μ or below 0.
    pub fn with_kinetic_friction(mut self, kinetic: f64) -> Result<Self, FrictionError> {
        if !(0.0..=self.friction).contains(&kinetic) {
            return Err(FrictionError::Kinetic { kinetic, most: self.friction });
        }
        self.kinetic = None;
        if kinetic < self.friction || self.growth.is_some() {
            let mut slower = Self { growth: None, ..self.clone() };
            slower.set_friction(kinetic)?;
            self.kinetic = Some(Arc::new(slower));
        }
        Ok(self)
    }

    /// Lets the static friction coefficient grow while the contact is at rest, from μ on. [`Self::with_kinetic_friction`] comes after it.
    ///
    /// The coefficient grows in stairs of 1/1024 of the growth Δ or b. A stair keeps the value with which it began, so that the
    /// coefficient is too small by at most one stair.
    ///
    /// # Errors
    /// A growth out of [0, [`Self::MAX_FRICTION`]], or a time that is not above 0.
    pub fn with_growth(mut self, growth: Growth) -> Result<Self, FrictionError> {
        let (Growth::Exponential { rise, time } | Growth::Logarithmic { rise, time }) = growth;
        if !((0.0..=Self::MAX_FRICTION).contains(&rise) && time > 0.0 && time.is_finite()) {
            return Err(FrictionError::Growth { rise, time });
        }
        self.growth = Some(growth);
        Ok(self)
    }

    /// Returns the growth of the static friction coefficient at rest.
    pub fn growth(&self) -> Option<Growth> {
        self.growth
    }

    /// Returns the interface with the static coefficient of a stair of its growth.
    pub(crate) fn on_stair(&self, stair: u32) -> Self {
        let friction = self.friction + self.growth.map_or(0.0, |growth| growth.height(stair));
        let slope = friction * self.pair.normal_modulus() / self.pair.tangential_modulus();
        Self { friction, slope, ..self.clone() }
    }

    /// Returns the static friction coefficient after a time at rest t (s), on the stair that has begun.
    pub fn friction_after(&self, t: f64) -> f64 {
        self.friction + self.growth.map_or(0.0, |growth| growth.height(growth.stair(t)))
    }

    /// Returns the interface without friction.
    #[must_use]
    pub fn frictionless(self) -> Self {
        Self { friction: 0.0, slope: 0.0, kinetic: None, growth: None, ..self }
    }

    /// Adds viscous damping of the sticking springs with the time constant β, s, at least 0.
    ///
    /// A spring of stretch s then carries G\*(s + βu̇), limited to its friction limit ±μE\*(d-h). The elastic part G\*s alone determines
    /// slip. F_x is therefore the elastic force after a further displacement βu̇, and |F_x| ≤ μF_N. A mass on a sticking contact of
    /// angular resonance frequency ω has the damping ratio βω/2.
    #[must_use]
    pub fn with_damping(self, damping: f64) -> Self {
        let kinetic =
            self.kinetic.map(|kinetic| Arc::new(Arc::unwrap_or_clone(kinetic).with_damping(damping)));
        Self { damping, kinetic, ..self }
    }

    /// Replaces the profile by a row of springs in the normal direction.
    ///
    /// Normal force, stiffness, energy and their inverses are then sums over the springs. The difference to the profile is of the
    /// order of the cell size.
    // Normal and tangential force of a row use the same springs, so that row and curve are independent tests of each other.
    #[must_use]
    pub fn on_springs(self, springs: Arc<Springs>) -> Self {
        let on_springs = |kinetic: Arc<Self>| Arc::unwrap_or_clone(kinetic).on_springs(Arc::clone(&springs));
        let kinetic = self.kinetic.map(|kinetic| Arc::new(on_springs(kinetic)));
        Self { springs: Some(springs), kinetic, ..self }
    }

    /// Returns the time constant β of the sticking springs, s.
    pub fn damping(&self) -> f64 {
        self.damping
    }

    /// Returns the damping coefficient of sticking springs, N s/m: β times their stiffness `stuck`, N/m.
    pub fn viscosity(&self, stuck: f64) -> f64 {
        self.damping * stuck
    }

    /// Returns the effective moduli and the mismatch of the two bodies.
    pub fn pair(&self) -> Pair {
        self.pair
    }

    /// Returns the effective modulus E\*, Pa.
    pub fn normal_modulus(&self) -> f64 {
        self.pair.normal_modulus()
    }

    /// Returns the effective shear modulus G\*, Pa.
    pub fn tangential_modulus(&self) -> f64 {
        self.pair.tangential_modulus()
    }

    /// Returns the friction coefficient μ, the static one where there are two.
    pub fn friction(&self) -> f64 {
        self.friction
    }

    /// Returns the kinetic friction coefficient μ_k; μ where there is only one coefficient.
    pub fn kinetic_friction(&self) -> f64 {
        self.kinetic.as_ref().map_or(self.friction, |kinetic| kinetic.friction)
    }

    /// Returns the interface of a contact that has broken loose, with μ_k as its only coefficient; `None` if there is only one.
    #[inline]
    pub fn kinetic(&self) -> Option<&Self> {
        self.kinetic.as_deref()
    }

    /// Returns the slope of the friction limit κ = μE\*/G\*. A spring of height h sticks while its stretch is below κ(d-h).
    pub fn stick_slope(&self) -> f64 {
        self.slope
    }

    /// Returns the profile of the gap.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// Returns the reduced force M(d), m²: the normal force over E\*.
    #[inline(always)]
    pub fn reduced_force(&self, d: f64) -> f64 {
        match &self.springs {
            None => self.profile.reduced_force(d),
            Some(springs) => springs.reduced_force(d),
        }
    }

    /// Returns the reduced stiffness m(d), m: the normal stiffness over E\*.
    fn reduced_stiffness(&self, d: f64) -> f64 {
        match &self.springs {
            None => self.profile.reduced_stiffness(d),
            Some(springs) => springs.reduced_stiffness(d),
        }
    }

    /// Returns the normal force F_N = E\* M(d), N (4.26); 0 for d ≤ 0.
    pub fn normal_force(&self, d: f64) -> f64 {
        if d > 0.0 { self.normal_modulus() * self.reduced_force(d) } else { 0.0 }
    }

    /// Returns the normal stiffness ∂F_N/∂d = E\* m(d), N/m; 0 for d ≤ 0.
    pub fn normal_stiffness(&self, d: f64) -> f64 {
        if d > 0.0 { self.normal_modulus() * self.reduced_stiffness(d) } else { 0.0 }
    }

    /// Returns the elastic energy of the normal deformation E\* N(d), J.
    pub fn normal_energy(&self, d: f64) -> f64 {
        let reduced_energy = match &self.springs {
            _ if d.is_nan() || d <= 0.0 => return 0.0,
            None => self.profile.reduced_energy(d),
            Some(springs) => springs.reduced_energy(d),
        };
        self.normal_modulus() * reduced_energy
    }

    /// Returns the tangential stiffness in full stick G\* m(d), N/m; for a convex profile this is 2G\*a.
    pub fn stick_stiffness(&self, d: f64) -> f64 {
        if d > 0.0 { self.tangential_modulus() * self.reduced_stiffness(d) } else { 0.0 }
    }

    /// Returns the gross slip displacement u_c = κ(d-h₀), m, at which gross slip begins; h₀ is the height of first touch.
    ///
    /// h₀ is above 0 only for lists of springs. The gross slip displacement is the same for every other profile (4.28).
    pub fn gross_slip_displacement(&self, d: f64) -> f64 {
        self.slope * (d - self.profile.lowest()).max(0.0)
    }

    /// Returns the natural displacement of a contact, m: u_c, or for asperities without a highest one κ times the scale of their heights.
    pub fn natural_displacement(&self, d: f64) -> f64 {
        self.slope * self.profile.endless_scale().unwrap_or(d).min(d).max(0.0)
    }

    /// Returns the indentation d at a normal force, m: the inverse of [`Self::normal_force`].
    ///
    /// At 0 N the indentation is 0, or for a row of springs the height of its lowest spring.
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
        assert_eq!(law(-0.2), Err(FrictionError::Range(-0.2)));
        assert!(law(0.0).is_ok() && law(Interface::MAX_FRICTION).is_ok());
    }
}
