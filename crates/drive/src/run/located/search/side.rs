//! Event function of a shrinking contact: the distance between its state (d, u) and an old curve of its slip memory.
//!
//! This distance is no polynomial, because the curve has breakpoints. With the dense output, values and rates cost little.

use super::Search;
use crate::contact::{Contact, Motion};
use crate::equations::Equations;
use crate::run::located::watched::Watched;
use stickslip_contact::Guard;
use stickslip_stepper::{Attempt, Completion};

/// Fractions of a step at which the distance is checked: closer near its start.
pub(super) const SHARES: [f64; 7] = [0.03125, 0.0625, 0.125, 0.25, 0.5, 0.75, 1.0];
/// Largest number of tangent constructions in the search for one minimum.
const DIPS: usize = 8;

/// Tangent of an event function at time `t`.
#[derive(Clone, Copy)]
struct Tangent {
    t: f64,
    y: f64,
    rate: f64,
}

impl Tangent {
    /// Returns time and value at the intersection of two tangents, if the function falls at the first and rises at the second.
    fn meet([first, last]: [Self; 2]) -> Option<(f64, f64)> {
        let way = (last.y - first.y - last.rate * (last.t - first.t)) / (first.rate - last.rate);
        let t = first.t + way;
        let inside = first.rate < 0.0 && last.rate > 0.0 && first.t < t && t < last.t;
        inside.then_some((t, first.y + first.rate * way))
    }
}

impl<'e, A: for<'q> Attempt<Equations<'q>>> Search<'_, 'e, A> {
    /// Returns the first time found at which the state (d, u) has crossed the old memory curve, and the distance from the curve.
    ///
    /// A step that begins after a crossing begins on the curve, and a second crossing may follow soon. Between a time with decreasing
    /// distance and the next one with increasing distance there is a minimum. If the curvature of the distance does not change sign, the
    /// minimum is not below the intersection of both tangents.
    pub(super) fn side(&mut self, (index, contact): (usize, &'e Contact)) -> Option<(f64, f64)> {
        let watched = Watched::Contact(index, contact, Guard::Side);
        let law = self.eq.law(index);
        let tangent = |t: f64, motion: &Motion| {
            let [y, rate] = Guard::beside(law, motion);
            Tangent { t, y, rate }
        };
        let (t0, t1) = (self.solver.span().time, self.solver.span().end_time);
        let (begin, end) = (self.from[index].motion, self.to[index].motion);
        self.solver.complete(self.eq, Completion::Dense);
        let mut before = tangent(t0, &begin);
        for share in SHARES {
            let (t, motion) = if share < 1.0 { self.motion_at(index, contact, share) } else { (t1, end) };
            let after = tangent(t, &motion);
            if after.y < 0.0 && self.has_fallen(watched, after.y) {
                return Some((after.t, after.y));
            }
            let mut part = [before, after];
            for _ in 0..DIPS {
                let Some((t, _)) = Tangent::meet(part).filter(|(_, y)| *y < 0.0) else { break };
                let at = self.solver.part(t);
                let lowest = tangent(t, &self.eq.motion(contact, t, |i| self.solver.value_at(i, at)));
                if lowest.y < 0.0 && self.has_fallen(watched, lowest.y) {
                    return Some((t, lowest.y));
                }
                part[usize::from(lowest.rate >= 0.0)] = lowest;
            }
            before = after;
        }
        None
    }
}
