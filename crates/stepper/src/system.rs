//! Systems of ordinary differential equations.

/// A system of ordinary differential equations whose right-hand side may have a memory.
///
/// Slopes are evaluated through a shared reference, so trial evaluations do not change the system. The owner of the system updates its
/// memory after each accepted step. All stages of a step therefore see the same right-hand side, smooth between events, as the order of a
/// method requires.
///
/// The state has [`total`](Self::total) components. The first [`dimension`](Self::dimension) components are coupled. The others are
/// quadratures (such as work), on which no slope depends. Quadratures are integrated with the same order, without cost in stages.
pub trait System {
    /// Returns the number of coupled components.
    // Separate from `total`: stages are computed for coupled components only.
    fn dimension(&self) -> usize;

    /// Returns the number of positions. The slopes of the first `positions` components are the next `positions` components (velocities).
    /// Verlet and steps under constant accelerations use this structure; 0 if the system does not have it.
    fn positions(&self) -> usize;

    /// Returns the number of coupled components and quadratures, at least `dimension`.
    fn total(&self) -> usize;

    /// Writes the slopes dy/dt at time `t` (s) and state `y` into `dy`.
    ///
    /// `y` has `dimension` components. `dy` has `total` components and must be filled completely.
    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]);

    /// Whether all slopes except those of positions stay constant until the stepper is restarted. Positions are then parabolas, all other
    /// components are linear in time, and steps need no evaluation.
    fn coasts(&self) -> bool {
        false
    }
}
