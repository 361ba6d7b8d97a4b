//! Steps and leaps as a record reads them.

use super::Located;
use crate::contact::Mode;
use crate::equations::Equations;
use crate::interval::PhasePoint;
use crate::record::{Record, Stride};
use crate::state::State;
use stickslip_stepper::{Attempt, Completion, Step};

/// A step, on its dense output, which an event may have cut.
struct Tried<'s, A> {
    solver: &'s A,
    /// Part of the step tried at which it ends.
    end: f64,
    knots: Vec<(usize, f64)>,
}

impl<A: Step> Stride for Tried<'_, A> {
    fn at(&mut self, part: f64, y: &mut [f64]) -> [f64; 2] {
        let part = part * self.end;
        y.iter_mut().enumerate().for_each(|(i, y)| *y = self.solver.value_at(i, part));
        let [t, pace] = self.solver.moment(part);
        [t, pace * self.end]
    }

    fn knots(&self) -> &[(usize, f64)] {
        &self.knots
    }
}

impl<A: for<'e> Attempt<Equations<'e>>> Located<'_, A> {
    /// Tells the step just made, whose paths are on the page.
    #[inline(never)]
    pub(super) fn tell_stride(&mut self, state: &State, record: &mut dyn Record) {
        let asked = self.motion.solver.evaluations();
        self.motion.solver.complete(&self.setting.equations(state, &self.interval), Completion::Dense);
        self.output.evaluations += self.motion.solver.evaluations() - asked;
        let solver = &self.motion.solver;
        let end = solver.part(solver.span().end_time);
        let growing = (0..state.modes.len()).filter(|c| state.modes[*c] == Mode::Grow);
        let part = |t: f64| (solver.part(t) / end).min(1.0);
        let knots = growing.flat_map(|c| self.ledger.ends(c, state.t).map(move |t| (c, part(t)))).collect();
        record.stride(&mut Tried { solver, end, knots });
    }

    /// Tells a leap, whether or not it `ends` with the event.
    #[inline(never)]
    pub(super) fn tell_leap(&mut self, from: f64, to: PhasePoint, ends: bool, record: &mut dyn Record) {
        let asked = self.swing.evaluations;
        record.stride(&mut self.swing.stretch([from, to.t], ends));
        self.swing.evaluations = asked;
    }
}
