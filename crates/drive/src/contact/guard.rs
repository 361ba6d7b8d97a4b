//! Event functions (guards) of a contact, which are positive while its law holds.
//!
//! An event is the first time in a step, after its start, at which an event function of the present law falls below zero by more than its
//! deadband. The event functions are s₊ = u̇ - κḋ, s₋ = -u̇ - κḋ, the indentation d, and two distances: to the end of the present segment
//! of slip memory, and to the older slip memory.
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
    /// σu̇ - κḋ: positive while springs at the contact edge slip in the direction σ.
    Drag,
    /// Length left of the segment of slip memory that slip is erasing.
    Piece,
    /// σ(u - p(d)): positive while the point (d, u) of a shrinking contact stays on its side of the slip memory p(d).
    Side,
    /// κḋ - u̇: positive in full stick, zero where forward slip begins.
    Lower,
    /// κḋ + u̇: positive in full stick, zero where backward slip begins.
    Upper,
    /// d: positive in contact.
    Contact,
    /// -d: positive while the contact is open.
    Gap,
    /// σu̇ - κḋ of a row of springs: positive while its slipping springs slip. This and the next four event functions detect state changes
    /// of single springs, which end a step without an event in the record.
    Edge,
    /// Displacement left until a spring of a row slips forward, m.
    Forward,
    /// Displacement left until a spring of a row slips backward, m.
    Backward,
    /// Indentation left until a spring of a row touches, m.
    Rise,
    /// Indentation left until a spring of a row separates, m.
    Sink,
}

/// Deadband of event functions, relative to natural displacement or velocity; prevents events by rounding of a body at rest.
const DEADBAND: f64 = 1e-13;
/// Bound below which an event function counts as zero, in units of the tolerance. The law is continuous at events, so the resulting error
/// is of second order.
pub(crate) const NEARNESS: f64 = 1e-3;

/// Rounding of a velocity after a long step of a high-order method, in units of ε·position·ω. Such methods multiply rounded forces by large
/// coefficients.
const NOISE: f64 = 256.0;

/// Returns the deadband of an event function with a natural scale, and the bound below which its value counts as zero.
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

    /// Returns the value of the event function: velocities in m/s, lengths in m; ∞ if the law does not have this function.
    #[inline]
    pub(crate) fn value(self, contact: &Contact, (memory, mode): (&Memory, &Mode), at: &Motion) -> f64 {
        let slope = contact.interface.stick_slope();
        match (self, mode) {
            // A row of springs under the full force law needs reversals only; its springs determine stick by themselves.
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

    /// Returns the event function [`Guard::Side`], σ(u - p(d)), m, and its rate, σ(u̇ - p'(d)ḋ), m/s; p is the slip memory.
    #[inline]
    pub(crate) fn beside((memory, mode): (&Memory, &Mode), at: &Motion) -> [f64; 2] {
        let Mode::Slip(branch) = mode else { return [f64::INFINITY, 0.0] };
        match memory.branching().and_then(|branching| branching.beside(at.apex())) {
            Some([above, slope]) => [above, at.du - slope * at.dd].map(|of| branch.sense() * of),
            None => [f64::INFINITY, 0.0],
        }
    }

    /// Returns whether the event function is the velocity of a contact edge that slips or sticks.
    pub(crate) fn is_edge(self) -> bool {
        matches!(self, Self::Drag | Self::Lower | Self::Upper)
    }

    /// Returns whether the event function depends on positions only, not on velocities.
    pub(crate) fn is_length(self) -> bool {
        !matches!(self, Self::Drag | Self::Lower | Self::Upper | Self::Edge)
    }

    /// Returns the time derivative of the event function from the motion and (d̈, ü), for a contact that only bodies move.
    ///
    /// Derivatives of velocities are in m/s², derivatives of lengths in m/s. For [`Guard::Side`] the result is that of [`Guard::Piece`].
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

    /// Returns the deadband and the bound that counts as zero, both with the rounding of displacements of size `u` (m) and of velocities.
    ///
    /// For the natural scale s (u_cω, u_c or the depth), the deadband is 1e-13 s + 4ε|u| and the bound max(1e-3·tolerance, 2e-13)s + 8ε|u|.
    /// The terms of u prevent endless events of closing hysteresis loops after long travel.
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
        // The laws on both sides of the slip memory differ by (δ/u_c)²μF_N at a distance δ, so the deadband is the square root. A contact
        // that shrinks along the line of its growth thus has no event. With contact damping the law jumps there, so the usual deadband
        // holds.
        let square = self == Self::Side && contact.interface.damping() == 0.0;
        let dead = if square { (NEARNESS * tolerance).sqrt() } else { DEADBAND };
        let near = (NEARNESS * tolerance).max(2.0 * DEADBAND);
        (dead * unit + rounding, near * unit + 2.0 * rounding)
    }

    /// Returns the rounding error of velocities of bodies at a distance `travel` (m) from their origins, m/s: [`NOISE`] ε·travel·ω. The
    /// result is 0 for event functions that are lengths.
    pub(crate) fn noise(self, contact: &Contact, travel: f64) -> f64 {
        match self {
            Self::Drag | Self::Lower | Self::Upper => {
                NOISE * f64::EPSILON * travel * contact.natural.frequency
            }
            _ => 0.0,
        }
    }

    /// Returns the change of state of a single spring at the zero crossing, for the event functions of a row of springs.
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

    /// Returns the kind of event at the zero crossing and the motion of the contact after the event.
    ///
    /// When slip at the edge stops, a contact with growing indentation changes to full stick; any other contact reverses its slip.
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
