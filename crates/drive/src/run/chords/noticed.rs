//! Events detected after a step of a run without event location.

use super::{Chords, heading};
use crate::contact::Motion;
use crate::equations::Equations;
use crate::event::{Event, EventKind, Source};
use crate::record::{Record, wants_events};
use crate::state::State;
use stickslip_contact::{ContactState, Memory};

impl Chords<'_> {
    /// Changes the laws of blocks whose event functions are negative after the step, or that choose a new law themselves.
    ///
    /// Each block handles one event function per step, the first negative one. Further negative event functions follow after later steps.
    pub(super) fn pass_guards(&mut self, state: &mut State, record: &mut dyn Record) {
        for (k, wired) in self.model.blocks.iter().enumerate() {
            let eq = Equations::on(self.model, state, self.layout, self.crossing);
            let t = state.t;
            let guards = wired.block().guards(&state.blocks[k].law);
            let down = |guard: &&usize| eq.block_guard(k, **guard, t, |i| state.y[i]) < 0.0;
            // The block's memory has been committed before: changes that it already contains cause no event.
            let fallen = guards.iter().find(down).map(|guard| eq.block_next(k, *guard, state));
            let Some((kind, law)) = fallen.or_else(|| eq.block_turn(k, state)) else { continue };
            state.blocks[k].law = law;
            if wants_events(record) {
                let event = Event { t, source: Source::Block(k), kind };
                let eq = Equations::on(self.model, state, self.layout, self.crossing);
                self.output.event(&eq, state, &event, record);
            }
        }
    }

    /// Returns the slip state of contact `c` after the last step, at motion `at`. The slip memory may not yet contain the step.
    pub(super) fn standing(&self, c: usize, memory: &Memory, at: Option<&Motion>) -> ContactState {
        let lags = self.branches.is_some();
        let at = at.filter(|_| lags).map_or(memory.apex(), Motion::apex);
        memory.preview(&self.model.contacts[c].interface, at).state
    }

    /// Reports a reversal for every sticking contact that reverses at a corner.
    ///
    /// For a slipping contact the next step reports the end of slip.
    pub(super) fn notice_turns(&mut self, state: &State, record: &mut dyn Record) {
        let ended = self.branches.iter().flat_map(|branches| &branches.ended);
        for &(c, sense) in ended {
            let was = std::mem::replace(&mut self.senses[c], sense);
            if !self.watched || was * sense >= 0.0 || self.standings[c] == ContactState::Slip {
                continue;
            }
            let event = Event { t: state.t, source: Source::Contact(c), kind: EventKind::Reversal };
            let eq = Equations::on(self.model, state, self.layout, self.crossing);
            self.output.event(&eq, state, &event, record);
        }
    }

    /// Reports the events that follow from the contacts before and after the step.
    ///
    /// The event counts of the state do not include these events, so that the state does not depend on the record.
    pub(super) fn notice(&mut self, state: &State, record: &mut dyn Record) {
        for (c, motion) in self.motions.iter().enumerate() {
            let now = self.standing(c, &state.memories[c], Some(motion));
            let was = std::mem::replace(&mut self.standings[c], now);
            let turns = self.senses[c] * heading(&state.modes[c], motion) < 0.0;
            let [begins, ends] = self.model.contacts[c].gross_slip();
            let kind = match (was, now) {
                (ContactState::Open, ContactState::Open) => continue,
                // A contact that touches in the first step was in contact from the start.
                (ContactState::Open, _) if state.counts.steps > 1 => EventKind::Touch,
                (_, ContactState::Open) => EventKind::LiftOff,
                (ContactState::Slip, now) if now != ContactState::Slip => ends,
                (was, ContactState::Slip) if was != ContactState::Slip => begins,
                _ if turns => EventKind::Reversal,
                _ => continue,
            };
            let event = Event { t: state.t, source: Source::Contact(c), kind };
            let eq = Equations::on(self.model, state, self.layout, self.crossing);
            self.output.event(&eq, state, &event, record);
        }
    }
}
