//! The contract of whatever has states, guards, a memory and an energy.
//!
//! A component reads what waveforms, other components and bodies do, and answers with a signal that bodies and actuators
//! may follow, with forces between bodies, or with both. Between two events it obeys one law; a guard of that law is
//! positive while it holds, and where one falls through zero the component says which law comes next. Contacts are the
//! first components; a scene may bring others, each a [`Block`].
//!
//! ```text
//! inputs ──► slopes, signal, efforts      evaluation borrows shared and leaves no trace
//!        ──► guards ──► next law          at an event
//!        ──► commit                       once per accepted step: the only thing that moves the memory
//!        ──► turn, jump                   where rates of inputs may jump, and where inputs themselves do
//! ```

use crate::linearised::block_eigenvalues;
use crate::scene::{Direction, Point, Side};
use crate::{EventKind, Sample};
use std::fmt;
use std::sync::Arc;

/// A component: constants only. What it remembers and the law it obeys are handed in.
pub trait Component: fmt::Debug {
    /// The law it obeys between two events.
    type Law;
    /// What it remembers of the past beside its states: plain data.
    type Memory;
    /// A guard.
    type Guard: Copy + PartialEq;
    /// What it reads at a moment.
    type Inputs: ?Sized;
    /// The accepted path of a step.
    type Segment;
    /// Why it cannot follow a path.
    type Error;

    /// Its states and their natural scales.
    fn states(&self) -> States;

    /// The guards of a law; all are positive while it holds.
    fn guards(&self, law: &Self::Law) -> &[Self::Guard];

    /// Value of a guard.
    fn guard(
        &self,
        guard: Self::Guard,
        standing: Standing<'_, Self::Law, Self::Memory>,
        at: &Moment<'_, Self::Inputs>,
    ) -> f64;

    /// What it means that a guard fell: the event's kind and the law after it.
    fn next(
        &self,
        guard: Self::Guard,
        standing: Standing<'_, Self::Law, Self::Memory>,
        at: &Moment<'_, Self::Inputs>,
    ) -> (EventKind, Self::Law);

    /// Accepts the path of a step: moves the memory, and gives the work lost on the way that no state counts, J.
    ///
    /// # Errors
    ///
    /// Where it cannot follow; the memory is then as it was.
    fn commit(&self, memory: &mut Self::Memory, segment: &Self::Segment) -> Result<f64, Self::Error>;

    /// Energy that it stores, J.
    fn energy(&self, standing: Standing<'_, Self::Law, Self::Memory>, at: &Moment<'_, Self::Inputs>) -> f64;

    /// Names of its columns with their SI units, such as `u_m`.
    fn columns(&self) -> Vec<&'static str>;
}

/// The states of a component.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct States {
    /// Natural scale of each, in its own unit, above 0: errors are measured against it.
    pub scales: Vec<f64>,
    /// Integrals beside them, on whose value nothing depends.
    pub integrals: usize,
}

/// What a component does and remembers.
#[derive(Debug)]
pub struct Standing<'a, L, M> {
    /// The law it obeys.
    pub law: &'a L,
    /// What it remembers.
    pub memory: &'a M,
}

/// What a component finds at a moment.
#[derive(Debug)]
pub struct Moment<'a, I: ?Sized> {
    /// Time, s.
    pub t: f64,
    /// What it reads.
    pub inputs: &'a I,
    /// Its states.
    pub states: &'a [f64],
    /// Whether steps end where a guard falls. If not, laws change at the ends of steps, late by up to one.
    pub located: bool,
}

/// A motion that a component cannot follow, in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused(pub String);

/// A component that a scene brings along: its law is a number, its memory a list of numbers, it reads samples. Law, memory
/// and states are all that its future depends on, and are plain data: as bytes they need no word of its own.
pub trait Block:
    Component<
        Law = usize,
        Memory = Vec<f64>,
        Guard = usize,
        Inputs = [Sample],
        Segment = Passage,
        Error = Refused,
    > + Send
    + Sync
{
    /// What it reads, in the order of the samples.
    fn inputs(&self) -> &[Input];

    /// How many laws it has, numbered from 0; those of a saved state beyond them are refused. By default all numbers are laws, for a
    /// block that takes any without a panic.
    fn laws(&self) -> usize {
        usize::MAX
    }

    /// Its states and its memory at t = 0, in law 0, from the inputs there. Memory keeps its length.
    fn start(&self, inputs: &[Sample]) -> (Vec<f64>, Vec<f64>);

    /// Slopes of its states, to be filled, and the forces and powers that it makes. A block that has no states and reads no length is
    /// not asked: it makes neither.
    fn slopes(
        &self,
        standing: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
        slopes: &mut [f64],
        efforts: &mut [f64],
    ) -> Powers;

    /// The signal that it makes, and its first two derivatives.
    fn signal(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> Sample;

    /// Smallest and largest value of that signal, from those of its inputs.
    fn range(&self, inputs: &[(f64, f64)]) -> (f64, f64);

    /// The law from here on where that is to be decided afresh, with the event's kind: when a run begins, and wherever the rates
    /// of its inputs may have jumped, at a corner of a waveform or where another block has changed its law.
    ///
    /// A guard that has been down all along does not fall: what goes by the sign of a rate says here which one it is. None keeps
    /// the law, and so does a block that has only one per state.
    fn turn(
        &self,
        standing: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
    ) -> Option<(EventKind, usize)> {
        let _ = (standing, at);
        None
    }

    /// Its states after its inputs have jumped to what they are at this moment: a straight path in no time. Memory follows by a
    /// [`commit`](Component::commit) of no duration, the law by [`turn`](Self::turn). States stay where they are but for those of
    /// a block that answers to how far and not how fast its inputs go.
    fn jump(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, states: &mut [f64]) {
        let _ = (standing, at, states);
    }

    /// Whether its signal jumps where an input does.
    fn passes_jumps(&self) -> bool {
        false
    }

    /// Natural scale of a guard, in its own unit: its rounding and how near to zero it is as good as there go by it.
    fn guard_scale(&self, guard: usize) -> f64;

    /// Its natural rate, 1/s: events that lie much closer together than a period of it count as accumulating.
    fn rate(&self) -> f64;

    /// Eigenvalues λ = a + ib of its states' own motions e^{λt} at these inputs, as (a, b), 1/s: they bound fixed steps. By default
    /// those of its slopes' gradient where it starts, in law 0, by differences over a scale of each state: exact where the
    /// slopes are linear in the states. A block whose states go by how fast an input goes tells the fastest.
    fn eigenvalues(&self, inputs: &[Sample]) -> Vec<(f64, f64)> {
        block_eigenvalues(self, inputs)
    }

    /// Most events that follow from one turn of an input, at least 1: they may be as close together as they like, and so many times
    /// more of them accumulate.
    fn events_per_turn(&self) -> u32 {
        1
    }

    /// Whether what it makes from here on depends on a state, by its place among its own: not where that only counts, as work done
    /// does, nor where this law puts something else in its place. A motion may be steady though such states go on.
    fn depends(&self, law: usize, state: usize) -> bool {
        let _ = (law, state);
        true
    }

    /// Begins anew, at time `t` (s), whatever it only counts. What it makes stays the same.
    fn count_from(&self, t: f64, states: &mut [f64], memory: &mut [f64]) {
        let _ = (t, states, memory);
    }

    /// Adds the values of its columns to a row.
    fn fill(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, row: &mut Vec<f64>);
}

/// What a block reads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Input {
    /// A signal: the waveform at this place of the scene, or after the last waveform the block at this place.
    Signal(usize),
    /// The displacement of a point of the first side less that of one on the second, m. The block's effort is the force
    /// on the first side along it, N; its opposite acts on the second.
    Length {
        /// The sides.
        between: [Side; 2],
        /// The point on either.
        at: [Point; 2],
        /// Along x or z.
        direction: Direction,
    },
}

/// Powers of a block, W.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Powers {
    /// What comes in from outside the scene.
    pub input: f64,
    /// What is lost.
    pub loss: f64,
}

/// The accepted path of a block through a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Passage {
    /// When it ends, s.
    pub t: f64,
    /// As in [`Moment::located`].
    pub located: bool,
    /// How long the step took, s.
    pub duration: f64,
    /// The law in the step.
    pub law: usize,
    /// The inputs at its end.
    pub inputs: Vec<Sample>,
    /// The states at its end.
    pub states: Vec<f64>,
}

/// A shared block. Two are equal if they are the same.
#[derive(Debug, Clone)]
pub struct SharedBlock(pub Arc<dyn Block>);

impl PartialEq for SharedBlock {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl<'a, L, M> Clone for Standing<'a, L, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<'a, L, M> Copy for Standing<'a, L, M> {}
