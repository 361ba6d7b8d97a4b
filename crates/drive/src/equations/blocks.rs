//! What blocks read and make.
//!
//! A signal is asked for where it is read: a waveform by its piece, a block by its inputs and states at that moment. Blocks
//! have states, so their scenes are stepped by the method that knows states; a scene without blocks comes here for one
//! comparison per signal.
//!
//! A block reads waveforms, lengths and other blocks' signals, has states in y, and makes one signal that
//! bodies and strokes may follow, and efforts along the lengths it reads. All of it is worked out anew
//! whenever it is asked for: an evaluation keeps nothing, and inputs and states of a block lie on the stack,
//! at most [`MOST_OF_A_BLOCK`] of each.

use super::sum::{Sum, View};
use super::{Components, Equations};
use crate::component::{Block, Moment, Standing};
use crate::model::{MOST_OF_A_BLOCK, Wire, Wired};
use crate::state::State;
use crate::{EventKind, Sample};
use arrayvec::ArrayVec;

/// What a block reads.
pub(crate) type Inputs = ArrayVec<Sample, MOST_OF_A_BLOCK>;

impl Equations<'_> {
    /// A signal: a waveform, what a block makes, or a balanced coordinate; `y` reads a component.
    #[inline(always)]
    pub(crate) fn signal(&self, signal: usize, at: &impl View) -> Sample {
        if signal < self.pieces.len() { self.sample(signal, at.time()) } else { self.made(signal, at) }
    }

    /// What a block makes, or the place of a balanced coordinate.
    ///
    /// Blocks read only signals before their own, as the scene's check has seen to: the recursion ends.
    #[inline(never)]
    fn made(&self, signal: usize, at: &impl View) -> Sample {
        let made = signal - self.pieces.len();
        match made.checked_sub(self.blocks.len()) {
            Some(balanced) => self.balanced(balanced, at),
            None => self.ask_block(made, at, |block, standing, at| block.signal(standing, at)),
        }
    }

    /// Asks block `k` something about a moment.
    pub(crate) fn ask_block<R>(
        &self,
        k: usize,
        at: &impl View,
        ask: impl FnOnce(&dyn Block, Standing<'_, usize, Vec<f64>>, &Moment<'_, [Sample]>) -> R,
    ) -> R {
        let wired = &self.model.blocks[k];
        let (inputs, states) = (self.block_inputs(wired, at), self.block_states(k, at));
        let located = self.layout.located;
        let moment = Moment { t: at.time(), inputs: &inputs[..], states: &states, located };
        ask(wired.block(), self.blocks[k].standing(), &moment)
    }

    /// What a block reads at a moment; the scene's check has seen to it that there is room.
    pub(crate) fn block_inputs(&self, wired: &Wired, at: &impl View) -> Inputs {
        let read = |wire: &Wire| match wire {
            Wire::Signal(signal) => self.signal(*signal, at),
            Wire::Length(measure) => {
                let reading = self.read(measure, at);
                // The acceleration of a length is what is being worked out: a block does not get it.
                Sample { value: reading.value, rate: reading.rate, acceleration: 0.0 }
            }
        };
        wired.wires.iter().map(read).collect()
    }

    /// The states of block `k` at a moment.
    pub(crate) fn block_states(&self, k: usize, at: &impl View) -> ArrayVec<f64, MOST_OF_A_BLOCK> {
        let wired = &self.model.blocks[k];
        let from = self.layout.block(wired.first);
        (from..from + wired.count()).map(|i| at.component(i)).collect()
    }

    /// Value of a guard of block `k` at time t, s; `y` reads a component.
    pub(crate) fn block_guard(&self, k: usize, guard: usize, t: f64, y: impl Fn(usize) -> f64) -> f64 {
        self.ask_block(k, &Components { t, y }, |block, standing, at| block.guard(guard, standing, at))
    }

    /// What follows when a guard of block `k` has fallen in a state.
    pub(crate) fn block_next(&self, k: usize, guard: usize, state: &State) -> (EventKind, usize) {
        let at = Components { t: state.t, y: |i: usize| state.y[i] };
        self.ask_block(k, &at, |block, standing, at| block.next(guard, standing, at))
    }

    /// The law of block `k` where it is decided afresh.
    pub(crate) fn block_turn(&self, k: usize, state: &State) -> Option<(EventKind, usize)> {
        let at = Components { t: state.t, y: |i: usize| state.y[i] };
        self.ask_block(k, &at, |block, standing, at| block.turn(standing, at))
    }

    /// Moves the states of block `k` along a jump of its inputs to what these are now.
    pub(crate) fn block_jump(&self, k: usize, state: &State) -> ArrayVec<f64, MOST_OF_A_BLOCK> {
        let at = Components { t: state.t, y: |i: usize| state.y[i] };
        let mut states = self.block_states(k, &at);
        self.ask_block(k, &at, |block, standing, at| block.jump(standing, at, &mut states));
        states
    }

    /// Energy that block `k` stores, J; its columns are added to the row.
    pub(crate) fn block_columns(
        &self,
        k: usize,
        t: f64,
        y: impl Fn(usize) -> f64,
        row: &mut Vec<f64>,
    ) -> f64 {
        self.ask_block(k, &Components { t, y }, |block, standing, at| {
            block.fill(standing, at, row);
            block.energy(standing, at)
        })
    }

    /// Slopes of the states of all blocks, and what they exert. `extra` begins after the velocities.
    ///
    /// Powers (W) go into the sum: what the block takes in, and what it loses. Efforts (N) act along lengths
    /// only.
    #[inline(never)]
    pub(super) fn blocks(&self, at: &impl View, sum: &mut Sum<'_>, extra: &mut [f64]) {
        for (k, wired) in self.model.blocks.iter().enumerate().filter(|(_, wired)| wired.acts()) {
            let from = self.layout.block(wired.first) - 2 * self.layout.free;
            let mut efforts = [0.0; MOST_OF_A_BLOCK];
            let slopes = &mut extra[from..from + wired.count()];
            let powers =
                self.ask_block(k, at, |block, standing, at| block.slopes(standing, at, slopes, &mut efforts));
            sum.input += powers.input;
            sum.damping += powers.loss;
            for (wire, effort) in wired.wires.iter().zip(efforts) {
                if let Wire::Length(measure) = wire {
                    let driven = self.read(measure, at).driven;
                    sum.apply(&measure.free, driven, effort);
                }
            }
        }
    }
}
