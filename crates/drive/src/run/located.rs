//! Runs with located events: smooth contact laws between two events.
//!
//! Each contact follows the force law set by its last event. The law stays smooth beyond the event that will end it. A step is attempted
//! with these laws. If an event function crosses zero inside the step, the event is located on the dense output and ends the step.
//!
//! Then the slip memories commit their paths, and contacts with an event get their next law. A contact with a closed-form force commits at
//! its own events only. Steps end exactly at waveform corners. If the motion has a closed form, one step covers the whole interval.
//!
//! [`Located::step`] advances a run by one step. It uses these parts:
//!
//! * [`Motion`]: integrator and step length.
//! * [`Watch`]: contacts at both ends of the step, and zero crossings at its end.
//! * [`Ledger`]: paths that the slip memories commit.
//! * [`Output`]: rows and snapshots.
//! * [`Horizon`]: end of the run and next corner.
//! * [`Turning`]: waveforms that change their pieces at a corner.

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

use super::advance::Advance;
use super::bounds::Bounds;
use super::horizon::{Goal, Horizon, Progress};
use super::ledger::Ledger;
use super::output::{Opening, Output};
use crate::equations::Equations;
use crate::interval::{Interval, Swing};
use crate::method::Method;
use crate::model::Model;
use crate::record::{Entry, Record};
use crate::state::{Books, Detour, Gait, Layout, LocatedWay, State, Underway, Whereabouts};
use crate::{Plan, RunError};
pub(super) use method::{Workspace, located};
use motion::Motion;
use path::FINEST_PIECES;
use room::Room;
use stickslip_contact::Memory;
use stickslip_stepper::{Attempt, StepControl, StepHistory, StepLimits};
use turning::Turning;
use watch::Watch;
use whole::Halves;

/// Constants of a run. The setting is copied, so that users of its constants borrow nothing.
#[derive(Clone, Copy)]
struct Setting<'a> {
    /// Constants of the model.
    model: &'a Model,
    /// Layout of the components.
    layout: Layout,
    tolerance: f64,
    /// Integration method of intervals without a closed-form solution.
    method: Method,
}

/// Contact laws at the start of a run.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Laws {
    /// Laws in the state, set by an earlier run with located events.
    Kept,
    /// Laws chosen from the motion, for a first run or after a run without located events.
    Chosen,
}

/// Workspace of a run with located events. Between two calls the [`State`] contains everything that the future of the run depends on.
pub(super) struct Located<'a, A> {
    setting: Setting<'a>,
    horizon: Horizon,
    /// Closed forms of the contacts until the next event.
    interval: Interval<'a>,
    /// Closed-form motion of a single slider until the next event.
    swing: Swing<'a>,
    /// Input work at the start of the current closed-form step, J; `None` if there is no such step.
    takeoff: Option<f64>,
    /// Current interval of step doubling (`detour`), the last such interval, and storage for its steps (`halves`).
    detour: Option<Detour>,
    last_detour: Detour,
    halves: Option<Box<Halves>>,
    /// Whether any contact has two friction coefficients, so that its force jumps where it breaks loose.
    jumps: bool,
    /// Whether any contact has damping along the normal, so that its indentation jumps where it touches.
    presses: bool,
    motion: Motion<A>,
    control: StepControl,
    watch: Watch,
    ledger: Ledger,
    turning: Turning,
    output: Output,
    bounds: Bounds,
    /// Storage for the run data of a state that has none.
    spare: Option<Box<LocatedWay>>,
}

impl<'a> Setting<'a> {
    /// Returns the equations of motion at a state, with the closed forms of the interval.
    #[inline(always)]
    fn equations<'s>(&self, state: &'s State, interval: &'s Interval<'a>) -> Equations<'s>
    where
        'a: 's,
    {
        Equations { interval: Some(interval), ..self.plain(state) }
    }

    /// Returns the equations of motion at a state, without closed forms.
    #[inline(always)]
    fn plain<'s>(&self, state: &'s State) -> Equations<'s>
    where
        'a: 's,
    {
        Equations::on(self.model, state, self.layout)
    }
}

impl<A: for<'e> Attempt<Equations<'e>> + Send> Advance for Located<'_, A> {
    fn set_out(&mut self, state: &mut State, opening: Opening, record: &mut dyn Record) {
        state.carry_over(self.setting.model, self.setting.layout);
        self.forget();
        self.output.set_out(state.t, record);
        match state.underway.take() {
            Some(Underway::Located(way)) if way.tolerance == self.setting.tolerance => {
                self.take_up(state, &way);
            }
            // The tolerance has changed: motion and contact laws continue.
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
        record.take(Entry::Enters(state));
    }

    fn go(&mut self, state: &mut State, goal: Goal, record: &mut dyn Record) -> Result<(), RunError> {
        self.horizon.aim(goal);
        // Only a run that ends at its goal has a last row.
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

    fn hand_over(&mut self, record: &mut dyn Record) {
        self.output.marks.hand_over(record);
    }

    fn touched(&self) -> u64 {
        self.ledger.touched
    }

    fn remembers(&self) -> usize {
        Memory::DEFAULT_CAPACITY
    }

    fn settle_books(&mut self, state: &mut State) {
        if self.ledger.booked.books == Books::Behind {
            self.settle(state);
            self.ledger.booked.books = Books::Current;
        }
        self.put_down(state);
    }

    fn write_now(&mut self, state: &State, record: &mut dyn Record) {
        self.output.write_now(&self.setting.plain(state), state, record);
    }
}

impl<'a, A: for<'e> Attempt<Equations<'e>>> Located<'a, A> {
    /// Creates the run. `order` is the order of the integrator for step control, `limits` are the limits of its steps.
    fn new(setting: Setting<'a>, plan: &Plan, solver: A, control: (u32, StepLimits)) -> Self {
        Self::within(Room::of(solver, setting.layout), setting, plan, control)
    }

    /// Creates the run in the storage of an earlier run.
    fn within(room: Room<A>, setting: Setting<'a>, plan: &Plan, (order, limits): (u32, StepLimits)) -> Self {
        let model = setting.model;
        let motion = Motion::new(&setting, room.solver, room.scale);
        // Steps resolve every smooth wave.
        let limits = StepLimits { longest: motion.pace.longest, ..limits };
        // Only contacts growing in full stick have more than one path in a step.
        let grows = model.contacts.iter().any(|contact| contact.slot.is_some());
        let pieces = if grows { FINEST_PIECES as usize } else { 0 };
        // Without free coordinates there is no oscillation.
        let period = if model.fastest > 0.0 { std::f64::consts::TAU / model.fastest } else { 0.0 };
        Self {
            horizon: Horizon::new(model, plan),
            interval: room.interval.renewed(model),
            swing: room.swing.renewed(model, motion.allowance.strict),
            takeoff: None,
            detour: None,
            last_detour: Detour::NONE,
            halves: None,
            jumps: model.contacts.iter().any(|contact| contact.interface.kinetic().is_some()),
            presses: model.contacts.iter().any(|contact| contact.normal_damping > 0.0),
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

    /// Resets all data of the workspace that depend on an earlier state.
    fn forget(&mut self) {
        self.takeoff = None;
        (self.detour, self.last_detour) = (None, Detour::NONE);
        self.control.set_history(StepHistory::BLANK);
        self.motion.pace.gait = Gait::FRESH;
        self.horizon.steps = self.horizon.unmade;
        self.bounds.begin_anew();
        self.ledger.booked.books = Books::Current;
        // Abandoned attempts are not counted.
        self.output.evaluations = self.motion.solver.evaluations();
    }

    /// Begins a run at a state. With [`Laws::Chosen`], contact laws and the first step length are chosen anew.
    ///
    /// The first step is at most one natural period of the fastest contact.
    fn begin(&mut self, state: &mut State, laws: Laws) {
        self.ledger.set_out(state.t);
        self.horizon.steps.begin(state);
        if laws == Laws::Chosen {
            state.choose_block_laws(self.setting.model, self.setting.layout);
            self.grow_limits(state, false);
            if self.presses {
                self.press_damped(state);
            }
            for c in 0..self.setting.model.contacts.len() {
                self.decide(state, c);
            }
        }
        self.turned(state);
        self.begin_interval(state);
        self.catch_up(state);
        self.stay_whole(state);
        if laws == Laws::Kept {
            return;
        }
        let contacts = self.setting.model.contacts.iter();
        // A longer first step would be rejected.
        let natural = contacts.map(|c| std::f64::consts::TAU / c.natural.frequency);
        let longest = natural.fold(self.motion.longest(state.t), f64::min);
        state.step = if self.setting.layout.dimension() == 0 {
            longest
        } else {
            let eq = self.setting.equations(state, &self.interval);
            self.motion.solver.first_step(&eq, longest, &self.motion.allowance.allowed.scale)
        };
    }

    /// Handles an event or a corner at the current time and begins the next interval.
    fn pass_event(
        &mut self,
        state: &mut State,
        is_corner: bool,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        record.take(Entry::Leaves(state));
        if is_corner {
            self.bounds.corner();
            self.output.turns.near_corner(&self.setting.plain(state), state.t, &state.y);
            self.turn_corners(state, record)?;
            self.turned(state);
        }
        self.handle_fallen(state, is_corner, record)?;
        self.grow_limits(state, true);
        if is_corner && self.output.turns.watches() {
            self.tell_corner_turns(state, record);
        }
        if !self.setting.model.balanced.is_empty() {
            self.check_balance(state)?;
        }
        // Origins move only here, because the integrator restarts and keeps no old positions.
        let moves = shift::shift(self.setting.model, state);
        if is_corner || moves || !self.renew_interval(state) {
            self.begin_interval(state);
        }
        record.take(Entry::Enters(state));
        self.go_on_from(state);
        Ok(())
    }

    /// Begins the next interval after the contact laws have changed.
    fn restart(&mut self, state: &mut State) {
        self.begin_interval(state);
        self.go_on_from(state);
    }

    /// Continues in the interval that has begun.
    ///
    /// The integrator restarts only if integration steps follow. A closed-form step needs no time derivatives.
    fn go_on_from(&mut self, state: &State) {
        self.motion.pace.restart();
        self.motion.whereabouts = Whereabouts::Behind;
        if !self.interval.leaps() {
            self.catch_up(state);
        }
    }

    /// Restarts the integrator at the current state, with one evaluation.
    ///
    /// Updates the data that depend on the restart: contact motions, allowed errors and the check for rest.
    fn catch_up(&mut self, state: &State) {
        let eq = self.setting.equations(state, &self.interval);
        self.motion.start(&eq, state);
        self.watch.set_out(&eq, &self.motion.solver);
        self.motion.allowance.set(self.setting.model, state);
        self.motion.rest(self.setting.model, state);
    }

    /// Updates the next corner and the power of prescribed motions after waveforms have changed their pieces.
    fn turned(&mut self, state: &State) {
        self.horizon.corner = self.next_corner(state);
        self.motion.allowance.allowed.power = allowance::follower_power(self.setting.model, state);
    }
}
