//! Traits of the one-step methods that an event-locating run uses, and the types of their arguments.

use crate::Grade;
use std::ops::Range;

/// Properties of a one-step method that do not depend on the current step.
// Three traits instead of one: code that reads a step need not know the type of the system.
pub trait Method {
    /// Returns the largest |hλ| at which an oscillating or decaying motion e^{λt} does not grow.
    fn stability_limit(&self) -> f64;
    /// Whether accelerations are constant, so that the next steps are exact at any length and need no evaluation.
    fn coasts(&self) -> bool;
    /// Whether the method supports graded steps ([`Grade`]). Otherwise the stages of all steps are evenly distributed.
    fn grades(&self) -> bool {
        true
    }
    /// Returns the number of evaluations of the right-hand side since construction.
    fn evaluations(&self) -> u64;
    /// Returns which method of a pair made the last attempt; the default for a single method.
    fn hand(&self) -> Hand {
        Hand::default()
    }
    /// Restores a [`Hand`], so that an attempt can be repeated from the same start.
    fn set_hand(&mut self, hand: Hand) {
        let _ = hand;
    }
}

/// Access to the attempted step: its ends, its dense output, cutting and accepting the step.
pub trait Step {
    /// Returns times and states at both ends of the step.
    fn span(&self) -> Span<'_>;
    /// Returns the slope of component `i`, a velocity, at one end of the step. The slope at the start is always known, the slope at the end
    /// only after [`Attempt::complete`].
    fn slope(&self, i: usize, at: End) -> f64;
    /// Returns component `i` at time `t` (s) by the dense output.
    #[inline]
    fn value(&self, i: usize, t: f64) -> f64 {
        self.value_at(i, self.part(t))
    }
    /// Returns the parameter of the dense output at time `t` (s): 0 at the start and 1 at the end of the attempted step.
    fn part(&self, t: f64) -> f64;
    /// Returns the time (s) at parameter `part`, and the derivative of time with respect to the parameter (s).
    fn moment(&self, part: f64) -> [f64; 2];
    /// Returns component `i` at parameter `part` of the dense output.
    fn value_at(&self, i: usize, part: f64) -> f64;
    /// Cuts the step at an earlier time `t` (s). The dense output gives the new end state.
    fn cut(&mut self, t: f64);
    /// Accepts the step: its end becomes the start of the next step.
    fn accept(&mut self);
    /// Writes the slopes at the start of the step into `slopes`, in the stepper's own order. Unknown slopes leave `slopes` empty.
    ///
    /// The slopes belong to the state of a run, because a new evaluation after a change of memory may differ in the last bit.
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
    /// Sets time `t` (s) and state `y` as the start, and evaluates the slopes there. The stepper uses as many components of `y` as it has
    /// itself. Required before the first step and after every discontinuity of the slopes.
    fn start(&mut self, system: &S, t: f64, y: &[f64]);
    /// Resumes the motion of another stepper at time `t` and state `y` from the [slopes](Step::first_slopes) of that stepper. Both steppers
    /// continue with identical bits. With empty `slopes` the stepper starts anew.
    fn take_up(&mut self, system: &S, at: (f64, &[f64]), hand: Hand, slopes: &[f64]);
    /// Returns a length for the first step (s), at most `longest`.
    fn first_step(&mut self, system: &S, longest: f64, scale: &[f64]) -> f64;
    /// Attempts a step and returns its error in units of `scale`. An error of 1 equals the tolerance; [`f64::INFINITY`] means that the
    /// result is not finite.
    ///
    /// The function may be called repeatedly from the same start.
    fn attempt(&mut self, system: &S, to: Target, scale: &[f64]) -> f64;
    /// Writes all components at time `t` inside the step into `out`, with the accuracy of a step end. This takes a separate step from the
    /// start to `t`.
    ///
    /// Returns false and writes nothing if the dense output is accurate enough or nothing better exists. The attempted step does not
    /// change; evaluations are not counted. `scale` must be that of the attempt.
    fn visit(&mut self, system: &S, t: f64, scale: &[f64], out: &mut [f64]) -> bool {
        let _ = (system, t, scale, out);
        false
    }
    /// Replaces the given components at the end of a cut step by the values of [`visit`](Self::visit). Evaluations are counted.
    fn settle(&mut self, system: &S, scale: &[f64], components: Range<usize>) {
        let _ = (system, scale, components);
    }
    /// Cuts the step at an earlier time `t` (s), with the state of [`visit`](Self::visit). Requires the dense output.
    fn cut_exactly(&mut self, system: &S, t: f64, scale: &[f64]) {
        let _ = (system, scale);
        self.cut(t);
    }
    /// Computes the slopes at the end or the dense output of the attempted step, unless already known.
    fn complete(&mut self, system: &S, what: Completion);
}

/// Which method of a pair made the last attempt, and whether the other method has the same start. Part of the state of a run: the methods
/// differ in rounding, and known slopes are not evaluated and counted again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Hand {
    /// Whether the last attempt was a graded step.
    pub graded: bool,
    /// Whether the other method of a pair has the same start. For an implicit method: whether its Jacobian is known.
    pub both: bool,
}

/// End time of a step and distribution of its stages.
///
/// The target is a time, not a length, because t + (end - t) may differ from the time of a waveform's corner in the last bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// End time, s, which the step reaches to the last bit.
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

/// Additional results of a step, which [`Attempt::complete`] computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Completion {
    /// Slopes at the end of the step.
    EndSlopes,
    /// Dense output.
    Dense,
}

/// Times and states at both ends of the attempted step.
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
