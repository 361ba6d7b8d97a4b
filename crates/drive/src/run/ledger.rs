//! Commit of accepted paths to the memories of contacts and blocks.
//!
//! A run collects the paths of all contacts that move and commits them together. A slip memory refuses values that are not finite or out of
//! range; the resulting error names the contact.
//!
//! The duration of a path counts from the end of the contact's previous path. A contact with a closed-form force has paths at events only.

use crate::RunError;
use crate::component::{Passage, Refused};
use crate::equations::{Components, Equations};
use crate::event::EventKind;
use crate::model::{Model, Wired};
use crate::record::{Entry, Record};
use crate::state::{Booked, Books, Layout, State};
use stickslip_contact::{Memory, Segment};

/// Paths to be committed, and the times of the last commits.
pub(super) struct Ledger {
    /// Contact index and path segment of each path, in order of time.
    segments: Vec<(usize, Segment)>,
    /// Times up to which paths have been committed.
    pub(super) booked: Booked,
    /// Number of reversals that commits have added or removed.
    pub(super) touched: u64,
    /// Paths of the blocks.
    passages: Vec<Passage>,
    /// Blocks that a jump has moved to another law, and the events of these changes.
    pub(super) led: Vec<(usize, EventKind)>,
    /// Paths committed since the last report, for a record that requests paths.
    told: Option<Vec<(usize, Segment)>>,
}

impl Ledger {
    /// Creates storage for one segment per contact and `more` segments.
    pub(super) fn new(model: &Model, more: usize) -> Self {
        let blank = Self {
            segments: Vec::new(),
            touched: 0,
            booked: Booked { blocks: 0.0, books: Books::Current },
            passages: Vec::new(),
            led: Vec::new(),
            told: None,
        };
        blank.renewed(model, more)
    }

    /// Returns an empty ledger in the same storage.
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
        (self.booked.blocks, self.booked.books) = (0.0, Books::Current);
        self.led.clear();
        self.led.reserve(model.blocks.len());
        self.passages.clear();
        self.passages.extend(model.blocks.iter().map(passage));
        Self { touched: 0, told: None, ..self }
    }

    /// Begins to store committed paths if the record requests paths.
    pub(super) fn begin_telling(&mut self, record: &dyn Record) {
        self.told = record.wants().paths.then(Vec::new);
    }

    /// Whether the record requests the committed paths.
    pub(super) fn is_told(&self) -> bool {
        self.told.is_some()
    }

    /// Stores a path that the slip memory of contact `c` has committed, to pass it to the record.
    #[inline]
    pub(super) fn note(&mut self, model: &Model, state: &State, c: usize, path: Segment) {
        if let Some(told) = &mut self.told
            && !model.contacts[c].stop
        {
            told.push((c, path.shifted(state.shift(&model.contacts[c]))));
        }
    }

    /// Passes the stored paths to the record.
    #[inline]
    pub(super) fn tell(&mut self, record: &mut dyn Record) {
        if let Some(told) = &mut self.told {
            told.drain(..).for_each(|(c, path)| record.take(Entry::Path(c, path)));
        }
    }

    /// Sets the time of the last commit of all contacts and blocks to t, s.
    pub(super) fn set_out(&mut self, t: f64) {
        self.booked.blocks = t;
    }

    /// Removes all collected paths.
    pub(super) fn clear(&mut self) {
        self.segments.clear();
    }

    /// Adds a path of contact `c`.
    ///
    /// A contact growing in full stick has several paths in a step, in order of time.
    #[inline]
    pub(super) fn push(&mut self, c: usize, path: Segment) {
        self.segments.push((c, path));
    }

    /// Commits all collected paths of a step that ends at time t, s.
    ///
    /// Adds the friction work of all identical contacts to the state, J, unless the run integrates this work. Fails if a slip memory
    /// refuses its path.
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
            let whole = state.modes[c].is_whole();
            let by_commits = !is_integral || whole || contact.goes_straight(&state.pieces);
            // If the run integrates the friction work, only the part without a power is added here.
            let memory = &mut state.memories[c];
            let friction = match by_commits {
                true => memory.commit(&contact.interface, segment),
                false => memory.commit_beside_power(&contact.interface, segment),
            };
            state.friction[c] += contact.count * friction.map_err(|source| model.refused(c, t, source))?;
            // A path adds at most two reversals to a memory curve and none to a spring row.
            let made = if matches!(state.memories[c], Memory::Curve(_)) { 2 } else { 0 };
            self.touched += (knots + made).saturating_sub(state.memories[c].knot_count()) as u64;
            self.note(model, state, c, segment);
            // Continued growth joins the previous piece; any other path ends that piece.
            state.grew[c] = matches!(segment, Segment::Grown { .. });
        }
        Ok(())
    }

    /// Commits all blocks at the current state, after every accepted step. Adds energy lost in the blocks to the state, J.
    pub(super) fn commit_blocks(
        &mut self,
        (model, layout): (&Model, Layout),
        state: &mut State,
    ) -> Result<(), RunError> {
        for k in 0..model.blocks.len() {
            self.commit_block((model, layout), k, state)?;
        }
        self.booked.blocks = state.t;
        Ok(())
    }

    /// Moves all blocks along a jump of their inputs.
    ///
    /// A block changes its states, memory and law before the next block reads its output signal.
    pub(super) fn jump_blocks(
        &mut self,
        (model, layout): (&Model, Layout),
        state: &mut State,
    ) -> Result<(), RunError> {
        self.led.clear();
        for (k, wired) in model.blocks.iter().enumerate() {
            let states = Equations::on(model, state, layout).block_jump(k, state);
            let from = layout.block(wired.first);
            state.y[from..from + wired.count()].copy_from_slice(&states);
            self.commit_block((model, layout), k, state)?;
            if let Some((kind, law)) = Equations::on(model, state, layout).block_turn(k, state) {
                state.blocks[k].law = law;
                self.led.push((k, kind));
            }
        }
        Ok(())
    }

    /// Commits one block.
    fn commit_block(
        &mut self,
        (model, layout): (&Model, Layout),
        k: usize,
        state: &mut State,
    ) -> Result<(), RunError> {
        let (t, wired, passage) = (state.t, &model.blocks[k], &mut self.passages[k]);
        // The inputs may depend on blocks that have just been committed.
        let equations = Equations::on(model, state, layout);
        lay_out(passage, (&equations, k), (t, &state.y), t - self.booked.blocks);
        let lost = wired.block().commit(&mut state.blocks[k].memory, passage);
        state.lost += lost.map_err(|refused| refusal(wired, t, refused))?;
        Ok(())
    }

    /// Returns the energy that all blocks would lose in a trial step, J.
    ///
    /// `ends` are the ends of the two half steps. `kept` is scratch storage for the memory of a block.
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

/// Fills in the path of block `k` up to time t with components y.
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
