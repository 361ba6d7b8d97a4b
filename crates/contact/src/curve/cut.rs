//! Intersection of a limit line with the memory curve, at the end of a straight path of the apex.
//!
//! For a direction σ each breakpoint has the level σp - κh, and the apex has the level σu - κd. Levels decrease from the centre to the edge
//! of the contact. The limit line shifts all points of a lower level than the apex. The limit line leaves the old curve where the levels
//! are equal.

use super::front::Front;
use super::knot::Knot;
use crate::{Apex, Interface, Response};

/// Number of breakpoints at the top that are searched linearly, before a binary search.
const NEAR: usize = 8;

/// Effect of a straight path on the curve.
#[derive(Debug, Clone, Copy)]
pub(super) enum Drag {
    /// The contact opens.
    Open,
    /// The apex does not move.
    Rest,
    /// The contact grows in full stick.
    Stick,
    /// The contact slips along a limit line.
    Slip(Edge),
}

/// Limit line of a slipping contact, and the point where it leaves the old curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// Slip direction: +1 forward, -1 backward.
    pub(super) sense: f64,
    /// Number of breakpoints that remain; 0 in gross slip.
    pub(super) kept: usize,
    /// Height at which the limit line begins, m.
    pub(super) height: f64,
    /// Whether the limit line begins inside a piece, above the last remaining breakpoint.
    pub(super) splits: bool,
}

impl Drag {
    /// Returns the effect of a straight path from the end of the curve to an apex.
    #[inline]
    pub(super) fn of(law: &Interface, knots: &[Knot], to: Apex) -> Self {
        if to.d <= 0.0 {
            return Self::Open;
        }
        let Some(top) = knots.last() else { return Self::Open };
        let (rise, travel) = (to.d - top.h, to.u - top.p);
        let limit = law.stick_slope() * rise;
        if rise == 0.0 && travel == 0.0 {
            return Self::Rest;
        }
        if rise > 0.0 && travel.abs() <= limit {
            return Self::Stick;
        }
        // If both limit lines would slip, the side of the old curve decides. The sign of Δu would be wrong for a contact that shrinks
        // along its growth path.
        let forward = if travel.abs() >= -limit { travel > 0.0 } else { to.u > anchor(knots, to.d) };
        Self::Slip(Edge::find(law, knots, if forward { 1.0 } else { -1.0 }, to))
    }
}

/// Returns the rest position at a height. The curve must have at least one breakpoint.
pub(super) fn anchor(knots: &[Knot], h: f64) -> f64 {
    anchor_and_slope(knots, h)[0]
}

/// Returns the rest position at a height and the slope dp/dh of the piece there.
pub(super) fn anchor_and_slope(knots: &[Knot], h: f64) -> [f64; 2] {
    // Binary search, because the height may be anywhere in the curve.
    let end = &knots[knots.partition_point(|k| k.h < h).max(1).min(knots.len() - 1)];
    [end.p - end.slope * (end.h - h), end.slope]
}

/// Returns whether the piece that ends in a breakpoint is parallel to the limit line of a direction.
pub(super) fn runs_along(slope: f64, sense: f64, end: &Knot) -> bool {
    // The tolerance is far above rounding and far below the slopes that growth leaves. A piece this close to the slope κ was made by slip.
    slope - sense * end.slope <= 1e-9 * slope
}

/// Returns the force over G\*, m², and the height at which the limit line of a direction begins, m.
///
/// Force and height are computed with the slope of the piece at which the limit line begins, also beyond the ends of that piece.
pub(super) fn onward(law: &Interface, knots: &[Knot], sense: f64, to: Apex) -> (f64, f64) {
    let slope = law.stick_slope();
    let (edge, whole) = (sense * slope, law.profile().reduced_force(to.d));
    // Pieces that slip has already shifted lie on the limit line; rounding would determine the intersection with them.
    let dragged = knots.iter().rev().take_while(|end| end.h > 0.0 && runs_along(slope, sense, end)).count();
    let knots = &knots[..knots.len() - dragged];
    let Edge { kept, height, .. } = Edge::find(law, knots, sense, to);
    // A contact that has just touched has no memory: all of it slips.
    let last = kept.min(knots.len().saturating_sub(1));
    let Some(base) = last.checked_sub(1).map(|i| &knots[i]) else {
        // Gross slip, or no piece that could be continued.
        let base =
            knots.first().filter(|_| kept > 0).map_or((0.0, 0.0), |base| (base.shear, base.reduced_force));
        return (base.0 + edge * (whole - base.1), height);
    };
    let end = &knots[last];
    let level = sense * to.u - slope * to.d;
    let rise = base.level(sense, slope) - level;
    let height =
        if runs_along(slope, sense, end) { base.h } else { base.h + rise / (slope - sense * end.slope) };
    let reduced_force = law.profile().reduced_force(height);
    (base.shear + end.gain * (reduced_force - base.reduced_force) + edge * (whole - reduced_force), height)
}

impl Edge {
    /// Finds the intersection of the limit line with the curve, from the top of the stack.
    // A straight path usually ends in the top piece or the one below; a binary search follows for long paths.
    #[inline]
    pub(super) fn find(law: &Interface, knots: &[Knot], sense: f64, to: Apex) -> Self {
        let slope = law.stick_slope();
        let level = sense * to.u - slope * to.d;
        let passes = |knot: &Knot| knot.level(sense, slope) < level || knot.h > to.d;
        let near = knots.iter().rev().take(NEAR).take_while(|knot| passes(knot)).count();
        let kept = knots.len() - near;
        let kept = if near == NEAR { knots[..kept].partition_point(|knot| !passes(knot)) } else { kept };
        let Some(base) = kept.checked_sub(1).map(|i| &knots[i]) else {
            return Self { sense, kept, height: 0.0, splits: false };
        };
        let Some(end) = knots.get(kept) else {
            return Self { sense, kept, height: base.h, splits: false };
        };
        let steep = slope - sense * end.slope;
        // A piece parallel to the limit line has no intersection and is removed as a whole.
        let rise =
            if steep > 4.0 * f64::EPSILON * slope { (base.level(sense, slope) - level) / steep } else { 0.0 };
        let height = (base.h + rise).min(end.h).min(to.d);
        Self { sense, kept, height: height.max(base.h), splits: height > base.h }
    }

    /// Returns whether the contact is in gross slip.
    pub(super) fn is_gross(&self) -> bool {
        self.kept == 0
    }

    /// Returns the slip front.
    pub(super) fn front(&self) -> Front {
        Front { sense: self.sense, height: if self.is_gross() { f64::NEG_INFINITY } else { self.height } }
    }

    /// Returns the breakpoint at which the limit line begins: the intersection, or in gross slip the centre.
    pub(super) fn foot(&self, law: &Interface, knots: &[Knot], to: Apex) -> Knot {
        if self.is_gross() {
            return Knot::touch(to.u - self.sense * law.stick_slope() * to.d);
        }
        let base = &knots[self.kept - 1];
        if self.splits { base.point(law, &knots[self.kept], self.height) } else { *base }
    }

    /// Returns the breakpoint of the apex at the end of the limit line. `top` is the previous apex, whose M and N are reused at equal d.
    #[inline]
    pub(super) fn end(&self, law: &Interface, foot: &Knot, top: Option<&Knot>, to: Apex) -> Knot {
        let slope = self.sense * law.stick_slope();
        match top {
            Some(top) if top.h == to.d => {
                foot.extend(to.d, to.u, slope, slope, top.reduced_force, top.reduced_energy)
            }
            _ => foot.grow(law, to.d, slope, to.u),
        }
    }

    /// Returns force and derivatives at the slip front h_c: ∂F/∂u = G\*m(h_c), ∂F/∂d = σκG\*[m(d)-m(h_c)].
    #[inline]
    pub(super) fn response(&self, law: &Interface, knots: &[Knot], to: Apex) -> Response {
        let (modulus, edge) = (law.tangential_modulus(), self.sense * law.stick_slope());
        let shear = self.shear(law, knots, to);
        let stiffness = if self.is_gross() { 0.0 } else { law.stick_stiffness(self.height) };
        Response {
            force: modulus * shear,
            stiffness,
            coupling: edge * (law.stick_stiffness(to.d) - stiffness),
        }
    }

    /// Returns the force over G\*, m², at the end of the limit line.
    #[inline]
    pub(super) fn shear(&self, law: &Interface, knots: &[Knot], to: Apex) -> f64 {
        let edge = self.sense * law.stick_slope();
        let whole = match knots.last() {
            // At constant d the value M(d) of the top breakpoint is reused.
            Some(top) if top.h == to.d => top.reduced_force,
            _ => law.profile().reduced_force(to.d),
        };
        let Some(base) = self.kept.checked_sub(1).map(|i| &knots[i]) else { return edge * whole };
        if !self.splits {
            return base.shear + edge * (whole - base.reduced_force);
        }
        let reduced_force = law.profile().reduced_force(self.height);
        base.shear
            + knots[self.kept].gain * (reduced_force - base.reduced_force)
            + edge * (whole - reduced_force)
    }
}
