//! The apex of a shrinking contact beside an old curve of its memory.
//!
//! How far it is from that curve is no polynomial: the curve has knots. Values are cheap once the dense output is there, rates are
//! differences of them.

use super::{Search, Watched};
use crate::equations::Equations;
use stickslip_stepper::{Attempt, Completion};

/// Places inside a step that are looked at, nearest to where the apex may have gone across.
const LOOKS: [f64; 7] = [0.03125, 0.0625, 0.125, 0.25, 0.5, 0.75, 1.0];
/// How often tangents are laid where it dips.
const DIPS: usize = 8;
/// Over which part of a step its rate is taken.
const APART: f64 = 1e-6;

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
    pub(super) fn side(&mut self, watched: Watched<'e>, g1: f64) -> Option<(f64, f64)> {
        let (t0, t1) = (self.solver.span().time, self.solver.span().end_time);
        self.solver.complete(self.eq, Completion::Dense);
        let apart = APART * (t1 - t0);
        let tangent = |t: f64, y: f64| {
            let beside = if t + apart > t1 { t - apart } else { t + apart };
            // By what rounding has left of the way between them.
            Tangent { t, y, rate: (self.inside(watched, beside) - y) / (beside - t) }
        };
        let mut before = tangent(t0, self.at_begin(watched));
        for share in LOOKS {
            let t = t0 + share * (t1 - t0);
            let g = if share < 1.0 { self.inside(watched, t) } else { g1 };
            if g < 0.0 && self.has_fallen(watched, g) {
                return Some((t, g));
            }
            let after = tangent(t, g);
            let mut part = [before, after];
            for _ in 0..DIPS {
                let Some((t, _)) = Tangent::meet(part).filter(|(_, y)| *y < 0.0) else { break };
                let lowest = tangent(t, self.inside(watched, t));
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
