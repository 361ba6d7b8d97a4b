//! What a run of the loop hands over.

use crate::contestant::Stop;
use crate::samples::Samples;
use std::hint::black_box;
use std::time::Instant;
use stickslip_results::Watcher;

/// Steps between two looks at the clock.
const STRIDE: usize = 4096;

/// What a run hands over after every step.
pub(super) trait Watch {
    /// After the step that ends at t, in places `x` with velocities `v`; `false` ends the run.
    fn step<const F: usize>(&mut self, n: usize, x: &[f64; F], v: &[f64; F]) -> bool;
}

/// Watches nothing but the wish to stop.
pub(super) struct Blind<'a>(pub(super) &'a dyn Watcher);

impl Watch for Blind<'_> {
    #[inline]
    fn step<const F: usize>(&mut self, n: usize, x: &[f64; F], _: &[f64; F]) -> bool {
        black_box(x);
        !n.is_multiple_of(STRIDE) || self.0.goes_on()
    }
}

/// Keeps the places at the common moments: between steps on the cubic through both ends.
pub(super) struct Keen<'a> {
    pub(super) samples: Samples,
    pub(super) step: f64,
    pub(super) duration: f64,
    /// Places and velocities after the last step.
    pub(super) last: (Vec<f64>, Vec<f64>),
    pub(super) begun: Instant,
    pub(super) wall: f64,
    pub(super) watcher: &'a dyn Watcher,
    pub(super) stop: Option<Stop>,
}

impl Watch for Keen<'_> {
    fn step<const F: usize>(&mut self, n: usize, x: &[f64; F], v: &[f64; F]) -> bool {
        let (from, to) = ((n - 1) as f64 * self.step, n as f64 * self.step);
        let interval = Samples::interval(self.duration);
        while self.samples.len() + 1 < Samples::complete() && self.samples.len() as f64 * interval <= to {
            let s = (self.samples.len() as f64 * interval - from) / self.step;
            for i in 0..F {
                let (x0, v0) = (self.last.0[i], self.last.1[i]);
                let mean = (x[i] - x0) / self.step;
                let bend = s * (1.0 - s) * ((1.0 - s) * (v0 - mean) - s * (v[i] - mean));
                self.samples.push(x0 + self.step * (s * mean + bend));
            }
        }
        self.last.0.copy_from_slice(x);
        self.last.1.copy_from_slice(v);
        if n.is_multiple_of(STRIDE) {
            if !self.watcher.goes_on() {
                self.stop = Some(Stop::Interrupted);
            } else if self.begun.elapsed().as_secs_f64() > self.wall {
                self.stop = Some(Stop::Slow);
            }
        }
        self.stop.is_none()
    }
}
