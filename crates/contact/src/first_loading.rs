//! First loading: the contact is pressed to an indentation, then displaced monotonically in tangential direction (4.37).
//!
//! One of {d, a, `F_N`} and one of {u, c, `F_x`} determine all other quantities:
//!
//! * `F_N` = E\*M(d), d = g(a);
//! * g(c) = d - u/κ for |u| below the gross slip displacement `u_c` = κd;
//! * `F_x` = μ[`F_N`(d) - `F_N`(g(c))] (4.38), a difference of two normal forces.

mod approaches;

use crate::Interface;
use thiserror::Error;

/// State at the end of a first loading. States with negative u and `F_x` are mirror images.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstLoading {
    /// Indentation d, m.
    pub d: f64,
    /// Contact radius a, m; for a list of springs half the length in contact.
    pub a: f64,
    /// Normal force `F_N`, N.
    pub normal_force: f64,
    /// Tangential displacement u, m.
    pub u: f64,
    /// Stick radius c, m; 0 in gross slip.
    pub c: f64,
    /// Tangential force `F_x`, N.
    pub tangential_force: f64,
}

/// Given quantity of the normal contact. The contact is open for d ≤ 0 and for a force or radius of 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NormalGiven {
    /// Indentation d, m.
    Indentation(f64),
    /// Contact radius a, m, at least 0; only for strictly convex profiles.
    Radius(f64),
    /// Normal force `F_N`, N, at least 0.
    Force(f64),
}

/// Given quantity of the tangential contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TangentialGiven {
    /// Displacement u, m; beyond `u_c` the contact is in gross slip.
    Displacement(f64),
    /// Stick radius c, m, between 0 and a, at positive u; only for strictly convex profiles. The value 0 is the onset of gross slip.
    StickRadius(f64),
    /// Tangential force `F_x`, N, at most `μF_N` in magnitude.
    Force(f64),
}

/// Reason why there is no first loading with the given quantities.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum FirstLoadingError {
    /// The indentation is not finite, m.
    #[error("expected a finite indentation, got {0} m")]
    Indentation(f64),
    /// The contact radius is below 0 or not reached by the profile, m.
    #[error("expected a contact radius of at least 0 m that the profile reaches, got {0} m")]
    Radius(f64),
    /// The normal force is below 0 or not finite, N.
    #[error("expected a normal force of at least 0 N, got {0} N")]
    NormalForce(f64),
    /// The displacement is not finite, m.
    #[error("expected a finite displacement, got {0} m")]
    Displacement(f64),
    /// The stick radius is not within the contact, m.
    #[error("expected a stick radius between 0 and the contact radius {a:.4e} m, got {c:e} m")]
    StickRadius {
        /// Stick radius given, m.
        c: f64,
        /// Contact radius, m.
        a: f64,
    },
    /// The tangential force exceeds the friction limit, N.
    #[error("expected a tangential force within the limit of friction ±{limit:.4e} N, got {force:e} N")]
    TangentialForce {
        /// Force given, N.
        force: f64,
        /// Friction limit `μF_N`, N.
        limit: f64,
    },
    /// The indentation exceeds the end of the profile: the equator of a sphere or the last point of a table.
    #[error("the indentation {d:.3e} m exceeds the range of the profile, {reach:.3e} m")]
    BeyondProfile {
        /// Indentation, m.
        d: f64,
        /// Largest indentation of the profile, m: [`Profile::reach`](crate::Profile::reach).
        reach: f64,
    },
    /// A radius does not determine the indentation of a flat punch, a truncated profile or a list of springs.
    #[error("a radius does not determine the indentation of this profile: give an indentation or a force")]
    Undetermined,
}

impl FirstLoading {
    /// Computes the first loading of an interface from two quantities.
    ///
    /// `F_x` is a difference and has the rounding error of `μF_N`. The displacement u has the rounding error of `u_c`.
    ///
    /// # Errors
    ///
    /// Fails if a quantity is out of its range, or if a given radius does not determine an indentation.
    pub fn solve(
        law: &Interface,
        normal: NormalGiven,
        tangential: TangentialGiven,
    ) -> Result<Self, FirstLoadingError> {
        let d = normal.indentation(law)?;
        let a = law.profile().radius(d);
        let (u, core) = slide(law, d, a, tangential)?;
        let normal_force = law.normal_force(d);
        Ok(Self {
            d,
            a,
            normal_force,
            u,
            c: law.profile().radius(core),
            tangential_force: u.signum() * law.friction() * (normal_force - law.normal_force(core)),
        })
    }
}

impl NormalGiven {
    /// Returns the indentation d of an interface, m.
    ///
    /// # Errors
    ///
    /// Fails if the quantity is out of its range or beyond the end of the profile. Fails also if a given radius does not determine an
    /// indentation.
    pub fn indentation(self, law: &Interface) -> Result<f64, FirstLoadingError> {
        let d = match self {
            Self::Indentation(d) if d.is_finite() => d,
            Self::Indentation(d) => return Err(FirstLoadingError::Indentation(d)),
            Self::Force(force) if force >= 0.0 && force.is_finite() => law.indentation(force),
            Self::Force(force) => return Err(FirstLoadingError::NormalForce(force)),
            Self::Radius(a) => {
                let d = depth(law, a)?;
                if a >= 0.0 && d.is_finite() {
                    d
                } else {
                    return Err(FirstLoadingError::Radius(a));
                }
            }
        };
        within(law, d)
    }
}

/// Checks that an indentation is within the profile. A sphere must stay below its equator; a table may be used up to its last point.
fn within(law: &Interface, d: f64) -> Result<f64, FirstLoadingError> {
    let profile = law.profile();
    match profile.reach() {
        Some(reach) if profile.ends_at_a_point() && profile.check_end(d).is_ok() => Ok(d.min(reach)),
        Some(reach) if d >= reach => Err(FirstLoadingError::BeyondProfile { d, reach }),
        _ => Ok(d),
    }
}

/// Returns the indentation g at a radius, for strictly convex profiles.
fn depth(law: &Interface, radius: f64) -> Result<f64, FirstLoadingError> {
    let profile = law.profile();
    if profile.is_strictly_convex() {
        Ok(profile.depth(radius))
    } else {
        Err(FirstLoadingError::Undetermined)
    }
}

/// Returns the displacement u and the height g(c) below which springs stick; the height is 0 in gross slip.
fn slide(law: &Interface, d: f64, a: f64, given: TangentialGiven) -> Result<(f64, f64), FirstLoadingError> {
    let slope = law.stick_slope();
    let depth_in_contact = d.max(0.0);
    match given {
        TangentialGiven::Displacement(u) if !u.is_finite() => Err(FirstLoadingError::Displacement(u)),
        TangentialGiven::Displacement(0.0) => Ok((0.0, depth_in_contact)),
        TangentialGiven::Displacement(u) if u.abs() >= slope * depth_in_contact => Ok((u, 0.0)),
        TangentialGiven::Displacement(u) => Ok((u, d - u.abs() / slope)),
        TangentialGiven::StickRadius(c) => {
            let core = depth(law, c)?;
            // A radius computed from an indentation may exceed a by one unit in the last place.
            let inside = c >= 0.0 && c <= a * (1.0 + 4.0 * f64::EPSILON);
            if !inside {
                return Err(FirstLoadingError::StickRadius { c, a });
            }
            let core = core.min(depth_in_contact);
            Ok((slope * (depth_in_contact - core), core))
        }
        TangentialGiven::Force(force) => {
            let limit = law.friction() * law.normal_force(d);
            // A given μF_N may exceed the computed limit by rounding.
            if force.is_nan() || force.abs() > limit * (1.0 + 4.0 * f64::EPSILON) {
                return Err(FirstLoadingError::TangentialForce { force, limit });
            }
            if force.abs() >= limit && limit > 0.0 {
                return Ok(((slope * depth_in_contact).copysign(force), 0.0));
            }
            if force == 0.0 {
                return Ok((0.0, depth_in_contact));
            }
            let core = law.indentation(law.normal_force(d) - force.abs() / law.friction());
            Ok(((slope * (d - core)).copysign(force), core))
        }
    }
}
