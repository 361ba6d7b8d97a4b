//! The contacts at both ends of a step.

use super::Run;
use crate::equations::Equations;
use crate::guard::Guard;
use crate::model::{Contact, Measure, Motion};
use crate::state::{Mode, State};
use stickslip_stepper::Attempt;

/// A contact at one end of a step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Moving {
    pub(super) motion: Motion,
    /// d̈ and ü, m/s²; what a waveform does to the indentation otherwise than by moving a body is left out.
    pub(super) second: (f64, f64),
}

/// Part by which a step aims beyond the expected end of a piece of memory, so that the end lies inside.
const OVERSTEP: f64 = 1.05;

impl<A: for<'e> Attempt<Equations<'e>>> Run<'_, A> {
    /// The contacts at the start of the next step, after anything that makes slopes jump.
    pub(super) fn set_out(&mut self, eq: &Equations<'_>) {
        let mut from = std::mem::take(&mut self.from);
        let (t, begin) = (self.solver.time(), self.solver.begin());
        self.follow(eq, &mut from, t, begin, |i| self.solver.begin_slope(i));
        self.from = from;
    }

    /// The contacts at the end of the step.
    pub(super) fn arrive(&mut self, eq: &Equations<'_>) {
        let mut to = std::mem::take(&mut self.to);
        let (t, end) = (self.solver.end_time(), self.solver.end());
        self.follow(eq, &mut to, t, end, |i| self.solver.end_slope(i));
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
        let n = self.layout.free;
        for steady in &interval.steady {
            let motion = steady.motion(t, |i| y[i], |i| y[n + i]);
            contacts[steady.contact] = Moving { motion, second: (0.0, steady.own(|i| slope(n + i))) };
        }
        for &c in interval.others.iter().chain(&interval.apart) {
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

    /// About when the first piece of memory will be used up, s from now: a step much longer would only be thrown away.
    pub(super) fn expected(&self, state: &State) -> f64 {
        let mut first = f64::INFINITY;
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let mode = &state.modes[c];
            if let Mode::Slip(branch) = mode {
                let Moving { motion, second } = self.from[c];
                let speed = Guard::Drag.value(contact, state.law(c), &motion);
                let (left, pull) =
                    (branch.margin(motion.d, motion.u), Guard::Drag.rate(contact, mode, &motion, second));
                // left = speed t + pull t²/2; a slowing edge may never get there.
                let reaches = speed * speed + 2.0 * pull * left;
                if speed > 0.0 && reaches > 0.0 && left > 0.0 {
                    first = first.min(2.0 * left / (speed + reaches.sqrt()));
                }
            }
        }
        OVERSTEP * first + 16.0 * f64::EPSILON * state.t
    }
}
