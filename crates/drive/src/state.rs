//! State of a drive: everything that the future of a run depends on.

mod bytes;
mod generated;
mod inputs;
mod layout;
mod underway;

pub use bytes::BytesError;
pub(crate) use generated::Generating;
pub use generated::{CommandError, Generated};
pub use inputs::InputError;
pub(crate) use layout::Layout;

pub(crate) use underway::{
    Ahead, Allowed, Booked, Books, Crawl, Detour, FixedWay, Gait, Grid, Grip, LocatedWay, Stepped, Takeoff,
    Underway, Whereabouts, Window,
};

use crate::contact::Contact;
use crate::equations::Equations;
use crate::method::Tally;
use crate::model::{Balanced, Binding, BlockState};
use crate::scene::Axis;
use crate::{Model, Piece, RunError, record};
use stickslip_contact::{Apex, ContactError, Law, Memory, Move};

/// State of a drive, which can be cloned, compared and saved. A run from a copied state gives identical bits.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Time, s.
    pub(crate) t: f64,
    /// Components of the state vector in the order of [`Layout`]; positions are relative to their shifted origins.
    pub(crate) y: Vec<f64>,
    /// Shift of the origin of each free coordinate, m. Shifts keep positions accurate over long travel.
    pub(crate) shifts: Vec<f64>,
    /// Slip memory of each contact, with displacements relative to the shifted origins.
    pub(crate) memories: Vec<Memory>,
    /// Law of each contact since its last event.
    pub(crate) modes: Vec<Law>,
    /// Whether the last path of each contact was growth in full stick that may continue.
    pub(crate) grew: Vec<bool>,
    /// Laws and memories of the blocks.
    pub(crate) blocks: Vec<BlockState>,
    /// Present smooth piece of each waveform.
    pub(crate) pieces: Vec<Piece>,
    /// Friction work of each contact from committed paths, J.
    pub(crate) friction: Vec<f64>,
    /// Input work that is not integrated over time, J: jumps, and initial values of work that is a function of the state.
    pub(crate) jumps: f64,
    /// Dissipated work of blocks from committed paths, J.
    pub(crate) lost: f64,
    /// Kinetic and elastic energy at t = 0, J.
    pub(crate) origin: f64,
    /// Length of the next step, s; 0 before the first one.
    pub(crate) step: f64,
    /// Step length before gross slip last began, s; it is used again when gross slip ends.
    pub(crate) stuck_step: f64,
    /// Working data of a run; none before the first run.
    pub(crate) underway: Option<Underway>,
    /// Next supplied piece of each input waveform; empty if the model has no inputs.
    pub(crate) supplied: Vec<Option<Piece>>,
    /// State of each generator; empty if the model has no generators.
    pub(crate) generators: Vec<Option<Generating>>,
    /// Counts of steps and events.
    pub(crate) counts: Counts,
    /// Numbers of steps and intervals by integration method.
    pub(crate) tally: Tally,
}

/// Counts of steps and events of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Number of accepted steps.
    pub steps: u64,
    /// Number of attempts that the step control rejected.
    pub rejected: u64,
    /// Number of evaluations of the equations of motion.
    pub evaluations: u64,
    /// Number of events.
    pub events: u64,
    /// Number of intervals where events accumulate and step doubling replaces event location.
    pub detours: u64,
    /// Number of steps in step doubling that were accepted above the tolerance: the force jumps where a contact breaks loose, and shorter
    /// steps do not converge.
    pub missed: u64,
}

/// Magnitude from which a component counts as not finite, because energies contain products of components.
const REACH: f64 = 1e120;

/// Returns the index of the first component that is not finite.
#[inline]
pub(crate) fn beyond(y: &[f64]) -> Option<usize> {
    y.iter().position(|y| y.is_nan() || y.abs() >= REACH)
}

impl Model {
    /// Returns the error for component `i`, which is not finite. Forces and work are attributed to the first body.
    pub(crate) fn not_finite(&self, t: f64, i: usize) -> RunError {
        // Forces and work have no coordinate.
        let free = if i < 2 * self.free.len() { i % self.free.len() } else { 0 };
        let body = self.free.get(free).map(|f| self.bodies[f.body].name.clone());
        RunError::NotFinite { t, body: body.unwrap_or_default() }
    }

    /// Returns the error for balanced coordinate `b` with its load and the limit of its contacts, N.
    pub(crate) fn unbalanced(&self, b: usize, t: f64, [load, limit]: [f64; 2]) -> RunError {
        let Balanced { body, axis, .. } = self.balanced[b];
        RunError::Unbalanced { t, body: self.bodies[body].name.clone(), axis, load, limit }
    }

    /// Returns the error for contact `c`, which cannot follow its path.
    pub(crate) fn refused(&self, c: usize, t: f64, source: ContactError) -> RunError {
        RunError::Contact { t, contact: self.contacts[c].name.clone(), source }
    }

    /// Returns the state at t = 0, before static equilibrium is solved and force laws are chosen.
    pub(crate) fn rest(&self) -> State {
        let mut state = State::blank();
        self.put_at_rest(&mut state);
        state
    }

    /// Computes the state of [`Self::rest`] in existing storage.
    pub(crate) fn put_at_rest(&self, state: &mut State) {
        let layout = self.layout();
        state.t = 0.0;
        refill(&mut state.y, layout.total(), 0.0);
        for (i, free) in self.free.iter().enumerate() {
            (state.y[i], state.y[layout.velocity(i)]) = free.start;
        }
        state.blocks.clear();
        for wired in &self.blocks {
            let (states, memory) = wired.block().start(&self.signals().first_inputs(wired));
            let from = layout.block(wired.first);
            state.y[from..from + wired.count()].copy_from_slice(&states);
            state.blocks.push(BlockState { law: 0, memory });
        }
        state.pieces.clear();
        state.pieces.extend((0..self.waveforms.len()).map(|w| self.first_piece(w)));
        self.touch(&mut state.memories);
        let contacts = self.contacts.len();
        refill(&mut state.shifts, layout.free, 0.0);
        // A run chooses laws from velocities and accelerations at its start.
        refill(&mut state.modes, contacts, Law::whole(0.0));
        refill(&mut state.grew, contacts, false);
        refill(&mut state.friction, contacts, 0.0);
        (state.jumps, state.lost, state.origin, state.step) = (0.0, 0.0, 0.0, 0.0);
        // There has been no gross slip yet.
        state.stuck_step = f64::INFINITY;
        state.underway = None;
        let inputs = self.waveforms.iter().any(|w| w.interpolation().is_some());
        refill(&mut state.supplied, if inputs { self.waveforms.len() } else { 0 }, None);
        state.generators = self.generators();
        state.counts = Counts::default();
        state.tally.clear(contacts);
    }

    /// Sets the initial slip memories of contacts: untouched, or loaded monotonically to the initial displacement.
    fn touch(&self, memories: &mut Vec<Memory>) {
        memories.truncate(self.contacts.len());
        for (c, contact) in self.contacts.iter().enumerate() {
            let at = Apex { d: self.indentation(contact), u: 0.0 };
            match memories.get_mut(c) {
                Some(memory) => contact.engine.begin(memory, &contact.interface, at),
                None => memories.push(contact.engine.memory(&contact.interface, at)),
            }
            memories[c].rest_since(-contact.rest);
            memories[c].grow(&contact.interface, 0.0);
            let to = Apex { u: contact.start, ..at };
            // Cannot fail, because the model checks ensure finite values.
            let _ = memories[c].commit(&contact.interface, stickslip_contact::Segment::Straight(to));
        }
    }
}

/// Fills a list with `count` copies of a value, reusing its memory.
fn refill<T: Clone>(list: &mut Vec<T>, count: usize, value: T) {
    list.clear();
    list.resize(count, value);
}

impl State {
    /// Returns an empty state.
    pub(crate) fn blank() -> Self {
        Self {
            t: 0.0,
            y: Vec::new(),
            shifts: Vec::new(),
            memories: Vec::new(),
            modes: Vec::new(),
            grew: Vec::new(),
            blocks: Vec::new(),
            pieces: Vec::new(),
            friction: Vec::new(),
            jumps: 0.0,
            lost: 0.0,
            origin: 0.0,
            step: 0.0,
            stuck_step: f64::INFINITY,
            underway: None,
            supplied: Vec::new(),
            generators: Vec::new(),
            counts: Counts::default(),
            tally: Tally::of(0),
        }
    }

    /// Returns the time, s.
    pub fn time(&self) -> f64 {
        self.t
    }

    /// Returns the memory of the block with this index. None if there is no such block.
    #[must_use]
    pub fn block_memory(&self, block: usize) -> Option<&[f64]> {
        self.blocks.get(block).map(|block| block.memory.as_slice())
    }

    /// Returns the shift of the origin of a contact's displacement u, m.
    pub(crate) fn shift(&self, contact: &Contact) -> f64 {
        contact.u.free.iter().map(|(i, a)| a * self.shifts[*i]).sum()
    }

    /// Returns the slip memories with displacements relative to the initial positions.
    pub(crate) fn shifted_back(&self, model: &Model) -> Vec<Memory> {
        let mut memories = self.memories.clone();
        for (memory, contact) in memories.iter_mut().zip(&model.contacts) {
            memory.shift(self.shift(contact));
        }
        memories
    }

    /// Shifts the displacements in the slip memory and the force law of contact `c` by `by` (m).
    pub(crate) fn shift_law(&mut self, c: usize, by: f64) {
        self.memories[c].shift(by);
        self.modes[c].shift(by);
    }

    /// Recomputes the force law of contact `c`, with the same sense of slip, after its memory was replaced and u increased by `by` (m).
    pub(crate) fn renew_law(&mut self, model: &Model, c: usize, by: f64) {
        let (contact, memory) = (&model.contacts[c], &self.memories[c]);
        let law = &mut self.modes[c];
        match memory.branching() {
            Some(curve) if law.branch().is_some() => {
                *law = Law::slip(curve.branch(memory.law(&contact.interface), law.sense(), 0.0));
            }
            _ if law.grows() => {
                let (Some(slot), layout) = (contact.slot, model.layout()) else { return };
                let now = memory.preview(&contact.interface, memory.apex());
                self.y[layout.force(slot)] = now.force;
                self.y[layout.elastic(slot)] = now.elastic;
            }
            _ => law.shift(by),
        }
    }

    /// Resets the origins of all displacements to the initial positions.
    pub(crate) fn come_back(&mut self, model: &Model) {
        if self.shifts.iter().all(|shift| *shift == 0.0) {
            return;
        }
        for contact in &model.contacts {
            self.shift_law(contact.place, self.shift(contact));
        }
        self.y.iter_mut().zip(&mut self.shifts).for_each(|(x, shift)| *x += std::mem::take(shift));
    }

    /// Converts a state from a run of another stepper with other components. Forces of contacts growing in full stick are dropped, because
    /// slip memories are committed and laws are chosen anew.
    pub(crate) fn carry_over(&mut self, model: &Model, to: Layout) {
        // With the same components the state keeps all its bits.
        if self.y.len() == to.total() {
            return;
        }
        let growing = if to.growing == 0 { model.growing } else { 0 };
        let from = Layout { growing, ..to };
        for (contact, friction) in model.contacts.iter().zip(&mut self.friction) {
            if let Some(slot) = contact.slot.filter(|_| growing > 0) {
                // Friction work from integrals is added to that from committed paths.
                *friction += contact.count * self.y[from.friction(slot)];
            }
        }
        let (input, damping) = (self.y[from.input()], self.y[from.damping()]);
        let own = self.y[from.block(0)..from.block(to.own)].to_vec();
        self.y.truncate(2 * to.free);
        self.y.resize(to.total(), 0.0);
        self.y[to.block(0)..to.block(to.own)].copy_from_slice(&own);
        (self.y[to.input()], self.y[to.damping()]) = (input, damping);
    }

    /// Chooses the law of every block anew for the present pieces of the waveforms, without an event.
    pub(crate) fn choose_block_laws(&mut self, model: &Model, layout: Layout) {
        for k in 0..model.blocks.len() {
            if let Some((_, law)) = Equations::on(model, self, layout).block_turn(k, self) {
                self.blocks[k].law = law;
            }
        }
    }

    /// Returns the time of the next corner of a waveform, s.
    pub(crate) fn next_corner(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.end).fold(f64::INFINITY, f64::min)
    }

    /// Returns memory and law of a contact.
    pub(crate) fn law(&self, c: usize) -> (&Memory, &Law) {
        (&self.memories[c], &self.modes[c])
    }

    /// Returns the counts of steps and events.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Writes the present values of all channels into a row.
    pub fn write_row(&self, model: &Model, row: &mut Vec<f64>) {
        let equations = Equations::on(model, self, self.layout(model));
        record::fill(&equations, self, self.t, &|i| self.y[i], row);
    }

    /// Returns the numbers of steps and intervals by integration method.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Returns the slip memories of all contacts. Displacements in them are relative to shifted origins and may differ from u in rows.
    pub fn memories(&self) -> &[Memory] {
        &self.memories
    }

    /// Returns position (m) and velocity (m/s) along x of body `index`.
    pub fn body(&self, model: &Model, index: usize) -> Option<(f64, f64)> {
        self.coordinate(model, index, Axis::X)
    }

    /// Returns a coordinate of body `index` and its rate; m and m/s, or rad and rad/s.
    pub fn coordinate(&self, model: &Model, index: usize, axis: Axis) -> Option<(f64, f64)> {
        let place = model.bodies.get(index)?.bindings[axis as usize];
        Some(match place {
            Binding::Held(x) => (x, 0.0),
            Binding::Free(i) => (self.shifts[i] + self.y[i], self.y[model.layout().velocity(i)]),
            Binding::Driven(_) => {
                let equations = Equations::on(model, self, self.layout(model));
                let [value, rate] = equations.place(place, self.t, |i| self.y[i]);
                (value, rate)
            }
        })
    }

    /// Returns the present tangential force of one contact, N.
    pub fn tangential_force(&self, model: &Model, index: usize) -> Option<f64> {
        let (contact, memory) = (model.contacts.get(index)?, self.memories.get(index)?);
        Some(memory.trial(&contact.interface, Move::Chord(memory.apex())).force)
    }
}
