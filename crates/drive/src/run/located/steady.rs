//! End of a run as soon as the step length of the drive is steady.
//!
//! Up to its end the run has the same bits as a run without early end. Positions at period ends come from the dense output, and no step is
//! cut there.

use super::Located;
use super::write::Attempted;
use crate::equations::Equations;
use crate::state::State;
use stickslip_stepper::Attempt;

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Ends the run at the period end inside the attempted step at which the step length of the drive has become steady, if it has.
    #[inline(never)]
    pub(super) fn take_steps(&mut self, state: &State) {
        let (t, tolerance) = (self.motion.solver.span().end_time, self.setting.tolerance);
        let eq = self.setting.equations(state, &self.interval);
        let mut step = Attempted { motion: &mut self.motion, eq: &eq, state, tolerance };
        if let Some(end) = self.horizon.take_periods(state, &mut step, (t, &mut self.output.components)) {
            self.end_at(end);
        }
    }
}
