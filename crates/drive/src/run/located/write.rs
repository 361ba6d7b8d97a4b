//! Rows and snapshots inside a step, from its dense output.
//!
//! Output does not change the trajectory. Values come from an accepted step, snapshots are copies, and evaluations for the dense output are
//! not counted in the run.

use super::path::Growth;
use super::{Located, Motion};
use crate::equations::Equations;
use crate::record::Record;
use crate::state::State;
use stickslip_contact::{ContactError, Memory, Segment};
use stickslip_stepper::{Attempt, Completion};

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Writes the output that is due up to time `t`, s, the end of the step.
    ///
    /// An event may have cut the step. A row at the time of an event contains the state at the event.
    #[inline(never)]
    pub(super) fn write(&mut self, state: &State, t: f64, record: &mut dyn Record) {
        // Without closed forms: a row shows every contact.
        let eq = self.setting.plain(state);
        let turns = self.output.turns.watches() && self.turns_by(&eq, state, t);
        if turns || self.output.reads(t) {
            self.read(&eq, state, t, record);
        }
        if self.output.marks.watches() {
            let (end, layout) = (self.motion.solver.span().end, self.setting.layout);
            let point = |i: usize| [t, state.shifts[i] + end[i], end[layout.velocity(i)]];
            self.output.marks.pass(state, point);
            self.output.marks.end_step();
        }
    }

    /// Reports turning points of the displacement u at the corner that has just been passed.
    #[inline(never)]
    pub(super) fn tell_corner_turns(&mut self, state: &State, record: &mut dyn Record) {
        let eq = self.setting.plain(state);
        self.output.turns.pass_corner(&eq, (state.t, &state.y), self.setting.tolerance);
        self.output.tell_turns(&eq, state, state.t, |i, _| state.y[i], record);
    }

    /// Whether the displacement u of any watched contact has a turning point in the step.
    fn turns_by(&mut self, eq: &Equations<'_>, state: &State, t: f64) -> bool {
        let end = self.motion.solver.span().end;
        self.output.turns.notice(eq, (state.t, &state.y), (t, |i| end[i]), self.setting.tolerance)
    }

    /// Writes the output that is due inside the step.
    fn read(&mut self, eq: &Equations<'_>, state: &State, t: f64, record: &mut dyn Record) {
        let asked = self.motion.solver.evaluations();
        self.motion.solver.complete(&self.setting.equations(state, &self.interval), Completion::Dense);
        // Integrals of the state that the integrator does not carry stay unchanged.
        let known = self.motion.solver.span().end.len();
        let mut visited = std::mem::take(&mut self.output.components);
        visited[known..].copy_from_slice(&state.y[known..]);
        while let Some(due) = self.output.grid.due(t) {
            self.visit(state, due, &mut visited[..known]);
            self.output.grid.write(eq, state, due, &|i| visited[i], record);
        }
        let solver = &self.motion.solver;
        let at = |i: usize, t: f64| if i < known { solver.value(i, t) } else { state.y[i] };
        self.output.turns.locate(eq, [state.t, t], at);
        while let Some(due) = self.output.marks.due(t) {
            self.visit(state, due, &mut visited[..known]);
            let solver = &self.motion.solver;
            let at = |i: usize, t: f64| if i < known { solver.value(i, t) } else { state.y[i] };
            self.output.tell_turns(eq, state, due, at, record);
            self.output.marks.write(eq, state, due, &|i| visited[i], record);
        }
        self.output.components = visited;
        let solver = &self.motion.solver;
        let at = |i: usize, t: f64| if i < known { solver.value(i, t) } else { state.y[i] };
        self.output.tell_turns(eq, state, t, at, record);
        while let Some(due) = self.output.looks.due(t) {
            let memories = self.memories_at(eq, state, due, |i| self.motion.component(i, due));
            self.output.looks.show(self.setting.model, memories.as_deref().ok(), record);
        }
        // Evaluations for output do not belong to the run.
        self.output.evaluations += self.motion.solver.evaluations() - asked;
    }

    /// Writes all components of the integrator at time t inside the step into `out`.
    ///
    /// The components come from the dense output. If motions may decay within a step, they come from a separate step to t.
    fn visit(&mut self, state: &State, t: f64, out: &mut [f64]) {
        let eq = self.setting.equations(state, &self.interval);
        let Motion { solver, allowance, fades, .. } = &mut self.motion;
        if !*fades || !solver.visit(&eq, t, &allowance.allowed.scale, out) {
            let part = solver.part(t);
            out.iter_mut().enumerate().for_each(|(i, to)| *to = solver.value_at(i, part));
        }
    }

    /// Returns copies of the slip memories at time t inside the step, as if the step ended at t.
    ///
    /// `y` returns a component at time t. Displacements are relative to the initial positions. Fails if a contact leaves its spring row up
    /// to that time or is not finite; the snapshot is then omitted.
    #[inline(never)]
    pub(super) fn memories_at(
        &self,
        eq: &Equations<'_>,
        state: &State,
        t: f64,
        y: impl Fn(usize) -> f64,
    ) -> Result<Vec<Memory>, ContactError> {
        let mut path = Vec::new();
        let contacts = self.setting.model.contacts.iter().zip(&state.memories).enumerate();
        let memories = contacts.map(|(c, (contact, memory))| {
            let motion = eq.motion(contact, t, &y);
            let curved = contact.slot.filter(|_| !contact.goes_straight(&state.pieces));
            if let Some(slot) = curved.filter(|_| state.modes[c].grows()) {
                let growth = Growth { motion: &self.motion, eq, state, tolerance: self.setting.tolerance };
                growth.trace((c, slot), (t, &motion), |piece| path.push(piece));
            } else {
                path.push(Segment::Straight(motion.apex()));
            }
            // Every snapshot is a copy and does not change the state.
            let mut memory = memory.clone();
            path.drain(..).try_for_each(|piece| memory.commit(&contact.interface, piece).map(drop))?;
            memory.shift(state.shift(contact));
            Ok(memory)
        });
        memories.collect()
    }
}
