//! What a run at a fixed step asks of a method.

use crate::System;

/// A one-step method without an error estimate.
///
/// It evaluates through `&System` only; the owner moves the system's memory after a step.
pub trait FixedStep {
    /// Workspace for systems of this one's size.
    fn of<S: System + ?Sized>(system: &S) -> Self;
    /// Moves `y` (`total` components) from `t` to `t + h`.
    fn step<S: System + ?Sized>(&mut self, system: &S, t: f64, y: &mut [f64], h: f64);
    /// Forgets slopes of the last step, if it keeps any: due when they jump (a corner of a waveform, a state changed from
    /// outside).
    fn restart(&mut self);
    /// Evaluations of the slopes since construction.
    fn evaluations(&self) -> u64;
}
