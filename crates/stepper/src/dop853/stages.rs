//! The stages of a step, and its end.

use super::tableau::{
    NODES, Row, Stage2, Stage3, Stage4, Stage5, Stage6, Stage7, Stage8, Stage9, Stage10, Stage11, Stage12,
    Weights,
};
use super::{Dop853, Grade};
use crate::{System, Target};

impl Dop853 {
    /// Tries a step: all stages, the end y + h Σ b_i k_i, the error.
    pub(super) fn attempt_span<S: System + ?Sized>(
        &mut self,
        system: &S,
        Target { end, grade }: Target,
        scale: &[f64],
    ) -> f64 {
        if !self.ends.first_known {
            self.restart_slopes(system);
        }
        self.forget_step();
        let h = end - self.extent.time;
        (self.extent.step, self.extent.grade) = (h, if self.coasts { Grade::Even } else { grade });
        (self.extent.end_time, self.extent.target) = (end, end);
        if self.coasts {
            return self.coast(system);
        }
        self.recall_first();
        self.stage::<Stage2, 1, S>(system);
        self.stage::<Stage3, 2, S>(system);
        self.stage::<Stage4, 3, S>(system);
        self.stage::<Stage5, 4, S>(system);
        self.stage::<Stage6, 5, S>(system);
        self.stage::<Stage7, 6, S>(system);
        self.stage::<Stage8, 7, S>(system);
        self.stage::<Stage9, 8, S>(system);
        self.stage::<Stage10, 9, S>(system);
        self.stage::<Stage11, 10, S>(system);
        self.stage::<Stage12, 11, S>(system);
        self.keep::<11>();
        for ((to, y), k) in self.end.iter_mut().zip(&self.begin).zip(&self.k) {
            *to = y + h * Weights::dot(k);
        }
        if self.extent.grade != Grade::Even {
            self.end.iter_mut().zip(&self.ends.first).for_each(|(to, first)| *to += h * first);
        }
        self.error(scale)
    }

    /// One stage, y + h Σ a k at the time of node `J`: keep the newest slope, combine all so far over the coupled components, evaluate the next.
    ///
    /// Evaluations follow on one another, so what counts is the path from one slope to the next: a product and a sum.
    #[inline(always)]
    pub(super) fn stage<R: Row, const J: usize, S: System + ?Sized>(&mut self, system: &S) {
        // The newest slope comes last into the sum, apart from all that is known before it: 157 ns instead of 170 for a step
        // of one oscillator. Rounding differs from the order of the books by a last place.
        let h = self.extent.step;
        let last = h * R::LAST;
        for (((to, y), k), newest) in
            self.stage.iter_mut().zip(&self.begin).zip(&mut self.k).zip(&self.newest)
        {
            *to = (y + h * R::rest(k)) + last * newest;
            k[R::NEWEST] = *newest;
        }
        let quadratures = self.k[self.dimension..].iter_mut().zip(&self.newest[self.dimension..]);
        for (k, newest) in quadratures {
            k[R::NEWEST] = *newest;
        }
        // Over σ the slopes begin with 0 at a singular start; the straight motion with the first slope is taken apart from
        // them and added here exactly.
        if self.extent.grade != Grade::Even {
            let past = h * self.extent.grade.time(NODES[J]);
            self.stage.iter_mut().zip(&self.ends.first).for_each(|(to, first)| *to += past * first);
        }
        // A node of 1 is the very end of the step, not t + h, which may differ in the last bit.
        let t = if NODES[J] == 1.0 {
            self.extent.target
        } else {
            self.extent.time + self.extent.grade.time(NODES[J]) * h
        };
        system.slopes(t, &self.stage, &mut self.newest);
        self.evaluations += 1;
        self.pace(self.extent.grade.pace(NODES[J]));
    }

    /// From slopes over the part of the time to those over σ, less the straight part: φ'(σ) (f - f₀).
    #[inline(always)]
    pub(super) fn pace(&mut self, pace: f64) {
        if self.extent.grade != Grade::Even {
            self.newest
                .iter_mut()
                .zip(&self.ends.first)
                .for_each(|(slope, first)| *slope = pace * (*slope - first));
        }
    }

    /// Keeps the newest slopes as those of stage `J`.
    #[inline(always)]
    pub(super) fn keep<const J: usize>(&mut self) {
        for (k, slope) in self.k.iter_mut().zip(&self.newest) {
            k[J] = *slope;
        }
    }

    /// The slopes at the start as the newest ones: what a rejected attempt left of them is another stage's.
    fn recall_first(&mut self) {
        self.newest.copy_from_slice(&self.ends.first);
        self.pace(self.extent.grade.pace(0.0));
    }
}
