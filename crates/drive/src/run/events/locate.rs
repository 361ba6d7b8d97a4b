//! Finding the first guard that falls inside a step.

use super::{Moving, Run};
use crate::equations::Equations;
use crate::guard::{Guard, NEARNESS};
use crate::model::Motion;
use crate::state::State;
use stickslip_stepper::{Attempt, hermite_dip, hermite_root, root, root_near};

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
            let (start, stop) = (self.from[c].motion, self.to[c].motion);
            for &guard in Guard::of(contact, &state.modes[c]) {
                let value = |at: &Motion| guard.value(contact, state.law(c), at);
                let (dead, _) = guard.bands(contact, self.tolerance, &start);
                let (g0, g1) = (value(&start), value(&stop));
                let low = if g1 < -dead && g1 < g0 {
                    Some((self.solver.end_time(), g1))
                } else {
                    self.dip(eq, state, (c, guard), (g0, g1), dead)
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
                let start = self.from[c].motion;
                let (dead, _) = guard.bands(contact, self.tolerance, &start);
                let g1 = self.guard_at(eq, state, (c, guard), first.t);
                if g1 < -dead {
                    let g0 = guard.value(contact, state.law(c), &start);
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
        (g0, g1): (f64, f64),
        dead: f64,
    ) -> Option<(f64, f64)> {
        let contact = &self.model.contacts[c];
        let (t0, h) = (self.solver.time(), self.solver.end_time() - self.solver.time());
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
                let closing = closes(&self.from[c].motion) || closes(&self.to[c].motion);
                return if closing { looks(self) } else { None };
            }
            _ => {}
        }
        let rate = |at: &Moving| guard.rate(contact, &state.modes[c], &at.motion, at.second);
        let (share, lowest) = hermite_dip(g0, rate(&self.from[c]), g1, rate(&self.to[c]), h)?;
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
        let guess = self.guess(state, guard, (g0, low, below));
        let (_, near) =
            guard.1.bands(&self.model.contacts[guard.0], self.tolerance, &self.from[guard.0].motion);
        let value = |t: f64| {
            let value = self.guard_at(eq, state, guard, t);
            // As good as there.
            if value.abs() < near { 0.0 } else { value }
        };
        root_near(value, (t0, low), (g0, below), guess, tolerance)
    }

    /// About where a guard falls between the start of the step and a time, as a fraction of the way: by the cubic through
    /// both ends of the step where its rates are known there.
    fn guess(&self, state: &State, (c, guard): (usize, Guard), (g0, low, below): (f64, f64, f64)) -> f64 {
        let contact = &self.model.contacts[c];
        if low < self.solver.end_time() || contact.press.waveform().is_some() {
            return 0.5;
        }
        let rate = |at: &Moving| guard.rate(contact, &state.modes[c], &at.motion, at.second);
        hermite_root(g0, rate(&self.from[c]), below, rate(&self.to[c]), low - self.solver.time())
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
        let value = |i: usize| self.solver.value(i, t);
        let motion = match eq.interval.and_then(|interval| interval.steady(c)) {
            Some(steady) => steady.motion(t, value, |i| value(self.layout.velocity(i))),
            None => eq.motion(contact, t, value),
        };
        guard.value(contact, state.law(c), &motion)
    }

    /// The guard that ends the step, by decree, and all others that are down or as good as down there:
    /// simultaneous events are one.
    pub(super) fn collect_fallen(&mut self, state: &State, fall: Fall) {
        self.fired.push((fall.contact, fall.guard));
        let others = self.model.contacts.iter().enumerate().filter(|(c, _)| *c != fall.contact);
        for (c, contact) in others {
            let (start, stop) = (self.from[c].motion, self.to[c].motion);
            let fallen = Guard::of(contact, &state.modes[c]).iter().find(|guard| {
                let (_, near) = guard.bands(contact, self.tolerance, &stop);
                let value = |at| guard.value(contact, state.law(c), at);
                value(&stop) < near && value(&stop) < value(&start)
            });
            self.fired.extend(fallen.map(|guard| (c, *guard)));
        }
    }
}
