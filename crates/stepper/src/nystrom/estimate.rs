//! Error estimate of a step, and length of the first step.

use super::tableau::{POSITION_ERROR, STAGES, VELOCITY_ERROR};
use super::track::dot;
use super::{Nystrom, ORDER, Storage};

impl<N: Storage> Nystrom<N> {
    /// Returns the largest difference between the solutions of both orders in units of `scale`, over positions, velocities, and quadratures
    /// for which `scale` has values.
    #[inline]
    pub(super) fn error(&self, scale: &[f64]) -> f64 {
        let (h, n) = (self.step, self.positions());
        let (positions, velocities) = scale.split_at(n);
        let (mut largest, mut sum) = (0.0_f64, 0.0);
        let mut add = |error: f64, scale: f64| {
            let error = (error / scale).abs();
            largest = if error > largest { error } else { largest };
            // Comparisons ignore NaN, a sum does not.
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

    /// Returns the length of a first step without an evaluation: 0.01 (s/a)^{1/7} T^{6/7}. T is the maximum step. s/a (s) is the shortest
    /// time in which an initial acceleration a changes a velocity by its tolerance s.
    pub(super) fn starting_step(&self, longest: f64, scale: &[f64]) -> f64 {
        // Without accelerations the first step is a hundredth of the longest.
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
