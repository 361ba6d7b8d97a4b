//! Components: model elements with states, event functions (guards), a memory and an energy.
//!
//! A component reads waveforms, other components and the motion of bodies. It produces a signal that bodies and actuators may follow, or
//! forces between bodies, or both. Between two events it obeys one smooth law. The event functions of a law are positive while it holds.
//! When one crosses zero, the component chooses the next law. Contacts are components; a model may contain others, each a [`Block`].
//!
//! ```text
//! inputs ──► slopes, signal, efforts      evaluation uses shared references and changes nothing
//!        ──► guards ──► next law          at an event
//!        ──► commit                       once per accepted step: the only change of the memory
//!        ──► turn, jump                   where rates of inputs may jump, and where inputs jump
//! ```

use crate::linearised::block_eigenvalues;
use crate::scene::{Direction, Point, Side};
use crate::{EventKind, Sample};
use std::fmt;
use std::sync::Arc;

/// A model element with states, event functions, a memory and an energy. It holds constants only; law and memory are arguments.
pub trait Component: fmt::Debug {
    /// Law that it obeys between two events.
    type Law;
    /// Memory of the past in addition to its states, as plain data.
    type Memory;
    /// Event function of a law.
    type Guard: Copy + PartialEq;
    /// Inputs at one time.
    type Inputs: ?Sized;
    /// Accepted path of a step.
    type Segment;
    /// Error for a path that it cannot follow.
    type Error;

    /// Returns its states and their natural scales.
    fn states(&self) -> States;

    /// Returns the event functions of a law. All are positive while the law holds.
    fn guards(&self, law: &Self::Law) -> &[Self::Guard];

    /// Returns the value of an event function.
    fn guard(
        &self,
        guard: Self::Guard,
        standing: Standing<'_, Self::Law, Self::Memory>,
        at: &Moment<'_, Self::Inputs>,
    ) -> f64;

    /// Returns the kind of the event at a zero crossing of an event function, and the law after it.
    fn next(
        &self,
        guard: Self::Guard,
        standing: Standing<'_, Self::Law, Self::Memory>,
        at: &Moment<'_, Self::Inputs>,
    ) -> (EventKind, Self::Law);

    /// Accepts the path of a step and updates the memory. Returns the dissipated work that no state contains, J.
    ///
    /// # Errors
    ///
    /// If it cannot follow the path; the memory is then unchanged.
    fn commit(&self, memory: &mut Self::Memory, segment: &Self::Segment) -> Result<f64, Self::Error>;

    /// Returns the stored energy, J.
    fn energy(&self, standing: Standing<'_, Self::Law, Self::Memory>, at: &Moment<'_, Self::Inputs>) -> f64;

    /// Returns the names of its columns with their SI units, such as `u_m`.
    fn columns(&self) -> Vec<&'static str>;
}

/// States of a component.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct States {
    /// Natural scale of each state, in its unit, above 0. Allowed errors are relative to it.
    pub scales: Vec<f64>,
    /// Number of additional integrals, on which nothing depends.
    pub integrals: usize,
}

/// Law and memory of a component at one time.
#[derive(Debug)]
pub struct Standing<'a, L, M> {
    /// Present law.
    pub law: &'a L,
    /// Present memory.
    pub memory: &'a M,
}

/// Time, inputs and states of a component at one time.
#[derive(Debug)]
pub struct Moment<'a, I: ?Sized> {
    /// Time, s.
    pub t: f64,
    /// Inputs.
    pub inputs: &'a I,
    /// States.
    pub states: &'a [f64],
    /// Whether steps end at zero crossings of event functions. Otherwise laws change at the ends of steps, up to one step late.
    pub located: bool,
}

/// Message of a block that cannot follow its inputs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused(pub String);

/// A component that is added to a [`Scene`](crate::Scene): driver electronics, hysteresis or creep, for example. Its law is a number, its
/// memory a list of numbers and its inputs are samples of signals. Law, memory and states determine its future; all are plain data.
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
    /// Returns its inputs, in the order of the samples.
    fn inputs(&self) -> &[Input];

    /// Returns the number of its laws, which are numbered from 0. Saved states with other laws are refused. By default every
    /// number is a law.
    fn laws(&self) -> usize {
        usize::MAX
    }

    /// Returns its states and its memory at t = 0, in law 0, from the inputs there. The length of the memory never changes.
    fn start(&self, inputs: &[Sample]) -> (Vec<f64>, Vec<f64>);

    /// Writes the slopes of its states and its efforts, and returns its powers. Not called for a block that has no states and
    /// reads no length.
    fn slopes(
        &self,
        standing: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
        slopes: &mut [f64],
        efforts: &mut [f64],
    ) -> Powers;

    /// Returns its output signal with the first two derivatives.
    fn signal(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> Sample;

    /// Returns the smallest and the largest value of its signal, from the ranges of its inputs.
    fn range(&self, inputs: &[(f64, f64)]) -> (f64, f64);

    /// Chooses the law anew; returns the kind of the event and the law. Called at the start of a run, and where rates of inputs
    /// may jump. Rates jump at corners of waveforms and where another block changes its law.
    ///
    /// A law that depends on the sign of a rate is chosen here, because an event function that is already negative has no zero
    /// crossing. None keeps the law.
    fn turn(
        &self,
        standing: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
    ) -> Option<(EventKind, usize)> {
        let _ = (standing, at);
        None
    }

    /// Updates its states after a jump of its inputs, a straight path in zero time. By default states do not change. A
    /// rate-independent block, whose states depend on the path only, updates them here.
    ///
    /// The memory follows by a [`commit`](Component::commit) of zero duration, the law by [`turn`](Self::turn).
    fn jump(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, states: &mut [f64]) {
        let _ = (standing, at, states);
    }

    /// Whether its signal jumps where an input jumps.
    fn passes_jumps(&self) -> bool {
        false
    }

    /// Returns the natural scale of an event function, in its unit. Rounding and nearness to zero are relative to it.
    fn guard_scale(&self, guard: usize) -> f64;

    /// Returns its natural rate, 1/s. Events much closer than its inverse count as accumulating.
    fn rate(&self) -> f64;

    /// Returns the eigenvalues λ = a + ib of its states at these inputs, as (a, b), 1/s. They limit fixed time steps.
    ///
    /// The default is the Jacobian of its slopes at the start in law 0, by finite differences. This is exact for linear slopes. A
    /// block whose rates depend on the rate of an input returns the fastest.
    fn eigenvalues(&self, inputs: &[Sample]) -> Vec<(f64, f64)> {
        block_eigenvalues(self, inputs)
    }

    /// Returns the largest number of events that one reversal of an input may cause, at least 1. They may be simultaneous; the
    /// limit for accumulating events is larger by this factor.
    fn events_per_turn(&self) -> u32 {
        1
    }

    /// Whether its output depends on a state, given by its index. False for a state that only accumulates, such as work, or that
    /// has no effect in this law. A motion can be periodic although such states are not.
    fn depends(&self, law: usize, state: usize) -> bool {
        let _ = (law, state);
        true
    }

    /// Resets accumulating states at time `t` (s). Its output does not change.
    fn count_from(&self, t: f64, states: &mut [f64], memory: &mut [f64]) {
        let _ = (t, states, memory);
    }

    /// Appends the values of its columns to a row.
    fn fill(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, row: &mut Vec<f64>);
}

/// Input of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Input {
    /// Signal by index: waveforms first, then blocks.
    Signal(usize),
    /// Displacement of a point of the first side minus that of a point of the second side, m. The effort of the block is the
    /// force on the first side along it, N; the opposite force acts on the second side.
    Length {
        /// The two sides.
        between: [Side; 2],
        /// Point on each side.
        at: [Point; 2],
        /// Direction, x or z.
        direction: Direction,
    },
}

/// Powers of a block, W.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Powers {
    /// Power supplied from outside the model.
    pub input: f64,
    /// Dissipated power.
    pub loss: f64,
}

/// Accepted path of a block in one step.
#[derive(Debug, Clone, PartialEq)]
pub struct Passage {
    /// End of the step, s.
    pub t: f64,
    /// See [`Moment::located`].
    pub located: bool,
    /// Duration of the step, s.
    pub duration: f64,
    /// Law during the step.
    pub law: usize,
    /// Inputs at the end.
    pub inputs: Vec<Sample>,
    /// States at the end.
    pub states: Vec<f64>,
}

/// Shared block. Two are equal if they refer to the same object.
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
