//! What a run at a fixed step asks of a method.

/// A one-step method without an error estimate.
pub trait FixedStep {
    /// Workspace for systems of `positions` positions among `dimension` coupled components among `total`.
    fn sized(positions: usize, dimension: usize, total: usize) -> Self;
    /// Forgets slopes of the last step, if it keeps any: due when they jump (a corner of a waveform, a state changed from
    /// outside).
    fn restart(&mut self);
    /// Slopes kept from the last step, which belong to a run's state; none where the next step needs none.
    fn kept(&self) -> Option<&[f64]> {
        None
    }
    /// Goes on from slopes kept by another stepper of the same system.
    fn keep(&mut self, slopes: &[f64]) {
        let _ = slopes;
    }
    /// Evaluations of the slopes since construction.
    fn evaluations(&self) -> u64;
}

/// The same for the systems that it can step: some ask for slopes, some for accelerations alone.
///
/// It evaluates through `&S` only; the owner moves the system's memory after a step.
pub trait Stepping<S: ?Sized>: FixedStep {
    /// Moves `y` (all components) from `t` to `t + h`.
    fn step(&mut self, system: &S, t: f64, y: &mut [f64], h: f64);

    /// The same where forces go with the root of the time that is left until `t + h + left`, `left` ≥ 0.
    fn step_to_a_root(&mut self, system: &S, t: f64, y: &mut [f64], (h, left): (f64, f64)) {
        let _ = left;
        self.step(system, t, y, h);
    }
}
