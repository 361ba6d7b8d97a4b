//! The event-aware run: smooth laws between located events.
//!
//! Each contact follows the law set at its last event, which goes on smoothly beyond the event that will end it. A step is
//! attempted on these laws; if a guard falls below zero inside it, the moment is found on the dense output and the step
//! ends there, in the state that the dense output has. Then memory is committed, all contacts together, and those whose
//! guard fell get their next law. Steps that no event ends leave the memories of contacts of closed form to the next one that
//! does. Corners of waveforms end steps exactly. Where an interval has a closed form, no step is attempted: one leap takes
//! it to its end.
//!
//! The sentence is [`Located::step`]. Its parts own what they change: [`Motion`] the solver and what steers it, [`Watch`] the
//! contacts at both ends of the step and the guards that fell, [`Ledger`] what the memories commit, [`Output`] rows and
//! looks, [`Horizon`] where the run ends, [`Turning`] what waveforms do at a corner.

mod aim;
mod allowance;
mod laws;
mod leap;
mod motion;
mod path;
mod search;
mod shift;
mod steady;
mod step;
mod turning;
mod watch;
mod watched;
mod write;

use super::bounds::Bounds;
use super::horizon::Horizon;
use super::ledger::{Books, Ledger};
use super::output::Output;
use crate::contact::Mode;
use crate::equations::Equations;
use crate::interval::{Interval, Swing};
use crate::method::{Method, SceneTraits, stepping};
use crate::model::Model;
use crate::record::Record;
use crate::state::{Layout, State};
use crate::{Plan, RunError};
use motion::{Grip, Motion, Whereabouts};
use path::MOST_PIECES;
use stickslip_stepper::{Attempt, DOP853_ORDER, Dop853, NYSTROM_ORDER, Paired, StepControl, StepLimits};
use turning::Turning;
use watch::Watch;

/// What stays the same throughout a run. Small and copied: parts that own what they change borrow nothing from it.
#[derive(Clone, Copy)]
struct Setting<'a> {
    /// The scene's constants.
    model: &'a Model,
    /// Places of the components.
    layout: Layout,
    tolerance: f64,
    /// The method of intervals without a closed form.
    method: Method,
}

/// Scratch of one run; all that its future depends on is in the [`State`], or begins anew at every end that a plan may have.
struct Located<'a, A> {
    setting: Setting<'a>,
    horizon: Horizon,
    /// What stays the same until the next event.
    interval: Interval<'a>,
    /// The motion of a single slider until then, where the interval leaps.
    swing: Swing,
    motion: Motion<A>,
    watch: Watch,
    ledger: Ledger,
    turning: Turning,
    output: Output,
    bounds: Bounds,
}

/// Runs by the method of the scene's intervals without a closed form: where no force depends on a velocity, one that
/// spares a third of the evaluations.
pub(super) fn run(
    model: &Model,
    plan: &Plan,
    tolerance: f64,
    state: &mut State,
    record: &mut dyn Record,
) -> Result<(), RunError> {
    let layout = model.layout();
    let setting = Setting { model, layout, tolerance, method: stepping(&SceneTraits::of(model)).0 };
    match (setting.method, layout.free) {
        // The work put in is the only integral: nothing dissipates but contacts, which book for themselves.
        (Method::Nystrom, 1) => {
            let solver = Paired::one(layout.total());
            Located::new(setting, plan, solver).go(NYSTROM_ORDER, state, record)
        }
        (Method::Nystrom, free) => {
            let solver = Paired::new(free, 1, layout.total());
            Located::new(setting, plan, solver).go(NYSTROM_ORDER, state, record)
        }
        _ => {
            let solver = Dop853::new(layout.dimension(), layout.total());
            Located::new(setting, plan, solver).go(DOP853_ORDER, state, record)
        }
    }
}

impl<'a> Setting<'a> {
    /// The equations on a state as it stands, with what is known of the interval.
    #[inline(always)]
    fn equations<'s>(&self, state: &'s State, interval: &'s Interval<'a>) -> Equations<'s>
    where
        'a: 's,
    {
        Equations { interval: Some(interval), ..self.plain(state) }
    }

    /// The equations on a state as it stands, by the general law alone.
    #[inline(always)]
    fn plain<'s>(&self, state: &'s State) -> Equations<'s>
    where
        'a: 's,
    {
        Equations::on(self.model, state, self.layout, false)
    }
}

impl<'a, A: for<'e> Attempt<Equations<'e>>> Located<'a, A> {
    fn new(setting: Setting<'a>, plan: &Plan, solver: A) -> Self {
        let model = setting.model;
        let motion = Motion::new(&setting, plan, solver);
        Self {
            horizon: Horizon::new(model, plan),
            interval: Interval::of(model),
            swing: Swing::of(model, motion.allowance.strict),
            motion,
            watch: Watch::new(model, setting.tolerance),
            ledger: Ledger::new(model, MOST_PIECES as usize),
            turning: Turning::new(model),
            output: Output::new(plan.every, setting.layout),
            bounds: Bounds::new(model, plan.limits),
            setting,
        }
    }

    /// The run from the state's time to the plan's end. `order` is that of the solver, for step control. The
    /// first and the last row are written whatever the outcome; a run that fails leaves the state of its last
    /// accepted step.
    fn go(mut self, order: u32, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
        state.carry_over(self.setting.model, self.setting.layout);
        self.output.set_out(state.t, self.horizon.end);
        self.ledger.set_out(state.t);
        // No step leaps over a smooth wave.
        let limits = StepLimits { longest: self.motion.pace.longest, ..StepLimits::default() };
        // A run in two halves is one run to the last bit: what control has learnt goes on with the state.
        let mut control = state.control.clone().unwrap_or_else(|| StepControl::new(order, limits));
        self.begin(state);
        self.output.write_now(&self.setting.plain(state), state, record);
        self.horizon.steps.begin(state);
        self.output.begin_looks(self.setting.model, state, record);
        let mut outcome = Ok(());
        while state.t < self.horizon.end && outcome.is_ok() {
            outcome = self.step(state, &mut control, record);
        }
        // The last step had no event at its end, and its memories wait.
        if self.ledger.books == Books::Behind {
            self.settle(state);
        }
        state.control = Some(control);
        // With and without output the same count.
        state.counts.evaluations += self.motion.solver.evaluations() - self.output.evaluations;
        self.output.write_now(&self.setting.plain(state), state, record);
        outcome
    }

    /// Sets the first laws and proposes a first step, unless the state goes on from an earlier run.
    ///
    /// The first step is at most one natural period of the fastest contact.
    fn begin(&mut self, state: &mut State) {
        let fresh = state.step <= 0.0;
        if fresh {
            (0..self.setting.model.contacts.len()).for_each(|c| self.decide(state, c));
        }
        self.turned(state);
        self.begin_interval(state);
        self.catch_up(state);
        if !fresh {
            return;
        }
        let contacts = self.setting.model.contacts.iter();
        // A guess that begins above the fastest ringing would be thrown away.
        let natural = contacts.map(|c| std::f64::consts::TAU / c.natural.frequency);
        let longest = natural.fold(self.motion.pace.longest, f64::min);
        let longest = if longest.is_finite() { longest } else { self.horizon.end };
        state.step = if self.setting.layout.dimension() == 0 {
            longest
        } else {
            let eq = self.setting.equations(state, &self.interval);
            self.motion.solver.first_step(&eq, longest, &self.motion.allowance.scale)
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
        // Here and nowhere else: the solver starts anew at once and keeps no place counted from before.
        shift::shift(self.setting.model, state);
        self.restart(state);
        Ok(())
    }

    /// The laws, and perhaps the forces of growing contacts, have changed.
    ///
    /// The solver is caught up only where steps follow: a leap has no use for the slopes, and the next event
    /// may bring another.
    fn restart(&mut self, state: &mut State) {
        self.begin_interval(state);
        self.motion.pace.restart();
        self.motion.whereabouts = Whereabouts::Behind;
        if !self.interval.leaps() {
            self.catch_up(state);
        }
    }

    /// Puts the solver where the state is.
    ///
    /// Everything that is read of its start follows: the watch, the allowances, whether all is at rest. One
    /// evaluation.
    fn catch_up(&mut self, state: &State) {
        let eq = self.setting.equations(state, &self.interval);
        self.motion.start(&eq, state);
        self.watch.set_out(&eq, &self.motion.solver);
        self.motion.allowance.set(self.setting.model, state);
        self.motion.rest(self.setting.model, state);
    }

    /// What is known until the next event: forms of contacts, the method, and whether anything holds.
    fn begin_interval(&mut self, state: &mut State) {
        self.interval.begin(self.setting.model, state);
        self.interval.count(&mut state.tally);
        // Without contacts links alone hold, and their steps must damp all the same.
        let holds = state.modes.is_empty() || state.modes.iter().any(Mode::holds);
        self.motion.pace.grip = if holds { Grip::Sticks } else { Grip::Slips };
    }

    /// Waveforms are on new pieces.
    fn turned(&mut self, state: &State) {
        self.horizon.corner = state.pieces.iter().map(|piece| piece.end).fold(f64::INFINITY, f64::min);
        self.motion.allowance.power = allowance::follower_power(self.setting.model, state);
    }
}
