//! Contacts of a scene.

use super::{Point, Side, Varying};
use stickslip_contact::Interface;

/// A frictional contact: u = x(first) - x(second) at the contact point; F_x(u) acts on the second body, -F_x on the
/// first. The first body lies below.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// First (lower) and second body.
    pub between: [Side; 2],
    /// The contact point on either body.
    pub at: [Point; 2],
    /// Effective moduli, profile of the gap, Coulomb's coefficient of friction and the time constant of the stuck springs.
    pub interface: Interface,
    /// What presses the contact.
    pub normal: Normal,
    /// Gap between the bodies in the position drawn, m; negative: pressed. For [`Normal::Coupled`].
    pub gap: f64,
    /// The contact's own starting state.
    pub start: ContactStart,
    /// How the tangential problem is solved.
    pub engine: EngineChoice,
    /// Number of identical contacts that share this motion, at least 1.
    pub count: u32,
}

/// What presses a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Normal {
    /// Normal force of one contact, N, at least 0.
    Force(Varying),
    /// Indentation, m; negative: open.
    Indentation(Varying),
    /// Contact radius, m, at least 0.
    Radius(Varying),
    /// From the bodies' motion: d = z(first) - z(second) - gap at the contact point.
    Coupled,
}

/// A contact's starting state; both kinds are reached monotonically from the untouched contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ContactStart {
    /// Springs unstretched.
    #[default]
    Untouched,
    /// Preloaded to this tangential force of one contact, N; below μF_N in magnitude.
    Force(f64),
    /// Preloaded by this displacement, m.
    Displacement(f64),
}

/// How the tangential problem of a contact is solved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum EngineChoice {
    /// The exact memory curve.
    #[default]
    Curve,
    /// A row of springs.
    Springs {
        /// Number of springs.
        count: usize,
        /// Length of the row, m; by default the contact's width at the largest indentation known, or as much as it takes to bear the
        /// largest force known.
        span: Option<f64>,
    },
}
