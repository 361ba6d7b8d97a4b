//! Contacts whose tangential force is a closed form of u until the next event.
//!
//! At constant depth, slip spreads along one segment of the slip memory: F_x = F₀ + gM(h_c), with a slip-front height h_c that is linear in
//! u. Event functions are linear in the state, and one evaluation needs one M. The next event updates the slip memory by one straight path.

use super::Followed;
use crate::Sample;
use crate::contact::{Contact, Motion, Press};
use stickslip_contact::{Apex, Branch, FixedDepthBranch, Guard, Law};

/// Contact at constant indentation on one branch of its slip memory, so that its force is a closed form of u.
#[derive(Debug, Clone)]
pub(crate) struct Closed<'a> {
    /// Index among the contacts.
    pub(crate) index: usize,
    pub(crate) contact: &'a Contact,
    /// Event functions that end the interval.
    pub(crate) guards: &'static [Guard],
    d: f64,
    /// Prescribed part of u; the other part is Σ coefficient · free coordinate.
    pub(super) followed: Followed<'a>,
    /// Sum of the coefficients of the free coordinates; du/dx for a single coordinate x.
    pub(crate) arm: f64,
    pub(super) branch: FixedDepthBranch,
    /// Free coordinate that moves the contact and its coefficient, if there is only one.
    lever: Option<(usize, f64)>,
}

impl Closed<'_> {
    /// Sets another branch of the slip memory and its event functions.
    pub(super) fn renew(&mut self, branch: &Branch, guards: &'static [Guard]) {
        if let Press::Constant { d, reduced_force } = self.contact.press {
            self.branch = branch.at_depth(d, reduced_force);
        }
        self.guards = guards;
    }

    /// Returns the prescribed part of u, m, with its time derivatives.
    #[inline(always)]
    pub(crate) fn followed(&self, t: f64) -> Sample {
        self.followed.at(t)
    }

    /// Returns the rate of the prescribed part of u if this rate is constant, m/s.
    pub(crate) fn constant_rate(&self) -> Option<f64> {
        self.followed.line().map(|[_, rate, _]| rate)
    }

    /// Returns the contact force on the coordinates along u, N; the force is negative in forward slip.
    #[inline(always)]
    pub(crate) fn force(&self, u: f64) -> f64 {
        -self.contact.count * self.branch.force(self.contact.interface.profile(), u)
    }

    /// Returns the displacement u at time t (s), m; `x` returns positions of free coordinates.
    #[inline(always)]
    pub(crate) fn displacement(&self, t: f64, x: impl Fn(usize) -> f64) -> f64 {
        // Large displacements of two bodies cancel first.
        self.own(x) + self.followed(t).value
    }

    /// Returns the rate u̇ at time t (s), m/s; `v` returns velocities of free coordinates.
    #[inline(always)]
    pub(crate) fn speed(&self, t: f64, v: impl Fn(usize) -> f64) -> f64 {
        self.own(v) + self.followed(t).rate
    }

    /// Returns the motion of the contact at time t (s); `x` and `v` return positions and velocities of free coordinates.
    #[inline(always)]
    pub(crate) fn motion(&self, t: f64, x: impl Fn(usize) -> f64, v: impl Fn(usize) -> f64) -> Motion {
        let Sample { value, rate, .. } = self.followed(t);
        Motion { d: self.d, u: self.own(x) + value, dd: 0.0, du: self.own(v) + rate }
    }

    /// Returns indentation d and displacement u at time t (s); `x` returns positions of free coordinates.
    #[inline(always)]
    pub(crate) fn apex(&self, t: f64, x: impl Fn(usize) -> f64) -> Apex {
        Apex { d: self.d, u: self.displacement(t, x) }
    }

    /// Returns the motion of the contact at time t (s) and ü, m/s²; `x`, `v`, `a` return coordinates and their derivatives.
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

    /// Returns the value of an event function: remaining length of the segment of slip memory, or velocity of slip.
    #[inline(always)]
    pub(crate) fn guard(&self, guard: Guard, at: &Motion) -> f64 {
        match guard {
            Guard::Piece => self.branch.margin(at.u),
            _ => self.branch.sense() * at.du,
        }
    }

    /// Returns the time derivative of an event function; `second` is ü (m/s²).
    #[inline(always)]
    pub(crate) fn guard_rate(&self, guard: Guard, at: &Motion, second: f64) -> f64 {
        match guard {
            Guard::Piece => -self.branch.sense() * at.du,
            _ => self.branch.sense() * second,
        }
    }

    /// Returns the displacement left until the present segment of slip memory is used up, m; ∞ in gross slip.
    #[inline(always)]
    pub(crate) fn margin(&self, u: f64) -> f64 {
        if self.branch.is_gross() { f64::INFINITY } else { self.branch.margin(u) }
    }

    /// Returns whether the contact remains on the same segment of slip memory with the same sense of slip.
    #[inline(always)]
    pub(crate) fn keeps(&self, motion: &Motion) -> bool {
        self.branch.sense() * motion.du >= 0.0 && self.margin(motion.u) >= 0.0
    }

    /// Returns the sense of slip, +1 forward, -1 backward.
    pub(crate) fn sense(&self) -> f64 {
        self.branch.sense()
    }

    /// Returns the displacement of a single coordinate until a segment of slip memory is used up, m; ∞ in gross slip.
    #[inline(always)]
    pub(crate) fn reach(&self, t: f64, x: f64) -> f64 {
        let u = self.arm * x + self.followed(t).value;
        if self.branch.is_gross() { f64::INFINITY } else { self.branch.margin(u) / self.arm.abs() }
    }

    /// Returns Σ coefficient · coordinate over the free coordinates, or the same sum of their derivatives.
    #[inline(always)]
    pub(crate) fn own(&self, of: impl Fn(usize) -> f64) -> f64 {
        match self.lever {
            Some((i, a)) => a * of(i),
            None => self.contact.u.free.iter().map(|(i, a)| a * of(*i)).sum(),
        }
    }
}

/// Returns the data of a contact with a closed-form force; `None` if the contact's law has no such form.
pub(super) fn closed_form<'a>(
    c: usize,
    (contact, mode): (&'a Contact, &Law),
    followed: Option<Followed<'a>>,
) -> Option<Closed<'a>> {
    let Press::Constant { d, reduced_force } = &contact.press else { return None };
    let branch = mode.branch()?;
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
