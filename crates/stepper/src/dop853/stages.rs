//! The stages of a step, and its end.

use super::tableau::{
    NODES, Row, Stage2, Stage3, Stage4, Stage5, Stage6, Stage7, Stage8, Stage9, Stage10, Stage11, Stage12,
    Weights,
};
use super::{Dop853, Grade};
use crate::{System, Target};

impl Dop853 {
    pub(super) fn attempt_span<S: System + ?Sized>(
        &mut self,
        system: &S,
        Target { end, grade }: Target,
        scale: &[f64],
    ) -> f64 {
        if !self.first_known {
            self.restart_slopes(system);
        }
        self.forget_step();
        let h = end - self.time;
        (self.step, self.grade) = (h, if self.coasts { Grade::Even } else { grade });
        (self.end_time, self.target) = (end, end);
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
        if self.grade != Grade::Even {
            self.end.iter_mut().zip(&self.first).for_each(|(to, first)| *to += h * first);
        }
        self.error(scale)
    }

    /// One stage, at node `J`: keep the newest slope, combine all so far over the coupled components, evaluate the next.
    ///
    /// Evaluations follow on one another, so what counts is the path from one slope to the next: a product and a sum.
    #[inline(always)]
    pub(super) fn stage<R: Row, const J: usize, S: System + ?Sized>(&mut self, system: &S) {
        let h = self.step;
        let last = h * R::LAST;
        for (((to, y), k), newest) in self.stage.iter_mut().zip(&self.begin).zip(&mut self.k).zip(&self.slope)
        {
            *to = (y + h * R::rest(k)) + last * newest;
            k[R::NEWEST] = *newest;
        }
        let quadratures = self.k[self.dimension..].iter_mut().zip(&self.slope[self.dimension..]);
        for (k, newest) in quadratures {
            k[R::NEWEST] = *newest;
        }
        if self.grade != Grade::Even {
            let past = h * self.grade.time(NODES[J]);
            self.stage.iter_mut().zip(&self.first).for_each(|(to, first)| *to += past * first);
        }
        // A node of 1 is the very end of the step, not t + h, which may differ in the last bit.
        let t = if NODES[J] == 1.0 { self.target } else { self.time + self.grade.time(NODES[J]) * h };
        system.slopes(t, &self.stage, &mut self.slope);
        self.evaluations += 1;
        self.pace(self.grade.pace(NODES[J]));
    }

    /// From slopes over the part of the time to those over σ.
    #[inline(always)]
    pub(super) fn pace(&mut self, pace: f64) {
        if self.grade != Grade::Even {
            self.slope
                .iter_mut()
                .zip(&self.first)
                .for_each(|(slope, first)| *slope = pace * (*slope - first));
        }
    }

    #[inline(always)]
    pub(super) fn keep<const J: usize>(&mut self) {
        for (k, slope) in self.k.iter_mut().zip(&self.slope) {
            k[J] = *slope;
        }
    }

    fn recall_first(&mut self) {
        self.slope.copy_from_slice(&self.first);
        self.pace(self.grade.pace(0.0));
    }
}
