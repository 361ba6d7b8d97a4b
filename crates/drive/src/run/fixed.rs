//! Fixed steps, without events.
//!
//! A step is never chosen: an error that events make is the stepper's own, of second order at best. The work of a run is known
//! beforehand.

use super::chords::{Chords, Weakening};
use super::horizon::{Goal, Progress};
use super::output::Opening;
use crate::equations::Equations;
use crate::record::Record;
use crate::state::{FixedWay, Grid, Layout, State, Underway};
use crate::{Model, Plan, RunError};
use stickslip_stepper::{FixedStep, Stepping};

/// What is left of a step and below round-off belongs to it: this part of a step.
const REMAINDER: f64 = 1e-9;

/// The least part of a step to which one is cut where a contact's branch ends: what bounds the work.
const LEAST: f64 = 0.125;
/// The same where its damping weakens.
const BRIEF: f64 = 1e-6;
/// How often a step is taken anew to where the damping of a contact weakens.
const CORRECTIONS: u32 = 2;
/// Lengths of a step within which the damping of a contact must give way for its stages to lie for that: of a root that lies farther a plain
/// one misses a millionth.
const NEAR: f64 = 4.0;

/// A length of time, s, and the whole number of steps that it takes: of plain fixed steps one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    pub(super) length: f64,
    pub(super) steps: f64,
}

impl Frame {
    /// Moment `count` of a grid, s. Frames begin where whoever asks for them puts them, to the last bit.
    fn moment(self, Grid { start, step, .. }: Grid, count: f64) -> f64 {
        let frame = (count / self.steps).floor();
        start + (frame * self.length + (count - frame * self.steps) * step)
    }
}

/// Which components a method moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Moved {
    All,
    /// Nothing takes energy by its rate.
    WithoutDamping,
}

/// A run in steps of one length.
///
/// Steps end on a grid, multiplied and not summed up: frame k of n steps begins at start + k·length (s). One that an advance
/// or an input's piece cuts is followed by its rest.
pub(super) struct Fixed<'a, F> {
    chords: Chords<'a>,
    /// Made once the state is there.
    stepper: F,
    name: &'static str,
    grid: Grid,
    frame: Frame,
    /// Components at the end of the step under way, and how many of them, from the first on, the method moves.
    y: Vec<f64>,
    moved: usize,
    /// Slopes kept at the start of a step that may be taken back.
    slopes: Vec<f64>,
    /// Evaluations counted so far.
    counted: u64,
}

impl<'a, F: FixedStep + for<'e> Stepping<Equations<'e>>> Fixed<'a, F> {
    /// Fails where a step is as long as the longest with which small motions do not grow.
    ///
    /// `moved` is how many components, from the first on, the method moves: none dissipates beyond those.
    pub(super) fn new(model: &'a Model, plan: &Plan, frame: Frame, moved: Moved) -> Result<Self, RunError> {
        let step = frame.length / frame.steps;
        let limit = model.longest_step(plan.stepper).unwrap_or(f64::INFINITY);
        // Beyond it the stiffest motion grows at every step: refused instead of exploding.
        if step >= limit {
            return Err(RunError::Unstable { step, limit });
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
        while self.goes_on(state) && outcome.is_ok() {
            match self.step(state, record) {
                Ok(Progress::Made) => {}
                Ok(Progress::Short) => break,
                Err(error) => outcome = Err(error),
            }
        }
        // What the caller has supplied ahead begins here: there is room for the piece after it.
        let turned = match &outcome {
            _ if self.chords.crossing => Ok(state.take_supplied()),
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

    /// Writes the row of where the run stopped.
    pub(super) fn write_now(&mut self, state: &State, record: &mut dyn Record) {
        self.chords.write_now(state, record);
    }

    /// Tells the range of a watched body so far.
    pub(super) fn hand_over(&mut self, record: &mut dyn Record) {
        self.chords.output.marks.hand_over(record);
    }

    /// Turning points of contacts made or given up.
    pub(super) fn touched(&self) -> u64 {
        self.chords.touched()
    }

    /// How many turning points a contact remembers.
    pub(super) fn remembers(&self) -> usize {
        self.chords.remembers()
    }

    /// Memories are where the state is after every step, but those of contacts that keep to a branch.
    pub(super) fn settle_books(&mut self, state: &mut State) {
        self.chords.settle(state);
    }

    /// Rounding of moments at about a time, s: frames are multiplied by others, and may come out a digit longer.
    fn slack(&self, t: f64) -> f64 {
        REMAINDER * self.grid.step + 4.0 * f64::EPSILON * t.abs()
    }

    /// Whether the run is not yet where it was to go; where it stands on a corner, by more than rounding.
    fn goes_on(&self, state: &State) -> bool {
        let t = state.t;
        let on_corner =
            !self.chords.crossing && state.pieces.iter().any(|piece| piece.start == t || piece.end == t);
        // The end of a run has its row, however near to a corner.
        let limit = self.chords.horizon.limit();
        let slack = if on_corner && limit < self.chords.horizon.end { self.slack(t) } else { 0.0 };
        t < limit - slack
    }

    /// One step, up to the next moment of the grid or to where the run is cut before it.
    fn step(&mut self, state: &mut State, record: &mut dyn Record) -> Result<Progress, RunError> {
        let aim = self.frame.moment(self.grid, self.grid.count + 1.0);
        let slack = self.slack(aim);
        if self.chords.horizon.is_beyond(aim) {
            return Ok(Progress::Short);
        }
        let crossing = self.chords.crossing;
        let mut turned = !crossing && self.chords.turn(state, record)?;
        let corner = if crossing { state.next_input(self.chords.model) } else { state.next_corner() };
        let until = self.chords.horizon.until;
        // A corner where a frame ends is that corner, to the last bit, whether a frame ends there or not.
        let stop = if (until - corner).abs() <= slack { corner } else { until.min(corner) };
        let mut end = if aim > stop - slack { stop } else { aim };
        end = end.min(state.t + self.chords.longest(state));
        if crossing {
            turned = self.chords.enter(state, end);
        }
        if turned {
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
        self.chords.prepare(state);
        self.attempt(state, end);
        let is_plain = !is_due && self.root_ahead(state, end).is_none();
        if is_plain && self.chords.glides(state, (end, &self.y), record) {
            self.grid.count += if end >= aim - slack { 1.0 } else { 0.0 };
            return self.chords.bounds.step(state, record).map(|()| Progress::Made);
        }
        end = self.cut(state, end);
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
        let whole = if end >= aim - slack { 1.0 } else { 0.0 };
        self.grid.count += whole;
        if self.chords.accept(state, (end, &self.y), record)? {
            // The next step begins elsewhere, and is the rest of this one.
            self.stepper.restart();
            self.grid.count -= whole;
        }
        Ok(Progress::Made)
    }

    /// Takes a step to `end` anew, to where the first branch of a contact ends in it, but to no less than an eighth of a whole
    /// one, unless the damping of a contact weakens there; gives the end, s.
    fn cut(&mut self, state: &State, mut end: f64) -> f64 {
        self.chords.let_end_decide();
        let mut is_rooted = false;
        for _ in 0..CORRECTIONS {
            let Some(first) = self.chords.first_end(state, (end, &self.y)) else { break };
            let weakens = self.chords.weakens(state);
            let least = if weakens.is_some() { BRIEF } else { LEAST };
            // What is used up before the step begins ends as soon as time goes on.
            let cut = first.max(state.t + least * self.whole(state));
            let first = if weakens.is_some() { cut } else { first };
            if cut > first || cut >= end {
                self.chords.let_end_decide();
            }
            if cut >= end {
                return end;
            }
            end = cut;
            is_rooted = weakens == Some(Weakening::Away);
            self.again(state, end, is_rooted.then_some(end));
            if weakens.is_none() {
                return end;
            }
        }
        if !is_rooted && let Some(root) = self.root_ahead(state, end) {
            self.again(state, end, Some(root));
        }
        end
    }

    /// Length that a step has which nothing cuts, s: from corner to corner where these are nearer to each other than steps.
    fn whole(&self, state: &State) -> f64 {
        let pieces = state.pieces.iter().map(|piece| piece.end - piece.start).filter(|length| *length > 0.0);
        pieces.fold(self.grid.step, f64::min)
    }

    /// Where the damping of a contact gives way so soon after a step to `end` that its stages are to lie for that, s.
    fn root_ahead(&mut self, state: &State, end: f64) -> Option<f64> {
        let root = self.chords.gives_way_after(state, (end, &self.y))?;
        (root - state.t < NEAR * (end - state.t)).then_some(root)
    }

    /// Takes a step to `end` anew; where the damping of a contact gives way at a `root`, s, with its stages for that.
    fn again(&mut self, state: &State, end: f64, root: Option<f64>) {
        self.y.copy_from_slice(&state.y);
        self.stepper.restart();
        let Some(root) = root else { return self.attempt(state, end) };
        let y = &mut self.y[..self.moved];
        let way = (end - state.t, (root - end).max(0.0));
        self.stepper.step_to_a_root(&self.chords.equations(state), state.t, y, way);
    }

    /// The step from where the state is to `end`, s.
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
