//! The early end of a run whose steps have become constant.
//!
//! Until the run ends it is the same run to the last bit as one that was not asked to end: ends of periods
//! are looked up on the dense output and no step is shortened to meet them.

use super::Located;
use crate::equations::Equations;
use crate::state::State;
use stickslip_stepper::{Attempt, Completion};

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Takes the steps of the drive that the attempt just made brings to their end; the one with which they are constant
    /// ends the run. Until then nothing is changed: the places are read off the dense output.
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
