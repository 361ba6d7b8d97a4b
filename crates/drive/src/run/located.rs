//! The event-aware run: smooth laws between located events.
//!
//! Each contact follows the law set at its last event, which goes on smoothly beyond the event that will end it. A step is
//! attempted on these laws; if a guard falls below zero inside it, the moment is found on the dense output and the step
//! ends there, in the state that the dense output has. Then memories move, all that do together, and contacts whose
//! guard fell get their next law. The memory of a contact of closed form waits for an event of its own. Corners of waveforms end steps exactly. Where an interval has a closed form, no step is attempted: one leap takes
//! it to its end.
//!
//! The sentence is [`Located::step`]. Its parts own what they change: [`Motion`] the solver and what steers it, [`Watch`] the
//! contacts at both ends of the step and the guards that fell, [`Ledger`] what the memories commit, [`Output`] rows and
//! looks, [`Horizon`] where the run ends, [`Turning`] what waveforms do at a corner.

mod aim;
mod allowance;
mod balanced;
mod beginning;
mod block_laws;
mod ending;
mod laws;
mod leap;
mod method;
mod motion;
mod path;
mod room;
mod search;
mod shift;
mod steady;
mod step;
#[cfg(test)]
mod tests;
mod turning;
mod underway;
mod watch;
mod watched;
mod whole;
mod write;

use super::bounds::Bounds;
use super::horizon::{Goal, Horizon, Progress};
use super::ledger::Ledger;
use super::output::{Opening, Output};
use crate::equations::Equations;
use crate::interval::{Interval, Swing};
use crate::method::Method;
use crate::model::Model;
use crate::record::Record;
use crate::state::{Books, Detour, Gait, Layout, LocatedWay, State, Underway, Whereabouts};
use crate::{Plan, RunError};
pub(super) use method::{LocatedRun, Workspace};
use motion::Motion;
use path::FINEST_PIECES;
use room::Room;
use stickslip_contact::Memory;
use stickslip_stepper::{Attempt, StepControl, StepHistory, StepLimits};
use turning::Turning;
use watch::Watch;
use whole::Halves;

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

/// The laws with which a run begins.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Laws {
    /// Those of the state: an earlier run between located events has left them.
    Kept,
    /// Chosen from the motion: nothing has run yet, or a run that knows no laws.
    Chosen,
}

/// Scratch of one run; all that its future depends on is in the [`State`] whenever a caller holds that.
pub(super) struct Located<'a, A> {
    setting: Setting<'a>,
    horizon: Horizon,
    /// What stays the same until the next event.
    interval: Interval<'a>,
    /// The motion of a single slider until then, where the interval leaps.
    swing: Swing<'a>,
    /// Work put in before it began, J, while it is under way.
    takeoff: Option<f64>,
    /// The stretch that is taken by the whole law, and room for its steps.
    detour: Option<Detour>,
    last_detour: Detour,
    halves: Option<Box<Halves>>,
    /// Whether springs are damped: then the law jumps between stick and slip.
    slides: bool,
    motion: Motion<A>,
    control: StepControl,
    watch: Watch,
    ledger: Ledger,
    turning: Turning,
    output: Output,
    bounds: Bounds,
    /// Room for what is put down with a state that has none.
    spare: Option<Box<LocatedWay>>,
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
    /// `order` is that of the solver, for step control, and `limits` what its steps may do.
    fn new(setting: Setting<'a>, plan: &Plan, solver: A, control: (u32, StepLimits)) -> Self {
        Self::within(Room::of(solver, setting.layout), setting, plan, control)
    }

    /// The same in the room of another run.
    fn within(room: Room<A>, setting: Setting<'a>, plan: &Plan, (order, limits): (u32, StepLimits)) -> Self {
        let model = setting.model;
        let motion = Motion::new(&setting, room.solver, room.scale);
        // No step leaps over a smooth wave.
        let limits = StepLimits { longest: motion.pace.longest, ..limits };
        // Only contacts that grow have more than one path in a step.
        let grows = model.contacts.iter().any(|contact| contact.slot.is_some());
        let pieces = if grows { FINEST_PIECES as usize } else { 0 };
        // Where nothing is free nothing swings, and a walk has no pace.
        let period = if model.fastest > 0.0 { std::f64::consts::TAU / model.fastest } else { 0.0 };
        Self {
            horizon: Horizon::new(model, plan),
            interval: room.interval.renewed(model),
            swing: room.swing.renewed(model, motion.allowance.strict),
            takeoff: None,
            detour: None,
            last_detour: Detour::NONE,
            halves: None,
            slides: model.contacts.iter().any(|contact| contact.interface.damping() > 0.0),
            motion,
            control: StepControl::new(order, limits),
            watch: room.watch.renewed(model, setting.tolerance),
            ledger: room.ledger.renewed(model, pieces),
            turning: room.turning.renewed(model),
            output: room.output.renewed(plan.every, setting.layout),
            bounds: Bounds::new(model, plan.limits, period, room.windows),
            spare: room.way,
            setting,
        }
    }

    /// Takes up a state: begins a run there, or goes on with one.
    pub(super) fn set_out(&mut self, state: &mut State, opening: Opening, record: &mut dyn Record) {
        state.carry_over(self.setting.model, self.setting.layout);
        self.forget();
        self.output.set_out(state.t, record);
        match state.underway.take() {
            Some(Underway::Located(way)) if way.tolerance == self.setting.tolerance => {
                self.take_up(state, &way);
            }
            // At another tolerance the motion goes on, and its laws with it.
            Some(Underway::Located(way)) => {
                self.control.set_history(way.history);
                self.begin(state, Laws::Kept);
            }
            Some(Underway::Fixed(_)) | None => self.begin(state, Laws::Chosen),
        }
        if opening.has_row(self.output.every, state.t) {
            self.output.write_now(&self.setting.plain(state), state, record);
        }
        self.ledger.begin_telling(record);
        let eq = self.setting.plain(state);
        self.output.begin_looks(&eq, (self.setting.model, state), opening, record);
        record.enters(state);
    }

    /// Whatever it has done before: the workspace knows nothing of a state that it has yet to take up.
    fn forget(&mut self) {
        self.takeoff = None;
        (self.detour, self.last_detour) = (None, Detour::NONE);
        self.control.set_history(StepHistory::BLANK);
        self.motion.pace.gait = Gait::FRESH;
        self.horizon.steps = self.horizon.unmade;
        self.bounds.begin_anew();
        self.ledger.booked.books = Books::Current;
        // What was tried and given up is not counted.
        self.output.evaluations = self.motion.solver.evaluations();
    }

    /// Goes as far as a goal says, and puts down in the state what its future depends on.
    ///
    /// A run that fails leaves the state of its last accepted step.
    pub(super) fn go(
        &mut self,
        state: &mut State,
        goal: Goal,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        self.horizon.aim(goal);
        // A run that does not end there has no last row, and no row that is as good as that.
        let end = self.output.end_at(goal.last_row());
        self.horizon.nearly = end.min(self.horizon.end);
        let mut outcome = self.bounds.tried(state).and_then(|_| self.turn_due(state, record));
        self.ledger.tell(record);
        while state.t < self.horizon.limit() && outcome.is_ok() {
            match self.step(state, record) {
                Ok(Progress::Made) => {}
                Ok(Progress::Short) => break,
                Err(error) => outcome = Err(error),
            }
            self.ledger.tell(record);
        }
        self.put_down(state);
        outcome
    }

    /// Tells the range of a watched body so far.
    pub(super) fn hand_over(&mut self, record: &mut dyn Record) {
        self.output.marks.hand_over(record);
    }

    /// Turning points of contacts made or given up.
    pub(super) fn touched(&self) -> u64 {
        self.ledger.touched
    }

    /// How many turning points a contact remembers.
    pub(super) fn remembers(&self) -> usize {
        Memory::DEFAULT_CAPACITY
    }

    /// Brings memories that wait for an event to where the state is. For who will read them, at the end of a run.
    pub(super) fn settle_books(&mut self, state: &mut State) {
        if self.ledger.booked.books == Books::Behind {
            self.settle(state);
            self.ledger.booked.books = Books::Current;
        }
        self.put_down(state);
    }

    /// Writes the row of where the run stopped.
    pub(super) fn write_now(&mut self, state: &State, record: &mut dyn Record) {
        self.output.write_now(&self.setting.plain(state), state, record);
    }

    /// Begins with a state; where its laws are to be chosen, with them and with a first step.
    ///
    /// The first step is at most one natural period of the fastest contact.
    fn begin(&mut self, state: &mut State, laws: Laws) {
        self.ledger.set_out(state.t);
        self.horizon.steps.begin(state);
        if laws == Laws::Chosen {
            state.choose_block_laws(self.setting.model, self.setting.layout);
            (0..self.setting.model.contacts.len()).for_each(|c| self.decide(state, c));
        }
        self.turned(state);
        self.begin_interval(state);
        self.catch_up(state);
        self.stay_whole(state);
        if laws == Laws::Kept {
            return;
        }
        let contacts = self.setting.model.contacts.iter();
        // A guess that begins above the fastest ringing would be thrown away.
        let natural = contacts.map(|c| std::f64::consts::TAU / c.natural.frequency);
        let longest = natural.fold(self.motion.longest(state.t), f64::min);
        state.step = if self.setting.layout.dimension() == 0 {
            longest
        } else {
            let eq = self.setting.equations(state, &self.interval);
            self.motion.solver.first_step(&eq, longest, &self.motion.allowance.allowed.scale)
        };
    }

    /// From an event or a corner, at which the state is, into the next interval.
    fn pass_event(
        &mut self,
        state: &mut State,
        is_corner: bool,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        record.leaves(state);
        if is_corner {
            self.bounds.corner();
            self.output.turns.near_corner(&self.setting.plain(state), state.t, &state.y);
            self.turn_corners(state, record)?;
            self.turned(state);
        }
        self.handle_fallen(state, is_corner, record)?;
        if is_corner && self.output.turns.watches() {
            self.tell_corner_turns(state, record);
        }
        if !self.setting.model.balanced.is_empty() {
            self.check_balance(state)?;
        }
        // Here and nowhere else: the solver starts anew at once and keeps no place counted from before.
        let moves = shift::shift(self.setting.model, state);
        if is_corner || moves || !self.renew_interval(state) {
            self.begin_interval(state);
        }
        record.enters(state);
        self.go_on_from(state);
        Ok(())
    }

    /// The laws, and perhaps the forces of growing contacts, have changed.
    ///
    /// The solver is caught up only where steps follow: a leap has no use for the slopes, and the next event
    /// may bring another.
    fn restart(&mut self, state: &mut State) {
        self.begin_interval(state);
        self.go_on_from(state);
    }

    /// Into an interval that has begun.
    fn go_on_from(&mut self, state: &State) {
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

    /// Waveforms are on new pieces.
    fn turned(&mut self, state: &State) {
        self.horizon.corner = state.next_corner();
        self.motion.allowance.allowed.power = allowance::follower_power(self.setting.model, state);
    }
}
