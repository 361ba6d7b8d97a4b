//! Steps without located events: every accepted step is one chord of every contact.
//!
//! Contacts obey their whole law, kinks and all; what happened in a step is noticed from the states at both its ends, for the
//! record alone. Between steps positions are read by the cubic through both ends, velocities and work in proportion. The
//! order of a method is that of its chords, two at best, wherever a contact turns or grows inside a step.
//!
//! For steppers without events: fixed steps and the plain reference. Contacts go by the whole law of their
//! memory, kinks and all, and the path of a step is one chord in the plane of (d, u). Growth in full stick is
//! second order at best by that, and so is every step across an event, whatever the method's name. Events are
//! noticed after the fact, for the record alone.

use super::bounds::Bounds;
use super::horizon::Horizon;
use super::ledger::Ledger;
use super::output::Output;
use crate::contact::{Mode, Motion};
use crate::equations::Equations;
use crate::event::{Event, EventKind, Source};
use crate::method::Method;
use crate::model::Model;
use crate::record::Record;
use crate::state::{Layout, State};
use crate::{Plan, RunError};
use stickslip_contact::{ContactState, Segment};

/// A run by chords: accepts steps, writes what falls between them, notices events after the fact.
pub(super) struct Chords<'a> {
    pub(super) model: &'a Model,
    pub(super) state: &'a mut State,
    pub(super) layout: Layout,
    horizon: Horizon,
    output: Output,
    ledger: Ledger,
    bounds: Bounds,
    record: &'a mut dyn Record,
    /// Sense of sliding and state of each contact after the last step.
    standings: Vec<(f64, ContactState)>,
    /// The contacts at the end of the step.
    motions: Vec<Motion>,
}

impl<'a> Chords<'a> {
    /// Chords do not carry the extra components of growing contacts.
    ///
    /// Prepares the state: energies and friction of growing contacts go into the books, shifted origins come
    /// back, and every contact is put on its whole law.
    pub(super) fn new(
        model: &'a Model,
        plan: &Plan,
        state: &'a mut State,
        record: &'a mut dyn Record,
    ) -> Self {
        // A chord's force is the memory's own: nothing has to be carried beside it.
        let layout = Layout { growing: 0, ..model.layout() };
        state.carry_over(model, layout);
        // Steps without events have no moment at which an origin could move.
        state.come_back(model);
        for mode in &mut state.modes {
            // Without a sense: a chord may turn inside its step, and the memory sees it by itself.
            *mode = Mode::Whole { sense: 0.0 };
        }
        let mut horizon = Horizon::new(model, plan);
        horizon.steps.begin(state);
        let mut output = Output::new(plan.every, layout);
        output.set_out(state.t, horizon.end);
        output.begin_looks(model, state, record);
        let (mut ledger, bounds) = (Ledger::new(model, 0), Bounds::new(model, plan.limits));
        ledger.set_out(state.t);
        let standings = vec![(0.0, ContactState::Open); model.contacts.len()];
        let motions = Vec::with_capacity(model.contacts.len());
        Self { model, state, layout, horizon, output, ledger, bounds, record, standings, motions }
    }

    pub(super) fn equations(&self) -> Equations<'_> {
        Equations::on(self.model, self.state, self.layout, true)
    }

    /// Whether the run is not at its end yet.
    pub(super) fn goes_on(&self) -> bool {
        self.state.t < self.horizon.end
    }

    /// Puts every waveform on the piece that holds in the middle of a step from the present time to `end`, so that a step
    /// that ends at a corner sees one side of it only. Tells whether any changed.
    ///
    /// By the middle, since either end may lie on a corner and round to its other side.
    pub(super) fn enter(&mut self, end: f64) -> bool {
        let middle = 0.5 * (self.state.t + end);
        let mut changed = false;
        for (piece, waveform) in self.state.pieces.iter_mut().zip(&self.model.waveforms) {
            if !(piece.start..piece.end).contains(&middle) {
                *piece = waveform.piece_at(middle);
                changed = true;
            }
        }
        changed
    }

    /// Writes the first or the last row.
    pub(super) fn write_now(&mut self) {
        let eq = Equations::on(self.model, self.state, self.layout, true);
        self.output.write_now(&eq, self.state, self.record);
    }

    /// Accepts the step that ends at t in y, or earlier where the run does.
    ///
    /// Fails where y is not finite, a contact or block refuses its path, or a limit is reached.
    pub(super) fn accept(&mut self, t: f64, y: &[f64]) -> Result<(), RunError> {
        if let Some(i) = y.iter().position(|y| !y.is_finite()) {
            return Err(self.model.not_finite(t, i));
        }
        let Some((end, last)) = self.take_steps(t, y) else {
            self.write(t, (t, y));
            return self.commit(t, y);
        };
        self.write(end, (t, y));
        self.commit(end, &last)
    }

    /// Takes the steps of the drive that are over at t; where the run ends with one of them, its time and state.
    fn take_steps(&mut self, t: f64, y: &[f64]) -> Option<(f64, Vec<f64>)> {
        while let Some(due) = self.horizon.steps.due(t) {
            let step = Step { from: (self.state.t, &self.state.y), to: (t, y), free: self.layout.free };
            if self.horizon.steps.take(0.0, step.value(self.horizon.steps.coordinate, due)) {
                self.horizon.end = due;
                self.output.end_at(due);
                return Some((due, (0..y.len()).map(|i| step.value(i, due)).collect()));
            }
        }
        None
    }

    /// Commits all contacts at time t in y.
    ///
    /// All paths are worked out before any memory moves.
    fn commit(&mut self, t: f64, y: &[f64]) -> Result<(), RunError> {
        let eq = Equations::on(self.model, self.state, self.layout, true);
        self.motions.clear();
        self.motions.extend(self.model.contacts.iter().map(|c| eq.motion(c, t, |i| y[i])));
        self.ledger.clear();
        for (c, motion) in self.motions.iter().enumerate() {
            self.ledger.push(c, t, Segment::Straight(motion.apex()));
        }
        self.ledger.commit((self.model, self.layout), t, self.state)?;
        self.state.y.copy_from_slice(y);
        self.state.t = t;
        if !self.model.blocks.is_empty() {
            self.ledger.commit_blocks((self.model, self.layout), self.state)?;
            self.pass_guards();
        }
        self.state.counts.steps += 1;
        self.state.tally.step(Method::AskedFor);
        if self.record.wants_events() {
            self.notice();
        }
        self.bounds.step(self.state, self.record)
    }

    /// Rows and looks up to time t of the step that leads to `to`.
    ///
    /// Looks are shown copies of the memories, each led on one chord to its moment.
    fn write(&mut self, t: f64, to: (f64, &[f64])) {
        let eq = Equations::on(self.model, self.state, self.layout, true);
        let step = Step { from: (self.state.t, &self.state.y), to, free: self.layout.free };
        while let Some(due) = self.output.grid.due(t) {
            self.output.grid.write(&eq, self.state, due, &|i| step.value(i, due), self.record);
        }
        while let Some(due) = self.output.looks.due(t) {
            let memories = self.model.contacts.iter().zip(&self.state.memories).map(|(contact, memory)| {
                let apex = eq.motion(contact, due, |i| step.value(i, due)).apex();
                let mut memory = memory.clone();
                memory.commit(&contact.interface, Segment::Straight(apex)).map(|_| memory)
            });
            let memories: Result<Vec<_>, _> = memories.collect();
            self.output.looks.show(memories.as_deref().ok(), self.record);
        }
    }

    /// The laws of blocks whose guards are down after the step.
    ///
    /// One guard of each block in a step, the first that is down; the others have their turn after the next
    /// step.
    fn pass_guards(&mut self) {
        for (k, wired) in self.model.blocks.iter().enumerate() {
            let eq = Equations::on(self.model, self.state, self.layout, true);
            let t = self.state.t;
            let guards = wired.block().guards(&self.state.blocks[k].law);
            let down = |guard: &&usize| eq.block_guard(k, **guard, t, |i| self.state.y[i]) < 0.0;
            let Some(&guard) = guards.iter().find(down) else { continue };
            let (kind, law) = eq.block_next(k, guard, self.state);
            self.state.blocks[k].law = law;
            if self.record.wants_events() {
                let event = Event { t, source: Source::Block(k), kind };
                let eq = Equations::on(self.model, self.state, self.layout, true);
                self.output.event(&eq, self.state, &event, self.record);
            }
        }
    }

    /// Events as they show after the step. They are the record's: the state does not count them, or it would tell
    /// whether somebody watched.
    fn notice(&mut self) {
        for (c, motion) in self.motions.iter().enumerate() {
            let contact = &self.model.contacts[c];
            let memory = &self.state.memories[c];
            let now = memory.preview(&contact.interface, memory.apex()).state;
            // At rest a contact keeps the sense it had: stopping is no reversal.
            let sense = if motion.du == 0.0 { self.standings[c].0 } else { motion.du.signum() };
            let (before, was) = std::mem::replace(&mut self.standings[c], (sense, now));
            let kind = match (was, now) {
                (ContactState::Open, ContactState::Open) => continue,
                // What is in contact after the first step has been so from the start.
                (ContactState::Open, _) if self.state.counts.steps > 1 => EventKind::Touch,
                (_, ContactState::Open) => EventKind::LiftOff,
                (ContactState::Slip, now) if now != ContactState::Slip => EventKind::GrossSlipEnds,
                (was, ContactState::Slip) if was != ContactState::Slip => EventKind::GrossSlip,
                _ if before * sense < 0.0 => EventKind::Reversal,
                _ => continue,
            };
            let event = Event { t: self.state.t, source: Source::Contact(c), kind };
            let eq = Equations::on(self.model, self.state, self.layout, true);
            self.output.event(&eq, self.state, &event, self.record);
        }
    }
}

/// A step accepted, with its components at both ends.
struct Step<'a> {
    from: (f64, &'a [f64]),
    to: (f64, &'a [f64]),
    free: usize,
}

impl Step<'_> {
    /// Component `i` at time t of the step: positions by the cubic through both ends, velocities and work in proportion.
    ///
    /// The cubic has the places and velocities of both ends.
    fn value(&self, i: usize, t: f64) -> f64 {
        let ((t0, from), (t1, to), n) = (self.from, self.to, self.free);
        if t >= t1 {
            return to[i];
        }
        let h = t1 - t0;
        let s = (t - t0) / h;
        let straight = from[i] + s * (to[i] - from[i]);
        if i >= n {
            return straight;
        }
        let (v0, v1, mean) = (from[n + i], to[n + i], (to[i] - from[i]) / h);
        straight + h * s * (1.0 - s) * ((1.0 - s) * (v0 - mean) - s * (v1 - mean))
    }
}
