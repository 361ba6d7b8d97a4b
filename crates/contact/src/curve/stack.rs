//! The stack of knots: how it grows, is cut, and stays bounded.
//!
//! A growing contact pushes knots, a dragging edge gives up those it passes and puts itself in their place, and where the
//! stack is full the knots that matter least go ([`super::thinning`]).

use super::Curve;
use super::cut::Edge;
use super::front::Front;
use super::sweep::{self, Told};
use crate::{Apex, Interface};

/// Slopes of the top piece that keep every knot merged into it within round-off of where it was: without this
/// bound a slightly curved growth in many tiny steps would be straightened without limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SlopeRange {
    pub(super) low: f64,
    pub(super) high: f64,
}

// Growth along a straight line in 100 000 steps leaves two knots; without merging the stack is full after a sixth of them.
// Along a path that bends by 1e-9 of its length 866 are left, their force 6e-7 of what the bend adds beside it, and 28 080 at
// a bend of 1e-6.

impl SlopeRange {
    /// Nothing merged yet: any slope will do.
    pub(super) const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    /// Nothing may be merged: the top piece is no growth, or a curved one.
    pub(super) const NONE: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };
}

/// Deviation of a merged knot, in units of the last place of the largest of |u| and κd.
// 0 merges nothing but by chance (16 383 knots of the straight path, 89 506 of that with a bend of 1e-9); 16 leave 294 of the
// latter and err by 2e-6 of what the bend adds, 256 leave 74 and err by 4e-5.
const COLLINEAR_ULPS: f64 = 2.0;

/// Knots that one move adds at most: the knot where it cuts, or touches, and the apex.
pub(super) const KNOTS_PER_MOVE: usize = 2;

impl Curve {
    /// Growth in full stick along a curved path, its force and energy integrated elsewhere. `joins`: it goes on smoothly from
    /// the growth before.
    pub(super) fn grow(&mut self, law: &Interface, to: Apex, (force, energy): (f64, f64), joins: bool) {
        if self.knots.is_empty() {
            let touch = self.touching(to);
            self.knots.push(touch);
        }
        if let Some(last) = self.knots.last_mut() {
            last.joined = joins;
            let modulus = law.tangential_modulus();
            let knot = last.grow_by(law, to, force / modulus, 2.0 * energy / modulus);
            self.knots.push(knot);
        }
        self.front = Front::STICK;
        self.range = SlopeRange::NONE;
        self.apex = to;
    }

    /// Pushes a straight piece of growth, merging it with the piece below where the two are collinear.
    pub(super) fn push_grown(&mut self, law: &Interface, to: Apex) {
        let count = self.knots.len();
        let top = self.knots[count - 1];
        let knot = top.stick(law, to);
        if count >= 2 {
            let base = self.knots[count - 2];
            let slack =
                COLLINEAR_ULPS * f64::EPSILON * top.p.abs().max(knot.p.abs()).max(law.stick_slope() * knot.h);
            let rise = top.h - base.h;
            let range = SlopeRange {
                low: self.range.low.max((top.p - base.p - slack) / rise),
                high: self.range.high.min((top.p - base.p + slack) / rise),
            };
            let slope = (knot.p - base.p) / (knot.h - base.h);
            let straight = top.slope == top.gain && top.slope.abs() < law.stick_slope();
            if straight && (range.low..=range.high).contains(&slope) {
                self.knots[count - 1] = base.grow(law, knot.h, slope, knot.p);
                self.range = range;
                return;
            }
        }
        self.knots.push(knot);
        self.range = SlopeRange::ALL;
    }

    /// Replaces what was cut by the straight edge of the wedge; gives the friction work, J.
    pub(super) fn push_cut(&mut self, law: &Interface, (edge, to): (Edge, Apex), told: Told) -> f64 {
        let foot = edge.foot(law, &self.knots, to);
        let end = edge.end(law, &foot, self.knots.last(), to);
        let friction = sweep::slipped(law, &self.knots, [self.apex, to], (&edge, &foot), told);
        self.knots.truncate(edge.kept);
        if edge.splits || edge.is_gross() {
            self.knots.push(foot);
        }
        if end.h > foot.h {
            self.knots.push(end);
        } else if let Some(top) = self.knots.last_mut() {
            // A move below the last place of the level cuts nothing; the apex still takes it.
            top.p = to.u;
        }
        self.front = edge.front();
        self.range = SlopeRange::NONE;
        friction
    }
}
