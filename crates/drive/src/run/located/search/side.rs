//! The apex of a shrinking contact beside an old curve of its memory.
//!
//! How far it is from that curve is no polynomial: the curve has knots. Values and rates are cheap once the dense output is there.

use super::{LOOKS, Search};
use crate::contact::{Contact, Guard, Motion};
use crate::equations::Equations;
use crate::run::located::watched::Watched;
use stickslip_stepper::{Attempt, Completion};

/// Places near the start of a step, where the apex may have gone across, that are looked at before [`LOOKS`].
pub(super) const EARLY: [f64; 3] = [0.03125, 0.0625, 0.125];
/// How often tangents are laid where it dips.
const DIPS: usize = 8;

/// The tangent of a guard at a moment.
#[derive(Clone, Copy)]
struct Tangent {
    t: f64,
    y: f64,
    rate: f64,
}

impl Tangent {
    /// When and where two of them meet, of a guard that falls at the first and rises at the last.
    fn meet([first, last]: [Self; 2]) -> Option<(f64, f64)> {
        let way = (last.y - first.y - last.rate * (last.t - first.t)) / (first.rate - last.rate);
        let t = first.t + way;
        let inside = first.rate < 0.0 && last.rate > 0.0 && first.t < t && t < last.t;
        inside.then_some((t, first.y + first.rate * way))
    }
}

impl<'e, A: for<'q> Attempt<Equations<'q>>> Search<'_, 'e, A> {
    /// The first moment that is found at which the apex has gone across the old curve, and how far.
    ///
    /// It stands on it where a step begins after it has gone across, and may soon go back and forth again. Where it comes nearer at
    /// one moment that is looked at and goes away at the next, it dips between them, no deeper than where both tangents meet if its
    /// way is bent to one side.
    // Looked at three times, without its rates, an apex that went back after 3 and forth after another 0.5 thousandths of a period was seen
    // in every other period only, and what was not seen moved the step by 3e-4 u_c at any tolerance.
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
        for share in EARLY.into_iter().chain(LOOKS).chain([1.0]) {
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
