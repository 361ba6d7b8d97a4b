//! Contacts of a [`Scene`](super::Scene).

use super::{Point, Side, Varying};
use stickslip_contact::Interface;

/// Frictional contact with the displacement u = x(first) - x(second) at the contact point. The tangential force F_x(u) acts on the second
/// body, and -F_x acts on the first (lower) body.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// First (lower) and second body.
    pub between: [Side; 2],
    /// Contact point on both bodies.
    pub at: [Point; 2],
    /// Effective moduli, profile, friction coefficient and damping time of sticking springs.
    pub interface: Interface,
    /// Normal load.
    pub normal: Normal,
    /// Gap between the bodies in the reference position, m; negative if they overlap. Used for [`Normal::Coupled`] only.
    pub gap: f64,
    /// Damping along the normal.
    pub normal_damping: NormalDamping,
    /// Initial state of the contact.
    pub start: ContactStart,
    /// Solution of the tangential problem.
    pub engine: EngineChoice,
    /// Number of identical contacts with this motion, at least 1.
    pub count: u32,
}

/// Normal load of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Normal {
    /// Normal force of one contact, N, at least 0.
    Force(Varying),
    /// Indentation, m; negative when open.
    Indentation(Varying),
    /// Contact radius, m, at least 0.
    Radius(Varying),
    /// Indentation from the motion of the bodies: d = z(first) - z(second) - gap at the contact point.
    Coupled,
}

/// Damping of a contact along the normal: the contact is that of the elastic one pressed by d + βḋ.
///
/// Force, radius, friction limit and slip memory follow d + βḋ, and there is no tension. A prescribed normal force is not damped.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum NormalDamping {
    /// No damping.
    #[default]
    None,
    /// Damping time β, s, at least 0.
    Time(f64),
    /// Damping time of an impact of the two bodies at a speed (m/s) with a coefficient of restitution in (0, 1].
    ///
    /// The impact has the effective mass of the bodies along the normal, divided by the number of contacts, and no other force.
    Restitution {
        /// Coefficient of restitution: speed after the impact divided by the speed before.
        coefficient: f64,
        /// Speed before the impact, m/s.
        speed: f64,
    },
}

/// Initial state of a contact, reached by monotonic tangential loading of the untouched contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ContactStart {
    /// Springs unstretched.
    #[default]
    Untouched,
    /// Tangential force of one contact after loading, N; its magnitude must be below μF_N.
    Force(f64),
    /// Tangential displacement of the contact after loading, m.
    Displacement(f64),
    /// Springs unstretched after a rest of this time, s.
    Rest(f64),
}

/// Solution of the tangential problem of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum EngineChoice {
    /// Exact memory curve.
    #[default]
    Curve,
    /// Row of springs.
    Springs {
        /// Number of springs.
        count: usize,
        /// Length of the row, m. By default the row covers the contact at the largest known indentation, or is long enough to carry the
        /// largest known force.
        span: Option<f64>,
    },
}
