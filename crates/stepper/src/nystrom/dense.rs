//! Dense output: Hermite–Birkhoff interpolation of accelerations at seven nodes.
//!
//! The interpolating polynomial of the accelerations is integrated once for velocities and twice for positions. Velocities and positions
//! are therefore consistent, and exact at the start of the step.

use super::tableau::{NODES, REFINED, REFINED_POSITIONS, SAMPLED};
use super::{Conservative, Nystrom, Storage, Track};

impl<N: Storage> Nystrom<N> {
    /// Computes the dense output of the attempted step, unless already known.
    pub(super) fn interpolate<S: Conservative + ?Sized>(&mut self, system: &S) {
        if self.known.dense {
            return;
        }
        self.known.dense = true;
        if self.few {
            return self.interpolate_fifth();
        }
        if !self.constant {
            self.refine(system);
        }
        self.tracks.as_mut().iter_mut().for_each(Track::interpolate);
    }

    /// Evaluates the accelerations at the inner nodes again, because the stages there have only order 4.
    fn refine<S: Conservative + ?Sized>(&mut self, system: &S) {
        // Costs four evaluations, only in steps that need the dense output.
        let (h, n) = (self.step, self.positions());
        for track in &mut self.tracks.as_mut()[..n] {
            for (r, sample) in REFINED.enumerate() {
                let node = NODES[SAMPLED[sample]];
                let bend: f64 =
                    REFINED_POSITIONS[r].iter().zip(SAMPLED).map(|(w, stage)| w * track.k[stage]).sum();
                track.refined[r] = track.x + node * h * (track.v + node * h * bend);
            }
        }
        for (r, sample) in REFINED.enumerate() {
            let stage = SAMPLED[sample];
            for (to, track) in self.stage.as_mut().iter_mut().zip(self.tracks.as_ref()) {
                *to = track.refined[r];
            }
            self.evaluate(system, self.time + NODES[stage] * h, stage);
        }
    }

    /// Returns component `i` at fraction `share` of the step.
    #[inline]
    pub(super) fn at(&self, i: usize, share: f64) -> f64 {
        match i.checked_sub(self.positions()) {
            None => self.tracks.as_ref()[i].position(self.step, share),
            Some(i) => self.tracks.as_ref()[i].velocity(self.step, share),
        }
    }
}
