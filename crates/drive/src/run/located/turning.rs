//! What waveforms do at a corner.
//!
//! A corner ends a step exactly: the pieces on both of its sides are smooth, and no step sees both. Here
//! pieces turn and jumps are booked; what contacts do after the corner is chosen in [`laws`](super::laws),
//! from the velocities to its right.

use super::Located;
use crate::RunError;
use crate::contact::{Mode, Motion};
use crate::equations::Equations;
use crate::event::{EventKind, Source};
use crate::model::Model;
use crate::record::Record;
use crate::run::stored::stored;
use crate::state::{Books, State};
use stickslip_contact::Segment;
use stickslip_stepper::Attempt;

/// What waveforms do at a corner.
#[derive(Debug, Default)]
pub(super) struct Turning {
    jumps: Jumps,
    /// Modes before the corner.
    pub(super) before: Vec<Mode>,
    /// Waveforms that turned.
    turned: Vec<(usize, EventKind)>,
    /// Of each block whether it has another law, or reads one that has: room.
    pub(super) bent: Vec<bool>,
}

/// Whether any waveform jumps: only then is the energy before a corner asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Jumps {
    #[default]
    Never,
    Possible,
}

impl Turning {
    pub(super) fn renewed(mut self, model: &Model) -> Self {
        let jumps = if model.jumps() { Jumps::Possible } else { Jumps::Never };
        self.before.clear();
        self.before.reserve(model.contacts.len());
        self.turned.clear();
        self.turned.reserve(model.waveforms.len());
        self.bent.reserve(model.blocks.len());
        Self { jumps, ..self }
    }
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Moves every waveform whose piece ends now to its next piece, and books jumps. Events are noted when all of it
    /// has happened: the state after them is whole.
    ///
    /// Fails where a load has jumped beyond what balances it.
    pub(super) fn turn_corners(
        &mut self,
        state: &mut State,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        // The energy of all contacts costs a preview of each: corners are many, and most waveforms never
        // jump.
        let before = match self.turning.jumps {
            Jumps::Possible => (stored(&self.setting.plain(state), state), self.laden(state)),
            Jumps::Never => (0.0, 0.0),
        };
        self.turning.before.clone_from(&state.modes);
        let turned = &mut self.turning.turned;
        turned.clear();
        for (w, waveform) in self.setting.model.waveforms.iter().enumerate() {
            // Several pieces may end in the rounding of one moment.
            while state.pieces[w].end <= state.t {
                let piece = state.pieces[w];
                let Some(next) = state.next_piece(w, waveform) else { break };
                state.pieces[w] = next;
                // Of the piece that ends: the next one has a jump of its own.
                let jump = waveform.jump_between(&piece, &next) != 0.0;
                turned.push((w, if jump { EventKind::Jump } else { EventKind::Corner }));
            }
        }
        if turned.iter().any(|(_, kind)| *kind == EventKind::Jump) {
            self.jump(state, before)?;
        }
        for i in 0..self.turning.turned.len() {
            let (w, kind) = self.turning.turned[i];
            self.note(state, Source::Waveform(w), kind, record);
            // What a jump has led blocks to comes after it, and once.
            if kind == EventKind::Jump {
                for i in 0..self.ledger.led.len() {
                    let (k, kind) = self.ledger.led[i];
                    self.note(state, Source::Block(k), kind, record);
                }
                self.ledger.led.clear();
            }
        }
        Ok(())
    }

    /// Turns what an input has been given, or a generator told, since the run stopped here.
    ///
    /// Memories that wait for an event come to where the state is first: their paths bend here.
    pub(super) fn turn_due(&mut self, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
        if state.supplied.is_empty() && state.generators.is_empty() {
            return Ok(());
        }
        self.horizon.corner = state.next_corner();
        if self.horizon.corner > state.t || state.waits_for_input(self.setting.model) {
            return Ok(());
        }
        if self.ledger.booked.books == Books::Behind {
            self.settle(state);
            self.ledger.booked.books = Books::Current;
        }
        self.watch.fired.clear();
        self.pass_event(state, true, record)
    }

    /// Blocks follow first, and bodies that follow a waveform or a block that passes jumps on jump: a straight path of every contact in no time. The work of the jump is what
    /// the elastic energy, `before` until now, gains and friction takes.
    ///
    /// Free coordinates stay where they are: in no time no finite force moves a mass. Links and contacts with
    /// dampers are refused by the model where something they join jumps.
    ///
    /// Fails where nothing balances what has jumped, and where it leads a contact out of its row or its table.
    fn jump(&mut self, state: &mut State, (before, laden): (f64, f64)) -> Result<(), RunError> {
        let mut friction = 0.0;
        self.ledger.jump_blocks((self.setting.model, self.setting.layout), state)?;
        self.balance_jump(state)?;
        for (c, contact) in self.setting.model.contacts.iter().enumerate() {
            let to = self.setting.plain(state).motion(contact, state.t, |i| state.y[i]).apex();
            let from = state.memories[c].apex();
            // Friction of the whole path, for contacts that integrate theirs too: no time passes to integrate
            // over.
            let work = contact.count
                * state.memories[c]
                    .commit(&contact.interface, Segment::Jump(to))
                    .map_err(|source| self.setting.model.refused(c, state.t, source))?;
            self.ledger.note(self.setting.model, state, c, Segment::Jump(to));
            state.friction[c] += work;
            friction += work;
            // The law follows the way of the jump; a contact that the jump did not move keeps its own.
            if let (Some(branching), true) = (state.memories[c].branching(), to != from) {
                let course = branching.course(&contact.interface, to.d - from.d, to.u - from.u);
                let at = Motion { d: to.d, u: to.u, dd: to.d - from.d, du: to.u - from.u };
                self.set_law(state, c, (course, &at), 0.0);
            }
        }
        state.jumps += stored(&self.setting.plain(state), state) - before + friction;
        if !self.setting.model.balanced.is_empty() {
            // Read off the places, the work of loads has jumped already.
            state.jumps -= self.laden(state) - laden;
        }
        Ok(())
    }

    /// Puts the contacts of balanced bodies on the whole law of their memories: a jump may close or open whatever it likes,
    /// and its end is where that law balances.
    fn balance_jump(&self, state: &mut State) -> Result<(), RunError> {
        let model = self.setting.model;
        if model.balanced.is_empty() {
            return Ok(());
        }
        for contact in model.contacts.iter().filter(|contact| contact.balanced) {
            state.modes[contact.place] = Mode::Whole { sense: 0.0 };
        }
        match self.setting.plain(state).overloaded(state.t, &|i| state.y[i]) {
            Some((b, forces)) => Err(model.unbalanced(b, state.t, forces)),
            None => Ok(()),
        }
    }

    /// Work of loads on balanced coordinates that is read off their places, J.
    fn laden(&self, state: &State) -> f64 {
        if self.setting.model.balanced.is_empty() {
            return 0.0;
        }
        self.setting.plain(state).laden(state.t, &|i| state.y[i])
    }
}
