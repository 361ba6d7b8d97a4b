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
