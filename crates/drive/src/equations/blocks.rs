//! Inputs and outputs of blocks.
//!
//! A block reads waveforms, lengths between bodies and signals of other blocks. A block has states in the state vector, one output signal,
//! and efforts along the lengths. Inputs and states of a block are stored on the stack, at most [`MOST_OF_A_BLOCK`] of each. Models with
//! blocks are integrated by methods that evaluate all states.

use super::sum::{Once, Sum, View};
use super::{Components, Equations};
use crate::component::{Block, Moment, Standing};
use crate::model::{MOST_OF_A_BLOCK, Wire, Wired};
use crate::state::State;
use crate::{EventKind, Sample};
use arrayvec::ArrayVec;

/// Samples of the inputs of a block.
pub(crate) type Inputs = ArrayVec<Sample, MOST_OF_A_BLOCK>;

/// Largest number of outputs that are computed once for an evaluation. Further ones are computed for each reader.
const MOST_OUTPUTS: usize = 16;

/// Outputs of blocks, then of quasi-static coordinates.
pub(super) type Outputs = ArrayVec<Sample, MOST_OUTPUTS>;

impl Equations<'_> {
    /// Returns the value of a signal: a waveform, the output of a block, or a quasi-static coordinate.
    #[inline(always)]
    pub(crate) fn signal(&self, signal: usize, at: &impl View) -> Sample {
        if signal < self.pieces.len() { self.sample(signal, at.time()) } else { self.made(signal, at) }
    }

    /// Returns the output of a block, or the position of a quasi-static coordinate.
    ///
    /// Blocks read only signals with a smaller index, as the model check ensures, so the recursion ends.
    #[inline(never)]
    pub(super) fn made(&self, signal: usize, at: &impl View) -> Sample {
        let made = signal - self.pieces.len();
        at.output(made).unwrap_or_else(|| self.make(made, at))
    }

    /// Computes outputs of blocks and quasi-static coordinates, the first ones if they are many.
    pub(super) fn compute_outputs(&self, at: &impl View, outputs: &mut Outputs) {
        let count = self.blocks.len() + self.model.balanced.len();
        for made in 0..count.min(MOST_OUTPUTS) {
            let output = self.make(made, &Once { at, outputs });
            outputs.push(output);
        }
    }

    fn make(&self, made: usize, at: &impl View) -> Sample {
        match made.checked_sub(self.blocks.len()) {
            Some(balanced) => self.balanced(balanced, at),
            None => self.ask_block(made, at, |block, standing, at| block.signal(standing, at)),
        }
    }

    /// Calls the function `ask` with block `k`, its law, memory, inputs and states.
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

    /// Returns the inputs of a block. The checks of the model limit the number of inputs.
    pub(crate) fn block_inputs(&self, wired: &Wired, at: &impl View) -> Inputs {
        let read = |wire: &Wire| match wire {
            Wire::Signal(signal) => self.signal(*signal, at),
            Wire::Length(measure) => {
                let reading = self.read(measure, at);
                // The acceleration of a length depends on this evaluation and is not available.
                Sample { value: reading.value, rate: reading.rate, acceleration: 0.0 }
            }
        };
        wired.wires.iter().map(read).collect()
    }

    /// Returns the states of block `k`.
    pub(crate) fn block_states(&self, k: usize, at: &impl View) -> ArrayVec<f64, MOST_OF_A_BLOCK> {
        let wired = &self.model.blocks[k];
        let from = self.layout.block(wired.first);
        (from..from + wired.count()).map(|i| at.component(i)).collect()
    }

    /// Returns the value of an event function of block `k` at time t (s); `y` returns a component of the state.
    pub(crate) fn block_guard(&self, k: usize, guard: usize, t: f64, y: impl Fn(usize) -> f64) -> f64 {
        self.ask_block(k, &Components { t, y }, |block, standing, at| block.guard(guard, standing, at))
    }

    /// Returns the kind of event and the new law after a zero crossing of an event function of block `k`.
    pub(crate) fn block_next(&self, k: usize, guard: usize, state: &State) -> (EventKind, usize) {
        let at = Components { t: state.t, y: |i: usize| state.y[i] };
        self.ask_block(k, &at, |block, standing, at| block.next(guard, standing, at))
    }

    /// Returns the kind of event and the new law if block `k` changes its law at a jump of an input rate.
    pub(crate) fn block_turn(&self, k: usize, state: &State) -> Option<(EventKind, usize)> {
        let at = Components { t: state.t, y: |i: usize| state.y[i] };
        self.ask_block(k, &at, |block, standing, at| block.turn(standing, at))
    }

    /// Returns the states of block `k` after a jump of its inputs.
    pub(crate) fn block_jump(&self, k: usize, state: &State) -> ArrayVec<f64, MOST_OF_A_BLOCK> {
        let at = Components { t: state.t, y: |i: usize| state.y[i] };
        let mut states = self.block_states(k, &at);
        self.ask_block(k, &at, |block, standing, at| block.jump(standing, at, &mut states));
        states
    }

    /// Returns the stored energy of block `k`, J, and appends the values of the block's columns to the row.
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

    /// Writes the state derivatives of all blocks and adds their forces. `extra` is the part of the slopes after the velocities.
    ///
    /// The supplied and dissipated power (W) of blocks is added to the sum. Efforts (N) act along lengths between bodies only.
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
