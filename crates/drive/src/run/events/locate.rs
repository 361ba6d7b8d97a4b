//! Finding the first guard that falls inside a step.

use super::Run;
use crate::equations::Equations;
use crate::guard::{Guard, NEARNESS};
use crate::model::{Contact, Measure, Motion};
use crate::state::State;
use stickslip_stepper::{Attempt, hermite_dip, root};

/// A guard that falls inside the step just attempted.
#[derive(Clone, Copy)]
pub(super) struct Fall {
    pub(super) t: f64,
    contact: usize,
    guard: Guard,
}

/// Places inside a step at which guards are looked at whose course is no polynomial of low degree.
const LOOKS: [f64; 3] = [0.25, 0.5, 0.75];

impl<A: for<'e> Attempt<Equations<'e>>> Run<'_, A> {
    /// The earliest fall in the step just attempted, on its dense output.
    pub(super) fn first_fall(&mut self, eq: &Equations<'_>, state: &State) -> Option<Fall> {
        let mut first: Option<Fall> = None;
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let (begin, end) = (self.solver.begin(), self.solver.end());
            let start = eq.motion(contact, self.solver.time(), |i| begin[i]);
            let stop = eq.motion(contact, self.solver.end_time(), |i| end[i]);
            for &guard in Guard::of(contact, &state.modes[c]) {
                let value = |at: &Motion| guard.value(contact, state.law(c), at);
                let (dead, _) = guard.bands(contact, self.tolerance);
                let (g0, g1) = (value(&start), value(&stop));
                let low = if g1 < -dead && g1 < g0 {
                    Some((self.solver.end_time(), g1))
                } else {
                    self.dip(eq, state, (c, guard), (&start, &stop), dead)
                };
                if let Some((low, below)) = low {
                    let t = self.fall(eq, state, (c, guard), (g0, low, below));
                    if first.is_none_or(|first| t < first.t) {
                        first = Some(Fall { t, contact: c, guard });
                    }
                }
            }
        }
        first.map(|first| self.before(eq, state, first))
    }

    /// A guard that is up at both ends of the step may be down where another one falls: the piece of memory that an
    /// edge has used up before it turns back. Then that one comes first.
    fn before(&mut self, eq: &Equations<'_>, state: &State, mut first: Fall) -> Fall {
        for (c, contact) in self.model.contacts.iter().enumerate() {
            for &guard in Guard::of(contact, &state.modes[c]) {
                if (c, guard) == (first.contact, first.guard) {
                    continue;
                }
                let (dead, _) = guard.bands(contact, self.tolerance);
                let g1 = self.guard_at(eq, state, (c, guard), first.t);
                let g0 = self.guard_at(eq, state, (c, guard), self.solver.time());
                if g1 < -dead {
                    let t = self.fall(eq, state, (c, guard), (g0, first.t, g1));
                    if g1 < g0 && t < first.t {
                        first = Fall { t, contact: c, guard };
                    }
                }
            }
        }
        first
    }

    /// A guard that falls and returns inside the step: the time and value of its lowest point found.
    fn dip(
        &mut self,
        eq: &Equations<'_>,
        state: &State,
        (c, guard): (usize, Guard),
        (start, stop): (&Motion, &Motion),
        dead: f64,
    ) -> Option<(f64, f64)> {
        let contact = &self.model.contacts[c];
        let (t0, h) = (self.solver.time(), self.solver.end_time() - self.solver.time());
        let value = |at: &Motion| guard.value(contact, state.law(c), at);
        let (g0, g1) = (value(start), value(stop));
        let look = |run: &mut Self, share: f64| {
            run.solver.dense(eq);
            let t = t0 + share * h;
            (t, run.guard_at(eq, state, (c, guard), t))
        };
        let looks = |run: &mut Self| {
            LOOKS.into_iter().map(|share| look(run, share)).find(|(_, g)| *g < -dead && *g < g0)
        };
        if contact.press.waveform().is_some() {
            return looks(self);
        }
        match guard {
            // It rises again only after the edge has turned, and then that comes first.
            Guard::Piece => return None,
            Guard::Side => {
                let slope = contact.law.stick_slope();
                let closes = |at: &Motion| at.dd < 0.0 && at.du.abs() < -slope * at.dd;
                return if closes(start) || closes(stop) { looks(self) } else { None };
            }
            _ => {}
        }
        let rate = |at: &Motion, end: bool| {
            guard.rate(contact, &state.modes[c], at, self.accelerations(eq, contact, end))
        };
        let (share, lowest) = hermite_dip(g0, rate(start, false), g1, rate(stop, true), h)?;
        if lowest > 0.1 * g0.min(g1).max(0.0) {
            return None;
        }
        Some(look(self, share)).filter(|(_, g)| *g < -dead)
    }

    /// The moment at which a guard falls, between the start of the step and a time at which it is below zero.
    fn fall(
        &mut self,
        eq: &Equations<'_>,
        state: &State,
        guard: (usize, Guard),
        (g0, low, below): (f64, f64, f64),
    ) -> f64 {
        self.solver.dense(eq);
        let t0 = self.solver.time();
        if g0 <= 0.0 {
            return self.leave(eq, state, guard, (t0, low));
        }
        // A moment missed by this much leaves its guard far nearer to zero than the laws on both sides can tell.
        let tolerance = (0.1 * NEARNESS * self.tolerance * (low - t0)).max(4.0 * f64::EPSILON * low.abs());
        let this = &*self;
        root(|t| this.guard_at(eq, state, guard, t), t0, low, g0, below, tolerance)
    }

    /// A guard that starts within its deadband: it may first rise and then fall.
    fn leave(&self, eq: &Equations<'_>, state: &State, guard: (usize, Guard), (t0, low): (f64, f64)) -> f64 {
        let g = |t: f64| self.guard_at(eq, state, guard, t);
        let mut t = low;
        for _ in 0..40 {
            t = t0 + 0.5 * (t - t0);
            if g(t) > 0.0 {
                let (high, below) = (g(t), g(low));
                return root(g, t, low, high, below, 4.0 * f64::EPSILON * low.abs());
            }
        }
        t
    }

    /// Value of a guard at a time inside the step, on the dense output.
    fn guard_at(&self, eq: &Equations<'_>, state: &State, (c, guard): (usize, Guard), t: f64) -> f64 {
        let contact = &self.model.contacts[c];
        let motion = eq.motion(contact, t, |i| self.solver.value(i, t));
        guard.value(contact, state.law(c), &motion)
    }

    /// Motion of a contact's rates, (d̈, ü), at one end of the step, m/s². What a waveform does to the indentation
    /// otherwise than by moving a body is left out.
    pub(super) fn accelerations(&self, eq: &Equations<'_>, contact: &Contact, end: bool) -> (f64, f64) {
        let t = if end { self.solver.end_time() } else { self.solver.time() };
        let free = |i: usize| {
            let i = self.layout.velocity(i);
            if end { self.solver.end_slope(i) } else { self.solver.begin_slope(i) }
        };
        let of = |measure: &Measure| eq.acceleration(measure, t, free);
        (contact.coupling().map_or(0.0, of), of(&contact.u))
    }

    /// The guard that ends the step, by decree, and all others that are down or as good as down there:
    /// simultaneous events are one.
    pub(super) fn collect_fallen(&mut self, eq: &Equations<'_>, state: &State, fall: Fall) {
        self.fired.push((fall.contact, fall.guard));
        let t1 = self.solver.end_time();
        let others = self.model.contacts.iter().enumerate().filter(|(c, _)| *c != fall.contact);
        for (c, contact) in others {
            let (begin, end) = (self.solver.begin(), self.solver.end());
            let start = eq.motion(contact, self.solver.time(), |i| begin[i]);
            let stop = eq.motion(contact, t1, |i| end[i]);
            let fallen = Guard::of(contact, &state.modes[c]).iter().find(|guard| {
                let (_, near) = guard.bands(contact, self.tolerance);
                let value = |at| guard.value(contact, state.law(c), at);
                value(&stop) < near && value(&stop) < value(&start)
            });
            self.fired.extend(fallen.map(|guard| (c, *guard)));
        }
    }
}
