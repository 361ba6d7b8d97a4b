//! The early end of a run whose steps have become constant.

use super::Run;
use crate::equations::Equations;
use crate::run::output::Grid;
use crate::state::State;
use stickslip_stepper::{Attempt, Completion};

impl<A: for<'e> Attempt<Equations<'e>>> Run<'_, A> {
    /// Takes the steps that the attempt just made brings to their end; the one with which they are constant ends the
    /// attempt and the run. Until then nothing is changed: the places are read off the dense output.
    #[inline(never)]
    pub(super) fn take_steps(&mut self, state: &State, grid: &mut Grid) {
        let (t, i) = (self.solver.span().end_time, self.steps.coordinate);
        while let Some(due) = self.steps.due(t) {
            if due < t {
                self.with_equations(state, |run, eq| run.solver.complete(eq, Completion::Dense));
            }
            if !self.steps.take(state.shifts[i], self.component(i, due)) {
                continue;
            }
            self.end = due;
            grid.end_at(due);
            if due < t {
                self.solver.cut(due);
                self.with_equations(state, Self::arrive);
                self.fired.clear();
            }
            return;
        }
    }
}
