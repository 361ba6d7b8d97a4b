//! Words shared by both engines: where a contact moves, what that would give, what is kept of it.

use thiserror::Error;

/// Where a contact stands: the apex of the wedge of admissible anchors.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Apex {
    /// Indentation d, m; negative while the contact is open, -d is then the gap.
    pub d: f64,
    /// Tangential displacement u of the indenter relative to the other body, m.
    pub u: f64,
}

/// A contact in motion: where it stands and how fast it moves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Indentation d, m.
    pub d: f64,
    /// Tangential displacement u, m.
    pub u: f64,
    /// ḋ, m/s.
    pub dd: f64,
    /// u̇, m/s.
    pub du: f64,
}

impl Motion {
    /// Where the contact stands.
    #[inline]
    pub fn apex(&self) -> Apex {
        Apex { d: self.d, u: self.u }
    }
}

/// A move that is only tried, from the committed apex; it leaves no trace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Move {
    /// Straight in the (d, u) plane.
    Chord(Apex),
    /// Grown in full stick along a curved path: its end and the tangential force F_x integrated along it, N.
    // As a chord it would cost every method its order: an oblique impact in 198 steps of Dopri5 comes out 2.4e-5 off, and 9e-10
    // in 219 with F_x as a state beside the motion.
    Grown {
        /// End of the path.
        to: Apex,
        /// F_x at the end, N.
        force: f64,
    },
}

/// The accepted path of one step. Committing it is the only thing that moves a contact's memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Segment {
    /// Straight in the (d, u) plane.
    Straight(Apex),
    /// Straight and in no time: a jump of a waveform.
    Jump(Apex),
    /// Grown in full stick along a curved path; force and energy at its end as integrated along it.
    Grown {
        /// End of the path.
        to: Apex,
        /// F_x at the end, N.
        force: f64,
        /// Tangential elastic energy at the end, J.
        energy: f64,
        /// Whether the path goes on smoothly from a segment of growth just before: the knot between the two is then
        /// no event when it is cut.
        joins: bool,
    },
}

/// A path and how long it takes. A law without damping does not ask; a path on its own is one in no hurry, quasi-static.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timed<P> {
    /// The path.
    pub path: P,
    /// Δt, s; 0 where rates do not count.
    pub duration: f64,
}

impl From<Move> for Timed<Move> {
    fn from(path: Move) -> Self {
        Self { path, duration: 0.0 }
    }
}

impl From<Segment> for Timed<Segment> {
    fn from(path: Segment) -> Self {
        Self { path, duration: 0.0 }
    }
}

impl Move {
    /// Where the move ends.
    pub fn end(&self) -> Apex {
        match *self {
            Self::Chord(to) | Self::Grown { to, .. } => to,
        }
    }
}

impl Segment {
    /// The same path with displacements counted from another origin, `by` (m) further back.
    #[must_use]
    pub fn shifted(self, by: f64) -> Self {
        let shifted = |to: Apex| Apex { u: to.u + by, ..to };
        match self {
            Self::Straight(to) => Self::Straight(shifted(to)),
            Self::Jump(to) => Self::Jump(shifted(to)),
            Self::Grown { to, force, energy, joins } => Self::Grown { to: shifted(to), force, energy, joins },
        }
    }

    /// Where the segment ends.
    pub fn end(&self) -> Apex {
        match *self {
            Self::Straight(to) | Self::Jump(to) | Self::Grown { to, .. } => to,
        }
    }
}

/// What a move would give: the tangential force and its tangents.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Response {
    /// Tangential force F_x, N.
    pub force: f64,
    /// ∂F_x/∂u at constant d, in the direction of the move, N/m.
    pub stiffness: f64,
    /// ∂F_x/∂d at constant u, in the direction of the move, N/m.
    pub coupling: f64,
}

/// What a move would give, in full.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// Tangential force F_x, N.
    pub force: f64,
    /// Tangential elastic energy, J.
    pub elastic: f64,
    /// Friction work of the move, J, from the swept pieces; never negative.
    pub friction: f64,
    /// Radius inside which no spring is at its limit, m; 0 in gross slip and while open.
    pub stick_radius: f64,
    /// State of the whole contact.
    pub state: ContactState,
}

/// State of a whole contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum ContactState {
    /// No spring touches.
    #[default]
    Open,
    /// Every spring sticks.
    Stick,
    /// Some springs are at their limit.
    Partial,
    /// Every spring is at its limit.
    Slip,
}

/// State of one spring after the last move that was not zero. Signs are those of its stretch, which the force has, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum SpringState {
    /// Does not touch.
    #[default]
    Open,
    /// Below its limit.
    Stick,
    /// At its limit, stretched in the positive direction.
    SlipForward,
    /// At its limit, stretched in the negative direction.
    SlipBackward,
}

/// A motion that an engine cannot follow.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ContactError {
    /// The indentation outgrew the span of a row of springs.
    #[error("the indentation {d:.4e} m outgrew the row of springs, which reaches {reach:e} m")]
    Outgrown {
        /// Indentation, m.
        d: f64,
        /// Largest indentation the row can follow, m.
        reach: f64,
    },
    /// The indentation went beyond the points that the profile is given by.
    #[error("the indentation {d:.4e} m went beyond the last point of the profile, which reaches {reach:e} m")]
    Beyond {
        /// Indentation, m.
        d: f64,
        /// Largest indentation known of, m.
        reach: f64,
    },
    /// The motion is not a number.
    #[error("the motion is not finite: d = {d}, u = {u}")]
    NotFinite {
        /// Indentation, m.
        d: f64,
        /// Displacement, m.
        u: f64,
    },
    /// What was integrated along a curved path of growth is not a number.
    #[error("the integrated motion is not finite: F_x = {force}, energy = {energy}")]
    SumsNotFinite {
        /// F_x, N.
        force: f64,
        /// Tangential elastic energy, J.
        energy: f64,
    },
}
