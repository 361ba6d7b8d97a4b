//! All that the future of a run depends on.

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

use crate::contact::{Contact, Mode};
use crate::equations::Equations;
use crate::method::Tally;
use crate::model::{Balanced, Binding, BlockState};
use crate::scene::Axis;
use crate::{Model, Piece, RunError, record};
use stickslip_contact::{Apex, ContactError, Memory, Move};

/// State of a drive: cloneable, comparable. A run started from a copy goes on to the same bits.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Time, s.
    pub(crate) t: f64,
    /// Components in the order of [`Layout`]; positions without their shifts.
    pub(crate) y: Vec<f64>,
    /// By how much the origin of each free coordinate has moved, m: what travels far is counted from near by.
    pub(crate) shifts: Vec<f64>,
    /// What each contact remembers; displacements counted from the shifted origins.
    pub(crate) memories: Vec<Memory>,
    /// The law of each contact, set at its last event.
    pub(crate) modes: Vec<Mode>,
    /// Whether the last segment of each contact was growth that may go on smoothly.
    pub(crate) grew: Vec<bool>,
    /// Laws and memories of the blocks.
    pub(crate) blocks: Vec<BlockState>,
    /// The smooth piece each waveform is on.
    pub(crate) pieces: Vec<Piece>,
    /// Friction work of each contact booked at its commits, J.
    pub(crate) friction: Vec<f64>,
    /// Input that is not an integral over time, J: jumps; and what constant forces and prescribed normal loads had done
    /// before the start, since their work is read off the present state.
    pub(crate) jumps: f64,
    /// Work lost in blocks at their commits, J.
    pub(crate) lost: f64,
    /// Kinetic plus elastic energy at t = 0, J.
    pub(crate) origin: f64,
    /// Next step, s; 0 before the first one.
    pub(crate) step: f64,
    /// Step in use when a contact last went into gross slip, s: what comes after needs it again.
    pub(crate) stuck_step: f64,
    /// What a run has learnt; none before the first run.
    pub(crate) underway: Option<Underway>,
    /// The piece that a caller has supplied of each waveform after the present one; empty where none is an input.
    pub(crate) supplied: Vec<Option<Piece>>,
    /// What each waveform generates; empty where none is a generator.
    pub(crate) generators: Vec<Option<Generating>>,
    /// Work done so far.
    pub(crate) counts: Counts,
    /// Steps and intervals by method.
    pub(crate) tally: Tally,
}

/// Work done so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Accepted steps.
    pub steps: u64,
    /// Attempts thrown away by step control.
    pub rejected: u64,
    /// Evaluations of the equations of motion.
    pub evaluations: u64,
    /// Events.
    pub events: u64,
    /// Stretches by the whole law, where events accumulated.
    pub detours: u64,
    /// Steps of such stretches taken although their estimate missed what is allowed: where damped springs stick and slip by
    /// turns the law itself jumps, and no shorter step would do better.
    pub missed: u64,
}

/// Magnitude from which on a component of a state counts as no longer finite: energies are products of two of them and a mass or
/// a stiffness, and must be numbers.
const REACH: f64 = 1e120;

/// The first component that is no longer finite, if any.
#[inline]
pub(crate) fn beyond(y: &[f64]) -> Option<usize> {
    y.iter().position(|y| y.is_nan() || y.abs() >= REACH)
}

impl Model {
    /// The error of component `i` that is no longer finite; forces and work are laid at the first body's door.
    pub(crate) fn not_finite(&self, t: f64, i: usize) -> RunError {
        // A force or a work belongs to no coordinate.
        let free = if i < 2 * self.free.len() { i % self.free.len() } else { 0 };
        let body = self.free.get(free).map(|f| self.bodies[f.body].name.clone());
        RunError::NotFinite { t, body: body.unwrap_or_default() }
    }

    /// The error of balanced coordinate `b` that nothing balances any more: what pulls at it and what its contacts hold, N.
    pub(crate) fn unbalanced(&self, b: usize, t: f64, [load, limit]: [f64; 2]) -> RunError {
        let Balanced { body, axis, .. } = self.balanced[b];
        RunError::Unbalanced { t, body: self.bodies[body].name.clone(), axis, load, limit }
    }

    /// The error of contact `c` that cannot follow its path.
    pub(crate) fn refused(&self, c: usize, t: f64, source: ContactError) -> RunError {
        RunError::Contact { t, contact: self.contacts[c].name.clone(), source }
    }

    /// The state at t = 0, before anything is in equilibrium or classified.
    pub(crate) fn rest(&self) -> State {
        let mut state = State::blank();
        self.put_at_rest(&mut state);
        state
    }

    /// The same in the room of another state.
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
        // Not classified yet: a run chooses laws from velocities and accelerations when it begins.
        refill(&mut state.modes, contacts, Mode::Whole { sense: 0.0 });
        refill(&mut state.grew, contacts, false);
        refill(&mut state.friction, contacts, 0.0);
        (state.jumps, state.lost, state.origin, state.step) = (0.0, 0.0, 0.0, 0.0);
        // No gross slip has begun yet: its end takes nothing from the step.
        state.stuck_step = f64::INFINITY;
        state.underway = None;
        let inputs = self.waveforms.iter().any(|w| w.interpolation().is_some());
        refill(&mut state.supplied, if inputs { self.waveforms.len() } else { 0 }, None);
        state.generators = self.generators();
        state.counts = Counts::default();
        state.tally.clear(contacts);
    }

    /// The memories that contacts start with: untouched, or loaded monotonically to their starting displacement.
    fn touch(&self, memories: &mut Vec<Memory>) {
        memories.truncate(self.contacts.len());
        for (c, contact) in self.contacts.iter().enumerate() {
            let at = Apex { d: self.indentation(contact), u: 0.0 };
            match memories.get_mut(c) {
                Some(memory) => contact.engine.begin(memory, &contact.interface, at),
                None => memories.push(contact.engine.memory(&contact.interface, at)),
            }
            let to = Apex { u: contact.start, ..at };
            // Finite by the scene's checks, so the commit cannot fail.
            let _ = memories[c].commit(&contact.interface, stickslip_contact::Segment::Straight(to));
        }
    }
}

/// Makes a list so many of one value, in the room there is.
fn refill<T: Clone>(list: &mut Vec<T>, count: usize, value: T) {
    list.clear();
    list.resize(count, value);
}

impl State {
    /// Of no model yet.
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

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.t
    }

    /// What the block at this place of the scene remembers; none where there is none.
    #[must_use]
    pub fn block_memory(&self, block: usize) -> Option<&[f64]> {
        self.blocks.get(block).map(|block| block.memory.as_slice())
    }

    /// By how much u of a contact is counted from another place, m.
    pub(crate) fn shift(&self, contact: &Contact) -> f64 {
        contact.u.free.iter().map(|(i, a)| a * self.shifts[*i]).sum()
    }

    /// The memories with displacements counted from where the bodies started.
    pub(crate) fn shifted_back(&self, model: &Model) -> Vec<Memory> {
        let mut memories = self.memories.clone();
        for (memory, contact) in memories.iter_mut().zip(&model.contacts) {
            memory.shift(self.shift(contact));
        }
        memories
    }

    /// Counts u of a contact from another origin, `by` (m) further back: its memory, and the law that was made of it.
    pub(crate) fn shift_law(&mut self, c: usize, by: f64) {
        self.memories[c].shift(by);
        self.modes[c].shift(by);
    }

    /// Makes the law of a contact anew from a memory that was put in the place of its own, for a motion in the same sense; its u has
    /// grown by `by`, m.
    pub(crate) fn renew_law(&mut self, model: &Model, c: usize, by: f64) {
        let (contact, memory) = (&model.contacts[c], &self.memories[c]);
        match (&mut self.modes[c], memory.branching()) {
            (Mode::Slip(branch), Some(curve)) => {
                *branch = curve.branch(&contact.interface, branch.sense(), 0.0);
            }
            (Mode::Grow, _) => {
                let (Some(slot), layout) = (contact.slot, model.layout()) else { return };
                let now = memory.preview(&contact.interface, memory.apex());
                self.y[layout.force(slot)] = now.force;
                self.y[layout.elastic(slot)] = now.elastic;
            }
            (mode, _) => mode.shift(by),
        }
    }

    /// Counts all positions from where they started.
    pub(crate) fn come_back(&mut self, model: &Model) {
        if self.shifts.iter().all(|shift| *shift == 0.0) {
            return;
        }
        for contact in &model.contacts {
            self.shift_law(contact.place, self.shift(contact));
        }
        self.y.iter_mut().zip(&mut self.shifts).for_each(|(x, shift)| *x += std::mem::take(shift));
    }

    /// Takes over a state of another stepper's run, which carried other extra components.
    ///
    /// Forces of growing contacts are dropped: the memories have been committed, and laws are chosen anew.
    pub(crate) fn carry_over(&mut self, model: &Model, to: Layout) {
        // The same components: a run that goes on keeps its state to the last bit.
        if self.y.len() == to.total() {
            return;
        }
        let growing = if to.growing == 0 { model.growing } else { 0 };
        let from = Layout { growing, ..to };
        for (contact, friction) in model.contacts.iter().zip(&mut self.friction) {
            if let Some(slot) = contact.slot.filter(|_| growing > 0) {
                // What an integral had booked goes where commits book: no friction is lost when the stepper
                // changes.
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

    /// Lets every block choose its law afresh, by the pieces on which the waveforms are. No event: it had none before.
    pub(crate) fn choose_block_laws(&mut self, model: &Model, layout: Layout) {
        for k in 0..model.blocks.len() {
            if let Some((_, law)) = Equations::on(model, self, layout, false).block_turn(k, self) {
                self.blocks[k].law = law;
            }
        }
    }

    /// When the first piece of a waveform ends, s.
    pub(crate) fn next_corner(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.end).fold(f64::INFINITY, f64::min)
    }

    /// What a contact remembers and the mode set for it.
    pub(crate) fn law(&self, c: usize) -> (&Memory, &Mode) {
        (&self.memories[c], &self.modes[c])
    }

    /// Work done so far.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Writes the values of all channels where it stands into a row.
    pub fn write_row(&self, model: &Model, row: &mut Vec<f64>) {
        let equations = Equations::on(model, self, self.layout(model), false);
        record::fill(&equations, self, self.t, &|i| self.y[i], row);
    }

    /// The methods by which it was done.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Memories of the contacts, in the scene's order. Displacements are counted from near by: of a body that has travelled
    /// far they are not u of the rows.
    pub fn memories(&self) -> &[Memory] {
        &self.memories
    }

    /// Position (m) and velocity (m/s) along x of body `index` of the scene.
    pub fn body(&self, model: &Model, index: usize) -> Option<(f64, f64)> {
        self.coordinate(model, index, Axis::X)
    }

    /// A coordinate of body `index` of the scene and its rate; m and m/s, rad and rad/s.
    pub fn coordinate(&self, model: &Model, index: usize, axis: Axis) -> Option<(f64, f64)> {
        let place = model.bodies.get(index)?.bindings[axis as usize];
        Some(match place {
            Binding::Held(x) => (x, 0.0),
            Binding::Free(i) => (self.shifts[i] + self.y[i], self.y[model.layout().velocity(i)]),
            Binding::Driven(_) => {
                let equations = Equations::on(model, self, self.layout(model), false);
                let [value, rate] = equations.place(place, self.t, |i| self.y[i]);
                (value, rate)
            }
        })
    }

    /// Tangential force of one contact, N, as the contacts stand.
    pub fn tangential_force(&self, model: &Model, index: usize) -> Option<f64> {
        let (contact, memory) = (model.contacts.get(index)?, self.memories.get(index)?);
        Some(memory.trial(&contact.interface, Move::Chord(memory.apex())).force)
    }
}
