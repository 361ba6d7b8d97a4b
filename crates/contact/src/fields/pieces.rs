//! The straight pieces of the memory curve, by radius.

use super::kernel::Rim;
use crate::{Interface, Memory};

/// A straight piece of the curve p(h).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    pub(super) from: Rim,
    pub(super) to: Rim,
    /// dp/dh.
    pub(super) slope: f64,
    /// Force per ΔM as a share of the limit's, G\*γ/(μE\*), in [-1, 1]: the slope over κ, or the mean of a curved path of
    /// growth.
    pub(super) share: f64,
}

/// How near to the slope of the limit a piece was laid by slip.
// As for the curve's own edge: far above rounding, far below what any growth leaves.
pub(super) const LAID_BY_SLIP: f64 = 1e-9;

/// The pieces from the centre to the edge, neighbours of one slope as one, and the anchor in the centre, m.
pub(super) fn of(law: &Interface, memory: &Memory) -> (Vec<Piece>, f64) {
    let limit = law.stick_slope();
    let share = |slope: f64| if limit > 0.0 { (slope / limit).clamp(-1.0, 1.0) } else { 0.0 };
    let rim = |h: f64| Rim { h, x: law.profile().radius(h) };
    let mut pieces: Vec<Piece> = Vec::new();
    let mut push = |from: f64, to: f64, slope: f64, gain: f64| match pieces.last_mut() {
        Some(last) if last.slope == slope && last.share == share(gain) => last.to = rim(to),
        _ if to > from => pieces.push(Piece { from: rim(from), to: rim(to), slope, share: share(gain) }),
        _ => {}
    };
    let centre = match memory {
        Memory::Curve(curve) => {
            for [from, to, slope, gain] in curve.pieces() {
                push(from, to, slope, gain);
            }
            curve.knots().next().map_or(curve.apex().u, |(_, p)| p)
        }
        Memory::Row(row) => {
            let apex = row.row.apex();
            let end = (apex.d > 0.0).then_some((apex.d, apex.u));
            let corners: Vec<_> = row.row.anchors(&row.springs, law).chain(end).collect();
            let centre = corners.first().map_or(apex.u, |(_, p)| *p);
            let mut last = (0.0, centre);
            for (h, p) in corners {
                if h > last.0 {
                    let slope = (p - last.1) / (h - last.0);
                    // Each is clamped for itself, so that slopes at the limit are so but for rounding.
                    let at_limit = slope.abs() >= limit * (1.0 - LAID_BY_SLIP);
                    let slope = if at_limit { limit.copysign(slope) } else { slope };
                    push(last.0, h, slope, slope);
                    last = (h, p);
                }
            }
            centre
        }
    };
    (pieces, centre)
}
