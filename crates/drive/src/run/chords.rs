//! Steps without located events: every accepted step is one chord of every contact.
//!
//! Contacts obey their whole law, kinks and all; what happened in a step is noticed from the states at both its ends, for the
//! record alone. Between steps positions are read by the cubic through both ends, velocities and work in proportion. The
//! order of a method is that of its chords, two at best, wherever a contact turns or grows inside a step.

mod branches;
mod corners;
mod noticed;
mod step;
mod way;

use super::bounds::Bounds;
use super::horizon::{Goal, Horizon};
use super::ledger::Ledger;
use super::output::{Opening, Output};
use crate::contact::{Contact, Mode, Motion};
use crate::equations::Equations;
use crate::method::Method;
use crate::model::Model;
use crate::record::Record;
use crate::state::{FixedWay, Layout, State, Underway, beyond};
use crate::{Plan, RunError, Stepper};
pub(super) use branches::Weakening;
use branches::{Branches, GROWING_KNOTS, KNOTS};
pub(super) use step::Between;
use stickslip_contact::{ContactState, Memory, Segment};

/// A run by chords: accepts steps, writes what falls between them, notices events after the fact.
pub(super) struct Chords<'a> {
    pub(super) model: &'a Model,
    pub(super) layout: Layout,
    pub(super) horizon: Horizon,
    pub(super) output: Output,
    ledger: Ledger,
    pub(super) bounds: Bounds,
    /// Sense in which each contact slid last; 0 before it did.
    senses: Vec<f64>,
    /// State of each contact after the last step, where somebody watches.
    standings: Vec<ContactState>,
    /// Whether somebody did at the last step.
    watched: bool,
    /// Whether a step may cross corners of waveforms, and see both sides; otherwise it ends there.
    pub(super) crossing: bool,
    /// Of frames: branches that contacts keep to.
    branches: Option<Branches<'a>>,
    /// Whether springs of any contact are damped.
    is_damped: bool,
    /// The contacts at both ends of the step.
    before: Vec<Motion>,
    motions: Vec<Motion>,
    /// The components where a run ends inside the step.
    last: Vec<f64>,
}

impl<'a> Chords<'a> {
    /// Chords do not carry the extra components of growing contacts.
    pub(super) fn new(model: &'a Model, plan: &Plan) -> Self {
        // A chord's force is the memory's own: nothing has to be carried beside it.
        let layout = Layout { growing: 0, located: false, ..model.layout() };
        Self {
            horizon: Horizon::new(model, plan),
            output: Output::new(plan.every, layout),
            // A contact that turns in a step has a path to where it does, and one from there.
            ledger: Ledger::new(model, model.contacts.len()),
            bounds: Bounds::new(model, plan.limits, 0.0, Vec::new()),
            senses: vec![0.0; model.contacts.len()],
            standings: vec![ContactState::Open; model.contacts.len()],
            watched: false,
            crossing: !plan.stepper.ends_at_corners(),
            branches: match plan.stepper {
                Stepper::Frames { accuracy, .. } => Some(Branches::of(model, accuracy)),
                _ => None,
            },
            is_damped: model.contacts.iter().any(Contact::is_damped),
            before: Vec::with_capacity(model.contacts.len()),
            motions: Vec::with_capacity(model.contacts.len()),
            last: Vec::with_capacity(layout.total()),
            model,
            layout,
        }
    }

    /// Prepares a state: energies and friction of growing contacts go into the books, shifted origins come back, and every
    /// contact is put on its whole law.
    pub(super) fn set_out(&mut self, state: &mut State, opening: Opening, record: &mut dyn Record) {
        let model = self.model;
        state.carry_over(model, self.layout);
        // Steps without events have no moment at which an origin could move.
        state.come_back(model);
        let goes_on = matches!(state.underway, Some(Underway::Fixed(_)));
        if self.branches.is_none() || !goes_on {
            // Without a sense: a chord may turn inside its step, and the memory sees it by itself.
            state.modes.fill(Mode::Whole { sense: 0.0 });
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
        let eq = Equations::on(self.model, state, self.layout, self.crossing);
        self.output.begin_looks(&eq, (model, state), opening, record);
    }

    /// Goes on from what another run put down.
    fn take_up(&mut self, way: &FixedWay, state: &State) {
        self.senses.clone_from(&way.senses);
        self.ledger.booked.copy(&way.booked);
        self.bounds.windows.clone_from(&way.windows);
        if let Some(steps) = way.steps {
            self.horizon.steps.take_up(steps, state);
        }
    }

    /// Puts down what the next step depends on, but for what its method knows.
    pub(super) fn put_down(&self, way: &mut FixedWay) {
        way.senses.clone_from(&self.senses);
        way.booked.copy(&self.ledger.booked);
        way.windows.clone_from(&self.bounds.windows);
        way.steps = self.horizon.steps.so_far();
    }

    pub(super) fn touched(&self) -> u64 {
        self.ledger.touched
    }

    /// How many turning points a contact remembers.
    pub(super) fn remembers(&self) -> usize {
        match &self.branches {
            Some(_) if self.model.has_moving_normals() => GROWING_KNOTS,
            Some(_) => KNOTS,
            None => Memory::DEFAULT_CAPACITY,
        }
    }

    pub(super) fn equations<'s>(&'s self, state: &'s State) -> Equations<'s> {
        let interval = self.branches.as_ref().filter(|branches| branches.current).map(|it| &it.interval);
        Equations { interval, ..self.plain(state) }
    }

    /// The same by the general law alone.
    fn plain<'s>(&self, state: &'s State) -> Equations<'s>
    where
        'a: 's,
    {
        Equations::on(self.model, state, self.layout, self.crossing)
    }

    /// Goes as far as a goal says.
    pub(super) fn aim(&mut self, goal: Goal) {
        self.horizon.aim(goal);
        self.horizon.nearly = self.output.end_at(self.horizon.end);
    }

    /// Whether the run is not at its end yet.
    pub(super) fn goes_on(&self, state: &State) -> bool {
        state.t < self.horizon.limit()
    }

    /// Writes the row of where the run stands.
    pub(super) fn write_now(&mut self, state: &State, record: &mut dyn Record) {
        let eq = Equations::on(self.model, state, self.layout, self.crossing);
        self.output.write_now(&eq, state, record);
    }

    /// Whether the step that ends at t in y would end the run: because it goes that far, or because the steps of the drive are
    /// constant with it.
    pub(super) fn take_steps(&mut self, state: &State, t: f64, y: &[f64]) {
        while let Some(due) = self.horizon.steps.due(t) {
            let step = Between { from: (state.t, &state.y), to: (t, y), free: self.layout.free };
            if self.horizon.steps.take(0.0, step.value(self.horizon.steps.coordinate, due)) {
                self.end_at(due);
                return;
            }
        }
    }

    /// Ends the run, and its rows, at another time, s.
    pub(super) fn end_at(&mut self, end: f64) {
        self.horizon.end = end;
        self.horizon.nearly = self.output.end_at(end);
    }

    /// Accepts the step that ends at t in y, or earlier where the run does; tells whether it was cut there.
    ///
    /// Fails where y is not finite, a contact or block refuses its path, or a limit is reached.
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

    /// Commits all contacts at time t in y.
    ///
    /// All paths are worked out before any memory moves.
    fn commit(
        &mut self,
        state: &mut State,
        (t, y): (f64, &[f64]),
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        let was_watched = std::mem::replace(&mut self.watched, record.wants_events());
        if self.watched && !was_watched && state.counts.steps > 0 {
            // Who begins to watch sees what happens from here on, not how the contacts came to be where they are.
            for (c, memory) in state.memories.iter().enumerate() {
                self.standings[c] = self.standing(c, memory, self.before.get(c));
            }
        }
        self.move_contacts(state, t, y);
        self.write_down(state, (t, t - state.t));
        self.ledger.commit((self.model, self.layout), t, state)?;
        self.ledger.tell(record);
        state.y.copy_from_slice(y);
        state.t = t;
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
            let heading = heading(&state.modes[c], motion);
            // At rest a contact keeps the sense it had: stopping is no reversal.
            if heading != 0.0 {
                self.senses[c] = heading.signum();
            }
        }
        self.bounds.step(state, record)
    }

    /// Rows and looks up to time t of the step that leads to `to`.
    ///
    /// Looks are shown copies of the memories, each led on one chord to its moment.
    fn write(&mut self, state: &State, t: f64, to: (f64, &[f64]), record: &mut dyn Record) {
        let eq = Equations::on(self.model, state, self.layout, self.crossing);
        let step = Between { from: (state.t, &state.y), to, free: self.layout.free };
        while let Some(due) = self.output.grid.due(t) {
            self.output.grid.write(&eq, state, due, &|i| step.value(i, due), record);
        }
        while let Some(due) = self.output.marks.due(t) {
            self.output.marks.write(&eq, state, due, &|i| step.value(i, due), record);
        }
        if self.output.marks.watches() {
            let point =
                |i: usize| [t, state.shifts[i] + step.value(i, t), step.value(self.layout.velocity(i), t)];
            self.output.marks.pass(state, point);
            self.output.marks.end_step();
        }
        while let Some(due) = self.output.looks.due(t) {
            let memories = self.model.contacts.iter().zip(&state.memories).map(|(contact, memory)| {
                let apex = eq.motion(contact, due, |i| step.value(i, due)).apex();
                let mut memory = memory.clone();
                memory.commit(&contact.interface, Segment::Straight(apex)).map(|_| memory)
            });
            let memories: Result<Vec<_>, _> = memories.collect();
            self.output.looks.show(memories.as_deref().ok(), record);
        }
    }
}

/// Which way a contact goes: by its branch where it keeps to one, for where a step is cut at a turn the last bit of its rate may
/// still say otherwise.
pub(super) fn heading(mode: &Mode, motion: &Motion) -> f64 {
    match mode {
        Mode::Slip(branch) => branch.sense(),
        _ => motion.du,
    }
}
