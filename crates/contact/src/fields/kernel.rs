//! Pressure and surface displacement of a frictionless contact; the fields with friction are superpositions of these.

use super::power::PowerField;
use super::smooth::{self, Estimate};
use crate::Profile;
use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};

/// Height h of the foundation and the contact radius x at this height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rim {
    /// Height h, m.
    pub(super) h: f64,
    /// Radius x with g(x) = h, m.
    pub(super) x: f64,
}

/// Method for the integrals over a profile.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Kernel<'a> {
    /// Flat punch of a radius, m: closed forms.
    Flat(f64),
    /// Power law: closed forms.
    Power(Box<PowerField>),
    /// Other profile: quadrature.
    Any(&'a Profile),
}

impl<'a> Kernel<'a> {
    /// Returns the method for a profile; `None` for a list of springs and a normal law, which define no shape in three dimensions.
    pub(super) fn of(profile: &'a Profile) -> Option<Self> {
        if !profile.has_shape() {
            return None;
        }
        Some(match (profile.exponent(), profile.punch()) {
            (Some(n), _) => Self::Power(Box::new(PowerField::new(n))),
            (None, Some(radius)) => Self::Flat(radius),
            (None, None) => Self::Any(profile),
        })
    }

    /// Returns the pressure over E\* at r of a contact pressed to a rim: (1/π) ∫ᵣˣ g'/√(ξ²-r²) dξ (4.34); 0 beyond the rim.
    pub(super) fn pressure(&self, rim: Rim, r: f64) -> Estimate {
        if r >= rim.x || rim.h <= 0.0 {
            return (0.0, 0.0);
        }
        let (value, error) = match self {
            Self::Flat(b) => (rim.h / ((b - r) * (b + r)).sqrt(), 0.0),
            Self::Power(power) => (power.slope_integral(rim.h, rim.x, r), 0.0),
            Self::Any(profile) => smooth::slope_integral(profile, rim.x, r),
        };
        (FRAC_1_PI * value, FRAC_1_PI * error)
    }

    /// Returns the difference of [`Self::pressure`] of two rims, also where each of the two pressures is infinite.
    pub(super) fn pressure_between(&self, low: Rim, high: Rim, r: f64) -> Estimate {
        if low.h > 0.0 && low.x > r {
            let between = match self {
                Self::Flat(_) => None,
                Self::Power(power) => Some((power.slope_between((low.h, low.x), (high.h, high.x), r), 0.0)),
                Self::Any(profile) => Some(smooth::slope_between(profile, [low.x, high.x], r)),
            };
            if let Some((value, error)) = between {
                return (FRAC_1_PI * value, FRAC_1_PI * error);
            }
        }
        let (upper, lower) = (self.pressure(high, r), self.pressure(low, r));
        (upper.0 - lower.0, upper.1 + lower.1)
    }

    /// Returns the surface displacement w(r), m, of a contact pressed to a rim.
    ///
    /// Inside the rim w = h - f(r); outside w = (2/π) ∫₀ˣ arcsin(ξ/r) dg (4.36).
    pub(super) fn deflection(&self, profile: &Profile, rim: Rim, r: f64) -> Estimate {
        if rim.h <= 0.0 {
            return (0.0, 0.0);
        }
        if r <= rim.x {
            if let Self::Power(power) = self {
                return (rim.h - power.gap(profile.depth(r)), 0.0);
            }
            return match profile.gap(r) {
                Some(gap) => (rim.h - gap, 0.0),
                None => {
                    let (gap, error) = smooth::gap(profile, r);
                    (rim.h - gap, error)
                }
            };
        }
        match self {
            Self::Flat(b) => (FRAC_2_PI * rim.h * math::asin(b / r), 0.0),
            Self::Power(power) => (rim.h * power.outside(rim.x / r), 0.0),
            Self::Any(profile) => {
                let (value, error) = smooth::arc_integral(profile, rim.x, r);
                (FRAC_2_PI * value, FRAC_2_PI * error)
            }
        }
    }
}
