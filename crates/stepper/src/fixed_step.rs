//! Traits of fixed-step methods.

/// A one-step method without an error estimate.
pub trait FixedStep {
    /// Returns a workspace for systems with `positions` positions, `dimension` coupled components and `total` components.
    fn sized(positions: usize, dimension: usize, total: usize) -> Self;
    /// Drops slopes kept from the last step. Required where slopes jump: at a corner of a waveform, or after a change of the state from
    /// outside.
    fn restart(&mut self);
    /// Returns the slopes kept from the last step, which are part of the state of a run. None if the next step needs no such slopes.
    fn kept(&self) -> Option<&[f64]> {
        None
    }
    /// Restores slopes kept by another stepper of the same system.
    fn keep(&mut self, slopes: &[f64]) {
        let _ = slopes;
    }
    /// Number of evaluations of the right-hand side since construction.
    fn evaluations(&self) -> u64;
}

/// A fixed-step method for systems of type `S`. Some methods need a [`System`](crate::System), others a
/// [`Conservative`](crate::Conservative) system.
///
/// The method evaluates the system through `&S` only; the owner updates the system's memory after a step.
pub trait Stepping<S: ?Sized>: FixedStep {
    /// Advances `y` (all components) from `t` to `t + h` (s).
    fn step(&mut self, system: &S, t: f64, y: &mut [f64], h: f64);
}
