//! Waveforms at a corner.
//!
//! A corner ends a step exactly: the pieces on both sides are smooth, and no step contains parts of both. This module moves waveforms to
//! their next pieces and adds up the work of jumps. Afterwards [`laws`](super::laws) chooses the contact laws from the velocities after the
//! corner.

use super::Located;
use crate::RunError;
use crate::contact::{Contact, Motion};
use crate::equations::Equations;
use crate::event::{EventKind, Source};
use crate::model::Model;
use crate::record::Record;
use crate::run::stored::stored;
use crate::state::{Books, State};
use stickslip_contact::{Law, Segment};
use stickslip_stepper::Attempt;

/// Scratch memory for the processing of waveform corners.
#[derive(Debug, Default)]
pub(super) struct Turning {
    jumps: Jumps,
    /// Contact laws before the corner.
    pub(super) before: Vec<Law>,
    /// Waveforms that have reached a corner, and the kind of event.
    turned: Vec<(usize, EventKind)>,
    /// For each block, whether its own law or the law of an input has changed.
    pub(super) bent: Vec<bool>,
}

/// Whether any waveform jumps. Only in this case is the energy before a corner computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Jumps {
    #[default]
    Never,
    Possible,
}

impl Turning {
    pub(super) fn renewed(mut self, model: &Model) -> Self {
        let jumps = model.jumps() || model.contacts.iter().any(Contact::is_driven_normally);
        let jumps = if jumps { Jumps::Possible } else { Jumps::Never };
        self.before.clear();
        self.before.reserve(model.contacts.len());
        self.turned.clear();
        self.turned.reserve(model.waveforms.len());
        self.bent.reserve(model.blocks.len());
        Self { jumps, ..self }
    }
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Moves every waveform whose piece has ended to its next piece, and handles jumps.
    ///
    /// Events are reported afterwards, with the complete state. Fails if a load jumps beyond the largest force that can balance it.
    pub(super) fn turn_corners(
        &mut self,
        state: &mut State,
        record: &mut dyn Record,
    ) -> Result<(), RunError> {
        // The energy requires a preview of every contact, and most waveforms never jump.
        let before = match self.turning.jumps {
            Jumps::Possible => (stored(&self.setting.plain(state), state), self.laden(state)),
            Jumps::Never => (0.0, 0.0),
        };
        self.turning.before.clone_from(&state.modes);
        let turned = &mut self.turning.turned;
        turned.clear();
        for (w, waveform) in self.setting.model.waveforms.iter().enumerate() {
            // Several pieces may end at the same rounded time.
            while state.pieces[w].end <= state.t {
                let piece = state.pieces[w];
                let Some(next) = state.next_piece(w, waveform) else { break };
                state.pieces[w] = next;
                // The jump at the end of this piece; the next piece has its own.
                let jump = waveform.jump_between(&piece, &next) != 0.0;
                turned.push((w, if jump { EventKind::Jump } else { EventKind::Corner }));
            }
        }
        // The indentation d + βḋ jumps where the rate of a waveform jumps.
        let presses =
            self.presses && self.turning.jumps == Jumps::Possible && !self.turning.turned.is_empty();
        if presses || self.turning.turned.iter().any(|(_, kind)| *kind == EventKind::Jump) {
            self.jump(state, before)?;
        }
        for i in 0..self.turning.turned.len() {
            let (w, kind) = self.turning.turned[i];
            self.note(state, Source::Waveform(w), kind, record);
            // Events of blocks that the jump has caused follow it once.
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

    /// Begins supplied pieces of inputs and commanded cycles of generators that were given since the run stopped at this time.
    ///
    /// Slip memories that wait for an event commit first, because contact paths have a corner here.
    pub(super) fn turn_due(&mut self, state: &mut State, record: &mut dyn Record) -> Result<(), RunError> {
        if state.supplied.is_empty() && state.generators.is_empty() {
            return Ok(());
        }
        self.horizon.corner = self.next_corner(state);
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

    /// Moves all contacts along a jump, on a straight path in zero time.
    ///
    /// Blocks jump first, then bodies that follow a waveform or a block. Free coordinates stay, because no finite force
    /// moves a mass in zero time. The model refuses dampers between parts that jump.
    ///
    /// The work of the jump is the gain of elastic energy plus the friction work; `before` is the energy before the jump. Fails if a
    /// quasi-static body has no equilibrium after the jump, or if a contact leaves the range of its spring row or table.
    fn jump(&mut self, state: &mut State, (before, laden): (f64, f64)) -> Result<(), RunError> {
        let mut friction = 0.0;
        self.ledger.jump_blocks((self.setting.model, self.setting.layout), state)?;
        self.balance_jump(state)?;
        let (lost, jumps) = (state.lost, state.jumps);
        for (c, contact) in self.setting.model.contacts.iter().enumerate() {
            if contact.normal_damping > 0.0 {
                // The jump may close it.
                if state.modes[c].is_open() {
                    self.lose_overlap(state, c, false);
                }
                state.modes[c] = Law::whole(0.0);
            }
            let to = self.setting.plain(state).motion(contact, state.t, |i| state.y[i]).apex();
            let from = state.memories[c].apex();
            // Friction of the whole path, also where the run integrates it: there is no time to integrate over.
            let work = contact.count
                * state.memories[c]
                    .commit(&contact.interface, Segment::Jump(to))
                    .map_err(|source| self.setting.model.refused(c, state.t, source))?;
            self.ledger.note(self.setting.model, state, c, Segment::Jump(to));
            state.friction[c] += work;
            friction += work;
            // The law follows the direction of the jump. Contacts that have not moved keep theirs.
            if let (Some(branching), true) = (state.memories[c].branching(), to != from) {
                let course =
                    branching.course(state.memories[c].law(&contact.interface), to.d - from.d, to.u - from.u);
                let at = Motion { d: to.d, u: to.u, dd: to.d - from.d, du: to.u - from.u };
                self.set_law(state, c, (course, &at), 0.0);
            }
        }
        // Contacts with damping along the normal may have lost elastic energy; for prescribed indentations that is booked already.
        let lost = (state.lost - lost) - (state.jumps - jumps);
        state.jumps += stored(&self.setting.plain(state), state) - before + friction + lost;
        if !self.setting.model.balanced.is_empty() {
            // The work of loads follows from the positions and has jumped already.
            state.jumps -= self.laden(state) - laden;
        }
        Ok(())
    }

    /// Sets the contacts of quasi-static bodies to the full force law, because a jump may open or close any of them.
    ///
    /// Fails if a quasi-static body has no equilibrium after the jump.
    fn balance_jump(&self, state: &mut State) -> Result<(), RunError> {
        let model = self.setting.model;
        if model.balanced.is_empty() {
            return Ok(());
        }
        for contact in model.contacts.iter().filter(|contact| contact.balanced) {
            state.modes[contact.place] = Law::whole(0.0);
        }
        match self.setting.plain(state).overloaded(state.t, &|i| state.y[i]) {
            Some((b, forces)) => Err(model.unbalanced(b, state.t, forces)),
            None => Ok(()),
        }
    }

    /// Returns the work of loads on quasi-static coordinates that follows from their positions, J.
    fn laden(&self, state: &State) -> f64 {
        if self.setting.model.balanced.is_empty() {
            return 0.0;
        }
        self.setting.plain(state).laden(state.t, &|i| state.y[i])
    }
}
