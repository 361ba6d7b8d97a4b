//! Blocks of a model, connected to their inputs.
//!
//! Signals are numbered in the order waveforms, blocks. A block may read only earlier blocks, which excludes cycles. The number of inputs
//! and states is limited, so evaluations need no heap.

use super::{Balanced, Body, Measure, Model};
use crate::component::{Block, Input, Moment, SharedBlock, Standing, States};
use crate::scene::{Named, Scene, Start};
use crate::{Field, Part, Sample, SceneError, SceneFault, Waveform};

/// Largest number of inputs, and of states, of a block.
pub(crate) const MOST: usize = 8;

/// Block with its inputs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Wired {
    pub(crate) name: String,
    block: SharedBlock,
    pub(crate) wires: Vec<Wire>,
    /// Index of the block's first state among the states of all blocks.
    pub(crate) first: usize,
    pub(crate) states: States,
}

/// Source of a block's input.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Wire {
    /// Signal by its index: waveforms first, then blocks.
    Signal(usize),
    /// Length between bodies.
    Length(Measure),
}

/// Law and memory of a block.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct BlockState {
    pub(crate) law: usize,
    pub(crate) memory: Vec<f64>,
}

impl BlockState {
    pub(crate) fn standing(&self) -> Standing<'_, usize, Vec<f64>> {
        Standing { law: &self.law, memory: &self.memory }
    }
}

impl Wired {
    pub(crate) fn block(&self) -> &dyn Block {
        &*self.block.0
    }

    /// Returns whether the block has states or efforts; otherwise only its signal is evaluated.
    pub(crate) fn acts(&self) -> bool {
        self.count() > 0 || self.wires.iter().any(|wire| matches!(wire, Wire::Length(_)))
    }

    /// Returns the number of the block's states.
    pub(crate) fn count(&self) -> usize {
        self.states.scales.len()
    }
}

/// Signals that bodies and strokes may follow: waveforms, then outputs of blocks, then quasi-static coordinates.
#[derive(Clone, Copy)]
pub(crate) struct Signals<'a> {
    pub(crate) waveforms: &'a [Waveform],
    pub(crate) blocks: &'a [Wired],
    pub(crate) balanced: &'a [Balanced],
}

impl Signals<'_> {
    /// Returns the value of a signal at t = 0, where lengths between bodies are 0. Blocks read earlier signals only, so the recursion ends.
    pub(crate) fn first(&self, signal: usize) -> Sample {
        if let Some(balanced) = self.balanced(signal) {
            return Sample { value: balanced.first, rate: 0.0, acceleration: 0.0 };
        }
        let Some(block) = self.block(signal) else { return self.waveforms[signal].first() };
        let inputs = self.first_inputs(block);
        let (states, memory) = block.block().start(&inputs);
        let standing = Standing { law: &0, memory: &memory };
        block.block().signal(standing, &Moment { t: 0.0, inputs: &inputs, states: &states, located: true })
    }

    /// Returns the inputs of a block at t = 0.
    pub(crate) fn first_inputs(&self, block: &Wired) -> Vec<Sample> {
        let read = |wire: &Wire| match wire {
            Wire::Signal(signal) => self.first(*signal),
            Wire::Length(_) => Sample { value: 0.0, rate: 0.0, acceleration: 0.0 },
        };
        block.wires.iter().map(read).collect()
    }

    /// Returns the smallest and the largest value of a signal.
    ///
    /// For a block these values follow from the ranges of its inputs; a length is unbounded. For a quasi-static coordinate both are the
    /// initial position.
    pub(crate) fn range(&self, signal: usize) -> (f64, f64) {
        if let Some(balanced) = self.balanced(signal) {
            return (balanced.first, balanced.first);
        }
        let Some(block) = self.block(signal) else { return self.waveforms[signal].range() };
        let of = |wire: &Wire| match wire {
            Wire::Signal(signal) => self.range(*signal),
            Wire::Length(_) => (f64::NEG_INFINITY, f64::INFINITY),
        };
        block.block().range(&block.wires.iter().map(of).collect::<Vec<_>>())
    }

    /// Returns whether a signal jumps: a waveform by its shape, a block if it passes on jumps of its inputs.
    pub(crate) fn has_jumps(&self, signal: usize) -> bool {
        match self.block(signal) {
            Some(block) if block.block().passes_jumps() => {
                block.wires.iter().any(|wire| matches!(wire, Wire::Signal(s) if self.has_jumps(*s)))
            }
            Some(_) => false,
            None => self.waveforms.get(signal).is_some_and(Waveform::has_jumps),
        }
    }

    /// Returns the quasi-static coordinate of a signal; `None` for other signals.
    pub(crate) fn balanced(&self, signal: usize) -> Option<&'_ Balanced> {
        signal.checked_sub(self.waveforms.len() + self.blocks.len()).and_then(|b| self.balanced.get(b))
    }

    fn block(&self, signal: usize) -> Option<&Wired> {
        signal.checked_sub(self.waveforms.len()).and_then(|k| self.blocks.get(k))
    }
}

impl Model {
    /// Returns the signals of the model.
    pub(crate) fn signals(&self) -> Signals<'_> {
        Signals { waveforms: &self.waveforms, blocks: &self.blocks, balanced: &self.balanced }
    }
}

/// Connects blocks to their inputs.
///
/// Fails if a block reads a later or nonexistent signal, or has more than [`MOST`] inputs or states. Also fails if a block reads a length
/// while bodies start in equilibrium.
pub(super) fn wire(scene: &Scene, bodies: &[Body]) -> Result<Vec<Wired>, SceneError> {
    let mut wired: Vec<Wired> = Vec::with_capacity(scene.blocks.len());
    let mut first = 0;
    for (place, Named { name, part }) in scene.blocks.iter().enumerate() {
        let known = scene.waveforms.len() + place;
        let wire = |input: &Input| match *input {
            Input::Signal(signal) if signal < known => Ok(Wire::Signal(signal)),
            Input::Signal(signal) => Err(SceneFault::NoWaveform(signal).of(Part::Block(place), Field::Whole)),
            Input::Length { between, at, direction } => {
                let ends = [(between[0], at[0]), (between[1], at[1])];
                Ok(Wire::Length(Measure::between(ends, direction, bodies)))
            }
        };
        let states = part.0.states();
        let (inputs, count) = (part.0.inputs().len(), states.scales.len());
        let refused = |fault: SceneFault| Err(fault.of(Part::Block(place), Field::Whole));
        if inputs.max(count) > MOST {
            return refused(SceneFault::TooWide { most: MOST, count: inputs.max(count) });
        }
        let reads_length = || part.0.inputs().iter().any(|input| matches!(input, Input::Length { .. }));
        if scene.start == Start::Equilibrium && reads_length() {
            return refused(SceneFault::BlockInEquilibrium);
        }
        let wires = part.0.inputs().iter().map(wire).collect::<Result<_, _>>()?;
        wired.push(Wired { name: name.clone(), block: part.clone(), wires, first, states });
        first += count;
    }
    Ok(wired)
}
