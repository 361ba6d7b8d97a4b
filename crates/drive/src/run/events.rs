//! The event-aware run: smooth laws between located events.
//!
//! Each contact follows the law decreed at its last event, which goes on smoothly beyond the event that will end
//! it. A step is attempted on these laws; if a guard falls below zero inside it, the moment is found on the dense
//! output and the step ends there, in the state that the dense output has. Then memory is committed, all contacts
//! together, and those whose guard fell get their next law by decree. Steps that no event ends leave the memories of
//! steady contacts to the next one that does. Corners of waveforms end steps exactly. Where an interval has a closed form,
//! no step is attempted: one leap takes it to its end.

mod aim;
mod allowance;
mod leap;
mod locate;
mod moving;
mod path;
mod rest;
mod shift;
mod steady;
mod step;
mod switch;
mod write;

use super::output::{Grid, Looks};
use super::steady::Steps;
use super::watch::Watch;
use crate::equations::Equations;
use crate::event::EventKind;
use crate::guard::Guard;
use crate::interval::{Interval, Swing};
use crate::method::{Method, SceneTraits, stepping};
use crate::model::Model;
use crate::record::Record;
use crate::state::{Layout, Mode, State};
use crate::{Plan, RunError, Waveform};
use allowance::{longest, scale, slack};
use moving::Moving;
use path::MOST_PIECES;
use stickslip_contact::Segment;
use stickslip_stepper::{Attempt, DOP853_ORDER, Dop853, NYSTROM_ORDER, Paired, StepControl, StepLimits};

/// Scratch of one run; all that its future depends on is in the [`State`], or begins anew at every end that a plan may have.
pub(super) struct Run<'a, A> {
    model: &'a Model,
    end: f64,
    /// The steps of the drive, where they may end the run.
    steps: Steps,
    every: Option<f64>,
    tolerance: f64,
    layout: Layout,
    solver: A,
    scale: Vec<f64>,
    /// What is asked of the error estimates.
    strict: f64,
    /// Natural scale of work, J.
    work: f64,
    /// Largest power that followers could put into the contacts at the last corner, W.
    haste: f64,
    watch: Watch,
    /// Longest step, s: a fraction of the period of the fastest smooth waveform.
    longest: f64,
    /// Whether any waveform jumps.
    jumpy: bool,
    /// What stays the same until the next event.
    interval: Option<Box<Interval<'a>>>,
    /// The motion of a single slider until its next event, and whether it may be taken up.
    swing: Box<Swing>,
    leaps: bool,
    /// Whether the solver has been left behind by leaps.
    behind: bool,
    /// How near to a singular moment a step must end, as a part of it.
    slack: f64,
    /// How much must be left before such a moment for its law to tell, in natural lengths.
    telling: f64,
    /// Longest step since the last event, or since a graded one was refused, s.
    calm: f64,
    /// Whether a singular moment ahead has made an even step too long.
    feels: bool,
    /// Earliest corner of a waveform, s.
    corner: f64,
    /// Whether any contact is in partial slip or sticks.
    holds: bool,
    /// Whether all that is free is at rest.
    rests: bool,
    /// Whether memories of steady contacts lag behind the state.
    lags: bool,
    /// The contacts at the start of the step.
    from: Vec<Moving>,
    /// The contacts at its end.
    to: Vec<Moving>,
    /// What the contacts commit at the end of the step.
    segments: Vec<(usize, Segment)>,
    /// Guards that fell at the end of the step.
    fired: Vec<(usize, Guard)>,
    /// Modes before the corner at the end of the step.
    old: Vec<Mode>,
    /// Waveforms that turned a corner at the end of the step.
    turned: Vec<(usize, EventKind)>,
    row: Vec<f64>,
    /// Components of a moment, or their slopes.
    slopes: Vec<f64>,
    looks: Looks,
    /// Evaluations made for rows and looks only.
    for_output: u64,
}

/// Runs by the method that the model allows: where no force depends on a velocity, one that spares a third of the
/// evaluations.
pub(super) fn run(
    model: &Model,
    plan: &Plan,
    tolerance: f64,
    state: &mut State,
    record: &mut dyn Record,
) -> Result<(), RunError> {
    let layout = model.layout();
    if stepping(&SceneTraits::of(model)).0 == Method::Nystrom {
        // The work put in is the only integral: nothing dissipates but contacts, which book for themselves.
        if layout.free == 1 {
            return Run::new(model, plan, tolerance, Paired::one(layout.total())).go(
                NYSTROM_ORDER,
                state,
                record,
            );
        }
        let solver = Paired::new(layout.free, 1, layout.total());
        return Run::new(model, plan, tolerance, solver).go(NYSTROM_ORDER, state, record);
    }
    let solver = Dop853::new(layout.dimension(), layout.total());
    Run::new(model, plan, tolerance, solver).go(DOP853_ORDER, state, record)
}

/// Part of the tolerance that is asked of the estimates where a list of springs puts kinks into the law: they are no events,
/// and the estimates of a method of high order see them late. Without it errors were 20 to 1000 times the tolerance.
const KINKS: f64 = 1e-3;
/// Finest tolerance that rounding leaves room for.
const FINEST: f64 = 1e-13;

impl<'a, A: for<'e> Attempt<Equations<'e>>> Run<'a, A> {
    fn new(model: &'a Model, plan: &Plan, tolerance: f64, solver: A) -> Self {
        let layout = model.layout();
        let kinks = model.contacts.iter().any(|contact| contact.law.profile().has_kinks());
        let strict = if kinks { (KINKS * tolerance).max(f64::min(tolerance, FINEST)) } else { tolerance };
        Self {
            model,
            end: plan.duration,
            steps: Steps::of(model, plan),
            every: plan.every,
            tolerance,
            layout,
            solver,
            strict,
            scale: scale(model, strict),
            work: model.work_scale(),
            haste: 0.0,
            watch: Watch::new(model, plan.limits),
            longest: longest(model, plan),
            jumpy: model.waveforms.iter().any(Waveform::has_jumps),
            interval: Some(Box::new(Interval::of(model))),
            swing: Box::new(Swing::of(model, strict)),
            leaps: false,
            behind: false,
            slack: slack(model, tolerance),
            telling: tolerance.powf(2.0 / 3.0),
            calm: 0.0,
            feels: false,
            corner: f64::INFINITY,
            holds: false,
            rests: false,
            lags: false,
            from: vec![Moving::default(); model.contacts.len()],
            to: vec![Moving::default(); model.contacts.len()],
            segments: Vec::with_capacity(model.contacts.len() + MOST_PIECES as usize),
            fired: Vec::with_capacity(model.contacts.len()),
            old: Vec::with_capacity(model.contacts.len()),
            turned: Vec::with_capacity(model.waveforms.len()),
            row: Vec::new(),
            slopes: vec![0.0; layout.total()],
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
        self.steps.begin(state);
        self.looks = Looks::begin(self.model, state, record);
        let mut outcome = Ok(());
        while state.t < self.end && outcome.is_ok() {
            outcome = self.step(state, &mut control, &mut grid, record);
        }
        if self.lags {
            self.settle(state);
        }
        state.control = Some(control);
        state.counts.evaluations += self.solver.evaluations() - self.for_output;
        grid.write_now(&equations(self.model, self.layout, state), state, record);
        outcome
    }

    /// Decrees the first laws and proposes a first step, unless the state goes on from an earlier run.
    fn begin(&mut self, state: &mut State) {
        let fresh = state.step <= 0.0;
        if fresh {
            (0..self.model.contacts.len()).for_each(|c| self.decide(state, c));
        }
        self.turned(state);
        self.begin_interval(state);
        self.catch_up(state);
        if !fresh {
            return;
        }
        let natural = self.model.contacts.iter().map(|c| std::f64::consts::TAU / c.natural.frequency);
        let longest = natural.fold(self.longest, f64::min);
        let longest = if longest.is_finite() { longest } else { self.end };
        state.step = if self.layout.dimension() == 0 {
            longest
        } else {
            self.with_equations(state, |run, eq| run.solver.first_step(eq, longest, &run.scale))
        };
    }

    /// From an event or a corner, at which the state is, into the next interval.
    fn pass_event(
        &mut self,
        state: &mut State,
        is_corner: bool,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        if is_corner {
            self.turn_corners(state, record);
            self.turned(state);
        }
        self.handle_fallen(state, is_corner, record)?;
        self.shift(state);
        self.restart(state);
        Ok(())
    }

    /// The laws, and perhaps the forces of growing contacts, have changed.
    fn restart(&mut self, state: &State) {
        self.begin_interval(state);
        (self.calm, self.feels) = (0.0, false);
        self.behind = true;
        if !self.leaps {
            self.catch_up(state);
        }
    }

    /// Puts the solver where the state is.
    fn catch_up(&mut self, state: &State) {
        self.behind = false;
        self.with_equations(state, |run, eq| {
            run.solver.start(eq, state.t, &state.y);
            run.set_out(eq);
        });
        self.set_scale(state);
        self.rests = self.is_at_rest(state);
    }

    fn begin_interval(&mut self, state: &State) {
        if let Some(interval) = &mut self.interval {
            interval.begin(self.model, state);
        }
        self.leaps = self.interval.as_ref().is_some_and(|interval| interval.traits.leaps(&interval.scene));
        self.holds = state.modes.is_empty() || state.modes.iter().any(Mode::holds);
    }

    /// Waveforms are on new pieces.
    fn turned(&mut self, state: &State) {
        self.corner = state.pieces.iter().map(|piece| piece.end).fold(f64::INFINITY, f64::min);
        self.haste = self.haste(state);
    }

    /// Does something with the equations as they are until the next event.
    #[inline(always)]
    fn with_equations<R>(&mut self, state: &State, act: impl FnOnce(&mut Self, &Equations<'_>) -> R) -> R {
        let interval = self.interval.take();
        let eq = Equations { interval: interval.as_deref(), ..equations(self.model, self.layout, state) };
        let result = act(self, &eq);
        self.interval = interval;
        result
    }
}

/// The equations on the state as it stands.
fn equations<'s>(model: &'s Model, layout: Layout, state: &'s State) -> Equations<'s> {
    Equations::on(model, state, layout, false)
}
