//! One attempt, and what belongs to an accepted step.

use super::Run;
use super::aim::{Aim, SHRINK};
use crate::RunError;
use crate::equations::Equations;
use crate::record::Record;
use crate::run::output::Grid;
use crate::state::State;
use stickslip_stepper::{Attempt, Completion, Grade, Rejection, StepControl, StepHistory, Verdict};

/// How a step ends.
#[derive(Clone, Copy, PartialEq)]
enum Ending {
    Smooth,
    Event,
    Corner,
}

impl<A: for<'e> Attempt<Equations<'e>>> Run<'_, A> {
    /// A leap to the next event or, where that is not possible, one attempt and, if it succeeds, everything that belongs to
    /// an accepted step.
    pub(super) fn step(
        &mut self,
        state: &mut State,
        control: &mut StepControl,
        grid: &mut Grid,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        if self.leap(state, grid, record)? {
            return Ok(());
        }
        if self.behind {
            self.catch_up(state);
        }
        let corner = self.corner.min(self.end);
        let mut aim = self.next_step(state, corner);
        if aim.target <= state.t {
            return Err(RunError::StepTooSmall { t: state.t, step: state.step });
        }
        let verdict =
            self.with_equations(state, |run, eq| run.attempt(eq, state, control, (&mut aim, corner)));
        let (target, h) = (aim.target, aim.target - state.t);
        if !verdict.accepted {
            if aim.closes.is_some() {
                self.calm = 0.0;
                // The next attempt is an even one: nothing follows from both errors together.
                let rejected = Some(Rejection { step: h, log_error: f64::INFINITY });
                control.set_history(StepHistory { rejected, ..control.history() });
            }
            self.feels = aim.singular.is_finite();
            return self.reject(state, verdict.next, record);
        }
        self.calm = self.calm.max(h);
        if self.steps.due(self.solver.span().end_time).is_some() {
            self.take_steps(state, grid);
        }
        let cut = self.solver.span().end_time < target;
        let ending = if cut {
            Ending::Event
        } else if target == corner {
            Ending::Corner
        } else {
            Ending::Smooth
        };
        let wished = match (cut, h < state.step) {
            // The next law has not earned a longer step yet.
            _ if self.solver.coasts() => state.step,
            (true, false) => h.min(verdict.next),
            (true, true) => state.step,
            (false, false) => verdict.next,
            (false, true) => state.step.max(verdict.next),
        };
        self.accept(state, grid, record, ending == Ending::Smooth && self.fired.is_empty())?;
        // On the way to a singular moment an even step has the same error as the one before where it is the same part of
        // what is left.
        let nearer = if self.feels { (1.0 - h / aim.singular).max(SHRINK) } else { 1.0 };
        state.step = if ending == Ending::Smooth { nearer * wished } else { control.after_event(wished) };
        if ending == Ending::Corner || !self.fired.is_empty() {
            self.pass_event(state, ending == Ending::Corner, record)?;
        } else {
            std::mem::swap(&mut self.from, &mut self.to);
            self.rests = self.is_at_rest(state);
            if self.rests {
                self.stop(state);
            }
        }
        self.watch.step(state, record)
    }

    /// Tries a step and, if its error allows, looks for the first event in it and ends it there.
    #[inline(always)]
    fn attempt(
        &mut self,
        eq: &Equations<'_>,
        state: &State,
        control: &mut StepControl,
        (aim, corner): (&mut Aim, f64),
    ) -> Verdict {
        let error = self.try_step(eq, state, aim, corner);
        let target = aim.target;
        // The error of a step from a singular moment falls with the root of its length as that of an even one with its
        // length.
        let judged = if aim.grade == Grade::Start && error > 1.0 { error * error } else { error };
        let verdict = control.propose(judged, target - state.t);
        if verdict.accepted {
            self.solver.complete(eq, Completion::EndSlopes);
            self.arrive(eq);
            self.fired.clear();
            if let Some(fall) = self.first_fall(eq, state) {
                if fall.t < target {
                    self.solver.cut(fall.t);
                    self.arrive(eq);
                }
                self.collect_fallen(eq, state, fall);
            }
        }
        verdict
    }

    fn reject(&mut self, state: &mut State, next: f64, record: &mut dyn Record) -> Result<(), RunError> {
        state.counts.rejected += 1;
        state.step = next;
        // Perhaps rounding has grown above what was allowed for it.
        self.set_scale(state);
        if next > 4.0 * f64::EPSILON * state.t.abs() && next > f64::MIN_POSITIVE {
            return self.watch.step(state, record);
        }
        Err(RunError::StepTooSmall { t: state.t, step: next })
    }

    /// Rows and looks inside the step, then the commit of all contacts, then time moves on. `goes_on` says that no event
    /// ends the step.
    fn accept(
        &mut self,
        state: &mut State,
        grid: &mut Grid,
        record: &mut dyn Record,
        goes_on: bool,
    ) -> Result<(), RunError> {
        let t = self.solver.span().end_time;
        self.trace_segments(state, t, goes_on);
        self.lags = goes_on;
        if grid.due(t).is_some() || self.looks.due(t).is_some() {
            self.write(state, t, grid, record);
        }
        let end = self.solver.span().end;
        if let Some(i) = end.iter().position(|y| !y.is_finite()) {
            return Err(self.model.not_finite(t, i));
        }
        state.y[..end.len()].copy_from_slice(end);
        state.t = t;
        state.counts.steps += 1;
        self.solver.accept();
        self.commit(state)
    }
}
