//! Contacts whose force is a closed form of u until the next event.
//!
//! At a constant depth one edge of the wedge drags over one piece of the memory: F_x = F₀ + gM(h_c) with the height h_c of
//! the slip front a straight function of u. Then the guards are straight functions of the state, too, one evaluation costs
//! one M, and the memory need not move before the next event: one chord there is the same as many.

use super::Followed;
use crate::Sample;
use crate::contact::{Contact, Guard, Mode, Motion, Press};
use stickslip_contact::{Apex, Branch, FixedDepthBranch};

/// A contact at constant indentation on one branch.
#[derive(Debug, Clone)]
pub(crate) struct Closed<'a> {
    /// Its place among the contacts.
    pub(crate) index: usize,
    pub(crate) contact: &'a Contact,
    /// Those that end the interval.
    pub(crate) guards: &'static [Guard],
    d: f64,
    /// u = what followers make of it + Σ coefficient · coordinate.
    pub(super) followed: Followed<'a>,
    /// Sum of the coefficients: what a single coordinate counts in u.
    pub(crate) arm: f64,
    pub(super) branch: FixedDepthBranch,
    /// The one free coordinate in u and its coefficient, where there is no other.
    lever: Option<(usize, f64)>,
}

impl Closed<'_> {
    /// Takes up another branch and its guards.
    pub(super) fn renew(&mut self, branch: &Branch, guards: &'static [Guard]) {
        if let Press::Constant { d, reduced_force } = self.contact.press {
            self.branch = branch.at_depth(d, reduced_force);
        }
        self.guards = guards;
    }

    /// The part of u that does not depend on the free coordinates, m, and its derivatives.
    #[inline(always)]
    pub(crate) fn followed(&self, t: f64) -> Sample {
        self.followed.at(t)
    }

    /// Its rate where it is the same at all times, m/s.
    pub(crate) fn constant_rate(&self) -> Option<f64> {
        self.followed.line().map(|[_, rate, _]| rate)
    }

    /// Force along u on the coordinates, N: what the contacts exert, less than zero forward.
    #[inline(always)]
    pub(crate) fn force(&self, u: f64) -> f64 {
        -self.contact.count * self.branch.force(self.contact.interface.profile(), u)
    }

    /// u at time t, s; `x` reads positions of free coordinates.
    #[inline(always)]
    pub(crate) fn displacement(&self, t: f64, x: impl Fn(usize) -> f64) -> f64 {
        // Two bodies far from their start may be close to each other: their difference first.
        self.own(x) + self.followed(t).value
    }

    /// u̇ at time t, s; `v` reads velocities of free coordinates.
    #[inline(always)]
    pub(crate) fn speed(&self, t: f64, v: impl Fn(usize) -> f64) -> f64 {
        self.own(v) + self.followed(t).rate
    }

    /// Motion at time t, s; `x` and `v` read positions and velocities of free coordinates.
    #[inline(always)]
    pub(crate) fn motion(&self, t: f64, x: impl Fn(usize) -> f64, v: impl Fn(usize) -> f64) -> Motion {
        let Sample { value, rate, .. } = self.followed(t);
        Motion { d: self.d, u: self.own(x) + value, dd: 0.0, du: self.own(v) + rate }
    }

    /// Where it stands at time t, s; `x` reads positions of free coordinates.
    #[inline(always)]
    pub(crate) fn apex(&self, t: f64, x: impl Fn(usize) -> f64) -> Apex {
        Apex { d: self.d, u: self.displacement(t, x) }
    }

    /// The same with ü, m/s²; `a` reads accelerations of free coordinates.
    #[inline(always)]
    pub(crate) fn course(
        &self,
        t: f64,
        x: impl Fn(usize) -> f64,
        v: impl Fn(usize) -> f64,
        a: impl Fn(usize) -> f64,
    ) -> (Motion, f64) {
        let Sample { value, rate, acceleration } = self.followed(t);
        let motion = Motion { d: self.d, u: self.own(x) + value, dd: 0.0, du: self.own(v) + rate };
        (motion, self.own(a) + acceleration)
    }

    /// Value of one of its guards at a motion: the margin of its piece, or else the speed of its edge.
    #[inline(always)]
    pub(crate) fn guard(&self, guard: Guard, at: &Motion) -> f64 {
        match guard {
            Guard::Piece => self.branch.margin(at.u),
            _ => self.branch.sense() * at.du,
        }
    }

    /// Its rate, with ü (m/s²).
    #[inline(always)]
    pub(crate) fn guard_rate(&self, guard: Guard, at: &Motion, second: f64) -> f64 {
        match guard {
            Guard::Piece => -self.branch.sense() * at.du,
            _ => self.branch.sense() * second,
        }
    }

    /// How far the edge may still move at u before its piece is used up, m; ∞ in gross slip.
    #[inline(always)]
    pub(crate) fn margin(&self, u: f64) -> f64 {
        if self.branch.is_gross() { f64::INFINITY } else { self.branch.margin(u) }
    }

    /// Whether in this motion it still drags the same piece in the same sense.
    #[inline(always)]
    pub(crate) fn keeps(&self, motion: &Motion) -> bool {
        self.branch.sense() * motion.du >= 0.0 && self.margin(motion.u) >= 0.0
    }

    /// +1 forward, -1 backward.
    pub(crate) fn sense(&self) -> f64 {
        self.branch.sense()
    }

    /// How far a single coordinate at x (m) may still move before a piece of memory ends, m; ∞ in gross slip.
    #[inline(always)]
    pub(crate) fn reach(&self, t: f64, x: f64) -> f64 {
        let u = self.arm * x + self.followed(t).value;
        if self.branch.is_gross() { f64::INFINITY } else { self.branch.margin(u) / self.arm.abs() }
    }

    /// What the free coordinates make of u, or their derivatives of its own.
    #[inline(always)]
    pub(crate) fn own(&self, of: impl Fn(usize) -> f64) -> f64 {
        match self.lever {
            Some((i, a)) => a * of(i),
            None => self.contact.u.free.iter().map(|(i, a)| a * of(*i)).sum(),
        }
    }
}

/// A contact whose followers make a closed form of u.
pub(super) fn closed_form<'a>(
    c: usize,
    (contact, mode): (&'a Contact, &Mode),
    followed: Option<Followed<'a>>,
) -> Option<Closed<'a>> {
    let (Mode::Slip(branch), Press::Constant { d, reduced_force }) = (mode, &contact.press) else {
        return None;
    };
    Some(Closed {
        index: c,
        contact,
        guards: Guard::of(contact, mode),
        d: *d,
        followed: followed?,
        arm: contact.u.free.iter().map(|(_, a)| a).sum(),
        branch: branch.at_depth(*d, *reduced_force),
        lever: if let [lever] = contact.u.free[..] { Some(lever) } else { None },
    })
}
