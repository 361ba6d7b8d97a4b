//! End of a run as soon as the step length of the drive is steady.
//!
//! Up to its end the run has the same bits as a run without early end. Positions at period ends come from the dense output, and no step is
//! cut there.

use super::Located;
use crate::equations::Equations;
use crate::state::State;
use stickslip_stepper::{Attempt, Completion};

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Evaluates the step length of the drive at all period ends in the attempted step, from the dense output.
    ///
    /// Ends the run at the period end at which this step length has become steady. Otherwise nothing changes.
    #[inline(never)]
    pub(super) fn take_steps(&mut self, state: &State) {
        let (t, i) = (self.motion.solver.span().end_time, self.horizon.steps.coordinate);
        while let Some(due) = self.horizon.steps.due(t) {
            let eq = self.setting.equations(state, &self.interval);
            if due < t {
                self.motion.solver.complete(&eq, Completion::Dense);
            }
            if self.horizon.steps.take(state.shifts[i], self.motion.component(i, due)) {
                self.end_at(due);
                return;
            }
        }
    }
}
