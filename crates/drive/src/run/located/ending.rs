//! The step that reaches the end of a run.
//!
//! No step sees the end: it is tried in its whole length, and read off its dense output up to the end. So what a run writes
//! does not depend on when it ends, and one that stops before that step goes on from there as if it had never been told to
//! end.

use super::Located;
use crate::equations::Equations;
use crate::run::steady::Steps;
use crate::state::State;
use stickslip_stepper::{Attempt, Completion, Hand, StepControl};

/// What an attempt changes beside the solver's own scratch.
#[derive(Clone)]
pub(super) struct Bookmark {
    control: StepControl,
    steps: Steps,
    end: f64,
    evaluations: u64,
    hand: Hand,
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Where the run stands before an attempt that may reach its end; none where none can.
    #[inline(always)]
    pub(super) fn bookmark(&self) -> Option<Bookmark> {
        (self.horizon.end < f64::INFINITY && !self.horizon.takes_last).then(|| self.mark())
    }

    #[inline(always)]
    fn mark(&self) -> Bookmark {
        Bookmark {
            control: self.control.clone(),
            steps: self.horizon.steps,
            end: self.horizon.end,
            evaluations: self.motion.solver.evaluations(),
            hand: self.motion.solver.hand(),
        }
    }

    /// Takes back what the attempt changed: the run stands where it stood.
    pub(super) fn turn_back(&mut self, before: Option<Bookmark>) {
        let Some(before) = before else { return };
        // It will be made again, and counted then.
        self.output.evaluations += self.motion.solver.evaluations() - before.evaluations;
        self.motion.solver.set_hand(before.hand);
        (self.control, self.horizon.steps) = (before.control, before.steps);
        self.end_at(before.end);
    }

    /// Ends the run, and its rows, at another time, s.
    pub(super) fn end_at(&mut self, end: f64) {
        self.horizon.end = end;
        self.horizon.nearly = self.output.end_at(end);
    }

    /// Ends the step just tried at the end of the run, on its dense output, where it goes beyond.
    ///
    /// An event beyond the end is no event of this run: what had fallen is forgotten.
    pub(super) fn end_here(&mut self, state: &State) {
        if self.motion.solver.span().end_time <= self.horizon.end {
            return;
        }
        let eq = self.setting.equations(state, &self.interval);
        let solver = &mut self.motion.solver;
        solver.complete(&eq, Completion::Dense);
        solver.cut_exactly(&eq, self.horizon.end, &self.motion.allowance.allowed.scale);
        solver.complete(&eq, Completion::EndSlopes);
        self.watch.arrive(&eq, &self.motion.solver);
        self.watch.fired.clear();
    }
}
