//! Accurate cut of a step, for models in which a motion may decay within a step.
//!
//! In such a step the dense output is tens of times less accurate than the end of a step, which also affects the event time. A separate
//! step to the event time gives an accurate state. The value of the event function in that state corrects the event time.

use super::{Fall, Search};
use crate::equations::Equations;
use crate::run::located::watch::Watch;
use crate::run::located::watched::Watched;
use arrayvec::ArrayVec;
use stickslip_stepper::Attempt;

/// Largest number of corrections of the event time.
const MOVES: u32 = 3;
/// Fraction of the step over which a finite difference gives the rate of an event function.
const SHARE: f64 = 1e-4;

impl Watch {
    /// Cuts the step at an event and corrects the event time by separate steps to that time.
    #[inline(never)]
    pub(super) fn meet<'e, A: for<'q> Attempt<Equations<'q>>>(
        &mut self,
        (solver, scale): (&mut A, &Vec<f64>),
        eq: &Equations<'e>,
        fall: &mut Fall<'e>,
    ) {
        let (begin, end) = (solver.span().time, solver.span().end_time);
        let components = solver.span().end.len();
        for k in 0..=MOVES {
            solver.cut(fall.t);
            solver.settle(eq, scale, 0..components);
            let (tolerance, seen) = (self.tolerance, ArrayVec::new());
            let search = Search { from: &self.from, to: &self.to, tolerance, solver, eq, is_cut: true, seen };
            let (value, near) = (search.settled(fall.watched, fall.t), search.bands(fall.watched).1);
            let before = fall.t - SHARE * (fall.t - begin);
            let rate = (search.inside(fall.watched, fall.t) - search.inside(fall.watched, before))
                / (fall.t - before);
            let to = fall.t - value / rate;
            if k == MOVES || value.abs() <= near || !(rate < 0.0 && to > begin && to < end) {
                return;
            }
            fall.t = to;
        }
    }
}

impl<A: for<'q> Attempt<Equations<'q>>> Search<'_, '_, A> {
    /// Returns the value of an event function in the state at the end of the step, at time t.
    fn settled(&self, watched: Watched<'_>, t: f64) -> f64 {
        let end = self.solver.span().end;
        let n = self.eq.layout.free;
        match watched {
            Watched::Closed(steady, guard) => {
                steady.guard(guard, &steady.motion(t, |i| end[i], |i| end[n + i]))
            }
            Watched::Contact(index, contact, guard) => {
                guard.value(contact, self.eq.law(index), &self.eq.motion(contact, t, |i| end[i]))
            }
            Watched::Block(k, guard) => self.eq.block_guard(k, guard, t, |i| end[i]),
        }
    }
}
