//! Output inside a step of an integrator, from its dense output.
//!
//! Evaluations for the dense output are not counted in the run.

use super::path::Growth;
use super::{Located, Motion};
use crate::contact::Motion as ContactMotion;
use crate::equations::Equations;
use crate::event::{Event, EventKind, Source};
use crate::record::Record;
use crate::run::stretch::Stretch;
use crate::state::State;
use stickslip_contact::Segment;
use stickslip_stepper::{Attempt, Completion};

/// Attempted step of an integrator.
pub(super) struct Attempted<'r, 'e, A> {
    pub(super) motion: &'r mut Motion<A>,
    /// Equations of motion with the closed forms of the interval.
    pub(super) eq: &'r Equations<'e>,
    pub(super) state: &'r State,
    pub(super) tolerance: f64,
}

impl<A: for<'q> Attempt<Equations<'q>>> Stretch for Attempted<'_, '_, A> {
    const TURNS: bool = true;

    /// Components come from the dense output. If motions may decay within a step, they come from a separate step to t.
    fn fill(&mut self, t: f64, y: &mut [f64]) {
        let Motion { solver, allowance, fades, .. } = &mut *self.motion;
        // Integrals of the state that the integrator does not carry stay unchanged.
        let (y, others) = y.split_at_mut(solver.span().end.len());
        others.copy_from_slice(&self.state.y[y.len()..]);
        if t == solver.span().end_time {
            return y.copy_from_slice(solver.span().end);
        }
        solver.complete(self.eq, Completion::Dense);
        if !*fades || !solver.visit(self.eq, t, &allowance.allowed.scale, y) {
            let part = solver.part(t);
            y.iter_mut().enumerate().for_each(|(i, y)| *y = solver.value_at(i, part));
        }
    }

    fn trace(&self, (c, t): (usize, f64), to: &ContactMotion, push: &mut dyn FnMut(Segment)) {
        let (contact, state) = (&self.eq.model.contacts[c], self.state);
        let curved = contact.slot.filter(|_| !contact.goes_straight(&state.pieces));
        let Some(slot) = curved.filter(|_| state.modes[c].grows()) else {
            return push(Segment::Straight(to.apex()));
        };
        let growth = Growth { motion: &*self.motion, eq: self.eq, state, tolerance: self.tolerance };
        growth.trace((c, slot), (t, to), push);
    }
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Writes the output that is due up to time `t`, s, the end of the step.
    ///
    /// An event may have cut the step. A row at the time of an event contains the state at the event.
    #[inline(never)]
    pub(super) fn write(&mut self, state: &State, t: f64, record: &mut dyn Record) {
        // Without closed forms: a row shows every contact.
        let (plain, eq) = (self.setting.plain(state), self.setting.equations(state, &self.interval));
        let (asked, tolerance) = (self.motion.solver.evaluations(), self.setting.tolerance);
        let mut step = Attempted { motion: &mut self.motion, eq: &eq, state, tolerance };
        self.output.take((&plain, state), &mut step, (t, tolerance), record);
        self.output.evaluations += self.motion.solver.evaluations() - asked;
    }

    /// Reports turning points of the displacement u at the corner that has just been passed.
    #[inline(never)]
    pub(super) fn tell_corner_turns(&mut self, state: &State, record: &mut dyn Record) {
        let eq = self.setting.plain(state);
        self.output.turns.pass_corner(&eq, (state.t, &state.y), self.setting.tolerance);
        while let Some((t, c)) = self.output.turns.take(state.t) {
            let event = Event { t, source: Source::Contact(c), kind: EventKind::Turn };
            self.output.event(&eq, state, &event, record);
        }
    }
}
