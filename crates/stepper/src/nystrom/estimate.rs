//! What a step may be: its error, and the length of a first one.

use super::tableau::{POSITION_ERROR, STAGES, VELOCITY_ERROR};
use super::track::dot;
use super::{Nystrom, ORDER, Storage};

impl<N: Storage> Nystrom<N> {
    /// Largest difference of the two orders in units of `scale`: of positions, velocities and, where `scale` has values for
    /// them, quadratures. Why the largest, says the estimate of [`DormandPrince`](crate::DormandPrince).
    #[inline]
    pub(super) fn error(&self, scale: &[f64]) -> f64 {
        let (h, n) = (self.step, self.positions());
        let (positions, velocities) = scale.split_at(n);
        let (mut largest, mut sum) = (0.0_f64, 0.0);
        let mut add = |error: f64, scale: f64| {
            let error = (error / scale).abs();
            largest = if error > largest { error } else { largest };
            // A comparison drops NaN, a sum does not.
            sum += error;
        };
        for (track, scale) in self.tracks.as_ref().iter().zip(positions) {
            add(h * h * dot(&POSITION_ERROR, &track.k, 7), *scale);
        }
        for (track, scale) in self.tracks.as_ref().iter().zip(velocities) {
            add(h * dot(&VELOCITY_ERROR, &track.k, STAGES), *scale);
        }
        sum += self.end.as_ref().iter().sum::<f64>();
        if sum.is_finite() { largest } else { f64::INFINITY }
    }

    /// A first step for a fresh start, without an evaluation: 0.01 (s/a)^{1/7} T^{6/7} with T the longest step and s/a the
    /// shortest time (s) in which an acceleration at the start makes the tolerance of its velocity.
    pub(super) fn starting_step(&self, longest: f64, scale: &[f64]) -> f64 {
        // A hundredth of the longest step where nothing acts. The rule that the other method takes costs an evaluation, and a
        // first step is taken once a run.
        let n = self.positions();
        let bend = self.tracks.as_ref()[..n]
            .iter()
            .zip(&scale[n..])
            .map(|(track, scale)| track.k[0].abs() / scale)
            .fold(0.0, f64::max);
        let step = if bend > 0.0 {
            math::powf(1.0 / bend, 1.0 / f64::from(ORDER)) * math::powf(longest, 1.0 - 1.0 / f64::from(ORDER))
        } else {
            longest
        };
        (0.01 * step).min(longest)
    }
}
