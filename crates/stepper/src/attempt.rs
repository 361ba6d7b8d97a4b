//! What an event-aware run asks of a method.

use crate::{Dop853, Grade, System};

/// A one-step method that attempts; someone else accepts.
///
/// ```text
/// start ──► attempt_until ──► (end_slopes, dense, value, cut) ──► accept ──► attempt_until …
///                ▲  │ error too large: same start, other step
///                └──┘
/// ```
pub trait Attempt<S: ?Sized> {
    /// Largest |hλ| at which a motion e^{λt} that swings or fades does not grow.
    fn reach(&self) -> f64;
    /// Puts the stepper at time `t` and state `y`, of which it takes as many components as it has, and evaluates the
    /// slopes there.
    fn start(&mut self, system: &S, t: f64, y: &[f64]);
    /// Evaluates the slopes at the current point again: due after anything that makes them jump.
    fn restart_slopes(&mut self, system: &S);
    /// A first step for a fresh start, at most `longest`.
    fn first_step(&mut self, system: &S, longest: f64, scale: &[f64]) -> f64;
    /// Tries a step to the time `end` and returns its error in units of `scale`: 1 is just at the tolerance,
    /// [`f64::INFINITY`] not finite.
    fn attempt_until(&mut self, system: &S, end: f64, scale: &[f64]) -> f64;
    /// The same with stages that crowd towards a singular end of the step, by methods that can do that.
    fn attempt_graded(&mut self, system: &S, end: f64, scale: &[f64], _: Grade) -> f64 {
        self.attempt_until(system, end, scale)
    }
    /// Whether the coming steps are exact and free at any length.
    fn coasts(&self) -> bool {
        false
    }
    /// Makes the slopes at the end of the step tried known.
    fn end_slopes(&mut self, system: &S);
    /// Makes the dense output of the step tried, at the first call only.
    fn dense(&mut self, system: &S);
    /// Ends the step tried at an earlier time `t` of it, in the state of the dense output.
    fn cut(&mut self, t: f64);
    /// Moves to the end of the step tried.
    fn accept(&mut self);
    /// Component `i` at time `t` of the step, by the dense output.
    fn value(&self, i: usize, t: f64) -> f64;
    /// Time at the start of the step, s.
    fn time(&self) -> f64;
    /// Time at the end of the step tried, s.
    fn end_time(&self) -> f64;
    /// State at the start of the step.
    fn begin(&self) -> &[f64];
    /// State at the start of the step, to be changed by an event; [`restart_slopes`](Self::restart_slopes) is due then.
    fn begin_mut(&mut self) -> &mut [f64];
    /// State at the end of the step tried.
    fn end(&self) -> &[f64];
    /// Slope of a velocity, component `i` of the state, at the start of the step.
    fn begin_slope(&self, i: usize) -> f64;
    /// The same at the end of the step tried.
    fn end_slope(&self, i: usize) -> f64;
    /// Evaluations since construction.
    fn evaluations(&self) -> u64;
}

impl<S: System + ?Sized> Attempt<S> for Dop853 {
    /// The region of stability ends on the imaginary axis at 6.0, on the real axis at -6.4. Steps that events cut end on
    /// the dense output, which near there is no longer that of a swing.
    fn reach(&self) -> f64 {
        5.0
    }
    fn start(&mut self, system: &S, t: f64, y: &[f64]) {
        Self::start(self, system, t, y);
    }
    fn restart_slopes(&mut self, system: &S) {
        Self::restart_slopes(self, system);
    }
    fn first_step(&mut self, system: &S, longest: f64, scale: &[f64]) -> f64 {
        Self::first_step(self, system, longest, scale)
    }
    #[inline]
    fn attempt_until(&mut self, system: &S, end: f64, scale: &[f64]) -> f64 {
        Self::attempt_until(self, system, end, scale)
    }
    fn attempt_graded(&mut self, system: &S, end: f64, scale: &[f64], grade: Grade) -> f64 {
        Self::attempt_graded(self, system, end, scale, grade)
    }
    fn coasts(&self) -> bool {
        Self::coasts(self)
    }
    fn end_slopes(&mut self, system: &S) {
        Self::end_slopes(self, system);
    }
    fn dense(&mut self, system: &S) {
        Self::dense(self, system);
    }
    fn cut(&mut self, t: f64) {
        Self::cut(self, t);
    }
    fn accept(&mut self) {
        Self::accept(self);
    }
    #[inline]
    fn value(&self, i: usize, t: f64) -> f64 {
        Self::value(self, i, t)
    }
    fn time(&self) -> f64 {
        Self::time(self)
    }
    fn end_time(&self) -> f64 {
        Self::end_time(self)
    }
    fn begin(&self) -> &[f64] {
        Self::begin(self)
    }
    fn begin_mut(&mut self) -> &mut [f64] {
        Self::begin_mut(self)
    }
    fn end(&self) -> &[f64] {
        Self::end(self)
    }
    fn begin_slope(&self, i: usize) -> f64 {
        Self::begin_slope(self, i)
    }
    fn end_slope(&self, i: usize) -> f64 {
        Self::end_slope(self, i)
    }
    fn evaluations(&self) -> u64 {
        Self::evaluations(self)
    }
}
