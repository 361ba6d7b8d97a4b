//! Events detected after a step of a run without event location.

use super::{Chords, heading};
use crate::equations::Equations;
use crate::event::{Event, EventKind, Source};
use crate::record::{Record, wants_events};
use crate::state::State;
use stickslip_contact::{ContactState, Memory, SpringRow, SpringState};

impl Chords<'_> {
    /// Changes the laws of blocks whose event functions are negative after the step, or that choose a new law themselves.
    ///
    /// Each block handles one event function per step, the first negative one. Further negative event functions follow after later steps.
    pub(super) fn pass_guards(&mut self, state: &mut State, record: &mut dyn Record) {
        for (k, wired) in self.model.blocks.iter().enumerate() {
            let eq = Equations::on(self.model, state, self.layout);
            let t = state.t;
            let guards = wired.block().guards(&state.blocks[k].law);
            let down = |guard: &&usize| eq.block_guard(k, **guard, t, |i| state.y[i]) < 0.0;
            // The block's memory has been committed before: changes that it already contains cause no event.
            let fallen = guards.iter().find(down).map(|guard| eq.block_next(k, *guard, state));
            let next = fallen.or_else(|| eq.block_turn(k, state));
            self.set_block_law(state, (k, next), record);
        }
    }

    /// Chooses the laws of all blocks anew after a corner of a waveform.
    pub(super) fn turn_blocks(&mut self, state: &mut State, record: &mut dyn Record) {
        for k in 0..self.model.blocks.len() {
            let next = Equations::on(self.model, state, self.layout).block_turn(k, state);
            self.set_block_law(state, (k, next), record);
        }
    }

    /// Sets the law of block `k`, if there is another one, and reports the event.
    fn set_block_law(
        &mut self,
        state: &mut State,
        (k, next): (usize, Option<(EventKind, usize)>),
        record: &mut dyn Record,
    ) {
        let Some((kind, law)) = next else { return };
        state.blocks[k].law = law;
        if wants_events(record) {
            let event = Event { t: state.t, source: Source::Block(k), kind };
            let eq = Equations::on(self.model, state, self.layout);
            self.output.event(&eq, state, &event, record);
        }
    }

    /// Sets whether the record requests events. A record that begins to request events gets events from now on, not earlier changes.
    pub(super) fn watch(&mut self, state: &State, record: &dyn Record) {
        let was_watched = std::mem::replace(&mut self.watched, wants_events(record));
        if self.watched && !was_watched && state.counts.steps > 0 {
            for c in 0..self.standings.len() {
                self.standings[c] = self.standing(state, c);
            }
        }
    }

    /// Returns the slip state of contact `c` after the last step; sticking and partial slip are not distinguished.
    pub(super) fn standing(&self, state: &State, c: usize) -> ContactState {
        let (law, memory) = (&self.model.contacts[c].interface, &state.memories[c]);
        match (state.modes[c].branch(), memory) {
            // The slip memory may not yet contain the step.
            (Some(branch), _) if branch.is_gross() => ContactState::Slip,
            (Some(_), _) => ContactState::Partial,
            (None, Memory::Row(SpringRow { row, springs })) if law.kinetic().is_none() => {
                match row.lowest(springs, law) {
                    SpringState::Open => ContactState::Open,
                    SpringState::Stick => ContactState::Partial,
                    SpringState::SlipForward | SpringState::SlipBackward => ContactState::Slip,
                }
            }
            (None, _) => memory.preview(law, memory.apex()).state,
        }
    }

    /// Reports the events of the contacts that reverse at a corner.
    pub(super) fn notice_turns(&mut self, state: &State, record: &mut dyn Record) {
        let ended = self.branches.as_mut().map(|branches| std::mem::take(&mut branches.ended));
        let ended = ended.unwrap_or_default();
        for &(c, sense) in &ended {
            if self.watched {
                self.report(state, (c, sense), record);
            }
            self.senses[c] = sense;
        }
        if let Some(branches) = &mut self.branches {
            branches.ended = ended;
        }
    }

    /// Reports the events that follow from the contacts before and after the step.
    ///
    /// The event counts of the state do not include these events, so that the state does not depend on the record.
    pub(super) fn notice(&mut self, state: &State, record: &mut dyn Record) {
        for c in 0..self.motions.len() {
            let heading = heading(&self.model.contacts[c], &state.modes[c], &self.motions[c]);
            self.report(state, (c, heading), record);
        }
    }

    /// Reports the event of a contact that now moves with a sense, if its state has changed.
    fn report(&mut self, state: &State, (c, sense): (usize, f64), record: &mut dyn Record) {
        let now = self.standing(state, c);
        let was = std::mem::replace(&mut self.standings[c], now);
        let [begins, ends] = self.model.contacts[c].gross_slip();
        let kind = match (was, now) {
            (ContactState::Open, ContactState::Open) => return,
            // A contact that touches in the first step was in contact from the start.
            (ContactState::Open, _) if state.counts.steps > 1 => EventKind::Touch,
            (_, ContactState::Open) => EventKind::LiftOff,
            (ContactState::Slip, now) if now != ContactState::Slip => ends,
            (was, ContactState::Slip) if was != ContactState::Slip => begins,
            _ if self.senses[c] * sense < 0.0 => EventKind::Reversal,
            _ => return,
        };
        let event = Event { t: state.t, source: Source::Contact(c), kind };
        let eq = Equations::on(self.model, state, self.layout);
        self.output.event(&eq, state, &event, record);
    }
}
