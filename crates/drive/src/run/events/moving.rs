//! The contacts at both ends of a step.

use super::Run;
use crate::equations::Equations;
use crate::guard::Guard;
use crate::interval::{Interval, Steady};
use crate::model::{Contact, Measure, Motion};
use crate::state::{Mode, State};
use stickslip_stepper::{Attempt, End};

/// A contact at one end of a step. Steady contacts have none: their motion is read off the state where it is asked for.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Moving {
    pub(super) motion: Motion,
    /// d̈ and ü, m/s²; what a waveform does to the indentation otherwise than by moving a body is left out.
    pub(super) second: (f64, f64),
}

impl<A: for<'e> Attempt<Equations<'e>>> Run<'_, A> {
    /// The contacts at the start of the next step, after anything that makes slopes jump.
    pub(super) fn set_out(&mut self, eq: &Equations<'_>) {
        if eq.interval.is_some_and(Interval::is_steady) {
            return;
        }
        let mut from = std::mem::take(&mut self.from);
        let (t, begin) = (self.solver.span().time, self.solver.span().begin);
        self.follow(eq, &mut from, t, begin, |i| self.solver.slope(i, End::Start));
        self.from = from;
    }

    /// The contacts at the end of the step.
    pub(super) fn arrive(&mut self, eq: &Equations<'_>) {
        if eq.interval.is_some_and(Interval::is_steady) {
            return;
        }
        let mut to = std::mem::take(&mut self.to);
        let (t, end) = (self.solver.span().end_time, self.solver.span().end);
        self.follow(eq, &mut to, t, end, |i| self.solver.slope(i, End::End));
        self.to = to;
    }

    /// The contacts at time t and state y, with the slopes of its velocities.
    #[inline(always)]
    fn follow(
        &self,
        eq: &Equations<'_>,
        contacts: &mut [Moving],
        t: f64,
        y: &[f64],
        slope: impl Fn(usize) -> f64 + Copy,
    ) {
        let Some(interval) = eq.interval else { return };
        for c in interval.unsteady() {
            let contact = &self.model.contacts[c];
            let motion = eq.motion(contact, t, |i| y[i]);
            contacts[c] = Moving { motion, second: self.second(eq, contact, t, slope) };
        }
    }

    /// d̈ and ü of a contact from the slopes of the velocities.
    fn second(
        &self,
        eq: &Equations<'_>,
        contact: &Contact,
        t: f64,
        slope: impl Fn(usize) -> f64,
    ) -> (f64, f64) {
        let of = |measure: &Measure| eq.acceleration(measure, t, |i| slope(self.layout.velocity(i)));
        (contact.coupling().map_or(0.0, of), of(&contact.u))
    }

    /// Motion of contact `c` at the end of the step.
    pub(super) fn motion_at_end(&self, c: usize) -> Motion {
        self.motion(c, self.solver.span().end_time, self.solver.span().end)
    }

    /// The same once the state has moved there.
    pub(super) fn motion_now(&self, state: &State, c: usize) -> Motion {
        self.motion(c, state.t, &state.y)
    }

    fn motion(&self, c: usize, t: f64, y: &[f64]) -> Motion {
        let n = self.layout.free;
        match self.interval.as_ref().and_then(|interval| interval.steady(c)) {
            Some(steady) => steady.motion(t, |i| y[i], |i| y[n + i]),
            None => self.to[c].motion,
        }
    }

    /// The motion of a contact at the start of the step.
    pub(super) fn motion_from(&self, c: usize) -> Motion {
        let (t, begin, n) = (self.solver.span().time, self.solver.span().begin, self.layout.free);
        match self.interval.as_ref().and_then(|interval| interval.steady(c)) {
            Some(steady) => steady.motion(t, |i| begin[i], |i| begin[n + i]),
            None => self.from[c].motion,
        }
    }

    #[inline(always)]
    pub(super) fn expected_of_steady(&self, steady: &Steady<'_>) -> f64 {
        if !steady.guards.contains(&Guard::Piece) {
            return f64::INFINITY;
        }
        let (t, begin, n) = (self.solver.span().time, self.solver.span().begin, self.layout.free);
        let (x, v, a) = (|i| begin[i], |i| begin[n + i], |i| self.solver.slope(n + i, End::Start));
        let guard = |guard| steady.guard(guard, t, x, v);
        reached(guard(Guard::Piece), guard(Guard::Drag), steady.guard_rate(Guard::Drag, t, v, a))
    }

    pub(super) fn expected_of(&self, state: &State, c: usize) -> f64 {
        let (contact, mode) = (&self.model.contacts[c], &state.modes[c]);
        let Mode::Slip(branch) = mode else { return f64::INFINITY };
        let Moving { motion, second } = self.from[c];
        let speed = Guard::Drag.value(contact, state.law(c), &motion);
        let pull = Guard::Drag.rate(contact, mode, &motion, second);
        reached(branch.margin(motion.d, motion.u), speed, pull)
    }
}

/// When what is left (m) will be used up at a speed (m/s) and its rate (m/s²): left = speed t + pull t²/2.
#[inline(always)]
fn reached(left: f64, speed: f64, pull: f64) -> f64 {
    // A slowing edge may never get there.
    let reaches = speed * speed + 2.0 * pull * left;
    if speed > 0.0 && reaches > 0.0 && left > 0.0 {
        2.0 * left / (speed + reaches.sqrt())
    } else {
        f64::INFINITY
    }
}
