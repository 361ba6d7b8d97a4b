//! Event functions (guards) of a contact, which are positive while its law holds.
//!
//! An event is the first time in a step at which an event function of the present law falls below zero by more than its deadband.
//! The start of a step is excluded. The functions depend on the motion: s₊ = u̇ - κḋ, s₋ = -u̇ - κḋ, d, the rest of the piece of
//! memory, and the distance from the old memory curve.
//!
//! | signs of u̇ - κḋ and u̇ + κḋ | law | event functions |
//! | --- | --- | --- |
//! | +, + or -, - | slip spreads forward or backward | `Drag`, `Piece`, `Contact` |
//! | +, - | the contact shrinks | the same and `Side` |
//! | -, + | grows in full stick | `Lower`, `Upper`, `Contact` |

use super::{Contact, Mode, Motion};
use crate::EventKind;
use stickslip_contact::{Change, Course, Memory};

/// Event function that crosses zero where a law ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Guard {
    /// σu̇ - κḋ: positive while the edge slips.
    Drag,
    /// Length left of the piece of memory that is being erased.
    Piece,
    /// σ(u - p(d)): positive while the apex of a shrinking contact stays on its side of the old curve.
    Side,
    /// κḋ - u̇, positive in full stick.
    Lower,
    /// κḋ + u̇, positive in full stick.
    Upper,
    /// d: positive in contact.
    Contact,
    /// -d: positive while the contact is open.
    Gap,
    /// σu̇ - κḋ of a row: positive while its slipping springs slip. This function and the next four detect changes of single
    /// springs, which end a step without an event in the record.
    Edge,
    /// Displacement left until a spring slips forward, m.
    Forward,
    /// Displacement left until a spring slips backward, m.
    Backward,
    /// Indentation left until a spring touches, m.
    Rise,
    /// Indentation left until a spring separates, m.
    Sink,
}

/// Deadband for rounding, relative to natural displacement or velocity. Without it, rounding of a body at rest causes events.
const DEADBAND: f64 = 1e-13;
/// Nearness: an event function this close to zero counts as zero, in units of the tolerance. The law is continuous at events, so
/// the error is of second order.
pub(crate) const NEARNESS: f64 = 1e-3;

/// Rounding of a velocity after a long step of a method of high order, in units of ε·position·ω. Stages weight rounded forces
/// with large coefficients.
const NOISE: f64 = 256.0;

/// Returns deadband and nearness of an event function with a natural scale.
pub(crate) fn bands(scale: f64, tolerance: f64) -> (f64, f64) {
    (DEADBAND * scale, (NEARNESS * tolerance).max(2.0 * DEADBAND) * scale)
}

impl Guard {
    /// Returns the event functions of a contact under a law; empty for a contact that never ends a step.
    pub(crate) fn of(contact: &Contact, mode: &Mode) -> &'static [Self] {
        match (mode, contact.is_constant()) {
            // The contact never ends a step.
            _ if contact.unguarded => &[],
            (Mode::Lull { .. }, _) if contact.inert => &[Self::Rise, Self::Sink, Self::Contact],
            (Mode::Lull { .. }, _) => &[
                Self::Drag,
                Self::Edge,
                Self::Forward,
                Self::Backward,
                Self::Rise,
                Self::Sink,
                Self::Contact,
            ],
            // Without friction it can only separate.
            (Mode::Whole { .. }, false) if contact.inert => &[Self::Contact],
            (Mode::Open, true) => &[],
            (Mode::Open, false) => &[Self::Gap],
            (Mode::Grow, _) => &[Self::Lower, Self::Upper, Self::Contact],
            // In gross slip there is no piece of memory and no old curve.
            (Mode::Slip(branch), true) if branch.is_gross() => &[Self::Drag],
            (Mode::Slip(branch), false) if branch.is_gross() => &[Self::Drag, Self::Contact],
            (Mode::Slip(_), true) => &[Self::Drag, Self::Piece],
            (Mode::Slip(_), false) => &[Self::Drag, Self::Piece, Self::Side, Self::Contact],
            (Mode::Whole { .. }, true) => &[Self::Drag],
            (Mode::Whole { .. }, false) => &[Self::Drag, Self::Contact],
        }
    }

    /// Returns its value: velocities in m/s, lengths in m; ∞ if the law does not have this function.
    #[inline]
    pub(crate) fn value(self, contact: &Contact, (memory, mode): (&Memory, &Mode), at: &Motion) -> f64 {
        let slope = contact.interface.stick_slope();
        match (self, mode) {
            // A row under the full force law needs reversals only; its springs determine stick by themselves.
            (Self::Drag, Mode::Whole { sense }) if *sense == 0.0 => f64::INFINITY,
            (Self::Drag, Mode::Whole { sense } | Mode::Lull { sense, .. }) => sense * at.du,
            (Self::Edge, Mode::Lull { lull, .. }) if lull.sense() != 0.0 => {
                lull.sense() * at.du - slope * at.dd
            }
            (Self::Forward, Mode::Lull { lull, .. }) => lull.left(1.0, at.apex()),
            (Self::Backward, Mode::Lull { lull, .. }) => lull.left(-1.0, at.apex()),
            (Self::Rise, Mode::Lull { lull, .. }) => lull.next() - at.d,
            (Self::Sink, Mode::Lull { lull, .. }) => at.d - lull.top(),
            (Self::Edge | Self::Forward | Self::Backward | Self::Rise | Self::Sink, _) => f64::INFINITY,
            // s₊ or s₋: zero at a reversal under constant depth, or at the start of full stick under growing depth.
            (Self::Drag, _) => mode.sense() * at.du - slope * at.dd,
            (Self::Piece, Mode::Slip(branch)) => branch.margin(at.d, at.u),
            (Self::Side, mode) => Self::beside((memory, mode), at)[0],
            (Self::Piece, _) => f64::INFINITY,
            (Self::Lower, _) => slope * at.dd - at.du,
            (Self::Upper, _) => slope * at.dd + at.du,
            (Self::Contact, _) => at.d,
            (Self::Gap, _) => -at.d,
        }
    }

    /// Returns [`Guard::Side`], σ(u - p(d)), m, and its rate, σ(u̇ - p'(d)ḋ), m/s; p is the old curve.
    #[inline]
    pub(crate) fn beside((memory, mode): (&Memory, &Mode), at: &Motion) -> [f64; 2] {
        let Mode::Slip(branch) = mode else { return [f64::INFINITY, 0.0] };
        match memory.branching().and_then(|branching| branching.beside(at.apex())) {
            Some([above, slope]) => [above, at.du - slope * at.dd].map(|of| branch.sense() * of),
            None => [f64::INFINITY, 0.0],
        }
    }

    /// Whether it is a velocity of a slipping or sticking edge.
    pub(crate) fn is_edge(self) -> bool {
        matches!(self, Self::Drag | Self::Lower | Self::Upper)
    }

    /// Whether it depends on positions only, not on velocities.
    pub(crate) fn is_length(self) -> bool {
        !matches!(self, Self::Drag | Self::Lower | Self::Upper | Self::Edge)
    }

    /// Returns its rate from the motion and the second derivatives (d̈, ü), for a contact that only bodies move.
    ///
    /// Rates of velocities are in m/s², rates of lengths in m/s. For [`Guard::Side`] it is the rate of [`Guard::Piece`].
    pub(crate) fn rate(self, contact: &Contact, mode: &Mode, at: &Motion, (bend, pull): (f64, f64)) -> f64 {
        let slope = contact.interface.stick_slope();
        match (self, mode) {
            (Self::Drag, Mode::Whole { sense } | Mode::Lull { sense, .. }) => sense * pull,
            (Self::Edge, Mode::Lull { lull, .. }) => lull.sense() * pull - slope * bend,
            (Self::Edge, _) => 0.0,
            (Self::Forward, _) => slope * at.dd - at.du,
            (Self::Backward, _) => slope * at.dd + at.du,
            (Self::Rise, _) => -at.dd,
            (Self::Sink, _) => at.dd,
            (Self::Drag, _) => mode.sense() * pull - slope * bend,
            (Self::Piece | Self::Side, _) => slope * at.dd - mode.sense() * at.du,
            (Self::Lower, _) => slope * bend - pull,
            (Self::Upper, _) => slope * bend + pull,
            (Self::Contact, _) => at.dd,
            (Self::Gap, _) => -at.dd,
        }
    }

    /// Returns deadband and nearness. Both contain the rounding of displacements as large as `u` (m), and of the velocities that follow.
    ///
    /// With the natural scale s (u_cω, u_c or the depth) they are 1e-13 s + 4ε|u| and max(1e-3·tolerance, 2e-13)s + 8ε|u|. The
    /// terms of u prevent infinite events of closing loops after long travel.
    pub(crate) fn bands(self, contact: &Contact, tolerance: f64, u: f64) -> (f64, f64) {
        let rounding = 4.0 * f64::EPSILON * u.abs();
        let (unit, rounding) = match self {
            Self::Drag | Self::Lower | Self::Upper | Self::Edge => {
                (contact.natural_velocity(), rounding * contact.natural.frequency)
            }
            Self::Piece | Self::Side | Self::Forward | Self::Backward => {
                (contact.natural.displacement, rounding)
            }
            // Travel along the slide does not affect the rounding of a depth.
            Self::Contact | Self::Gap | Self::Rise | Self::Sink => (contact.natural.depth, 0.0),
        };
        // The laws on both sides of the old curve differ by (δ/u_c)²μF_N at a distance δ. The deadband is therefore the square
        // root. A contact that shrinks along the line of its growth thus has no event. With contact damping the law jumps there,
        // so the usual deadband holds.
        let square = self == Self::Side && contact.interface.damping() == 0.0;
        let dead = if square { (NEARNESS * tolerance).sqrt() } else { DEADBAND };
        let near = (NEARNESS * tolerance).max(2.0 * DEADBAND);
        (dead * unit + rounding, near * unit + 2.0 * rounding)
    }

    /// Returns the rounding of velocities of bodies at a distance `travel` (m) from their origins, m/s: [`NOISE`] ε·travel·ω. It
    /// is 0 for event functions that are lengths.
    pub(crate) fn noise(self, contact: &Contact, travel: f64) -> f64 {
        match self {
            Self::Drag | Self::Lower | Self::Upper => {
                NOISE * f64::EPSILON * travel * contact.natural.frequency
            }
            _ => 0.0,
        }
    }

    /// Returns the change of a spring that its zero crossing means, for the event functions of a row.
    pub(crate) fn change(self) -> Option<Change> {
        match self {
            Self::Edge => Some(Change::Sticks),
            Self::Forward => Some(Change::Slips(1.0)),
            Self::Backward => Some(Change::Slips(-1.0)),
            Self::Rise => Some(Change::Touches),
            Self::Sink => Some(Change::Parts),
            _ => None,
        }
    }

    /// Returns the event at its zero crossing and the motion of the contact after it.
    ///
    /// When a slipping edge stops, a deepening contact changes to full stick; any other contact slips in the opposite sense.
    pub(crate) fn fired(self, contact: &Contact, mode: &Mode, at: &Motion) -> (EventKind, Course) {
        let slope = contact.interface.stick_slope();
        let turned = if mode.sense() > 0.0 { Course::Backward } else { Course::Forward };
        let same = if mode.sense() > 0.0 { Course::Forward } else { Course::Backward };
        match self {
            Self::Drag if at.dd > 0.0 && matches!(mode, Mode::Slip(_)) => {
                (EventKind::FullStick, Course::Grow)
            }
            Self::Drag if mode.is_gross() => (EventKind::GrossSlipEnds, turned),
            Self::Drag | Self::Side => (EventKind::Reversal, turned),
            Self::Piece => (EventKind::LoopClosed, same),
            // Changes of single springs are not recorded; the kind is a placeholder.
            Self::Edge | Self::Forward | Self::Backward | Self::Rise | Self::Sink => {
                (EventKind::LoopClosed, same)
            }
            Self::Lower => (EventKind::SlipBegins, Course::Forward),
            Self::Upper => (EventKind::SlipBegins, Course::Backward),
            Self::Contact => (EventKind::LiftOff, Course::Open),
            // Contact at an angle within the friction cone: all springs stick, without friction work.
            Self::Gap if at.du.abs() <= slope * at.dd => (EventKind::Touch, Course::Grow),
            Self::Gap => (EventKind::Touch, if at.du > 0.0 { Course::Forward } else { Course::Backward }),
        }
    }
}
