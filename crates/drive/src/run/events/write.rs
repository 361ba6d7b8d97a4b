//! What is written of a step: rows and looks on its dense output.

use super::{Run, equations};
use crate::equations::Equations;
use crate::record::Record;
use crate::run::output::Grid;
use crate::state::{Mode, State};
use stickslip_contact::{ContactError, Memory, Segment};
use stickslip_stepper::{Attempt, Completion};

impl<A: for<'e> Attempt<Equations<'e>>> Run<'_, A> {
    /// Rows and looks that are due up to the end of the step. Kept out of the way of steps without any.
    #[inline(never)]
    pub(super) fn write(&mut self, state: &State, t: f64, grid: &mut Grid, record: &mut dyn Record) {
        let eq = equations(self.model, self.layout, state);
        let asked = self.solver.evaluations();
        self.with_equations(state, |run, eq| run.solver.complete(eq, Completion::Dense));
        while let Some(due) = grid.due(t) {
            grid.write(&eq, state, due, &|i| self.component_at(state, i, due), record);
        }
        while let Some(due) = self.looks.due(t) {
            let memories = self.memories_at(&eq, state, due, |i| self.component(i, due));
            self.looks.show(memories.as_deref().ok(), record);
        }
        // What output asks for is no part of the run.
        self.for_output += self.solver.evaluations() - asked;
    }

    /// The memories of all contacts at a time inside the step, as if it ended there; `y` reads the components. Kept out of the way of rows.
    #[inline(never)]
    pub(super) fn memories_at(
        &self,
        eq: &Equations<'_>,
        state: &State,
        t: f64,
        y: impl Fn(usize) -> f64,
    ) -> Result<Vec<Memory>, ContactError> {
        let mut path = Vec::new();
        let contacts = self.model.contacts.iter().zip(&state.memories).enumerate();
        let memories = contacts.map(|(c, (contact, memory))| {
            let motion = eq.motion(contact, t, &y);
            if let (Mode::Grow, Some(slot)) = (state.modes[c], contact.slot) {
                self.trace_growth(eq, state, (c, slot), (t, &motion), |piece| path.push(piece));
            } else {
                path.push(Segment::Straight(motion.apex()));
            }
            let mut memory = memory.clone();
            path.drain(..).try_for_each(|piece| memory.commit(&contact.law, piece).map(drop))?;
            memory.shift(state.shift(contact));
            Ok(memory)
        });
        memories.collect()
    }
}
