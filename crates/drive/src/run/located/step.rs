//! One attempt, and what belongs to an accepted step.
//!
//! The order is the invariant: nothing of the state moves before a step is accepted, rows and looks are
//! written of the step while its dense output is there, then the state moves to its end, then all memories
//! together, then laws. A step that is refused leaves a shorter wish and one more count.

use super::aim::Aim;
use super::motion::Pace;
use super::path::Moves;
use super::watch::{Fallen, Watch};
use super::{Located, Motion};
use crate::RunError;
use crate::equations::Equations;
use crate::method::Method;
use crate::record::Record;
use crate::run::horizon::Progress;
use crate::state::{Books, State, Whereabouts, beyond};
use stickslip_stepper::{Attempt, Completion, Grade, Rejection, StepControl, StepHistory, Verdict};

/// How a step ends.
#[derive(Clone, Copy, PartialEq)]
enum Ending {
    /// Where it was aimed at, and neither of the others.
    Smooth,
    /// Where a guard fell or a period ended, before its target.
    Event,
    /// Where a waveform turns.
    Corner,
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// A leap to the next event or, where that is not possible, one attempt and, if it succeeds, everything that belongs to
    /// an accepted step: attempt → locate → accept → commit → next law.
    ///
    /// Fails where the step would be too small, a value is not finite, a contact or block refuses its path,
    /// or a limit is reached. The state is then that of the last step accepted.
    pub(super) fn step(&mut self, state: &mut State, record: &mut dyn Record) -> Result<Progress, RunError> {
        let tells_rows = self.output.rows.any() && record.wants_events();
        if tells_rows {
            self.output.rows.look(self.setting.model, state);
        }
        let outcome = match self.detour {
            None => self.step_smoothly(state, record),
            Some(detour) => self.step_whole(state, detour, record),
        };
        // A step that a limit ends is made.
        if tells_rows {
            self.tell_rows(state, record);
        }
        match outcome {
            Ok(progress) => Ok(progress),
            Err(reason) => self.depart(state, reason),
        }
    }

    /// The same between located events.
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
        // Rounding of t has swallowed the step.
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
        // The length that was judged, even if an event cuts it: it is what the law bore.
        self.motion.pace.gait.proven = self.motion.pace.gait.proven.max(h);
        let ending = self.ending(&aim);
        let wished = self.wished(state, ending, (h, verdict.next));
        state.tally.step(self.method(&aim));
        self.accept(state, record, self.moves(ending))?;
        state.step = match ending {
            // Only what goes on smoothly knows how its error falls; after a corner or an event control begins
            // with caution.
            Ending::Smooth => self.motion.pace.nearing(h, aim.singular) * wished,
            Ending::Event | Ending::Corner => self.control.after_event(wished),
        };
        // What turns with an input turns when its caller has said where to.
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

    /// The step that comes to be wished for after one of length `h`, its control having proposed another, s.
    ///
    /// A step that was shorter than control had wished for, because of an event or a corner ahead, takes
    /// nothing from that wish; one that an event cut adds nothing to it.
    fn wished(&self, state: &State, ending: Ending, (h, next): (f64, f64)) -> f64 {
        match (ending == Ending::Event, h < state.step) {
            // The next law has not earned a longer step yet.
            _ if self.motion.solver.coasts() => state.step,
            (true, false) => h.min(next),
            (true, true) => state.step,
            (false, false) => next,
            (false, true) => state.step.max(next),
        }
    }

    /// The method of the step just made.
    /// For the tally alone: nothing is decided by it.
    fn method(&self, aim: &Aim) -> Method {
        match aim.grade {
            _ if self.interval.is_constant() && self.setting.layout.free > 0 => Method::Parabola,
            Grade::Even => self.setting.method,
            Grade::Few => self.setting.method.in_few_stages().unwrap_or(self.setting.method),
            Grade::Start | Grade::End => Method::Graded,
        }
    }

    /// Takes back nothing, since nothing was done: shortens the wish, renews what rounding is allowed, and
    /// fails where the wish falls to a few last places of t.
    #[inline(never)]
    fn reject(
        &mut self,
        state: &mut State,
        (aim, verdict): (&Aim, Verdict),
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        if aim.closes.is_some() {
            // The next attempt is an even one: nothing follows from both errors together.
            let rejected = Some(Rejection { step: aim.target - state.t, log_error: f64::INFINITY });
            self.control.set_history(StepHistory { rejected, ..self.control.history() });
        }
        self.motion.pace.refuse(aim);
        state.counts.rejected += 1;
        // That few stages do not do says nothing about all of them.
        if aim.grade != Grade::Few {
            state.step = verdict.next;
        }
        // Perhaps rounding has grown above what was allowed for it.
        self.motion.allowance.set(self.setting.model, state);
        if verdict.next > 4.0 * f64::EPSILON * state.t.abs() && verdict.next > f64::MIN_POSITIVE {
            return self.bounds.step(state, record);
        }
        Err(RunError::StepTooSmall { t: state.t, step: verdict.next })
    }

    /// Whose memories move at the end of the step just located.
    ///
    /// All where laws of contacts may change whose own guards have not fallen: at corners, at events of blocks, whose signals
    /// may be what bodies follow, and where places without mass are solved for from them.
    fn moves(&self, ending: Ending) -> Moves {
        let others = self.watch.fired.iter().any(|fallen| matches!(fallen, Fallen::Block(..)));
        if ending == Ending::Corner || others || !self.setting.model.balanced.is_empty() {
            Moves::All
        } else if self.watch.fired.is_empty() {
            Moves::Open
        } else {
            Moves::Fired
        }
    }

    /// Rows and looks inside the step, then the commit of all contacts that move, then time moves on.
    ///
    /// Memories of other contacts of closed form stay where they are, and the ledger says
    /// so. Fails where a component is not finite, before anything of the state has moved, or where a commit
    /// is refused.
    fn accept(&mut self, state: &mut State, record: &mut dyn Record, moves: Moves) -> Result<(), RunError> {
        let t = self.motion.solver.span().end_time;
        self.trace_step(state, t, moves);
        self.ledger.booked.books = if moves == Moves::All { Books::Current } else { Books::Behind };
        if self.output.due(t) {
            self.write(state, t, record);
        }
        let end = self.motion.solver.span().end;
        // Checked on the whole of the end: a value that is not finite must not reach a memory.
        if let Some(i) = beyond(end) {
            return Err(self.setting.model.not_finite(t, i));
        }
        // Some solvers carry the work put in as their only integral; the rest of y is not theirs.
        state.y[..end.len()].copy_from_slice(end);
        state.t = t;
        state.counts.steps += 1;
        self.motion.solver.accept();
        let scene = (self.setting.model, self.setting.layout);
        self.ledger.commit(scene, t, state)?;
        if self.setting.model.blocks.is_empty() { Ok(()) } else { self.ledger.commit_blocks(scene, state) }
    }

    /// The end of a step is the start of the next one.
    ///
    /// Places without mass are solved for from where the memories are, which have moved: they are looked at anew, as a run that is
    /// taken up here does.
    fn go_on(&mut self, state: &State) {
        if self.setting.model.balanced.is_empty() {
            self.watch.go_on();
        } else {
            self.watch.set_out(&self.setting.equations(state, &self.interval), &self.motion.solver);
        }
    }

    /// Takes away what rounding has left of the velocities: it would add up over a long rest.
    ///
    /// A slider under 0.9 μF_N that starts in equilibrium stays within a few last places of u_c for ever;
    /// without this its velocities would ring on in their last bit.
    fn stop(&mut self, state: &mut State) {
        let free = self.setting.layout.free;
        if state.y[free..2 * free].iter().any(|v| *v != 0.0) {
            state.y[free..2 * free].fill(0.0);
            self.restart(state);
        }
    }
}

/// Tries a step and, if its error allows, looks for the first event in it and ends it there.
///
/// The guards are looked at only where the error allows the step. All that fall together with the first are
/// collected: one moment, one choice.
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
        // Rates of guards at the end need its slopes; the dense output is asked for only where a guard may
        // have fallen.
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
