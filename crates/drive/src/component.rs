//! Components: model elements with states, event functions (guards), path-dependent memory and an energy.
//!
//! A component reads waveforms, other components and the motion of bodies. A component produces a signal that bodies may follow, forces
//! between bodies, or both. Between two events a component obeys one smooth law. The event functions of a law are positive while the law
//! holds. When an event function crosses zero, the component changes its law. Contacts and [`Block`]s are components.
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

/// Model element with states, event functions, memory of its past and energy. The type holds constants only; law and memory are arguments.
pub trait Component: fmt::Debug {
    /// Law that the component obeys between two events.
    type Law;
    /// Path-dependent memory of the component in addition to its states, as plain data.
    type Memory;
    /// Event function of a law.
    type Guard: Copy + PartialEq;
    /// Inputs at one time.
    type Inputs: ?Sized;
    /// Path of the component's inputs in one accepted step.
    type Segment;
    /// Error for a path that the component cannot follow.
    type Error;

    /// Returns the states of the component with their natural scales.
    fn states(&self) -> States;

    /// Returns the event functions of a law. All these functions are positive while the law holds.
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

    /// Accepts the path of a step and updates the memory. Returns the dissipated work that is not an integral in the state vector, J.
    ///
    /// # Errors
    ///
    /// Returns an error if the component cannot follow the path; the memory is then unchanged.
    fn commit(&self, memory: &mut Self::Memory, segment: &Self::Segment) -> Result<f64, Self::Error>;

    /// Returns the stored energy, J.
    fn energy(&self, standing: Standing<'_, Self::Law, Self::Memory>, at: &Moment<'_, Self::Inputs>) -> f64;

    /// Returns the names of the component's output columns with SI units, such as `u_m`.
    fn columns(&self) -> Vec<&'static str>;
}

/// States of a component.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct States {
    /// Natural scale of each state, in its unit, above 0. The error tolerance of a state is relative to this scale.
    pub scales: Vec<f64>,
    /// Number of additional integrals (such as work) that do not influence the motion.
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
    /// Whether steps end at zero crossings of event functions. If false, laws change at the ends of steps, up to one step late.
    pub located: bool,
}

/// Error message of a block that cannot follow its inputs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused(pub String);

/// Component that users add to a [`Scene`](crate::Scene): driver electronics, hysteresis or creep, for example. A block's law is a number,
/// its memory a list of numbers, and its inputs are samples of signals. Law, memory and states determine the block's future behaviour.
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
    /// Returns the inputs of the block, in the order of the samples.
    fn inputs(&self) -> &[Input];

    /// Returns the number of laws of the block, numbered from 0. A saved state with a law outside this range is refused. By default any
    /// number is accepted.
    fn laws(&self) -> usize {
        usize::MAX
    }

    /// Returns the states and the memory of the block at t = 0, in law 0, for given inputs. The length of the memory never changes.
    fn start(&self, inputs: &[Sample]) -> (Vec<f64>, Vec<f64>);

    /// Writes the time derivatives of the block's states and its efforts (forces), and returns its powers. The method is not called for a
    /// block without states and without [`Input::Length`].
    fn slopes(
        &self,
        standing: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
        slopes: &mut [f64],
        efforts: &mut [f64],
    ) -> Powers;

    /// Returns the output signal of the block with its first two time derivatives.
    fn signal(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>) -> Sample;

    /// Returns the smallest and the largest value of the output signal for given ranges of the inputs.
    fn range(&self, inputs: &[(f64, f64)]) -> (f64, f64);

    /// Chooses the law again and returns the kind of the event with the new law; `None` keeps the present law. The method is called where
    /// rates of inputs may jump: at the start of a run, at corners of waveforms, and where another block changes its law.
    ///
    /// A law that depends on the sign of a rate must be chosen in this method, because an already negative event function has no zero
    /// crossing.
    fn turn(
        &self,
        standing: Standing<'_, usize, Vec<f64>>,
        at: &Moment<'_, [Sample]>,
    ) -> Option<(EventKind, usize)> {
        let _ = (standing, at);
        None
    }

    /// Updates the states after a jump of the inputs, which counts as a straight path in zero time. By default the states do not change. A
    /// rate-independent block, whose states depend on the path of the inputs only, updates its states in this method.
    ///
    /// After the jump, a [`commit`](Component::commit) of zero duration updates the memory, and [`turn`](Self::turn) the law.
    fn jump(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, states: &mut [f64]) {
        let _ = (standing, at, states);
    }

    /// Returns whether the output signal jumps where an input jumps.
    fn passes_jumps(&self) -> bool {
        false
    }

    /// Returns the natural scale of an event function, in its unit. Deadbands for rounding and zero detection are relative to this scale.
    fn guard_scale(&self, guard: usize) -> f64;

    /// Returns the natural rate of the block, 1/s. Events much closer in time than the inverse rate count as accumulating.
    fn rate(&self) -> f64;

    /// Returns the eigenvalues λ = a + ib of the block's states at given inputs, as pairs (a, b), 1/s, which limit fixed time steps.
    ///
    /// The default computes the Jacobian of the slopes at the start in law 0 by finite differences, which is exact for linear slopes. A
    /// block whose eigenvalues depend on the rate of an input returns the fastest ones.
    fn eigenvalues(&self, inputs: &[Sample]) -> Vec<(f64, f64)> {
        block_eigenvalues(self, inputs)
    }

    /// Returns the largest number of events that one reversal of an input may cause, at least 1. The limit for accumulating events is
    /// multiplied by this number, because the events may be simultaneous.
    fn events_per_turn(&self) -> u32 {
        1
    }

    /// Returns whether the output depends on a state, given by its index. False for a state that only accumulates, such as work, or has no
    /// effect in this law. A motion can be periodic although such states are not.
    fn depends(&self, law: usize, state: usize) -> bool {
        let _ = (law, state);
        true
    }

    /// Resets accumulating states, such as work, at time `t` (s). The output signal does not change.
    fn count_from(&self, t: f64, states: &mut [f64], memory: &mut [f64]) {
        let _ = (t, states, memory);
    }

    /// Appends the values of the block's output columns to a row.
    fn fill(&self, standing: Standing<'_, usize, Vec<f64>>, at: &Moment<'_, [Sample]>, row: &mut Vec<f64>);
}

/// Input of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Input {
    /// Signal by index: waveforms first, then blocks.
    Signal(usize),
    /// Displacement of a point of the first side minus that of a point of the second side, m. The block's effort (N) acts as a force on the
    /// first side in this direction, and as the opposite force on the second side.
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

/// Data of one accepted step of a block.
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

/// Shared block. Two shared blocks are equal if they refer to the same object.
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
