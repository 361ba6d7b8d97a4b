//! Where a chord of the apex cuts the curve.

use super::Front;
use super::knot::Knot;
use crate::{Apex, Interface, Response};

/// What a chord does to the curve.
#[derive(Debug, Clone, Copy)]
pub(super) enum Drag {
    /// Contact is lost.
    Open,
    /// Nothing slips; the curve ends in this knot.
    Stick(Knot),
    /// An edge of the wedge drags the curve.
    Slip(Cut),
}

/// The place where an edge of the wedge leaves the old curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut {
    /// +1: the lower edge drags the curve forward; -1: the upper edge drags it backward.
    pub(super) sense: f64,
    /// Number of knots that stay.
    pub(super) kept: usize,
    /// Whether `knot` is a new one, inside a piece.
    pub(super) splits: bool,
    /// Where the new edge begins; at height 0 in gross slip.
    pub(super) knot: Knot,
    /// Whether the whole curve is dragged.
    pub(super) gross: bool,
}

impl Drag {
    /// The drag of a chord from the end of the curve (at least one knot) to an apex inside contact.
    #[inline]
    pub(super) fn of(law: &Interface, knots: &[Knot], to: Apex) -> Self {
        let Some(top) = knots.last() else { return Self::Open };
        let (rise, shift) = (to.d - top.h, to.u - top.p);
        let limit = law.stick_slope() * rise;
        if rise == 0.0 && shift == 0.0 {
            return Self::Stick(*top);
        }
        if rise > 0.0 && shift.abs() <= limit {
            return Self::Stick(top.grow(law, to.d, shift / rise, to.u));
        }
        // Both edges close in on a shrinking contact; the apex lies on one side of the old curve.
        let forward = if shift.abs() >= -limit { shift > 0.0 } else { to.u > anchor(knots, to.d) };
        Self::Slip(Cut::find(law, knots, if forward { 1.0 } else { -1.0 }, to))
    }
}

/// Anchor at a height of a curve of at least one knot.
pub(super) fn anchor(knots: &[Knot], h: f64) -> f64 {
    let above = knots.partition_point(|k| k.h < h).max(1).min(knots.len() - 1);
    knots[above].p - knots[above].slope * (knots[above].h - h)
}

impl Cut {
    /// Walks down the stack. In the frame of the sense, σp - κh falls along the curve, and all that lies below
    /// its value at the apex is dragged.
    #[inline]
    pub(super) fn find(law: &Interface, knots: &[Knot], sense: f64, to: Apex) -> Self {
        let slope = law.stick_slope();
        let level = sense * to.u - slope * to.d;
        let reach = |k: &Knot| sense * k.p - slope * k.h;
        let mut kept = knots.len();
        while kept > 0 && (reach(&knots[kept - 1]) < level || knots[kept - 1].h > to.d) {
            kept -= 1;
        }
        if kept == 0 {
            let knot = Knot::touch(sense * level);
            return Self { sense, kept, splits: false, knot, gross: true };
        }
        let base = &knots[kept - 1];
        let Some(end) = knots.get(kept) else {
            return Self { sense, kept, splits: false, knot: *base, gross: false };
        };
        let steep = slope - sense * end.slope;
        // A piece along the edge itself has no crossing: it is cut at its foot.
        let rise = if steep > 4.0 * f64::EPSILON * slope { (reach(base) - level) / steep } else { 0.0 };
        let h = (base.h + rise).min(end.h).min(to.d);
        if h <= base.h {
            return Self { sense, kept, splits: false, knot: *base, gross: false };
        }
        Self { sense, kept, splits: true, knot: base.point(law, end, h), gross: false }
    }

    /// The apex at the end of the new edge.
    #[inline]
    pub(super) fn end(&self, law: &Interface, to: Apex) -> Knot {
        self.knot.grow(law, to.d, self.sense * law.stick_slope(), to.u)
    }

    /// Where the springs at their limit begin.
    pub(super) fn front(&self) -> Front {
        Front { sense: self.sense, height: if self.gross { f64::NEG_INFINITY } else { self.knot.h } }
    }

    /// Force and tangents: with the front at h_c, ∂F/∂u = G\*m(h_c), ∂F/∂d = σκG\*[m(d)-m(h_c)].
    #[inline]
    pub(super) fn response(&self, law: &Interface, to: Apex) -> Response {
        let (modulus, edge) = (law.tangential_modulus(), self.sense * law.stick_slope());
        let profile = law.profile();
        let shear = self.knot.shear + edge * (profile.area(to.d) - self.knot.area);
        let stiffness = if self.gross { 0.0 } else { law.stick_stiffness(self.knot.h) };
        Response {
            force: modulus * shear,
            stiffness,
            coupling: edge * (law.stick_stiffness(to.d) - stiffness),
        }
    }
}
