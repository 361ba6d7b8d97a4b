//! Traits of the one-step methods that an event-locating run uses, and the types of their arguments.

use crate::Grade;
use std::ops::Range;

/// Properties of a one-step method that do not depend on the current step.
// Three traits instead of one: code that reads a step need not know the type of the system.
pub trait Method {
    /// Largest |hλ| at which an oscillating or decaying motion e^{λt} does not grow.
    fn stability_limit(&self) -> f64;
    /// Whether accelerations stay constant, so that the next steps are exact at any length and need no evaluation.
    fn coasts(&self) -> bool;
    /// Whether the method supports graded steps ([`Grade`]); otherwise all its steps are even.
    fn grades(&self) -> bool {
        true
    }
    /// Number of evaluations of the right-hand side since construction.
    fn evaluations(&self) -> u64;
    /// Which method of a pair made the last attempt; the default for a single method.
    fn hand(&self) -> Hand {
        Hand::default()
    }
    /// Restores a [`Hand`], so that an attempt can be repeated from the same start.
    fn set_hand(&mut self, hand: Hand) {
        let _ = hand;
    }
}

/// Access to the step attempted: its ends, its dense output, cutting and accepting it.
pub trait Step {
    /// Times and states at both ends of the step.
    fn span(&self) -> Span<'_>;
    /// Returns the slope of component `i`, a velocity, at one end of the step. The slope at the start is known. The slope at the
    /// end is known once the step is [complete](Attempt::complete).
    fn slope(&self, i: usize, at: End) -> f64;
    /// Returns component `i` at time `t` (s) by the dense output.
    #[inline]
    fn value(&self, i: usize, t: f64) -> f64 {
        self.value_at(i, self.part(t))
    }
    /// Returns the parameter of the dense output at time `t` (s), 0 at the start and 1 at the end of the step attempted.
    fn part(&self, t: f64) -> f64;
    /// Returns the time (s) at parameter `part`, and the derivative of time by the parameter (s).
    fn moment(&self, part: f64) -> [f64; 2];
    /// Returns component `i` at parameter `part` of the dense output.
    fn value_at(&self, i: usize, part: f64) -> f64;
    /// Cuts the step at an earlier time `t` (s). The new end state is that of the dense output.
    fn cut(&mut self, t: f64);
    /// Accepts the step: its end becomes the start of the next step.
    fn accept(&mut self);
    /// Writes the slopes at the start of the step into `slopes`, in the stepper's own order. Leaves it empty if they are unknown.
    ///
    /// The slopes belong to the state of a run. After a change of memory, a new evaluation may differ in the last bit.
    fn first_slopes(&self, slopes: &mut Vec<f64>);
}

/// A one-step method that attempts a step; the caller decides whether to accept it.
///
/// ```text
/// start ──► attempt ──► (complete, value, cut) ──► accept ──► attempt …
///             ▲  │ error too large: same start, other step
///             └──┘
/// ```
pub trait Attempt<S: ?Sized>: Method + Step {
    /// Sets time `t` (s) and state `y` as the start, and evaluates the slopes there. The stepper takes as many components of `y`
    /// as it has. Required at first, and after every discontinuity of the slopes.
    fn start(&mut self, system: &S, t: f64, y: &[f64]);
    /// Resumes the motion of another stepper at time `t` and state `y` from its [slopes](Step::first_slopes). Both steppers
    /// continue with identical bits. With empty `slopes` it starts anew.
    fn take_up(&mut self, system: &S, at: (f64, &[f64]), hand: Hand, slopes: &[f64]);
    /// Returns a length for the first step (s), at most `longest`.
    fn first_step(&mut self, system: &S, longest: f64, scale: &[f64]) -> f64;
    /// Attempts a step and returns its error in units of `scale`. An error of 1 equals the tolerance; [`f64::INFINITY`] means
    /// that the result is not finite.
    ///
    /// May be called repeatedly from the same start.
    fn attempt(&mut self, system: &S, to: Target, scale: &[f64]) -> f64;
    /// Writes all components at time `t` inside the step into `out`, as accurate as at the end of the step. Takes a separate step
    /// from the start to `t`.
    ///
    /// Returns false and writes nothing where the dense output is accurate enough or nothing better exists. The step does not
    /// change; its evaluations are not counted. `scale` is that of the attempt.
    fn visit(&mut self, system: &S, t: f64, scale: &[f64], out: &mut [f64]) -> bool {
        let _ = (system, t, scale, out);
        false
    }
    /// Replaces the given components at the end of a cut step by the values of [`visit`](Self::visit). Counts the evaluations.
    fn settle(&mut self, system: &S, scale: &[f64], components: Range<usize>) {
        let _ = (system, scale, components);
    }
    /// Cuts the step at an earlier time `t` (s), at the state of [`visit`](Self::visit). Requires the dense output.
    fn cut_exactly(&mut self, system: &S, t: f64, scale: &[f64]) {
        let _ = (system, scale);
        self.cut(t);
    }
    /// Computes the end slopes or the dense output of the step attempted, unless they are known.
    fn complete(&mut self, system: &S, what: Completion);
}

/// Which method of a pair made the last attempt, and whether the other one is at the same start. Part of the state of a run: both
/// methods evaluate the same law in different order, and known slopes are not evaluated and counted again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Hand {
    /// Whether the last attempt was a graded step.
    pub graded: bool,
    /// Whether the other method of a pair is at the same start. For an implicit method: whether its Jacobian is known.
    pub both: bool,
}

/// End time of a step and distribution of its stages.
///
/// The target is a time, not a length: t + (end - t) may differ from a waveform's corner in the last bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// End time, s; reached to the last bit.
    pub end: f64,
    /// Distribution of the stages.
    pub grade: Grade,
}

impl Target {
    /// Returns a target with evenly distributed stages.
    #[must_use]
    pub fn even(end: f64) -> Self {
        Self { end, grade: Grade::Even }
    }
}

/// Additional result of a step that [`Attempt::complete`] computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Completion {
    /// Slopes at the end of the step.
    EndSlopes,
    /// Dense output.
    Dense,
}

/// Times and states at both ends of the step attempted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span<'a> {
    /// Time at its start, s.
    pub time: f64,
    /// Time at its end, s.
    pub end_time: f64,
    /// State at its start.
    pub begin: &'a [f64],
    /// State at its end.
    pub end: &'a [f64],
}

/// One end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// Start of the step.
    Start,
    /// End of the step.
    End,
}
