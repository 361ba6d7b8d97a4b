//! Where a chord of the apex cuts the curve.
//!
//! In the frame of a sense σ each knot has a level σp - κh, and so has the apex. Levels fall from the centre to the edge; an
//! edge takes along all that lies below its own, and leaves the old curve where both levels meet.

use super::front::Front;
use super::knot::Knot;
use crate::{Apex, Interface, Response};

/// So many knots below the top are passed one by one.
const NEAR: usize = 8;

/// What a chord does to the curve.
#[derive(Debug, Clone, Copy)]
pub(super) enum Drag {
    /// Contact is lost.
    Open,
    /// Nothing moves.
    Rest,
    /// Nothing slips: the contact grows.
    Stick,
    /// An edge of the wedge drags the curve.
    Slip(Edge),
}

/// The edge of the wedge that drags, and where it leaves the old curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// +1: the lower edge drags the curve forward; -1: the upper edge drags it backward.
    pub(super) sense: f64,
    /// Number of knots that stay; none in gross slip.
    pub(super) kept: usize,
    /// Height at which the edge begins, m.
    pub(super) height: f64,
    /// Whether it begins inside a piece, above the last knot that stays.
    pub(super) splits: bool,
}

impl Drag {
    /// The drag of a chord from the end of the curve (at least one knot) to an apex.
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
        // Both edges close in on a shrinking contact; the apex lies on one side of the old curve. The sign of Δu would tell
        // the wrong one wherever the contact shrinks along the line on which it grew.
        let forward = if travel.abs() >= -limit { travel > 0.0 } else { to.u > anchor(knots, to.d) };
        Self::Slip(Edge::find(law, knots, if forward { 1.0 } else { -1.0 }, to))
    }
}

/// Anchor at a height of a curve of at least one knot.
pub(super) fn anchor(knots: &[Knot], h: f64) -> f64 {
    anchor_and_slope(knots, h)[0]
}

/// The same, and the slope dp/dh of the piece on which it lies.
pub(super) fn anchor_and_slope(knots: &[Knot], h: f64) -> [f64; 2] {
    // By halves, other than a drag: whoever asks for an anchor asks anywhere in the curve.
    let end = &knots[knots.partition_point(|k| k.h < h).max(1).min(knots.len() - 1)];
    [end.p - end.slope * (end.h - h), end.slope]
}

/// Whether the piece that ends in a knot runs along the edge of a sense itself.
pub(super) fn runs_along(slope: f64, sense: f64, end: &Knot) -> bool {
    // Far above rounding (ε is 2e-16) and far below what any growth leaves: a piece so near to the edge's own slope has been
    // dragged by it. Taken for one that the edge crosses, the front would jump by the whole of it for a last place of u.
    slope - sense * end.slope <= 1e-9 * slope
}

/// Force over G\*, m², and height at which the edge of a sense begins, m, by the straight line of the piece on which it
/// begins, also beyond that piece.
pub(super) fn onward(law: &Interface, knots: &[Knot], sense: f64, to: Apex) -> (f64, f64) {
    let slope = law.stick_slope();
    let (edge, whole) = (sense * slope, law.profile().reduced_force(to.d));
    // What the edge has dragged so far lies along it, at its own level: rounding would decide where on it the edge begins.
    let dragged = knots.iter().rev().take_while(|end| end.h > 0.0 && runs_along(slope, sense, end)).count();
    let knots = &knots[..knots.len() - dragged];
    let Edge { kept, height, .. } = Edge::find(law, knots, sense, to);
    // What has only just touched remembers nothing: all of it slips.
    let last = kept.min(knots.len().saturating_sub(1));
    let Some(base) = last.checked_sub(1).map(|i| &knots[i]) else {
        // Gross slip, or no piece to go on along.
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
    /// Walks down the stack. In the frame of the sense, σp - κh falls along the curve, and all that lies below
    /// its value at the apex is dragged.
    // From the top, though the levels are sorted and halves would do: a chord of a stepper ends within the top piece or the
    // one below. Farther down by halves: stages of a step along a path of a thousand pieces ask without giving any up.
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
        // A piece along the edge itself has no crossing: it is cut at its foot.
        let rise =
            if steep > 4.0 * f64::EPSILON * slope { (base.level(sense, slope) - level) / steep } else { 0.0 };
        let height = (base.h + rise).min(end.h).min(to.d);
        Self { sense, kept, height: height.max(base.h), splits: height > base.h }
    }

    /// Whether the whole curve is dragged: no spring sticks.
    pub(super) fn is_gross(&self) -> bool {
        self.kept == 0
    }

    /// Where the springs at their limit begin.
    pub(super) fn front(&self) -> Front {
        Front { sense: self.sense, height: if self.is_gross() { f64::NEG_INFINITY } else { self.height } }
    }

    /// The knot at which the edge begins: in gross slip the centre, with nothing below it.
    pub(super) fn foot(&self, law: &Interface, knots: &[Knot], to: Apex) -> Knot {
        if self.is_gross() {
            return Knot::touch(to.u - self.sense * law.stick_slope() * to.d);
        }
        let base = &knots[self.kept - 1];
        if self.splits { base.point(law, &knots[self.kept], self.height) } else { *base }
    }

    /// The apex at the end of the edge; `top` is the one before, whose M and N it shares where d stays.
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

    /// Force and tangents: with the front at h_c, ∂F/∂u = G\*m(h_c), ∂F/∂d = σκG\*[m(d)-m(h_c)].
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

    /// Force over G\*, m², at the end of the edge.
    #[inline]
    pub(super) fn shear(&self, law: &Interface, knots: &[Knot], to: Apex) -> f64 {
        let edge = self.sense * law.stick_slope();
        let whole = match knots.last() {
            // Under a constant load M(d) is at hand: 70 ns instead of 82 for a force of a power law with an exponent of 2.5,
            // 36 instead of 39 for a sphere. A paraboloid, whose M takes 2.6 ns, does not feel it.
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
