//! Motions of a contact, and the forces and states that result from them.

use thiserror::Error;

/// Indentation and displacement of a contact: the apex (d, u) of the wedge |p-u| ≤ κ(d-h) of possible rest positions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Apex {
    /// Indentation d, m; negative for an open contact, where -d is the gap.
    pub d: f64,
    /// Tangential displacement u of the indenter relative to the other body, m.
    pub u: f64,
}

/// Indentation and displacement of a contact with their rates.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Indentation d, m.
    pub d: f64,
    /// Tangential displacement u, m.
    pub u: f64,
    /// Rate of the indentation ḋ, m/s.
    pub dd: f64,
    /// Rate of the displacement u̇, m/s.
    pub du: f64,
}

impl Motion {
    /// Returns indentation and displacement without the rates.
    #[inline]
    pub fn apex(&self) -> Apex {
        Apex { d: self.d, u: self.u }
    }
}

/// Trial path from the committed apex; it does not change the memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Move {
    /// Straight path in the (d, u) plane.
    Chord(Apex),
    /// Curved path of growth in full stick: its end and the tangential force F_x integrated along it, N.
    // A straight approximation of this path would have an error of second order.
    Grown {
        /// End of the path.
        to: Apex,
        /// Tangential force F_x at the end, N.
        force: f64,
    },
}

/// Accepted path of one step. Committing a segment is the only way to change the memory of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Segment {
    /// Straight path in the (d, u) plane.
    Straight(Apex),
    /// Straight path in zero time: a jump of a waveform.
    Jump(Apex),
    /// Curved path of growth in full stick, with force and energy integrated along it.
    Grown {
        /// End of the path.
        to: Apex,
        /// Tangential force F_x at the end, N.
        force: f64,
        /// Tangential elastic energy at the end, J.
        energy: f64,
        /// Whether the path continues a growth segment smoothly. The breakpoint between the two is then no event when slip reaches it.
        joins: bool,
    },
}

impl Move {
    /// Returns the end of the move.
    pub fn end(&self) -> Apex {
        match *self {
            Self::Chord(to) | Self::Grown { to, .. } => to,
        }
    }
}

impl Segment {
    /// Returns the segment with displacements relative to another origin: all displacements grow by `by` (m).
    #[must_use]
    pub fn shifted(self, by: f64) -> Self {
        let shifted = |to: Apex| Apex { u: to.u + by, ..to };
        match self {
            Self::Straight(to) => Self::Straight(shifted(to)),
            Self::Jump(to) => Self::Jump(shifted(to)),
            Self::Grown { to, force, energy, joins } => Self::Grown { to: shifted(to), force, energy, joins },
        }
    }

    /// Returns the end of the segment.
    pub fn end(&self) -> Apex {
        match *self {
            Self::Straight(to) | Self::Jump(to) | Self::Grown { to, .. } => to,
        }
    }
}

/// Tangential force of a move and its derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Response {
    /// Tangential force F_x, N.
    pub force: f64,
    /// Stiffness ∂F_x/∂u at constant d, in the direction of the move, N/m.
    pub stiffness: f64,
    /// Derivative ∂F_x/∂d at constant u, in the direction of the move, N/m.
    pub coupling: f64,
}

/// Forces, energies and state at the end of a move.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// Tangential force F_x, N.
    pub force: f64,
    /// Tangential elastic energy, J.
    pub elastic: f64,
    /// Friction work of the move, J, at least 0.
    pub friction: f64,
    /// Stick radius, m: all springs inside stick; 0 in gross slip and for an open contact.
    pub stick_radius: f64,
    /// State of the whole contact.
    pub state: ContactState,
}

/// State of the whole contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum ContactState {
    /// No spring touches.
    #[default]
    Open,
    /// Full stick: every spring sticks.
    Stick,
    /// Partial slip: some springs are at their friction limit.
    Partial,
    /// Gross slip: every spring is at its friction limit.
    Slip,
}

/// State of one spring after the last move of non-zero length. Directions are those of the spring's stretch and force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum SpringState {
    /// The spring does not touch.
    #[default]
    Open,
    /// The spring is below its friction limit.
    Stick,
    /// The spring is at its friction limit, stretched in positive direction.
    SlipForward,
    /// The spring is at its friction limit, stretched in negative direction.
    SlipBackward,
}

/// Reason why a contact engine rejects a motion.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ContactError {
    /// The indentation exceeds the range of a row of springs.
    #[error("the indentation {d:.4e} m exceeds the range of the row of springs, {reach:e} m")]
    Outgrown {
        /// Indentation, m.
        d: f64,
        /// Largest indentation of the row, m.
        reach: f64,
    },
    /// The indentation exceeds the last point of the profile.
    #[error("the indentation {d:.4e} m exceeds the range of the profile, {reach:e} m")]
    Beyond {
        /// Indentation, m.
        d: f64,
        /// Largest known indentation, m.
        reach: f64,
    },
    /// The indentation or the displacement is not finite.
    #[error("the motion is not finite: d = {d}, u = {u}")]
    NotFinite {
        /// Indentation, m.
        d: f64,
        /// Displacement, m.
        u: f64,
    },
    /// The force or energy integrated along a growth path is not finite.
    #[error("the integrated motion is not finite: F_x = {force}, energy = {energy}")]
    SumsNotFinite {
        /// Tangential force F_x, N.
        force: f64,
        /// Tangential elastic energy, J.
        energy: f64,
    },
}
