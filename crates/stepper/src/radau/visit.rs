//! Accurate states inside a step, by a separate step from its start to the requested time.
//!
//! The dense output interpolates the stages. Between stages, a stiff component, such as a driver current, has a large interpolation error.
//! A separate step from the same start avoids this error. Its stages are close to the dense output, so one or two corrections suffice.

use super::{Radau, dense};
use crate::System;
use crate::radau::tableau::NODES;
use std::ops::Range;

impl Radau {
    /// Creates the stepper for times inside the step, unless the stepper exists.
    pub(super) fn invite(&mut self) {
        if self.visitor.is_none() {
            self.visitor = Some(Box::new(self.clone()));
        }
    }

    /// Writes all components at time `t` inside the step into `out`. Returns false without a result at the ends, for constant
    /// accelerations, without dense output, and if the Newton iteration fails.
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

    /// Replaces the given components and their slopes at the end of a cut step by the result of a separate step to that end.
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

    /// Repeats the step `of` up to time `t` (s). Returns false if the Newton iteration fails.
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
