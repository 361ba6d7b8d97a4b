//! The event-aware run: smooth laws between located events.
//!
//! Each contact follows the law decreed at its last event, which goes on smoothly beyond the event that will end
//! it. A step is attempted on these laws; if a guard falls below zero inside it, the moment is found on the dense
//! output and the step ends there, in the state that the dense output has. Then memory is committed, all contacts together, and those whose
//! guard fell get their next law by decree. Corners of waveforms end steps exactly.

mod locate;
mod path;
mod rest;
mod switch;
mod write;

use super::output::{Grid, Looks};
use super::watch::Watch;
use crate::equations::Equations;
use crate::event::EventKind;
use crate::guard::Guard;
use crate::model::{Model, Motion};
use crate::record::Record;
use crate::state::{Layout, Mode, State};
use crate::{Plan, RunError, Waveform};
use path::MOST_PIECES;
use stickslip_contact::{Engine, Segment};
use stickslip_stepper::{Attempt, DOP853_ORDER, Dop853, NYSTROM_ORDER, Nystrom, StepControl, StepLimits};

/// Scratch of one run; all that its future depends on is in the [`State`].
pub(super) struct Run<'a, A> {
    model: &'a Model,
    end: f64,
    every: Option<f64>,
    tolerance: f64,
    layout: Layout,
    solver: A,
    scale: Vec<f64>,
    watch: Watch,
    /// Longest step, s: a fraction of the period of the fastest smooth waveform.
    longest: f64,
    /// Largest rate of the motions with all contacts stuck, 1/s.
    fastest: f64,
    /// Whether any waveform jumps.
    jumpy: bool,
    /// Motions of the contacts at the end of the step.
    motions: Vec<Motion>,
    /// What the contacts commit at the end of the step.
    segments: Vec<(usize, Segment)>,
    /// Guards that fell at the end of the step.
    fired: Vec<(usize, Guard)>,
    /// Modes before the corner at the end of the step.
    old: Vec<Mode>,
    /// Waveforms that turned a corner at the end of the step.
    turned: Vec<(usize, EventKind)>,
    row: Vec<f64>,
    looks: Looks,
    /// Evaluations made for rows and looks only.
    for_output: u64,
}

/// Runs by the method that the model allows: where no force hangs on a velocity, one that spares a third of the
/// evaluations.
pub(super) fn run(
    model: &Model,
    plan: &Plan,
    tolerance: f64,
    state: &mut State,
    record: &mut dyn Record,
) -> Result<(), RunError> {
    let layout = model.layout();
    if model.is_conservative() {
        let quadratures = layout.total() - layout.dimension();
        let solver = Nystrom::new(layout.free, quadratures);
        return Run::new(model, plan, tolerance, solver).go(NYSTROM_ORDER, state, record);
    }
    let solver = Dop853::new(layout.dimension(), layout.total());
    Run::new(model, plan, tolerance, solver).go(DOP853_ORDER, state, record)
}

/// Part by which a step aims beyond the expected end of a piece of memory, so that the end lies inside.
const OVERSTEP: f64 = 1.05;

/// Steps of a row under a varying load in a period of the load, at least.
const CHORDS_PER_PERIOD: f64 = 4096.0;

/// How a step ends.
#[derive(Clone, Copy, PartialEq)]
enum Ending {
    Smooth,
    Event,
    Corner,
}

impl<'a, A: for<'e> Attempt<Equations<'e>>> Run<'a, A> {
    fn new(model: &'a Model, plan: &Plan, tolerance: f64, solver: A) -> Self {
        let layout = model.layout();
        Self {
            model,
            end: plan.duration,
            every: plan.every,
            tolerance,
            layout,
            fastest: model.fastest(),
            solver,
            // The integrals of work steer the steps as well: energy books close at the tolerance.
            scale: vec![0.0; layout.total()],
            watch: Watch::new(model, plan.limits),
            longest: longest(model, plan),
            jumpy: model.waveforms.iter().any(Waveform::has_jumps),
            motions: Vec::with_capacity(model.contacts.len()),
            segments: Vec::with_capacity(model.contacts.len() + MOST_PIECES as usize),
            fired: Vec::with_capacity(model.contacts.len()),
            old: Vec::with_capacity(model.contacts.len()),
            turned: Vec::with_capacity(model.waveforms.len()),
            row: Vec::new(),
            looks: Looks::NONE,
            for_output: 0,
        }
    }

    fn go(mut self, order: u32, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
        state.carry_over(self.model, self.layout);
        let mut grid = Grid::new(self.every, state.t, self.end);
        let limits = StepLimits { longest: self.longest, ..StepLimits::default() };
        let mut control = state.control.clone().unwrap_or_else(|| StepControl::new(order, limits));
        self.begin(state);
        grid.write_now(&equations(self.model, self.layout, state), state, record);
        self.looks = Looks::begin(state, record);
        let mut outcome = Ok(());
        while state.t < self.end && outcome.is_ok() {
            outcome = self.step(state, &mut control, &mut grid, record);
        }
        state.control = Some(control);
        state.counts.evaluations += self.solver.evaluations() - self.for_output;
        grid.write_now(&equations(self.model, self.layout, state), state, record);
        outcome
    }

    /// Decrees the first laws and proposes a first step, unless the state goes on from an earlier run.
    fn begin(&mut self, state: &mut State) {
        self.solver.start(&equations(self.model, self.layout, state), state.t, &state.y);
        if state.step > 0.0 {
            return;
        }
        for c in 0..self.model.contacts.len() {
            self.decide(state, c);
        }
        self.set_scale(state);
        let eq = equations(self.model, self.layout, state);
        self.solver.start(&eq, state.t, &state.y);
        let natural = self.model.contacts.iter().map(|c| std::f64::consts::TAU / c.natural.frequency);
        let longest = natural.fold(self.longest, f64::min);
        let longest = if longest.is_finite() { longest } else { self.end };
        state.step = if self.layout.dimension() == 0 {
            longest
        } else {
            self.solver.first_step(&eq, longest, &self.scale)
        };
    }

    /// One attempt and, if it succeeds, everything that belongs to an accepted step.
    fn step(
        &mut self,
        state: &mut State,
        control: &mut StepControl,
        grid: &mut Grid,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        self.set_scale(state);
        let corner = state.pieces.iter().map(|p| p.end).fold(self.end, f64::min);
        let eq = equations(self.model, self.layout, state);
        let longest = self.longest_now(state);
        let target = aim(state.t, state.step.min(longest).min(self.expected(&eq, state)), corner);
        let h = target - state.t;
        if h <= 0.0 {
            return Err(RunError::StepTooSmall { t: state.t, step: state.step });
        }
        let error = self.solver.attempt_until(&eq, target, &self.scale);
        let verdict = control.propose(error, h);
        if !verdict.accepted {
            return self.reject(state, verdict.next, record);
        }
        self.solver.end_slopes(&eq);
        let mut wished = if h < state.step { state.step.max(verdict.next) } else { verdict.next };
        let mut ending = if target == corner { Ending::Corner } else { Ending::Smooth };
        self.fired.clear();
        if let Some(fall) = self.first_fall(&eq, state) {
            if fall.t < target {
                self.solver.cut(fall.t);
                ending = Ending::Event;
                // The next law has not earned a longer step yet.
                wished = if h < state.step { state.step } else { h.min(verdict.next) };
            }
            self.collect_fallen(&eq, state, fall);
        }
        self.accept(state, grid, record)?;
        state.step = if ending == Ending::Smooth { wished } else { control.after_event(wished) };
        if ending == Ending::Corner {
            self.turn_corners(state, record);
        }
        if ending == Ending::Corner || !self.fired.is_empty() {
            self.handle_fallen(state, ending == Ending::Corner, record)?;
            self.restart(state);
        } else if self.rests(state) {
            self.stop(state);
        }
        self.watch.step(state, record)
    }

    fn reject(&mut self, state: &mut State, next: f64, record: &mut dyn Record) -> Result<(), RunError> {
        state.counts.rejected += 1;
        state.step = next;
        if next > 4.0 * f64::EPSILON * state.t.abs() && next > f64::MIN_POSITIVE {
            return self.watch.step(state, record);
        }
        Err(RunError::StepTooSmall { t: state.t, step: next })
    }

    /// Rows and looks inside the step, then the commit of all contacts, then time moves on.
    fn accept(
        &mut self,
        state: &mut State,
        grid: &mut Grid,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let t = self.solver.end_time();
        self.trace_segments(state, t);
        if grid.due(t).is_some() || self.looks.due(t).is_some() {
            self.write(state, t, grid, record);
        }
        let end = self.solver.end();
        if let Some(i) = end.iter().position(|y| !y.is_finite()) {
            return Err(self.model.not_finite(t, i));
        }
        state.y.copy_from_slice(end);
        state.t = t;
        state.counts.steps += 1;
        self.solver.accept();
        self.commit(state)
    }

    /// About when the first piece of memory will be used up, s from now: a step much longer would only be thrown away.
    fn expected(&self, eq: &Equations<'_>, state: &State) -> f64 {
        let mut first = f64::INFINITY;
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let mode = &state.modes[c];
            if let Mode::Slip(branch) = mode {
                let motion = eq.motion(contact, state.t, |i| state.y[i]);
                let speed = Guard::Drag.value(contact, state.law(c), &motion);
                let second = self.accelerations(eq, contact, false);
                let (left, pull) =
                    (branch.margin(motion.d, motion.u), Guard::Drag.rate(contact, mode, &motion, second));
                // left = speed t + pull t²/2; a slowing edge may never get there.
                let reaches = speed * speed + 2.0 * pull * left;
                if speed > 0.0 && reaches > 0.0 && left > 0.0 {
                    first = first.min(2.0 * left / (speed + reaches.sqrt()));
                }
            }
        }
        OVERSTEP * first + 16.0 * f64::EPSILON * state.t
    }

    /// Tells the solver that the laws, and perhaps the forces of growing contacts, have changed.
    fn restart(&mut self, state: &State) {
        self.solver.begin_mut().copy_from_slice(&state.y);
        self.solver.restart_slopes(&equations(self.model, self.layout, state));
    }

    /// Absolute error allowed per component: the tolerance times the natural scale, and never below what rounding
    /// of a far-travelled coordinate makes of the force.
    fn set_scale(&mut self, state: &State) {
        let layout = self.layout;
        for (i, free) in self.model.free.iter().enumerate() {
            let (length, speed) = free.scale;
            let floor = 8.0 * f64::EPSILON * state.y[i].abs() / length;
            self.scale[i] = (self.tolerance + floor) * length;
            let floor = floor + 8.0 * f64::EPSILON * state.y[layout.velocity(i)].abs() / speed;
            self.scale[layout.velocity(i)] = (self.tolerance + floor) * speed;
        }
        for contact in &self.model.contacts {
            if let Some(slot) = contact.slot {
                let limit = contact.friction_limit();
                self.scale[layout.force(slot)] = self.tolerance * if limit > 0.0 { limit } else { 1.0 };
            }
        }
        let work = self.tolerance * self.model.work_scale();
        self.scale.iter_mut().skip(layout.dimension()).for_each(|scale| *scale = work);
    }
}

/// The equations on the state as it stands.
fn equations<'s>(model: &'s Model, layout: Layout, state: &'s State) -> Equations<'s> {
    Equations::on(model, state, layout, false)
}

/// Longest step, s. A row under a varying load follows chords: it needs steps that leave the load no bend.
fn longest(model: &Model, plan: &Plan) -> f64 {
    let waves = model.waveforms.iter().map(Waveform::resolution).fold(f64::INFINITY, f64::min);
    let rows = model.contacts.iter().filter(|c| c.engine != Engine::Curve && !c.is_constant());
    let load = |w: usize| model.waveforms[w].period().unwrap_or(plan.duration) / CHORDS_PER_PERIOD;
    rows.filter_map(|c| c.press.waveform().map(load)).fold(waves, f64::min)
}

/// End of the next step: the corner exactly, or so that no sliver is left before it.
fn aim(t: f64, step: f64, corner: f64) -> f64 {
    let left = corner - t;
    if step >= 0.999 * left {
        corner
    } else if 2.0 * step > left {
        t + 0.5 * left
    } else {
        t + step
    }
}
