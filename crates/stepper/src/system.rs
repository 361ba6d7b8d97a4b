//! What is stepped.

/// A system of ordinary differential equations whose right-hand side may remember.
///
/// Evaluation borrows shared: a stepper tries as many points as it likes and leaves no trace. Whoever owns the system
/// moves its memory once a step has been accepted.
///
/// Memory moves between steps only, so all stages of a step see one and the same right-hand side, smooth as long as no event
/// falls: that is what the order of a method rests on.
///
/// The state has [`total`](Self::total) components. The first [`dimension`](Self::dimension) of them are coupled; the
/// rest are quadratures (work, dissipation), integrals on whose value no slope depends: they are carried along at the
/// same order, but neither cost stage combinations nor steer the step.
pub trait System {
    /// Number of coupled components.
    // Apart from `total`, because a scene has as many integrals of work as of motion: with three of five components carried
    // along instead of coupled a step takes 163 ns instead of 205.
    fn dimension(&self) -> usize;

    /// Number of positions: the first `positions` components, whose slopes are the `positions` components after them
    /// (velocities). Verlet and steps that coast use it; 0 if the system has no such structure.
    fn positions(&self) -> usize;

    /// Number of coupled components and quadratures, at least `dimension`.
    fn total(&self) -> usize;

    /// Slopes at time `t` (s) and state `y`.
    ///
    /// `y` has `dimension` components, `dy` has `total` and must be filled completely.
    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]);

    /// Whether all slopes but those of the positions stay as they are until the steps are restarted: then positions run
    /// along parabolas, everything else along straight lines, and nothing has to be evaluated.
    fn coasts(&self) -> bool {
        false
    }
}
