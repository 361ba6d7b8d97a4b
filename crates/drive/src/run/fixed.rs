//! Runs with fixed time steps and without event location.
//!
//! Events reduce the order of accuracy to at most two. The number of evaluations of a run is known in advance.

use super::advance::Advance;
use super::chords::Chords;
use super::horizon::{Goal, Progress};
use super::output::Opening;
use crate::equations::Equations;
use crate::record::Record;
use crate::state::{FixedWay, Grid, Layout, State, Underway};
use crate::{Accuracy, Model, Plan, RunError};
use stickslip_stepper::{FixedStep, Stepping};

/// Largest remainder of a time interval that is joined to a step because it results from rounding, as a fraction of the step.
const REMAINDER: f64 = 1e-9;

/// Shortest length to which a branch end cuts a step, as a fraction of a full step. The limit bounds the number of steps.
const LEAST: f64 = 0.125;

/// Length of a frame, s, and its whole number of steps; one step for plain fixed-step methods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    pub(super) length: f64,
    pub(super) steps: f64,
}

impl Frame {
    /// Returns the grid time after `count` steps, s. Frame `k` begins exactly at start + k·length.
    fn moment(self, Grid { start, step, .. }: Grid, count: f64) -> f64 {
        let frame = (count / self.steps).floor();
        start + (frame * self.length + (count - frame * self.steps) * step)
    }
}

/// Components that a method integrates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Moved {
    All,
    /// All components except the damping work, for models without velocity-dependent forces.
    WithoutDamping,
}

/// Run with time steps of constant length.
///
/// Steps end on a time grid, where frame k begins at start + k·length (s). Grid times are products, so rounding does
/// not accumulate. A step that a goal or an input cuts is completed by a second step.
pub(super) struct Fixed<'a, F> {
    chords: Chords<'a>,
    /// Integrator.
    stepper: F,
    name: &'static str,
    grid: Grid,
    frame: Frame,
    /// Components at the end of the current step (`y`). The method integrates the first `moved` of them.
    y: Vec<f64>,
    moved: usize,
    /// Time derivatives saved before a step that may be undone.
    slopes: Vec<f64>,
    /// Number of evaluations already counted in the state.
    counted: u64,
}

impl<F: FixedStep + for<'e> Stepping<Equations<'e>> + Send> Advance for Fixed<'_, F> {
    fn set_out(&mut self, state: &mut State, opening: Opening, record: &mut dyn Record) {
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

    fn go(&mut self, state: &mut State, goal: Goal, record: &mut dyn Record) -> Result<(), RunError> {
        self.chords.aim(goal);
        let mut outcome = self.chords.bounds.tried(state).map(drop);
        while self.goes_on(state) && outcome.is_ok() {
            match self.step(state, record) {
                Ok(Progress::Made) => {}
                Ok(Progress::Short) => break,
                Err(error) => outcome = Err(error),
            }
        }
        // Inputs take up the piece supplied in advance, so that the caller can supply another one.
        let turned = match &outcome {
            Ok(()) => self.chords.turn(state, record),
            Err(_) => Ok(false),
        };
        if turned.unwrap_or_else(|error| {
            outcome = Err(error);
            false
        }) {
            self.stepper.restart();
        }
        self.put_down(state);
        outcome
    }

    fn write_now(&mut self, state: &State, record: &mut dyn Record) {
        self.chords.write_now(state, record);
    }

    fn hand_over(&mut self, record: &mut dyn Record) {
        self.chords.output.marks.hand_over(record);
    }

    fn touched(&self) -> u64 {
        self.chords.touched()
    }

    fn remembers(&self) -> usize {
        self.chords.remembers()
    }

    fn settle_books(&mut self, state: &mut State) {
        self.chords.settle(state);
    }
}

impl<'a, F: FixedStep + for<'e> Stepping<Equations<'e>>> Fixed<'a, F> {
    /// Creates the run. `moved` selects the components that the method integrates.
    ///
    /// Fails if the step reaches the stability limit of the model.
    pub(super) fn new(model: &'a Model, plan: &Plan, frame: Frame, moved: Moved) -> Result<Self, RunError> {
        let step = frame.length / frame.steps;
        if let Accuracy::Step(step) = plan.stepper.accuracy() {
            let limit = model.longest_step(plan.stepper).unwrap_or(f64::INFINITY);
            // Beyond the limit the stiffest oscillation grows at every step.
            if step >= limit {
                return Err(RunError::Unstable { step, limit });
            }
        }
        let chords = Chords::new(model, plan);
        let Layout { free, .. } = chords.layout;
        let (dimension, total) = (chords.layout.dimension(), chords.layout.total());
        let moved = match moved {
            Moved::All => total,
            Moved::WithoutDamping => total - 1,
        };
        let grid = Grid { start: 0.0, step, count: 0.0 };
        Ok(Self {
            stepper: F::sized(free, dimension, moved),
            name: plan.stepper.name(),
            grid,
            frame,
            y: vec![0.0; total],
            moved,
            slopes: Vec::with_capacity(total),
            counted: 0,
            chords,
        })
    }

    /// Returns the rounding error of grid times near t, s. Callers may compute frame times by another product.
    fn slack(&self, t: f64) -> f64 {
        REMAINDER * self.grid.step + 4.0 * f64::EPSILON * t.abs()
    }

    /// Whether the goal is not yet reached. At a waveform corner, a distance within rounding counts as reached.
    fn goes_on(&self, state: &State) -> bool {
        let t = state.t;
        let on_corner = state.pieces.iter().any(|piece| piece.start == t || piece.end == t);
        // The end of a run always has a row.
        let limit = self.chords.horizon.limit();
        let slack = if on_corner && limit < self.chords.horizon.end { self.slack(t) } else { 0.0 };
        t < limit - slack
    }

    /// Takes one step to the next grid time, or to an earlier corner, goal or branch end.
    fn step(&mut self, state: &mut State, record: &mut dyn Record) -> Result<Progress, RunError> {
        let aim = self.frame.moment(self.grid, self.grid.count + 1.0);
        let slack = self.slack(aim);
        if self.chords.horizon.is_beyond(aim) {
            return Ok(Progress::Short);
        }
        if self.chords.turn(state, record)? {
            // The stored slopes belong to the other side of the corner.
            self.stepper.restart();
        }
        let corner = state.next_corner();
        let until = self.chords.horizon.until;
        // A frame that ends at a corner ends there to the last bit.
        let stop = if (until - corner).abs() <= slack { corner } else { until.min(corner) };
        let mut end = if aim > stop - slack { stop } else { aim };
        self.y.copy_from_slice(&state.y);
        let (before, is_due) = (self.chords.horizon.steps, self.chords.horizon.steps.due(end).is_some());
        let mut spent = self.stepper.evaluations();
        if is_due {
            self.slopes.clear();
            self.slopes.extend_from_slice(self.stepper.kept().unwrap_or_default());
        }
        self.chords.prepare(state);
        self.attempt(state, end);
        if !is_due && self.chords.glides(state, (end, &self.y), record) {
            self.grid.count += if end >= aim - slack { 1.0 } else { 0.0 };
            return self.chords.bounds.step(state, record).map(|()| Progress::Made);
        }
        end = self.cut(state, end);
        if self.chords.leaves(state, (end, &self.y)) {
            // A step that is undone below is taken again from here.
            spent = self.stepper.evaluations();
            self.slopes.clear();
            self.chords.prepare(state);
            self.repeat(state, end);
        }
        if is_due {
            let goal = self.chords.horizon.end;
            self.chords.take_steps(state, end, &self.y);
            if self.chords.horizon.is_beyond(end) {
                // This step ends the run. It is undone here and taken again by the call that finishes the run.
                self.stepper.keep(&self.slopes);
                self.counted += self.stepper.evaluations() - spent;
                self.chords.horizon.steps = before;
                self.chords.end_at(goal);
                return Ok(Progress::Short);
            }
        }
        let whole = if end >= aim - slack { 1.0 } else { 0.0 };
        self.grid.count += whole;
        self.y[self.chords.layout.damping()] += self.chords.damping_work(state, (end, &self.y));
        if self.chords.accept(state, (end, &self.y), record)? {
            // The run ended inside this step; the next step is the rest of it.
            self.stepper.restart();
            self.grid.count -= whole;
        }
        Ok(Progress::Made)
    }

    /// Repeats the step to `end` so that it stops at the first branch end. Returns the new end, s.
    ///
    /// The step is cut to no less than [`LEAST`] of a full step.
    fn cut(&mut self, state: &State, end: f64) -> f64 {
        self.chords.let_end_decide();
        let Some(first) = self.chords.first_end(state, (end, &self.y)) else { return end };
        // A branch that is used up at the start of the step ends after the shortest step.
        let cut = first.max(state.t + LEAST * self.whole(state));
        if cut > first || cut >= end {
            self.chords.let_end_decide();
        }
        if cut >= end {
            return end;
        }
        self.repeat(state, cut);
        cut
    }

    /// Takes the step from the current state again, to `end`, s.
    fn repeat(&mut self, state: &State, end: f64) {
        self.y.copy_from_slice(&state.y);
        self.stepper.restart();
        self.attempt(state, end);
    }

    /// Returns the length of an uncut step, s: the grid step, or the shortest current waveform piece.
    fn whole(&self, state: &State) -> f64 {
        let pieces = state.pieces.iter().map(|piece| piece.end - piece.start).filter(|length| *length > 0.0);
        pieces.fold(self.grid.step, f64::min)
    }

    /// Takes the step from the current state to `end`, s.
    fn attempt(&mut self, state: &State, end: f64) {
        let y = &mut self.y[..self.moved];
        self.stepper.step(&self.chords.equations(state), state.t, y, end - state.t);
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
