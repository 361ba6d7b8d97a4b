//! Waveform corners in runs without event location.

use super::Chords;
use crate::equations::Equations;
use crate::event::{EventKind, Source};
use crate::record::{Record, wants_events};
use crate::run::stored::stored;
use crate::state::State;
use crate::{Event, RunError};
use stickslip_contact::{Law, Segment};

impl Chords<'_> {
    /// Moves every waveform whose piece has ended to its next piece. Returns whether a corner was reached.
    ///
    /// For runs whose steps end at corners. At a jump, every contact moves along a straight path in zero time and free
    /// coordinates stay. The gain of elastic energy plus the friction work counts as input work.
    ///
    /// Fails if a jump moves a contact out of the range of its spring row or table.
    #[inline]
    pub(in crate::run) fn turn(
        &mut self,
        state: &mut State,
        record: &mut dyn Record,
    ) -> Result<bool, RunError> {
        if state.next_corner() > state.t || state.waits_for_input(self.model) {
            return Ok(false);
        }
        self.turn_all(state, record)?;
        Ok(true)
    }

    #[inline(never)]
    fn turn_all(&mut self, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
        let model = self.model;
        self.watch(state, record);
        let before = if model.waveforms.iter().any(crate::Waveform::has_jumps) {
            self.settle(state);
            stored(&self.plain(state), state)
        } else {
            0.0
        };
        let mut jumps = false;
        for (w, waveform) in model.waveforms.iter().enumerate() {
            // Several pieces may end at the same rounded time.
            while state.pieces[w].end <= state.t {
                let piece = state.pieces[w];
                let Some(next) = state.next_piece(w, waveform) else { break };
                state.pieces[w] = next;
                jumps |= waveform.jump_between(&piece, &next) != 0.0;
            }
        }
        if jumps {
            self.jump(state, before)?;
        }
        if jumps && wants_events(record) {
            // Only jumps are reported. Other corners follow from the waveform.
            for (w, waveform) in model.waveforms.iter().enumerate() {
                if waveform.has_jumps() && state.pieces[w].start == state.t {
                    let event = Event { t: state.t, source: Source::Waveform(w), kind: EventKind::Jump };
                    let eq = Equations::on(self.model, state, self.layout);
                    self.output.event(&eq, state, &event, record);
                }
            }
            self.ledger.tell(record);
        }
        self.turn_blocks(state, record);
        self.branch_at_corner(state, record)
    }

    /// Moves all contacts along a jump. `before` is the stored energy before the jump, J.
    fn jump(&mut self, state: &mut State, before: f64) -> Result<(), RunError> {
        let mut friction = 0.0;
        self.ledger.jump_blocks((self.model, self.layout), state)?;
        for (c, contact) in self.model.contacts.iter().enumerate() {
            let to = self.plain(state).motion(contact, state.t, |i| state.y[i]).apex();
            let work = state.memories[c].commit(&contact.interface, Segment::Jump(to));
            let work = contact.count * work.map_err(|source| self.model.refused(c, state.t, source))?;
            self.ledger.note(self.model, state, c, Segment::Jump(to));
            state.friction[c] += work;
            friction += work;
            // The next branch depends on the motion after the jump.
            state.modes[c] = Law::whole(0.0);
        }
        state.jumps += stored(&self.plain(state), state) - before + friction;
        Ok(())
    }
}
