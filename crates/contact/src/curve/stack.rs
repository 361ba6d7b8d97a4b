//! Changes of the breakpoint stack: growth of the contact, slip, and the limit of the number of breakpoints.
//!
//! A growing contact adds breakpoints. Slip removes breakpoints and adds a straight piece. A full stack removes the breakpoints with the
//! smallest effect ([`super::thinning`]).

use super::Curve;
use super::cut::Edge;
use super::front::Front;
use super::sweep::{self, Told};
use crate::{Apex, Interface};

/// Range of slopes of the top piece for which all breakpoints merged into this piece lie on it within rounding.
///
/// Without this range, growth along a slightly curved path in many small steps would be straightened without limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SlopeRange {
    pub(super) low: f64,
    pub(super) high: f64,
}

// Merging keeps the number of breakpoints small when a contact grows along a straight line in many steps.

impl SlopeRange {
    /// Range before the first merge: every slope is possible.
    pub(super) const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    /// Range that forbids merging, for a top piece that is a curved growth path or was made by slip.
    pub(super) const NONE: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };
}

/// Largest deviation of a merged breakpoint, in units of the last place of the larger of |u| and κd.
const COLLINEAR_ULPS: f64 = 2.0;

/// Largest number of breakpoints that a move adds: the point of intersection or first touch, and the apex.
pub(super) const KNOTS_PER_MOVE: usize = 2;

impl Curve {
    /// Adds growth in full stick along a curved path, with force and energy integrated along it.
    ///
    /// `joins` states that the path continues the previous growth smoothly.
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

    /// Adds a straight growth piece, or merges it with the piece below if both are collinear.
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

    /// Replaces the part of the curve that slips by the limit line. Returns the friction work, J.
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
            // A move below the last place of the level removes nothing, but changes the apex.
            top.p = to.u;
        }
        self.front = edge.front();
        self.range = SlopeRange::NONE;
        friction
    }
}
