//! A first loading: pressed to an indentation, then pushed sideways, never back.
//!
//! Any one of {d, a, `F_N`} with any one of {u, c, `F_x`} determines the rest (handbook 4.37):
//!
//! * `F_N` = E\*M(d), d = g(a);
//! * G\*u = μE\*[d-g(c)], that is g(c) = d - u/κ, with gross slip from u = `u_c` = κd on;
//! * `F_x` = μ[`F_N`(d) - `F_N`(g(c))] (4.38), the force of a smaller contact taken from that of the whole; the handbook's other
//!   way, the integral of the line load q_x (4.39), is the test of it.

mod approaches;

use crate::Interface;
use thiserror::Error;

/// The state that a first loading ends in. Negative u and `F_x` are the mirror image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstLoading {
    /// Indentation d, m.
    pub d: f64,
    /// Contact radius a, m; half the length in contact for a foundation given spring by spring.
    pub a: f64,
    /// Normal force `F_N`, N.
    pub normal_force: f64,
    /// Tangential displacement u, m.
    pub u: f64,
    /// Radius c of the stick zone, m; 0 in gross slip.
    pub c: f64,
    /// Tangential force `F_x`, N.
    pub tangential_force: f64,
}

/// What is known of the normal contact. Nothing touches at d ≤ 0 or a force or radius of 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NormalGiven {
    /// Indentation d, m.
    Indentation(f64),
    /// Contact radius a, m, at least 0; for strictly convex profiles only.
    Radius(f64),
    /// Normal force `F_N`, N, at least 0.
    Force(f64),
}

/// What is known of the tangential contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TangentialGiven {
    /// Displacement u, m; beyond `u_c` the contact slips as a whole.
    Displacement(f64),
    /// Radius c of the stick zone, m, between 0 and a, reached by a positive u; for strictly convex profiles
    /// only. 0 is the onset of gross slip.
    StickRadius(f64),
    /// Force `F_x`, N, at most `μF_N` in magnitude.
    Force(f64),
}

/// Why no first loading fits.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum FirstLoadingError {
    /// The indentation must be finite, m.
    #[error("expected a finite indentation, got {0} m")]
    Indentation(f64),
    /// The contact radius must be at least 0 and one that the profile reaches, m.
    #[error("expected a contact radius of at least 0 m that the profile reaches, got {0} m")]
    Radius(f64),
    /// The normal force must be finite and at least 0, N.
    #[error("expected a normal force of at least 0 N, got {0} N")]
    NormalForce(f64),
    /// The displacement must be finite, m.
    #[error("expected a finite displacement, got {0} m")]
    Displacement(f64),
    /// The stick zone must lie inside the contact, m.
    #[error("expected a stick radius between 0 and the contact radius {a:.4e} m, got {c:e} m")]
    StickRadius {
        /// Stick radius asked for, m.
        c: f64,
        /// Contact radius, m.
        a: f64,
    },
    /// Friction cannot carry the force, N.
    #[error("expected a tangential force within the limit of friction ±{limit:.4e} N, got {force:e} N")]
    TangentialForce {
        /// Force asked for, N.
        force: f64,
        /// `μF_N`, N.
        limit: f64,
    },
    /// A sphere ends at its equator, a table at its last point, m.
    #[error("the indentation {d:.3e} m reaches beyond the profile, which allows {reach:.3e} m")]
    BeyondProfile {
        /// Indentation, m.
        d: f64,
        /// Where the profile ends, m: [`Profile::reach`](crate::Profile::reach).
        reach: f64,
    },
    /// A flat punch, a worn profile or a list of springs keeps one radius over a range of depths.
    #[error("a radius does not determine the depth of this profile: give a depth or a force")]
    Undetermined,
}

impl FirstLoading {
    /// The first loading of an interface with these two quantities.
    ///
    /// `F_x` is a difference and carries the rounding error of `μF_N`, u that of `u_c`.
    // 7e-13 of F_x at 1e-4 u_c, 2e-10 at 1e-6: what a designer asks is not asked that close to nothing. The curve, which runs
    // through there in every swing, sums thin strips instead.
    ///
    /// # Errors
    ///
    /// If a quantity is out of its range, or a radius is given that does not determine a depth.
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
    /// The indentation d of an interface with this quantity, m.
    ///
    /// # Errors
    ///
    /// If the quantity is out of its range, a radius that does not determine a depth, or beyond the equator of a sphere or the last point
    /// of a table.
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

/// An indentation that the profile allows. A sphere stops short of its equator, points are given to be used up to the last.
fn within(law: &Interface, d: f64) -> Result<f64, FirstLoadingError> {
    let profile = law.profile();
    match profile.reach() {
        Some(reach) if profile.ends_at_a_point() && profile.check_end(d).is_ok() => Ok(d.min(reach)),
        Some(reach) if d >= reach => Err(FirstLoadingError::BeyondProfile { d, reach }),
        _ => Ok(d),
    }
}

/// g of a radius, where that determines a depth.
fn depth(law: &Interface, radius: f64) -> Result<f64, FirstLoadingError> {
    let profile = law.profile();
    if profile.is_strictly_convex() {
        Ok(profile.depth(radius))
    } else {
        Err(FirstLoadingError::Undetermined)
    }
}

/// The displacement u and the height g(c) below which the springs still stick, 0 in gross slip.
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
            // A radius that came out of a depth may lie an ulp beyond it.
            let inside = c >= 0.0 && c <= a * (1.0 + 4.0 * f64::EPSILON);
            if !inside {
                return Err(FirstLoadingError::StickRadius { c, a });
            }
            let core = core.min(depth_in_contact);
            Ok((slope * (depth_in_contact - core), core))
        }
        TangentialGiven::Force(force) => {
            let limit = law.friction() * law.normal_force(d);
            // μF_N as people reckon it may lie some last places beyond what its product comes to.
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
