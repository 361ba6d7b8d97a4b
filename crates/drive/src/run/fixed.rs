//! Fixed steps, without events.
//!
//! A step is never chosen: an error that events make is the stepper's own, of second order at best. The work of a run is known
//! beforehand.

use super::chords::Chords;
use super::horizon::{Goal, Progress};
use super::output::Opening;
use crate::record::Record;
use crate::state::{FixedWay, Grid, Layout, State, Underway};
use crate::{Model, Plan, RunError};
use stickslip_stepper::FixedStep;

/// What is left of a step and below round-off belongs to it: this part of a step.
const REMAINDER: f64 = 1e-9;

/// A run in steps of one length.
///
/// Steps end at start + k·step (s), multiplied and not summed up; one that an advance or an input's piece cuts is followed by
/// its rest.
pub(super) struct Fixed<'a, F> {
    chords: Chords<'a>,
    /// Made once the state is there.
    stepper: F,
    name: &'static str,
    grid: Grid,
    /// Components at the end of the step under way.
    y: Vec<f64>,
    /// Slopes kept at the start of a step that may be taken back.
    slopes: Vec<f64>,
    /// Evaluations counted so far.
    counted: u64,
}

impl<'a, F: FixedStep> Fixed<'a, F> {
    /// Fails where `step` is as long as the longest with which small motions do not grow.
    pub(super) fn new(model: &'a Model, plan: &Plan, step: f64) -> Result<Self, RunError> {
        let limit = model.longest_step(plan.stepper).unwrap_or(f64::INFINITY);
        // Beyond it the stiffest motion grows at every step: refused instead of exploding.
        if step >= limit {
            return Err(RunError::Unstable { step, limit });
        }
        let chords = Chords::new(model, plan);
        let Layout { free, .. } = chords.layout;
        let (dimension, total) = (chords.layout.dimension(), chords.layout.total());
        let grid = Grid { start: 0.0, step, count: 0.0 };
        Ok(Self {
            stepper: F::sized(free, dimension, total),
            name: plan.stepper.name(),
            grid,
            y: vec![0.0; total],
            slopes: Vec::with_capacity(total),
            counted: 0,
            chords,
        })
    }

    /// Takes up a state: begins a run there, or goes on with one.
    pub(super) fn set_out(&mut self, state: &mut State, opening: Opening, record: &mut dyn Record) {
        match &state.underway {
            Some(Underway::Fixed(way)) if way.stepper == self.name && way.grid.step == self.grid.step => {
                self.grid = way.grid;
                self.stepper.keep(&way.slopes);
            }
            _ => {
                self.grid.start = state.t;
                state.underway = None;
            }
        }
        self.chords.set_out(state, opening, record);
    }

    /// Goes as far as a goal says, and puts down in the state what its future depends on.
    ///
    /// Fails as [`Chords::accept`] does.
    pub(super) fn go(
        &mut self,
        state: &mut State,
        goal: Goal,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        self.chords.aim(goal);
        let mut outcome = self.chords.bounds.tried(state).map(drop);
        while self.chords.goes_on(state) && outcome.is_ok() {
            match self.step(state, record) {
                Ok(Progress::Made) => {}
                Ok(Progress::Short) => break,
                Err(error) => outcome = Err(error),
            }
        }
        // What the caller has supplied ahead begins here: there is room for the piece after it.
        if state.take_supplied() {
            self.stepper.restart();
        }
        self.put_down(state);
        outcome
    }

    /// Writes the row of where the run stopped.
    pub(super) fn write_now(&mut self, state: &State, record: &mut dyn Record) {
        self.chords.write_now(state, record);
    }

    /// Tells the range of a watched body so far.
    pub(super) fn hand_over(&mut self, record: &mut dyn Record) {
        self.chords.output.marks.hand_over(record);
    }

    /// Memories are where the state is after every step.
    pub(super) fn settle_books(&mut self, _: &mut State) {}

    /// One step, up to the next moment of the grid or to where the run is cut before it.
    fn step(&mut self, state: &mut State, record: &mut dyn Record) -> Result<Progress, RunError> {
        let aim = self.grid.start + (self.grid.count + 1.0) * self.grid.step;
        if self.chords.horizon.is_beyond(aim) {
            return Ok(Progress::Short);
        }
        let stop = self.chords.horizon.until.min(state.next_input(self.chords.model));
        let end = if aim > stop - REMAINDER * self.grid.step { stop } else { aim };
        if self.chords.enter(state, end) {
            // Slopes kept from the step before belong to the other side of the corner.
            self.stepper.restart();
        }
        self.y.copy_from_slice(&state.y);
        let (before, is_due) = (self.chords.horizon.steps, self.chords.horizon.steps.due(end).is_some());
        let spent = self.stepper.evaluations();
        if is_due {
            self.slopes.clear();
            self.slopes.extend_from_slice(self.stepper.kept().unwrap_or_default());
        }
        self.stepper.step(&self.chords.equations(state), state.t, &mut self.y, end - state.t);
        if is_due {
            let goal = self.chords.horizon.end;
            self.chords.take_steps(state, end, &self.y);
            if self.chords.horizon.is_beyond(end) {
                // The steps of the drive are constant with this one: it will be taken by who wants the end.
                self.stepper.keep(&self.slopes);
                self.counted += self.stepper.evaluations() - spent;
                self.chords.horizon.steps = before;
                self.chords.end_at(goal);
                return Ok(Progress::Short);
            }
        }
        if end >= aim - REMAINDER * self.grid.step {
            self.grid.count += 1.0;
        }
        if self.chords.accept(state, (end, &self.y), record)? {
            // The next step begins elsewhere, and is the rest of this one.
            self.stepper.restart();
            self.grid.count -= 1.0;
        }
        Ok(Progress::Made)
    }

    fn put_down(&mut self, state: &mut State) {
        let evaluations = self.stepper.evaluations();
        state.counts.evaluations += evaluations - self.counted;
        self.counted = evaluations;
        let mut way = match state.underway.take() {
            Some(Underway::Fixed(way)) => way,
            _ => Box::new(FixedWay::BLANK),
        };
        (way.stepper, way.grid) = (self.name, self.grid);
        way.slopes.clear();
        way.slopes.reserve(self.y.len());
        way.slopes.extend_from_slice(self.stepper.kept().unwrap_or_default());
        self.chords.put_down(&mut way);
        state.underway = Some(Underway::Fixed(way));
    }
}
