//! Accurate states inside a step, by a separate step from its start to the requested time.
//!
//! If a component decays several times within a step, the dense output oscillates between the ends. The error of the dense output can
//! exceed ten times the error at the end. A separate step from the same start does not have this error.

use super::{DormandPrince, Grade};
use crate::{System, Target};
use std::ops::Range;

impl DormandPrince {
    /// Creates the stepper for times inside the step, unless the stepper exists.
    pub(super) fn invite(&mut self) {
        if self.visitor.is_none() {
            self.visitor = Some(Box::new(self.clone()));
        }
    }

    /// Writes all components at time `t` inside the step into `out`. Returns false without a result at the ends, for constant
    /// accelerations, and where the separate step fails.
    pub(super) fn visit_inside<S: System + ?Sized>(
        &mut self,
        system: &S,
        t: f64,
        scale: &[f64],
        out: &mut [f64],
    ) -> bool {
        if self.coasts || !self.ends.first_known || t <= self.extent.time || t >= self.extent.target {
            return false;
        }
        let Some(mut visitor) = self.visitor.take() else { return false };
        visitor.begin.clone_from(&self.begin);
        visitor.ends.first.clone_from(&self.ends.first);
        visitor.ends.first_known = true;
        (visitor.extent.time, visitor.coasts) = (self.extent.time, false);
        let grade = if self.extent.grade == Grade::Start { Grade::Start } else { Grade::Even };
        let found = visitor.attempt_span(system, Target { end: t, grade }, scale) <= 1.0;
        if found {
            out.iter_mut().zip(&visitor.end).for_each(|(to, end)| *to = *end);
        }
        self.visitor = Some(visitor);
        found
    }

    /// Replaces the given components at the end of a cut step by the result of a separate step to that end.
    pub(super) fn settle_cut<S: System + ?Sized>(
        &mut self,
        system: &S,
        scale: &[f64],
        components: Range<usize>,
    ) {
        self.invite();
        let mut end = std::mem::take(&mut self.stage);
        end.resize(self.end.len(), 0.0);
        let asked = self.visitor.as_ref().map_or(self.evaluations, |visitor| visitor.evaluations);
        if self.visit_inside(system, self.extent.end_time, scale, &mut end) {
            self.end[components.clone()].copy_from_slice(&end[components]);
        }
        self.evaluations += self.visitor.as_ref().map_or(0, |visitor| visitor.evaluations - asked);
        end.truncate(self.dimension.next_multiple_of(2));
        self.stage = end;
    }
}
