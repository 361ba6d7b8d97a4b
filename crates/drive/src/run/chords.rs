//! Runs without event location: every accepted step is one straight path of each contact in the plane of (d, u).
//!
//! Contacts follow the full force law of their slip memory, including its kinks. Events are detected afterwards, from
//! the contacts at both ends of a step, and only reported to the record.
//!
//! Inside a step, positions are cubic Hermite interpolants; velocities and works are linear in time. If a contact
//! reverses or grows within a step, the order of accuracy is at most two.

mod branches;
mod corners;
mod damping;
mod noticed;
mod step;
mod way;

use super::bounds::Bounds;
use super::horizon::{Goal, Horizon};
use super::ledger::Ledger;
use super::output::{Opening, Output};
use crate::contact::{Contact, Motion};
use crate::equations::Equations;
use crate::method::Method;
use crate::model::Model;
use crate::record::Record;
use crate::state::{FixedWay, Layout, State, Underway, beyond};
use crate::{Plan, RunError, Stepper};
use branches::{Branches, GROWING_KNOTS, KNOTS};
pub(super) use step::Between;
use stickslip_contact::{ContactState, Law, Memory};

/// Largest velocity of a contact at rest, in natural velocities.
const REST: f64 = 1e-12;

/// Run without event location: accepts steps, writes the output inside them and detects events afterwards.
pub(super) struct Chords<'a> {
    pub(super) model: &'a Model,
    pub(super) layout: Layout,
    pub(super) horizon: Horizon,
    pub(super) output: Output,
    ledger: Ledger,
    pub(super) bounds: Bounds,
    /// Sign of the last sliding velocity of each contact; 0 before it first slides.
    senses: Vec<f64>,
    /// Slip state of each contact after the last step, while the record requests events.
    standings: Vec<ContactState>,
    /// Whether the record requested events at the last step.
    watched: bool,
    /// Branches of the force laws; none for an integrator that chooses its own steps.
    branches: Option<Branches<'a>>,
    /// Whether steps end where branches end, as frames do.
    cuts: bool,
    /// Motions of the contacts at the start of the step (`before`) and at its end (`motions`).
    before: Vec<Motion>,
    motions: Vec<Motion>,
    /// Components at the end of the run, where the run ends inside a step.
    last: Vec<f64>,
}

impl<'a> Chords<'a> {
    /// Creates the run. The state vector of the run has no forces of contacts growing in full stick.
    pub(super) fn new(model: &'a Model, plan: &Plan) -> Self {
        // The slip memory gives the force of a straight path; no state is needed for it.
        let layout = Layout { growing: 0, located: false, ..model.layout() };
        Self {
            horizon: Horizon::new(model, plan),
            output: Output::new(plan.every, layout),
            // A contact that reverses within a step has one path before the reversal and one after it.
            ledger: Ledger::new(model, model.contacts.len()),
            bounds: Bounds::new(model, plan.limits, 0.0, Vec::new()),
            senses: vec![0.0; model.contacts.len()],
            standings: vec![ContactState::Open; model.contacts.len()],
            watched: false,
            branches: match plan.stepper {
                Stepper::Dopri5 { .. } => None,
                _ => Some(Branches::of(model)),
            },
            cuts: matches!(plan.stepper, Stepper::Frames { .. }),
            before: Vec::with_capacity(model.contacts.len()),
            motions: Vec::with_capacity(model.contacts.len()),
            last: Vec::with_capacity(layout.total()),
            model,
            layout,
        }
    }

    /// Prepares a state for the run.
    ///
    /// Friction work becomes committed work, origins return to the initial positions, and every contact gets the full force law. A
    /// continued run of the same stepper keeps the branches of its force laws.
    pub(super) fn set_out(&mut self, state: &mut State, opening: Opening, record: &mut dyn Record) {
        let model = self.model;
        state.carry_over(model, self.layout);
        // Origins move at located events only.
        state.come_back(model);
        let goes_on = matches!(state.underway, Some(Underway::Fixed(_)));
        if self.branches.is_none() || !goes_on {
            // The sense is 0: the slip memory itself detects a reversal within a step.
            state.modes.fill(Law::whole(0.0));
        }
        match &state.underway {
            Some(Underway::Fixed(way)) => self.take_up(way, state),
            _ => {
                state.choose_block_laws(model, self.layout);
                self.ledger.set_out(state.t);
                self.horizon.steps.begin(state);
            }
        }
        if !goes_on {
            self.branch_at_start(state);
        }
        self.output.set_out(state.t, record);
        if opening.has_row(self.output.every, state.t) {
            self.write_now(state, record);
        }
        self.ledger.begin_telling(record);
        let eq = Equations::on(self.model, state, self.layout);
        self.output.begin_looks(&eq, (model, state), opening, record);
    }

    /// Restores the data that an earlier run has saved in its state.
    fn take_up(&mut self, way: &FixedWay, state: &State) {
        self.senses.clone_from(&way.senses);
        self.ledger.booked = way.booked;
        self.bounds.windows.clone_from(&way.windows);
        if let Some(steps) = way.steps {
            self.horizon.steps.take_up(steps, state);
        }
    }

    /// Saves everything that the next step depends on, except the integrator's own data.
    pub(super) fn put_down(&self, way: &mut FixedWay) {
        way.senses.clone_from(&self.senses);
        way.booked = self.ledger.booked;
        way.windows.clone_from(&self.bounds.windows);
        way.steps = self.horizon.steps.so_far();
    }

    pub(super) fn touched(&self) -> u64 {
        self.ledger.touched
    }

    /// Returns the largest number of reversals that a slip memory keeps.
    pub(super) fn remembers(&self) -> usize {
        match self.cuts {
            true if self.model.has_moving_normals() => GROWING_KNOTS,
            true => KNOTS,
            false => Memory::DEFAULT_CAPACITY,
        }
    }

    pub(super) fn equations<'s>(&'s self, state: &'s State) -> Equations<'s> {
        let interval = self.branches.as_ref().filter(|branches| branches.current).map(|it| &it.interval);
        Equations { interval, ..self.plain(state) }
    }

    /// Returns the equations of motion without the closed forms of the current interval.
    fn plain<'s>(&self, state: &'s State) -> Equations<'s>
    where
        'a: 's,
    {
        Equations::on(self.model, state, self.layout)
    }

    /// Sets the goal of the run.
    pub(super) fn aim(&mut self, goal: Goal) {
        self.horizon.aim(goal);
        self.horizon.nearly = self.output.end_at(self.horizon.end);
    }

    /// Whether the run has not yet reached its goal.
    pub(super) fn goes_on(&self, state: &State) -> bool {
        state.t < self.horizon.limit()
    }

    /// Writes the current state as a row.
    pub(super) fn write_now(&mut self, state: &State, record: &mut dyn Record) {
        let eq = Equations::on(self.model, state, self.layout);
        self.output.write_now(&eq, state, record);
    }

    /// Evaluates the step length at all period ends within the step that ends at time t with components y.
    ///
    /// Ends the run at the period end at which the step length of the drive has become steady.
    pub(super) fn take_steps(&mut self, state: &State, t: f64, y: &[f64]) {
        let mut step = Between { from: (state.t, &state.y), to: (t, y), free: self.layout.free };
        let scratch = &mut self.output.components;
        if let Some(end) = self.horizon.take_periods(state, &mut step, (t, scratch)) {
            self.end_at(end);
        }
    }

    /// Sets the end of the run and of its rows, s.
    pub(super) fn end_at(&mut self, end: f64) {
        self.horizon.end = end;
        self.horizon.nearly = self.output.end_at(end);
    }

    /// Accepts the step that ends at time t with components y. Returns whether the end of the run has cut it.
    ///
    /// Fails if y is not finite, if a contact or block cannot follow its path, or if a limit is reached.
    pub(super) fn accept(
        &mut self,
        state: &mut State,
        (t, y): (f64, &[f64]),
        record: &mut dyn Record,
    ) -> Result<bool, RunError> {
        if let Some(i) = beyond(y) {
            return Err(self.model.not_finite(t, i));
        }
        let end = self.horizon.end;
        if t <= end {
            self.write(state, t, (t, y), record);
            return self.commit(state, (t, y), record).map(|()| false);
        }
        self.write(state, end, (t, y), record);
        let mut last = std::mem::take(&mut self.last);
        let step = Between { from: (state.t, &state.y), to: (t, y), free: self.layout.free };
        last.clear();
        last.extend((0..y.len()).map(|i| step.value(i, end)));
        let outcome = self.commit(state, (end, &last), record);
        self.last = last;
        outcome.map(|()| true)
    }

    /// Commits the paths of all contacts up to time t with components y.
    ///
    /// All paths are computed before any slip memory changes.
    fn commit(
        &mut self,
        state: &mut State,
        (t, y): (f64, &[f64]),
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        self.watch(state, record);
        self.move_contacts(state, t, y);
        self.write_down(state, t - state.t);
        self.ledger.commit((self.model, self.layout), t, state)?;
        self.ledger.tell(record);
        state.y.copy_from_slice(y);
        state.t = t;
        for (memory, contact) in state.memories.iter_mut().zip(&self.model.contacts) {
            memory.grow(&contact.interface, t);
        }
        self.branch(state);
        if !self.model.blocks.is_empty() {
            self.ledger.commit_blocks((self.model, self.layout), state)?;
            self.pass_guards(state, record);
        }
        state.counts.steps += 1;
        state.tally.step(Method::AskedFor);
        if self.watched {
            self.notice(state, record);
        }
        std::mem::swap(&mut self.before, &mut self.motions);
        for (c, motion) in self.before.iter().enumerate() {
            let heading = heading(&self.model.contacts[c], &state.modes[c], motion);
            // A contact at rest keeps its last sense: a stop is no reversal.
            if heading != 0.0 {
                self.senses[c] = heading;
            }
        }
        self.bounds.step(state, record)
    }

    /// Writes rows and snapshots up to time t in the step that ends at `to`.
    fn write(&mut self, state: &State, t: f64, to: (f64, &[f64]), record: &mut dyn Record) {
        if self.output.due(t) {
            let eq = Equations::on(self.model, state, self.layout);
            let mut step = Between { from: (state.t, &state.y), to, free: self.layout.free };
            self.output.take((&eq, state), &mut step, (t, 0.0), record);
        }
    }
}

/// Returns the sliding direction of a contact: the sense of its branch, otherwise the sign of its velocity u̇; 0 at rest.
///
/// At a reversal that cuts the step, rounding may give u̇ the wrong sign. The branch has the right one.
fn heading(contact: &Contact, law: &Law, motion: &Motion) -> f64 {
    match law.branch() {
        Some(branch) => branch.sense(),
        None if is_at_rest(contact, motion) => 0.0,
        None => motion.du.signum(),
    }
}

/// Whether the velocity u̇ of a contact is only rounding.
fn is_at_rest(contact: &Contact, motion: &Motion) -> bool {
    motion.du.abs() <= REST * contact.natural_velocity()
}
