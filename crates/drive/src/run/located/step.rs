//! Attempt of a step, and processing of an accepted step.
//!
//! The order of operations must not change. The state does not change before a step is accepted. Rows and snapshots are written while the
//! dense output exists. Then the state moves to the end of the step, all slip memories commit, and laws change. A rejected step only
//! shortens the next step and is counted.

use super::aim::Aim;
use super::motion::Pace;
use super::path::Moves;
use super::watch::{Fallen, Watch};
use super::{Located, Motion};
use crate::RunError;
use crate::equations::Equations;
use crate::method::Method;
use crate::record::{Record, wants_events};
use crate::run::horizon::Progress;
use crate::state::{Books, State, Whereabouts, beyond};
use stickslip_stepper::{Attempt, Completion, Grade, Rejection, StepControl, StepHistory, Verdict};

/// End of an accepted step.
#[derive(Clone, Copy, PartialEq)]
enum Ending {
    /// At the target, without event or corner.
    Smooth,
    /// Before the target: at an event or at the end of the run.
    Event,
    /// At a waveform corner.
    Corner,
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Advances to the next event by one closed-form step, or attempts one integration step and processes it if accepted.
    ///
    /// The order is attempt, locate, accept, commit, next law. Fails if the step would be too small, if a value is not finite, if a contact
    /// or block cannot follow its path, or if a limit is reached. The state is then that of the last accepted step.
    pub(super) fn step(&mut self, state: &mut State, record: &mut dyn Record) -> Result<Progress, RunError> {
        let tells_rows = self.output.rows.any() && wants_events(record);
        if tells_rows {
            self.output.rows.look(self.setting.model, state);
        }
        let outcome = match self.detour {
            None => self.step_smoothly(state, record),
            Some(detour) => self.step_whole(state, detour, record),
        };
        // Also after an error, because the step itself may have been taken.
        if tells_rows {
            self.tell_rows(state, record);
        }
        match outcome {
            Ok(progress) => Ok(progress),
            Err(reason) => self.depart(state, reason),
        }
    }

    /// Advances by a closed-form step or an integration step between located events.
    #[inline(always)]
    fn step_smoothly(&mut self, state: &mut State, record: &mut dyn Record) -> Result<Progress, RunError> {
        if let Some(progress) = self.leap(state, record)? {
            return Ok(progress);
        }
        if self.motion.whereabouts == Whereabouts::Behind {
            self.catch_up(state);
        }
        let corner = self.horizon.next();
        let mut aim = self.aim(state, corner);
        // The step is smaller than the rounding of t.
        if aim.target <= state.t {
            return Err(RunError::StepTooSmall { t: state.t, step: state.step });
        }
        let before = self.bookmark();
        let eq = self.setting.equations(state, &self.interval);
        let tried = (&mut self.motion, &mut self.watch, &mut self.control);
        let verdict = attempt(tried, &eq, state, (&mut aim, corner));
        if !verdict.accepted {
            return self.reject(state, (&aim, verdict), record).map(|()| Progress::Made);
        }
        if self.horizon.steps.due(self.motion.solver.span().end_time).is_some() {
            self.take_steps(state);
        }
        if self.motion.solver.span().end_time >= self.horizon.nearly {
            if self.horizon.is_beyond(self.motion.solver.span().end_time) {
                self.turn_back(before);
                return Ok(Progress::Short);
            }
            self.end_here(state);
        }
        let h = aim.target - state.t;
        // The attempted length counts even if an event has cut it, because its error was acceptable.
        self.motion.pace.gait.proven = self.motion.pace.gait.proven.max(h);
        let ending = self.ending(&aim);
        let wished = self.wished(state, ending, (h, verdict.next));
        state.tally.step(self.method(&aim));
        self.accept(state, record, self.moves(ending))?;
        state.step = match ending {
            // The error is predictable only without an event; after events and corners step control is cautious.
            Ending::Smooth => self.motion.pace.nearing(h, aim.singular) * wished,
            Ending::Event | Ending::Corner => self.control.after_event(wished),
        };
        // An input moves on at its corner only if its next piece has been supplied.
        let turns = ending == Ending::Corner && !state.waits_for_input(self.setting.model);
        if turns || !self.watch.fired.is_empty() {
            self.pass_event(state, turns, record)?;
        } else {
            self.go_on(state);
            if self.motion.rest(self.setting.model, state) {
                self.stop(state);
            }
        }
        self.bounds.step(state, record).map(|()| Progress::Made)
    }

    fn ending(&self, aim: &Aim) -> Ending {
        if self.motion.solver.span().end_time < aim.target {
            Ending::Event
        } else if aim.target == self.horizon.corner {
            Ending::Corner
        } else {
            Ending::Smooth
        }
    }

    /// Returns the length of the next step, s, after a step of length `h` for which step control proposes `next`.
    ///
    /// A step shortened by an event or corner ahead does not reduce the next length. A step that an event has cut does not increase it.
    fn wished(&self, state: &State, ending: Ending, (h, next): (f64, f64)) -> f64 {
        match (ending == Ending::Event, h < state.step) {
            // A coasting step says nothing about step lengths under the next law.
            _ if self.motion.solver.coasts() => state.step,
            (true, false) => h.min(next),
            (true, true) => state.step,
            (false, false) => next,
            (false, true) => state.step.max(next),
        }
    }

    /// Returns the integration method of the accepted step, for statistics only.
    fn method(&self, aim: &Aim) -> Method {
        match aim.grade {
            _ if self.interval.is_constant() && self.setting.layout.free > 0 => Method::Parabola,
            Grade::Even => self.setting.method,
            Grade::Few => self.setting.method.in_few_stages().unwrap_or(self.setting.method),
            Grade::Start | Grade::End => Method::Graded,
        }
    }

    /// Processes a rejected step: shortens the next step and updates allowed errors, which rounding limits.
    ///
    /// Fails if the next step would be only a few rounding errors of t.
    #[inline(never)]
    fn reject(
        &mut self,
        state: &mut State,
        (aim, verdict): (&Aim, Verdict),
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        if aim.closes.is_some() {
            // The next attempt is an even step, whose error cannot be compared with that of a graded step.
            let rejected = Some(Rejection { step: aim.target - state.t, log_error: f64::INFINITY });
            self.control.set_history(StepHistory { rejected, ..self.control.history() });
        }
        self.motion.pace.refuse(aim);
        state.counts.rejected += 1;
        // A rejection with few stages says nothing about all stages.
        if aim.grade != Grade::Few {
            state.step = verdict.next;
        }
        // Rounding errors may have grown since the allowed errors were set.
        self.motion.allowance.set(self.setting.model, state);
        if verdict.next > 4.0 * f64::EPSILON * state.t.abs() && verdict.next > f64::MIN_POSITIVE {
            return self.bounds.step(state, record);
        }
        Err(RunError::StepTooSmall { t: state.t, step: verdict.next })
    }

    /// Returns which slip memories commit at the end of the located step.
    ///
    /// All slip memories commit where laws of contacts without an event may change: at corners, at events of blocks, and in models with
    /// quasi-static coordinates or with damping along the normal.
    fn moves(&self, ending: Ending) -> Moves {
        let others = self.watch.fired.iter().any(|fallen| matches!(fallen, Fallen::Block(..)));
        let all = self.presses && !self.watch.fired.is_empty() || !self.setting.model.balanced.is_empty();
        if ending == Ending::Corner || others || all {
            Moves::All
        } else if self.watch.fired.is_empty() {
            Moves::Open
        } else {
            Moves::Fired
        }
    }

    /// Accepts a step: writes the output inside it, moves the state to its end and commits contacts and blocks.
    ///
    /// Contacts with closed-form forces and no event do not commit, which the ledger stores. Fails if a commit is refused, or, before the
    /// state has changed, if a component is not finite.
    fn accept(&mut self, state: &mut State, record: &mut dyn Record, moves: Moves) -> Result<(), RunError> {
        let t = self.motion.solver.span().end_time;
        self.trace_step(state, t, moves);
        self.ledger.booked.books = if moves == Moves::All { Books::Current } else { Books::Behind };
        if self.output.due(t) {
            self.write(state, t, record);
        }
        let end = self.motion.solver.span().end;
        // A value that is not finite must not reach a slip memory.
        if let Some(i) = beyond(end) {
            return Err(self.setting.model.not_finite(t, i));
        }
        // Some integrators carry the input work as their only integral; other components stay.
        state.y[..end.len()].copy_from_slice(end);
        state.t = t;
        state.counts.steps += 1;
        self.motion.solver.accept();
        let scene = (self.setting.model, self.setting.layout);
        self.ledger.commit(scene, t, state)?;
        if self.setting.model.blocks.is_empty() { Ok(()) } else { self.ledger.commit_blocks(scene, state) }
    }

    /// Makes the end of the step the start of the next one.
    ///
    /// Quasi-static coordinates depend on the committed slip memories. Their contacts are computed again, as in a continued run.
    fn go_on(&mut self, state: &State) {
        if self.setting.model.balanced.is_empty() {
            self.watch.go_on();
        } else {
            self.watch.set_out(&self.setting.equations(state, &self.interval), &self.motion.solver);
        }
    }

    /// For a body at rest, sets all velocities to zero, so that rounding errors do not accumulate.
    fn stop(&mut self, state: &mut State) {
        let free = self.setting.layout.free;
        if state.y[free..2 * free].iter().any(|v| *v != 0.0) {
            state.y[free..2 * free].fill(0.0);
            self.restart(state);
        }
    }
}

/// Attempts a step and ends it at the first event inside it.
///
/// Event functions are evaluated only if the error is allowed. All functions that cross zero together with the first belong to one event.
#[inline(always)]
fn attempt<A: for<'e> Attempt<Equations<'e>>>(
    (motion, watch, control): (&mut Motion<A>, &mut Watch, &mut StepControl),
    eq: &Equations<'_>,
    state: &State,
    (aim, corner): (&mut Aim, f64),
) -> Verdict {
    let error = motion.attempt(eq, state.t, aim, corner);
    let target = aim.target;
    let error = motion.with_books(eq, state, target, error);
    let verdict = control.propose(Pace::judged(error, aim.grade), target - state.t);
    if verdict.accepted {
        // Rates of event functions at the end need its slopes. The dense output is computed only where an event is possible.
        motion.solver.complete(eq, Completion::EndSlopes);
        watch.arrive(eq, &motion.solver);
        watch.fired.clear();
        if let Some(fall) = watch.first_fall(&mut motion.solver, eq) {
            let scale = &motion.allowance.allowed.scale;
            watch.end_at((&mut motion.solver, motion.fades.then_some(scale)), eq, fall);
        }
    }
    verdict
}
