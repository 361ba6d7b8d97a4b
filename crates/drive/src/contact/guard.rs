//! Guards: functions that are positive while a contact's mode holds.
//!
//! An event is the first moment inside a step at which a guard of the present mode falls below zero by more
//! than its deadband; the start of a step never belongs to it. The guards are functions of the motion, the
//! same in every mode that has them: s₊ = u̇ - κḋ, s₋ = -u̇ - κḋ, d, the margin of a piece, the distance from
//! the old curve.
//!
//! | regime, by the signs of u̇ - κḋ and u̇ + κḋ | mode | guards |
//! | --- | --- | --- |
//! | +, + or -, - | slip spreads forward or backward | `Drag`, `Piece`, `Contact` |
//! | +, - | the contact shrinks | the same and `Side` |
//! | -, + | grows in full stick | `Lower`, `Upper`, `Contact` |

use super::{Contact, Mode, Motion};
use crate::EventKind;
use stickslip_contact::{Change, Course, Memory};

/// A function that falls through zero where a mode ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Guard {
    /// σu̇ - κḋ: the dragging edge still drags.
    Drag,
    /// Length left of the piece of memory being cut.
    Piece,
    /// σ(u - p(d)): the apex of a shrinking contact stays on its side of the old curve.
    Side,
    /// κḋ - u̇ in full stick.
    Lower,
    /// κḋ + u̇ in full stick.
    Upper,
    /// d: still in contact.
    Contact,
    /// -d: still apart.
    Gap,
    /// σu̇ - κḋ of a row: its springs that slip go on slipping. This one and those below are silent: each is a change of one
    /// spring and ends a lull.
    Edge,
    /// Stretch left until a spring slips forward.
    Forward,
    /// Stretch left until a spring slips backward.
    Backward,
    /// Indentation left until a spring touches.
    Rise,
    /// Indentation left until a spring parts.
    Sink,
}

/// Round-off deadbands, relative to the natural displacement and velocity: without them a body at rest rings in
/// its last bit.
// Not tuned finely: a tenth or ten times as much changes no error by more than any other path of steps does.
const DEADBAND: f64 = 1e-13;
/// How near to its zero a guard counts as there, in units of the tolerance: the law is continuous across events,
/// so what is missed counts in second order only.
// Ten times as much leaves a damped flat punch under a falling load books of 8e-3 instead of 1e-6 at a tolerance of 1e-6; with
// a tenth its events accumulate and the run stops.
pub(crate) const NEARNESS: f64 = 1e-3;

/// What a step of a method of high order, as long as stability allows, makes of the rounding of a place in the velocity that
/// follows from it, in ε·place·ω: its stages weigh the rounded forces with large coefficients.
// With 64 a stage at rest on its foot (8 μm from its start, 50 N/μm, 500 mg) notes 16 400 events in a second, with 1024 1 560,
// without any 46 600, nearly all of them noise; its places end within 2e-9 u_c of each other.
const NOISE: f64 = 256.0;

/// How far below zero a guard of a natural scale must fall to count, and how near to zero it counts as there.
pub(crate) fn bands(scale: f64, tolerance: f64) -> (f64, f64) {
    (DEADBAND * scale, (NEARNESS * tolerance).max(2.0 * DEADBAND) * scale)
}

impl Guard {
    /// The guards of a contact in a mode.
    ///
    /// None for a contact of which nothing ends a step.
    pub(crate) fn of(contact: &Contact, mode: &Mode) -> &'static [Self] {
        match (mode, contact.is_constant()) {
            // Nothing that it does ends a step: nobody looks at it.
            _ if contact.unguarded => &[],
            // A row under a constant normal has no lulls.
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
            // Without friction it can but part.
            (Mode::Whole { .. }, false) if contact.inert => &[Self::Contact],
            (Mode::Open, true) => &[],
            (Mode::Open, false) => &[Self::Gap],
            (Mode::Grow, _) => &[Self::Lower, Self::Upper, Self::Contact],
            // In gross slip there is no piece left to cut and no old curve to cross.
            (Mode::Slip(branch), true) if branch.is_gross() => &[Self::Drag],
            (Mode::Slip(branch), false) if branch.is_gross() => &[Self::Drag, Self::Contact],
            (Mode::Slip(_), true) => &[Self::Drag, Self::Piece],
            (Mode::Slip(_), false) => &[Self::Drag, Self::Piece, Self::Side, Self::Contact],
            (Mode::Whole { .. }, true) => &[Self::Drag],
            (Mode::Whole { .. }, false) => &[Self::Drag, Self::Contact],
        }
    }

    /// Its value.
    ///
    /// Velocities in m/s, lengths in m; ∞ where the mode has no such guard.
    #[inline]
    pub(crate) fn value(self, contact: &Contact, (memory, mode): (&Memory, &Mode), at: &Motion) -> f64 {
        let slope = contact.interface.stick_slope();
        match (self, mode) {
            // A row needs its reversals only: its springs know by themselves when they stick.
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
            // s₊ or s₋: at constant depth it is a reversal of sliding, at a growing one the start of full
            // stick.
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

    /// The value of [`Guard::Side`], σ(u - p(d)), m, and its rate, σ(u̇ - p'(d)ḋ), m/s, p the old curve.
    #[inline]
    pub(crate) fn beside((memory, mode): (&Memory, &Mode), at: &Motion) -> [f64; 2] {
        let Mode::Slip(branch) = mode else { return [f64::INFINITY, 0.0] };
        match memory.branching().and_then(|branching| branching.beside(at.apex())) {
            Some([above, slope]) => [above, at.du - slope * at.dd].map(|of| branch.sense() * of),
            None => [f64::INFINITY, 0.0],
        }
    }

    /// Whether it asks how fast an edge moves that drags, or might.
    pub(crate) fn is_edge(self) -> bool {
        matches!(self, Self::Drag | Self::Lower | Self::Upper)
    }

    /// Whether it asks only where the contact stands, and not how fast it moves.
    pub(crate) fn is_length(self) -> bool {
        !matches!(self, Self::Drag | Self::Lower | Self::Upper | Self::Edge)
    }

    /// Its rate, from the motion and its second derivatives (d̈, ü), where the bodies alone move the contact.
    ///
    /// m/s² of velocities, m/s of lengths. Of [`Guard::Side`] it is that of [`Guard::Piece`].
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

    /// How far below zero a guard must fall to count, and how near to zero it counts as there. Both hold what rounding
    /// leaves of a difference of displacements that have travelled as far as `u` (m), and of the velocities that it makes.
    ///
    /// Of a natural scale s (u_cω, u_c or the depth): 1e-13 s + 4ε|u| and max(1e-3·tolerance, 2e-13)s +
    /// 8ε|u|. Without the terms of u loops that closed after a travel of many thousand u_c made events
    /// without end.
    pub(crate) fn bands(self, contact: &Contact, tolerance: f64, u: f64) -> (f64, f64) {
        let rounding = 4.0 * f64::EPSILON * u.abs();
        let (unit, rounding) = match self {
            Self::Drag | Self::Lower | Self::Upper | Self::Edge => {
                (contact.natural_velocity(), rounding * contact.natural.frequency)
            }
            Self::Piece | Self::Side | Self::Forward | Self::Backward => {
                (contact.natural.displacement, rounding)
            }
            // A depth is no difference of displacements along the slide: their travel does not round it.
            Self::Contact | Self::Gap | Self::Rise | Self::Sink => (contact.natural.depth, 0.0),
        };
        // The laws on the two sides of the old curve differ by the square of the distance δ from it only, by about
        // (δ/u_c)²μF_N. A contact that shrinks along the line on which it grew slips nowhere and rides on that line but for
        // rounding, the chords of the line and its own ringing: what the square cannot tell from the line is on it.
        // Where stuck springs are damped the law jumps there, and nothing is to spare.
        let square = self == Self::Side && contact.interface.damping() == 0.0;
        let dead = if square { (NEARNESS * tolerance).sqrt() } else { DEADBAND };
        let near = (NEARNESS * tolerance).max(2.0 * DEADBAND);
        (dead * unit + rounding, near * unit + 2.0 * rounding)
    }

    /// What the longest steps make of rounding in the velocities of bodies that lie as far from their origins as `travel` (m),
    /// m/s: [`NOISE`] ε·travel·ω. None in guards that are lengths.
    pub(crate) fn noise(self, contact: &Contact, travel: f64) -> f64 {
        match self {
            Self::Drag | Self::Lower | Self::Upper => {
                NOISE * f64::EPSILON * travel * contact.natural.frequency
            }
            _ => 0.0,
        }
    }

    /// What it means for the springs of a row, where it means nothing else.
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

    /// What it means that this guard fell: the event and the course after it.
    ///
    /// A dragging edge of a contact that deepens gives way to full stick; of one that does not, to the edge
    /// of the other sense.
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
            // Changes of single springs are nobody's news.
            Self::Edge | Self::Forward | Self::Backward | Self::Rise | Self::Sink => {
                (EventKind::LoopClosed, same)
            }
            Self::Lower => (EventKind::SlipBegins, Course::Forward),
            Self::Upper => (EventKind::SlipBegins, Course::Backward),
            Self::Contact => (EventKind::LiftOff, Course::Open),
            // Touching at an angle below the cone of friction: all springs stick, and no friction work is
            // done.
            Self::Gap if at.du.abs() <= slope * at.dd => (EventKind::Touch, Course::Grow),
            Self::Gap => (EventKind::Touch, if at.du > 0.0 { Course::Forward } else { Course::Backward }),
        }
    }
}
