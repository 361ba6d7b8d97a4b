//! Moments inside a step, as exactly as its end.
//!
//! The dense output lies on the stages, and between them a stiff component is off from where it belongs by what the polynomial misses: a
//! current that is the rest of two large voltages over a small resistance is then off by thousandths of its peak. A step from the
//! same start to the moment ends where everything belongs. Its stages are those of the dense output but for that, so that a correction
//! or two find them.

use super::{Radau, dense};
use crate::System;
use crate::radau::tableau::NODES;
use std::ops::Range;

impl Radau {
    /// Makes the one that visits, whole as this one is.
    pub(super) fn invite(&mut self) {
        if self.visitor.is_none() {
            self.visitor = Some(Box::new(self.clone()));
        }
    }

    /// All components at time `t` inside the step; false, with nothing done, where the dense output is all there is: at its end, of a
    /// parabola, and where no stages are found.
    pub(super) fn visit_inside<S: System + ?Sized>(
        &mut self,
        system: &S,
        t: f64,
        scale: &[f64],
        out: &mut [f64],
    ) -> bool {
        if self.coasts || !self.dense_known || t <= self.extent.time || t >= self.extent.target {
            return false;
        }
        let Some(mut visitor) = self.visitor.take() else { return false };
        let found = visitor.go_to(self, system, t, scale);
        if found {
            out.iter_mut().zip(&visitor.end).for_each(|(to, end)| *to = *end);
        }
        self.visitor = Some(visitor);
        found
    }

    /// Puts some components of a step that was cut as exactly as a step up to there has them, and their slopes with them.
    pub(super) fn settle_cut<S: System + ?Sized>(
        &mut self,
        system: &S,
        scale: &[f64],
        components: Range<usize>,
    ) {
        self.invite();
        let mut end = std::mem::take(&mut self.newest);
        let asked = self.visitor.as_ref().map_or(self.evaluations, |visitor| visitor.evaluations);
        let found = self.visit_inside(system, self.extent.end_time, scale, &mut end);
        if let Some(visitor) = self.visitor.as_ref() {
            self.evaluations += visitor.evaluations - asked;
            if found {
                self.end[components.clone()].copy_from_slice(&end[components.clone()]);
                self.last[components.clone()].copy_from_slice(&visitor.last[components]);
            }
        }
        self.newest = end;
    }

    /// Makes the step of another one up to time `t`; whether its stages are found.
    fn go_to<S: System + ?Sized>(&mut self, of: &Self, system: &S, t: f64, scale: &[f64]) -> bool {
        self.begin.clone_from(&of.begin);
        self.first.clone_from(&of.first);
        self.jacobian.copy(&of.jacobian);
        let (time, part) = (of.extent.time, of.fraction(t));
        (self.extent.time, self.extent.step) = (time, t - time);
        (self.extent.end_time, self.extent.target) = (t, t);
        let pace = of.extent.step.recip();
        for (k, c) in self.k.iter_mut().zip(&of.polynomials) {
            *k = NODES.map(|node| pace * dense::rate(c, part * node));
        }
        let found = self.factor_stages() && self.correct_stages(system, scale);
        if found {
            self.arrive();
        }
        found && self.end.iter().sum::<f64>().is_finite()
    }
}
