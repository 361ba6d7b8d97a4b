//! Stages of a step, and the state at its end.

use super::order5;
use super::order8::{
    NODES, Stage2, Stage3, Stage4, Stage5, Stage6, Stage7, Stage8, Stage9, Stage10, Stage11, Stage12, Weights,
};
use super::tableau::{Pair, Row, pairs_of};
use super::{DormandPrince, Grade};
use crate::{System, Target};

/// Calls a stage function with the number of pairs of components as constants, so that its loops are unrolled.
///
/// A pair holds two coupled components or two quadratures. The listed combinations cover bodies with up to five coordinates; the last arm
/// is generic.
macro_rules! of_pairs {
    ($step:ident, $by:ident, $may_grade:literal, $system:ident) => {
        match ($step.stage.len() / 2, $step.k.len() - $step.stage.len() / 2) {
            (1, 1) => $step.$by::<1, 1, $may_grade, S>($system),
            (2, 1) => $step.$by::<2, 1, $may_grade, S>($system),
            (2, 2) => $step.$by::<2, 2, $may_grade, S>($system),
            (3, 1) => $step.$by::<3, 1, $may_grade, S>($system),
            (3, 3) => $step.$by::<3, 3, $may_grade, S>($system),
            (4, 2) => $step.$by::<4, 2, $may_grade, S>($system),
            (4, 3) => $step.$by::<4, 3, $may_grade, S>($system),
            (5, 3) => $step.$by::<5, 3, $may_grade, S>($system),
            _ => $step.$by::<0, 0, $may_grade, S>($system),
        }
    };
}

impl DormandPrince {
    /// Attempts a step: computes all stages, the end y + h Σ b_i k_i and the error estimate.
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
        match self.extent.grade {
            Grade::Few => of_pairs!(self, by_fifth, false, system),
            Grade::Even => of_pairs!(self, by_eighth, false, system),
            Grade::Start | Grade::End => of_pairs!(self, by_eighth, true, system),
        }
        self.error(scale)
    }

    /// Computes the stages of DOPRI5, the state at the end of the step and the slopes there, which are the last stage.
    #[inline(never)]
    fn by_fifth<const PAIRS: usize, const RATES: usize, const MAY_GRADE: bool, S: System + ?Sized>(
        &mut self,
        system: &S,
    ) {
        self.stage::<order5::Stage2, S, PAIRS, RATES, MAY_GRADE>(system, order5::NODES[1]);
        self.stage::<order5::Stage3, S, PAIRS, RATES, MAY_GRADE>(system, order5::NODES[2]);
        self.stage::<order5::Stage4, S, PAIRS, RATES, MAY_GRADE>(system, order5::NODES[3]);
        self.stage::<order5::Stage5, S, PAIRS, RATES, MAY_GRADE>(system, order5::NODES[4]);
        self.stage::<order5::Stage6, S, PAIRS, RATES, MAY_GRADE>(system, order5::NODES[5]);
        self.keep::<5>();
        self.end_by::<order5::Weights>();
        self.end_slopes(system);
        self.newest.copy_from_slice(&self.ends.last);
        self.pace(self.extent.grade.pace(1.0));
        self.keep::<{ order5::END }>();
    }

    /// Computes the stages of DOP853 and the state at the end of the step.
    #[inline(never)]
    fn by_eighth<const PAIRS: usize, const RATES: usize, const MAY_GRADE: bool, S: System + ?Sized>(
        &mut self,
        system: &S,
    ) {
        self.stage::<Stage2, S, PAIRS, RATES, MAY_GRADE>(system, NODES[1]);
        self.stage::<Stage3, S, PAIRS, RATES, MAY_GRADE>(system, NODES[2]);
        self.stage::<Stage4, S, PAIRS, RATES, MAY_GRADE>(system, NODES[3]);
        self.stage::<Stage5, S, PAIRS, RATES, MAY_GRADE>(system, NODES[4]);
        self.stage::<Stage6, S, PAIRS, RATES, MAY_GRADE>(system, NODES[5]);
        self.stage::<Stage7, S, PAIRS, RATES, MAY_GRADE>(system, NODES[6]);
        self.stage::<Stage8, S, PAIRS, RATES, MAY_GRADE>(system, NODES[7]);
        self.stage::<Stage9, S, PAIRS, RATES, MAY_GRADE>(system, NODES[8]);
        self.stage::<Stage10, S, PAIRS, RATES, MAY_GRADE>(system, NODES[9]);
        self.stage::<Stage11, S, PAIRS, RATES, MAY_GRADE>(system, NODES[10]);
        self.stage::<Stage12, S, PAIRS, RATES, MAY_GRADE>(system, NODES[11]);
        self.keep::<11>();
        self.end_by::<Weights>();
    }

    /// Computes the end state y + h Σ b_i k_i, plus the linear part that graded stages leave out.
    #[inline(always)]
    fn end_by<R: Row>(&mut self) {
        let h = self.extent.step;
        let pairs = self.k.len();
        let (begin, end) = (&pairs_of(&self.begin)[..pairs], &mut self.end.as_chunks_mut::<2>().0[..pairs]);
        for (i, k) in self.k.iter().enumerate() {
            end[i] = (Pair(begin[i]) + h * R::dot(k)).0;
        }
        if !self.extent.grade.is_even() {
            self.end.iter_mut().zip(&self.ends.first).for_each(|(to, first)| *to += h * first);
        }
    }

    /// Computes one stage: stores the newest slope, combines all slopes so far, and evaluates the system at the node of the stage.
    ///
    /// `PAIRS` is the number of pairs of coupled components, and `RATES` is the number of pairs of quadratures; 0 means any number. Without
    /// `MAY_GRADE` the stages are evenly distributed in time.
    #[inline(always)]
    pub(super) fn stage<
        R: Row,
        S: System + ?Sized,
        const PAIRS: usize,
        const RATES: usize,
        const MAY_GRADE: bool,
    >(
        &mut self,
        system: &S,
        node: f64,
    ) {
        // The newest slope is added last: all other terms can be summed before it is known. The order of summation affects rounding.
        let h = self.extent.step;
        let last = h * R::LAST;
        // Slices cut to one length: the compiler drops the bounds checks.
        let stage = self.stage.as_chunks_mut::<2>().0;
        let pairs = if PAIRS > 0 { PAIRS } else { stage.len() };
        let (coupled, quadratures) = self.k.split_at_mut(pairs);
        let (newest, rates) = pairs_of(&self.newest).split_at(pairs);
        let (begin, stage) = (&pairs_of(&self.begin)[..pairs], &mut stage[..pairs]);
        for i in 0..pairs {
            let k = &mut coupled[i];
            stage[i] = ((Pair(begin[i]) + h * R::rest(k)) + last * Pair(newest[i])).0;
            k[R::NEWEST] = Pair(newest[i]);
        }
        let others = if RATES > 0 { RATES } else { quadratures.len() };
        for (k, rates) in quadratures[..others].iter_mut().zip(&rates[..others]) {
            k[R::NEWEST] = Pair(*rates);
        }
        // The derivatives by σ vanish at a singular start. The linear motion with the first slope is split off and added here.
        let is_even = !MAY_GRADE || self.extent.grade.is_even();
        if !is_even {
            let past = h * self.extent.grade.time(node);
            let stage = &mut self.stage.as_chunks_mut::<2>().0[..pairs];
            for (to, first) in stage.iter_mut().zip(&pairs_of(&self.ends.first)[..pairs]) {
                *to = (Pair(*to) + past * Pair(*first)).0;
            }
        }
        // A node of 1 is the exact end of the step, which may differ from t + h in the last bit.
        let t = if node == 1.0 {
            self.extent.target
        } else if is_even {
            self.extent.time + node * h
        } else {
            self.extent.time + self.extent.grade.time(node) * h
        };
        system.slopes(t, &self.stage[..self.dimension], &mut self.newest[..self.total]);
        self.evaluations += 1;
        if !is_even {
            let (pace, all) = (self.extent.grade.pace(node), pairs + others);
            let newest = &mut self.newest.as_chunks_mut::<2>().0[..all];
            for (slope, first) in newest.iter_mut().zip(&pairs_of(&self.ends.first)[..all]) {
                *slope = (pace * (Pair(*slope) - Pair(*first))).0;
            }
        }
    }

    /// Converts the newest slopes f to derivatives with respect to σ without the linear part: φ'(σ) (f - f₀).
    #[inline(always)]
    pub(super) fn pace(&mut self, pace: f64) {
        if !self.extent.grade.is_even() {
            self.newest
                .iter_mut()
                .zip(&self.ends.first)
                .for_each(|(slope, first)| *slope = pace * (*slope - first));
        }
    }

    /// Stores the newest slopes as the slopes of stage `J`.
    #[inline(always)]
    pub(super) fn keep<const J: usize>(&mut self) {
        for (k, slopes) in self.k.iter_mut().zip(pairs_of(&self.newest)) {
            k[J] = Pair(*slopes);
        }
    }

    /// Makes the slopes at the start the newest slopes, because a rejected attempt leaves slopes of another stage.
    fn recall_first(&mut self) {
        self.newest.copy_from_slice(&self.ends.first);
        self.pace(self.extent.grade.pace(0.0));
    }
}
