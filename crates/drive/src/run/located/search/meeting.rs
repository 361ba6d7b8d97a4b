//! A step that is cut where something fades within it: the cut met as exactly as an end.
//!
//! The dense output has the moment at which a guard falls as well as it has the state, which is off there by tens of what an end may be.
//! A step of its own to that moment tells the state, and by how much its guard is beside zero; the moment is moved by that.

use super::{Fall, Search};
use crate::equations::Equations;
use crate::run::located::watch::Watch;
use crate::run::located::watched::Watched;
use arrayvec::ArrayVec;
use stickslip_stepper::Attempt;

/// How often a moment is moved.
const MOVES: u32 = 3;
/// Part of the step over which the rate of a guard is taken.
const SHARE: f64 = 1e-4;

impl Watch {
    /// Cuts the step where a guard falls, and moves that moment to where it does so by a step of its own.
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
    /// Value of a guard in the state at the end of the step, at time t.
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
