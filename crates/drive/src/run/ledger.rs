//! What the contacts commit of an accepted step: the only place where memories move.
//!
//! A run clears the page, writes down one path for every contact that is to move, and commits all of it at
//! once. Whatever is not finite or out of range is refused by a memory here, with the contact's name. How
//! long a path took goes with it, from the time at which that contact's last one was written down: contacts
//! of closed form move at events only.

use crate::RunError;
use crate::component::{Passage, Refused};
use crate::contact::Mode;
use crate::equations::{Components, Equations};
use crate::event::EventKind;
use crate::model::{Model, Wired};
use crate::record::Record;
use crate::state::{Booked, Books, Layout, State};
use stickslip_contact::{Memory, Segment, Timed};

/// What the contacts commit.
pub(super) struct Ledger {
    /// Contacts, by their places, and the segments that lead them to the end of the step.
    segments: Vec<(usize, Timed<Segment>)>,
    /// Up to when that has been done.
    pub(super) booked: Booked,
    /// Turning points that commits have made or given up.
    pub(super) touched: u64,
    /// The blocks' paths.
    passages: Vec<Passage>,
    /// Blocks that a jump has led to another law, and what that is called.
    pub(super) led: Vec<(usize, EventKind)>,
    /// What was committed since the record was told last, where it wants to know.
    told: Option<Vec<(usize, Segment)>>,
}

impl Ledger {
    /// Room for a segment of every contact, and `more`.
    pub(super) fn new(model: &Model, more: usize) -> Self {
        let blank = Self {
            segments: Vec::new(),
            touched: 0,
            booked: Booked { last: Vec::new(), blocks: 0.0, books: Books::Current },
            passages: Vec::new(),
            led: Vec::new(),
            told: None,
        };
        blank.renewed(model, more)
    }

    /// The same in the room there is.
    pub(super) fn renewed(mut self, model: &Model, more: usize) -> Self {
        let passage = |wired: &Wired| Passage {
            t: 0.0,
            located: true,
            duration: 0.0,
            law: 0,
            inputs: Vec::with_capacity(wired.wires.len()),
            states: Vec::with_capacity(wired.count()),
        };
        self.segments.clear();
        self.segments.reserve(model.contacts.len() + more);
        self.booked.last.clear();
        self.booked.last.resize(model.contacts.len(), 0.0);
        (self.booked.blocks, self.booked.books) = (0.0, Books::Current);
        self.led.clear();
        self.led.reserve(model.blocks.len());
        self.passages.clear();
        self.passages.extend(model.blocks.iter().map(passage));
        Self { touched: 0, told: None, ..self }
    }

    /// Keeps what is committed from here on for a record that wants to know.
    pub(super) fn begin_telling(&mut self, record: &dyn Record) {
        self.told = record.follows().then(Vec::new);
    }

    /// Whether a record wants to know.
    pub(super) fn is_told(&self) -> bool {
        self.told.is_some()
    }

    /// Notes a path that the memory of contact `c` has committed.
    #[inline]
    pub(super) fn note(&mut self, model: &Model, state: &State, c: usize, path: Segment) {
        if let Some(told) = &mut self.told {
            told.push((c, path.shifted(state.shift(&model.contacts[c]))));
        }
    }

    /// Tells a record what was committed.
    #[inline]
    pub(super) fn tell(&mut self, record: &mut dyn Record) {
        if let Some(told) = &mut self.told {
            told.drain(..).for_each(|(c, path)| record.path(c, path));
        }
    }

    /// Begins at a time, s.
    pub(super) fn set_out(&mut self, t: f64) {
        self.booked.last.fill(t);
        self.booked.blocks = t;
    }

    /// Begins a page.
    pub(super) fn clear(&mut self) {
        self.segments.clear();
    }

    /// Writes down the path of contact `c` up to time t, s.
    ///
    /// A growing contact has several of them in a step, in order; each takes the time since the one before.
    #[inline]
    pub(super) fn push(&mut self, c: usize, t: f64, path: Segment) {
        // Since its own last path and not since the last step: a contact of closed form writes one down at
        // events only.
        let duration = t - std::mem::replace(&mut self.booked.last[c], t);
        self.segments.push((c, Timed { path, duration }));
    }

    /// All contacts move their memory to where the step ended, at time t, s.
    ///
    /// Books friction (J) of all of a contact's identical members, unless it is an integral of the run. Fails
    /// where a memory refuses its path.
    pub(super) fn commit(
        &mut self,
        (model, layout): (&Model, Layout),
        t: f64,
        state: &mut State,
    ) -> Result<(), RunError> {
        for k in 0..self.segments.len() {
            let (c, segment) = self.segments[k];
            let contact = &model.contacts[c];
            let knots = state.memories[c].knot_count();
            let is_integral = contact.slot.is_some() && layout.growing > 0;
            let whole = matches!(state.modes[c], Mode::Whole { .. });
            let by_commits = !is_integral || whole || contact.goes_straight(&state.pieces);
            // Of an integral the rest alone, which no power tells. Waveforms are still on the pieces on which the path went.
            let memory = &mut state.memories[c];
            let friction = match by_commits {
                true => memory.commit(&contact.interface, segment),
                false => memory.commit_beside_power(&contact.interface, segment),
            };
            state.friction[c] += contact.count * friction.map_err(|source| model.refused(c, t, source))?;
            // A path may make two, and of those that were there as many go; a row of springs has none.
            let made = if matches!(state.memories[c], Memory::Curve(_)) { 2 } else { 0 };
            self.touched += (knots + made).saturating_sub(state.memories[c].knot_count()) as u64;
            self.note(model, state, c, segment.path);
            // Growth that goes on joins the piece before it; anything else ends that piece.
            state.grew[c] = matches!(segment.path, Segment::Grown { .. });
        }
        Ok(())
    }

    /// All blocks move theirs to where the state is.
    ///
    /// Every accepted step, other than contacts of closed form: what a block remembers may be anything. Books
    /// what they lose, J.
    pub(super) fn commit_blocks(
        &mut self,
        (model, layout): (&Model, Layout),
        state: &mut State,
    ) -> Result<(), RunError> {
        for k in 0..model.blocks.len() {
            self.commit_block((model, layout, true), k, state)?;
        }
        self.booked.blocks = state.t;
        Ok(())
    }

    /// All blocks follow a jump of what they read: states, memory and law of each, before the next one asks for its signal.
    pub(super) fn jump_blocks(
        &mut self,
        (model, layout): (&Model, Layout),
        state: &mut State,
    ) -> Result<(), RunError> {
        self.led.clear();
        for (k, wired) in model.blocks.iter().enumerate() {
            let states = Equations::on(model, state, layout, false).block_jump(k, state);
            let from = layout.block(wired.first);
            state.y[from..from + wired.count()].copy_from_slice(&states);
            self.commit_block((model, layout, false), k, state)?;
            if let Some((kind, law)) = Equations::on(model, state, layout, false).block_turn(k, state) {
                state.blocks[k].law = law;
                self.led.push((k, kind));
            }
        }
        Ok(())
    }

    /// One of them. `crossing` says whether a piece that ends before now gives way to the one that holds.
    fn commit_block(
        &mut self,
        (model, layout, crossing): (&Model, Layout, bool),
        k: usize,
        state: &mut State,
    ) -> Result<(), RunError> {
        let (t, wired, passage) = (state.t, &model.blocks[k], &mut self.passages[k]);
        // Made here and not kept: the inputs may depend on blocks committed before.
        let equations = Equations::on(model, state, layout, crossing);
        lay_out(passage, (&equations, k), (t, &state.y), t - self.booked.blocks);
        let lost = wired.block().commit(&mut state.blocks[k].memory, passage);
        state.lost += lost.map_err(|refused| refusal(wired, t, refused))?;
        Ok(())
    }

    /// What all blocks would lose on the way to both ends of the halves of a step that is only tried, J. `kept` is room for what one of
    /// them remembers.
    pub(super) fn would_lose(
        &mut self,
        equations: &Equations<'_>,
        ends: [(f64, &[f64]); 2],
        kept: &mut Vec<f64>,
    ) -> Result<f64, RunError> {
        let mut lost = 0.0;
        for (k, wired) in equations.model.blocks.iter().enumerate() {
            let passage = &mut self.passages[k];
            kept.clone_from(&equations.blocks[k].memory);
            let mut since = self.booked.blocks;
            for (t, y) in ends {
                lay_out(passage, (equations, k), (t, y), t - since);
                lost += wired.block().commit(kept, passage).map_err(|refused| refusal(wired, t, refused))?;
                since = t;
            }
        }
        Ok(lost)
    }
}

/// Writes down the path of block `k` up to a time and components.
fn lay_out(
    passage: &mut Passage,
    (equations, k): (&Equations<'_>, usize),
    (t, y): (f64, &[f64]),
    duration: f64,
) {
    let at = Components { t, y: |i: usize| y[i] };
    passage.inputs.clear();
    passage.inputs.extend(equations.block_inputs(&equations.model.blocks[k], &at));
    passage.states.clear();
    passage.states.extend(equations.block_states(k, &at));
    (passage.t, passage.located) = (t, equations.layout.located);
    (passage.duration, passage.law) = (duration, equations.blocks[k].law);
}

fn refusal(wired: &Wired, t: f64, Refused(why): Refused) -> RunError {
    RunError::Block { t, block: wired.name.clone(), why }
}
