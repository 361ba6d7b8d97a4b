//! Corners of waveforms, between chords and inside them.

use super::Chords;
use crate::contact::Mode;
use crate::equations::Equations;
use crate::event::{EventKind, Source};
use crate::record::Record;
use crate::run::stored::stored;
use crate::state::State;
use crate::{Event, RunError};
use stickslip_contact::Segment;

impl Chords<'_> {
    /// Puts every waveform on the piece that holds in the middle of a step from the present time to `end`, so that a step
    /// that ends at a corner sees one side of it only. Tells whether any changed.
    ///
    /// By the middle, since either end may lie on a corner and round to its other side.
    ///
    /// Blocks turn with them. Waveforms that jump are no part of such runs.
    pub(in crate::run) fn enter(&self, state: &mut State, end: f64) -> bool {
        let middle = 0.5 * (state.t + end);
        let mut changed = false;
        for (w, waveform) in self.model.waveforms.iter().enumerate() {
            let piece = state.pieces[w];
            if (piece.start..piece.end).contains(&middle) {
                continue;
            }
            let next = match waveform.interpolation() {
                None => Some(state.piece_at(w, waveform, middle)),
                Some(_) if middle >= piece.end => state.supplied[w].take(),
                Some(_) => None,
            };
            if let Some(next) = next {
                state.pieces[w] = next;
                changed = true;
            }
        }
        if changed {
            state.choose_block_laws(self.model, self.layout);
        }
        changed
    }

    /// Moves every waveform whose piece ends now to its next piece: for steps that end at corners. Tells whether any turned.
    ///
    /// A jump is a straight path of every contact in no time; its work, what the elastic energy gains and friction takes, is
    /// booked as input. Free coordinates stay where they are.
    ///
    /// Fails where a jump leads a contact out of its row or its table.
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
        let before = if model.waveforms.iter().any(crate::Waveform::has_jumps) {
            self.settle(state);
            stored(&self.plain(state), state)
        } else {
            0.0
        };
        let mut jumps = false;
        for (w, waveform) in model.waveforms.iter().enumerate() {
            // Several pieces may end in the rounding of one moment.
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
        if jumps && record.wants_events() {
            // Corners are where their period puts them; a jump moves what is written.
            for (w, waveform) in model.waveforms.iter().enumerate() {
                if waveform.has_jumps() && state.pieces[w].start == state.t {
                    let event = Event { t: state.t, source: Source::Waveform(w), kind: EventKind::Jump };
                    let eq = Equations::on(self.model, state, self.layout, self.crossing);
                    self.output.event(&eq, state, &event, record);
                }
            }
            self.ledger.tell(record);
        }
        state.choose_block_laws(model, self.layout);
        self.branch_at_corner(state, record)
    }

    /// Contacts follow a jump; `before` is what was stored.
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
            // Its branch is chosen anew, by where it goes from here.
            state.modes[c] = Mode::Whole { sense: 0.0 };
        }
        state.jumps += stored(&self.plain(state), state) - before + friction;
        Ok(())
    }
}
