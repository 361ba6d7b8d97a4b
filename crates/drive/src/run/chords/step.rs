//! Interpolation within an accepted step.

use crate::run::stretch::Stretch;

/// Accepted step with its components at both ends.
pub(in crate::run) struct Between<'a> {
    pub(in crate::run) from: (f64, &'a [f64]),
    pub(in crate::run) to: (f64, &'a [f64]),
    pub(in crate::run) free: usize,
}

impl Between<'_> {
    /// Returns component `i` at time t inside the step.
    ///
    /// Positions use the cubic Hermite interpolant; velocities and works are linear in time.
    pub(in crate::run) fn value(&self, i: usize, t: f64) -> f64 {
        let ((t0, from), (t1, to), n) = (self.from, self.to, self.free);
        if t >= t1 {
            return to[i];
        }
        let h = t1 - t0;
        let s = (t - t0) / h;
        let straight = from[i] + s * (to[i] - from[i]);
        if i >= n {
            return straight;
        }
        let (v0, v1, mean) = (from[n + i], to[n + i], (to[i] - from[i]) / h);
        straight + h * s * (1.0 - s) * ((1.0 - s) * (v0 - mean) - s * (v1 - mean))
    }
}

impl Stretch for Between<'_> {
    fn fill(&mut self, t: f64, y: &mut [f64]) {
        y.iter_mut().enumerate().for_each(|(i, y)| *y = self.value(i, t));
    }
}
