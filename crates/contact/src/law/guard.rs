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
//!
//! A damped contact that slips has three more, `Ahead`, `Behind` and `Turn`, for kinks of the damping force.

use super::{Form, Law, Site};
use crate::{Change, Memory, Motion};

/// Event function that crosses zero where a law ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Guard {
    /// σu̇ - κḋ: positive while the edge slips.
    Drag,
    /// Length left of the segment of slip memory that slip is erasing.
    Piece,
    /// σ(u - p(d)): positive while the point (d, u) of a shrinking contact stays on its side of the slip memory p(d).
    Side,
    /// κḋ - u̇: positive in full stick, zero where forward slip begins.
    Lower,
    /// κḋ + u̇: positive in full stick, zero where backward slip begins.
    Upper,
    /// Length that the lead βu̇ of a damped contact may grow until it reaches the next piece of slip memory, m. It and the next event function
    /// detect kinks of the damping force, which end a step without an event in the record.
    Ahead,
    /// Length that the lead of a damped contact may shrink until it reaches the previous piece of slip memory, m.
    Behind,
    /// ±u̇: positive while the lead of a damped contact keeps its direction.
    Turn,
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
/// Nearness: an event function this close to zero counts as zero, in units of the tolerance. The law is continuous at events, so
/// the error is of second order.
pub const NEARNESS: f64 = 1e-3;

/// Rounding of a velocity after a long step of a high-order method, in units of ε·position·ω. Such methods multiply rounded forces by large
/// coefficients.
const NOISE: f64 = 256.0;

/// Returns deadband and nearness of an event function with a natural scale.
pub fn bands(scale: f64, tolerance: f64) -> (f64, f64) {
    (DEADBAND * scale, (NEARNESS * tolerance).max(2.0 * DEADBAND) * scale)
}

impl Guard {
    /// Returns the event functions of a contact under a law; empty for a contact that never ends a step.
    pub fn of(site: &impl Site, law: &Law) -> &'static [Self] {
        match (&law.0, site.load().is_constant()) {
            // The contact never ends a step.
            _ if site.is_unguarded() => &[],
            (Form::Lull { .. }, _) if site.is_inert() => &[Self::Rise, Self::Sink, Self::Contact],
            (Form::Lull { .. }, _) => &[
                Self::Drag,
                Self::Edge,
                Self::Forward,
                Self::Backward,
                Self::Rise,
                Self::Sink,
                Self::Contact,
            ],
            // Without friction it can only separate.
            (Form::Whole { .. }, false) if site.is_inert() => &[Self::Contact],
            (Form::Open, true) => &[],
            (Form::Open, false) => &[Self::Gap],
            (Form::Grow, _) => &[Self::Lower, Self::Upper, Self::Contact],
            // In gross slip there is no piece of memory and no old curve.
            (Form::Slip(branch, _), true) if branch.is_gross() => &[Self::Drag],
            (Form::Slip(branch, lead), false) if branch.is_gross() && !lead.is_some() => {
                &[Self::Drag, Self::Contact]
            }
            (Form::Slip(branch, _), false) if branch.is_gross() => &[Self::Drag, Self::Turn, Self::Contact],
            (Form::Slip(_, lead), true) if !lead.is_some() => &[Self::Drag, Self::Piece],
            (Form::Slip(_, lead), false) if !lead.is_some() => {
                &[Self::Drag, Self::Piece, Self::Side, Self::Contact]
            }
            (Form::Slip(..), true) => &[Self::Drag, Self::Piece, Self::Ahead, Self::Behind],
            (Form::Slip(..), false) => {
                &[Self::Drag, Self::Piece, Self::Ahead, Self::Behind, Self::Turn, Self::Side, Self::Contact]
            }
            (Form::Whole { .. }, true) => &[Self::Drag],
            (Form::Whole { .. }, false) => &[Self::Drag, Self::Contact],
        }
    }

    /// Returns the value of the event function: velocities in m/s, lengths in m; ∞ if the law does not have this function.
    #[inline]
    pub fn value(self, site: &impl Site, (memory, law): (&Memory, &Law), at: &Motion) -> f64 {
        let slope = memory.law(site.interface()).stick_slope();
        match (self, &law.0) {
            // A row under the full force law needs reversals only; its springs determine stick by themselves.
            (Self::Drag, Form::Whole { sense }) if *sense == 0.0 => f64::INFINITY,
            (Self::Drag, Form::Whole { sense } | Form::Lull { sense, .. }) => sense * at.du,
            (Self::Edge, Form::Lull { lull, .. }) if lull.sense() != 0.0 => {
                lull.sense() * at.du - lull.slope() * at.dd
            }
            (Self::Forward, Form::Lull { lull, .. }) => lull.left(1.0, at.apex()),
            (Self::Backward, Form::Lull { lull, .. }) => lull.left(-1.0, at.apex()),
            (Self::Rise, Form::Lull { lull, .. }) => lull.next() - at.d,
            (Self::Sink, Form::Lull { lull, .. }) => at.d - lull.top(),
            (Self::Edge | Self::Forward | Self::Backward | Self::Rise | Self::Sink, _) => f64::INFINITY,
            // s₊ or s₋: zero at a reversal under constant depth, or at the start of full stick under growing depth.
            (Self::Drag, Form::Slip(branch, _)) => branch.sense() * at.du - branch.slope() * at.dd,
            (Self::Drag, _) => law.sense() * at.du - slope * at.dd,
            (Self::Piece, Form::Slip(branch, _)) => branch.margin(at.d, at.u),
            (Self::Ahead | Self::Behind, Form::Slip(branch, lead)) => {
                let [ahead, behind] = lead.margins(branch, at.d, at.u + site.interface().damping() * at.du);
                if self == Self::Ahead { ahead } else { behind }
            }
            (Self::Turn, Form::Slip(branch, lead)) if lead.is_turned() => -branch.sense() * at.du,
            (Self::Turn, _) => law.sense() * at.du,
            (Self::Ahead | Self::Behind, _) => f64::INFINITY,
            (Self::Side, _) => Self::beside((memory, law), at)[0],
            (Self::Piece, _) => f64::INFINITY,
            (Self::Lower, _) => slope * at.dd - at.du,
            (Self::Upper, _) => slope * at.dd + at.du,
            (Self::Contact, _) => at.d,
            (Self::Gap, _) => -at.d,
        }
    }

    /// Returns the event function [`Guard::Side`], σ(u - p(d)), m, and its rate, σ(u̇ - p'(d)ḋ), m/s; p is the slip memory.
    #[inline]
    pub fn beside((memory, law): (&Memory, &Law), at: &Motion) -> [f64; 2] {
        let Some(branch) = law.branch() else { return [f64::INFINITY, 0.0] };
        match memory.branching().and_then(|branching| branching.beside(at.apex())) {
            Some([above, slope]) => [branch.sense() * above, branch.sense() * (at.du - slope * at.dd)],
            None => [f64::INFINITY, 0.0],
        }
    }

    /// Whether it is a velocity of a slipping or sticking edge.
    pub fn is_edge(self) -> bool {
        matches!(self, Self::Drag | Self::Lower | Self::Upper)
    }

    /// Whether it detects a kink of the damping force, which is no event.
    pub fn is_lead(self) -> bool {
        matches!(self, Self::Ahead | Self::Behind | Self::Turn)
    }

    /// Whether it depends on positions only, not on velocities.
    pub fn is_length(self) -> bool {
        !matches!(
            self,
            Self::Drag | Self::Lower | Self::Upper | Self::Edge | Self::Ahead | Self::Behind | Self::Turn
        )
    }

    /// Returns the time derivative of the event function from the motion and (d̈, ü), for a contact that only bodies move.
    ///
    /// Rates of velocities are in m/s², rates of lengths in m/s. For [`Guard::Side`] it is the rate of [`Guard::Piece`].
    pub fn rate(self, site: &impl Site, law: &Law, at: &Motion, (bend, pull): (f64, f64)) -> f64 {
        let slope = site.interface().stick_slope();
        match (self, &law.0) {
            (Self::Drag, Form::Whole { sense } | Form::Lull { sense, .. }) => sense * pull,
            (Self::Edge, Form::Lull { lull, .. }) => lull.sense() * pull - lull.slope() * bend,
            (Self::Edge, _) => 0.0,
            (Self::Forward, _) => slope * at.dd - at.du,
            (Self::Backward, _) => slope * at.dd + at.du,
            (Self::Rise, _) => -at.dd,
            (Self::Sink, _) => at.dd,
            (Self::Drag, Form::Slip(branch, _)) => branch.sense() * pull - branch.slope() * bend,
            (Self::Turn, Form::Slip(branch, lead)) if lead.is_turned() => -branch.sense() * pull,
            (Self::Turn, _) => law.sense() * pull,
            (Self::Ahead | Self::Behind, _) => {
                let grows = law.sense() * (at.du + site.interface().damping() * pull) - slope * at.dd;
                if self == Self::Ahead { -grows } else { grows }
            }
            (Self::Drag, _) => law.sense() * pull - slope * bend,
            (Self::Piece | Self::Side, _) => slope * at.dd - law.sense() * at.du,
            (Self::Lower, _) => slope * bend - pull,
            (Self::Upper, _) => slope * bend + pull,
            (Self::Contact, _) => at.dd,
            (Self::Gap, _) => -at.dd,
        }
    }

    /// Returns the deadband and the bound that counts as zero, both with the rounding of displacements of size `u` (m) and of velocities.
    ///
    /// With the natural scale s (u_cω, u_c or the depth) they are 1e-13 s + 4ε|u| and max(1e-3·tolerance, 2e-13)s + 8ε|u|. The
    /// terms of u prevent infinite events of closing loops after long travel.
    pub fn bands(self, site: &impl Site, tolerance: f64, u: f64) -> (f64, f64) {
        let rounding = 4.0 * f64::EPSILON * u.abs();
        let (unit, rounding) = match self {
            Self::Drag | Self::Lower | Self::Upper | Self::Edge | Self::Turn => {
                (site.scale().displacement * site.scale().frequency, rounding * site.scale().frequency)
            }
            Self::Piece | Self::Side | Self::Ahead | Self::Behind | Self::Forward | Self::Backward => {
                (site.scale().displacement, rounding)
            }
            // Travel along the slide does not affect the rounding of a depth.
            Self::Contact | Self::Gap | Self::Rise | Self::Sink => (site.scale().depth, 0.0),
        };
        // The laws on both sides of the old curve differ by (δ/u_c)²μF_N at a distance δ. The deadband is therefore the square
        // root. A contact that shrinks along the line of its growth thus has no event. With contact damping the law jumps there,
        // so the usual deadband holds.
        let square = self == Self::Side && site.interface().damping() == 0.0;
        let dead = if square { (NEARNESS * tolerance).sqrt() } else { DEADBAND };
        let near = (NEARNESS * tolerance).max(2.0 * DEADBAND);
        (dead * unit + rounding, near * unit + 2.0 * rounding)
    }

    /// Returns the rounding of velocities of bodies at a distance `travel` (m) from their origins, m/s: `NOISE` ε·travel·ω. It
    /// is 0 for event functions that are lengths.
    pub fn noise(self, site: &impl Site, travel: f64) -> f64 {
        match self {
            Self::Drag | Self::Lower | Self::Upper | Self::Turn => {
                NOISE * f64::EPSILON * travel * site.scale().frequency
            }
            _ => 0.0,
        }
    }

    /// Returns the change of a spring that its zero crossing means, for the event functions of a row.
    pub fn change(self) -> Option<Change> {
        match self {
            Self::Edge => Some(Change::Sticks),
            Self::Forward => Some(Change::Slips(1.0)),
            Self::Backward => Some(Change::Slips(-1.0)),
            Self::Rise => Some(Change::Touches),
            Self::Sink => Some(Change::Parts),
            _ => None,
        }
    }
}
