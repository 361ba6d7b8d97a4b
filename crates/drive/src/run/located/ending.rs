//! Step that reaches the end of a run.
//!
//! Steps are not cut at the end of the run. The last step is attempted in full length, and its dense output gives the output up to the end.
//! Output therefore does not depend on the end. A run that stops before the last step continues as if it had no end.

use super::Located;
use crate::equations::Equations;
use crate::run::steady::Steps;
use crate::state::State;
use stickslip_stepper::{Attempt, Completion, Hand, StepControl};

/// Data that an attempt changes, apart from scratch of the integrator.
#[derive(Clone)]
pub(super) struct Bookmark {
    control: StepControl,
    steps: Steps,
    end: f64,
    evaluations: u64,
    hand: Hand,
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Saves the data before an attempt that may reach the end of the run; `None` if no attempt can reach it.
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

    /// Restores the data saved before an attempt, which undoes the attempt.
    pub(super) fn turn_back(&mut self, before: Option<Bookmark>) {
        let Some(before) = before else { return };
        // The attempt will be repeated and counted then.
        self.output.evaluations += self.motion.solver.evaluations() - before.evaluations;
        self.motion.solver.set_hand(before.hand);
        (self.control, self.horizon.steps) = (before.control, before.steps);
        self.end_at(before.end);
    }

    /// Sets the end of the run and of its rows, s.
    pub(super) fn end_at(&mut self, end: f64) {
        self.horizon.end = end;
        self.horizon.nearly = self.output.end_at(end);
    }

    /// Cuts the attempted step at the end of the run, on its dense output, if it passes the end.
    ///
    /// Zero crossings beyond the end are discarded.
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
