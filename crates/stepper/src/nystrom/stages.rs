//! Stages of a step, and the state at its end.

use super::tableau::{NODES, POSITIONS, STAGES, VELOCITY};
use super::track::dot;
use super::{Conservative, Nystrom, Storage};

impl<N: Storage> Nystrom<N> {
    /// Computes all stages of a step to time `end` (s), and the state at the end of the step.
    #[inline(always)]
    pub(super) fn step_to<S: Conservative + ?Sized>(&mut self, system: &S, end: f64, few: bool) {
        if !self.known.first {
            self.restart_slopes(system);
        }
        self.forget_step();
        let (t, h) = (self.time, end - self.time);
        (self.step, self.end_time) = (h, end);
        self.few = few && !self.constant;
        if self.few {
            self.step_by_fifth(system, end);
            self.known.last = true;
            return;
        }
        if self.constant {
            self.advance_constant();
        } else {
            self.advance::<1, S>(system, t + NODES[1] * h);
            self.advance::<2, S>(system, t + NODES[2] * h);
            self.advance::<3, S>(system, t + NODES[3] * h);
            self.advance::<4, S>(system, t + NODES[4] * h);
            self.advance::<5, S>(system, t + NODES[5] * h);
            self.advance::<6, S>(system, t + NODES[6] * h);
            self.advance::<7, S>(system, end);
            self.advance::<8, S>(system, end);
        }
        self.conclude();
        self.known.last = true;
    }

    /// Evaluates the accelerations at the positions in `stage`, and stores them as the accelerations of stage number `stage`.
    #[inline(always)]
    pub(super) fn evaluate<S: Conservative + ?Sized>(&mut self, system: &S, t: f64, stage: usize) {
        system.accelerations(t, self.stage.as_ref(), self.rates.as_mut());
        self.evaluations += 1;
        for (track, rate) in self.tracks.as_mut().iter_mut().zip(self.rates.as_ref()) {
            track.k[stage] = *rate;
        }
    }

    /// Computes the positions of stage `J` and evaluates the accelerations there.
    #[inline(always)]
    fn advance<const J: usize, S: Conservative + ?Sized>(&mut self, system: &S, t: f64) {
        let h = self.step;
        // The newest acceleration is added last: all other terms can be summed before it is known.
        let (before, last) = (&POSITIONS[J], J - 1);
        for (to, track) in self.stage.as_mut().iter_mut().zip(self.tracks.as_ref()) {
            let known = track.x + h * (NODES[J] * track.v + h * dot(before, &track.k, last));
            *to = if before[last] == 0.0 { known } else { known + h * h * before[last] * track.k[last] };
        }
        self.evaluate(system, t, J);
    }

    /// Sets all stages under constant accelerations without an evaluation; the end of the step is that of a parabola.
    #[inline(never)]
    fn advance_constant(&mut self) {
        let h = self.step;
        for track in self.tracks.as_mut() {
            track.k = [track.k[0]; STAGES];
        }
        for (to, track) in self.stage.as_mut().iter_mut().zip(self.tracks.as_ref()) {
            *to = track.x + h * (track.v + 0.5 * h * track.k[0]);
        }
    }

    /// Computes the end of the step by the weights of order 8. Positions at the end are those of the last stage.
    #[inline]
    fn conclude(&mut self) {
        let (h, n) = (self.step, self.positions());
        self.end.as_mut()[..n].copy_from_slice(self.stage.as_ref());
        for (to, track) in self.end.as_mut()[n..].iter_mut().zip(self.tracks.as_ref()) {
            *to = track.v + h * dot(&VELOCITY, &track.k, 8);
        }
    }
}
