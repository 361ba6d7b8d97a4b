//! Linear pieces of the memory curve as functions of the radius.

use super::kernel::Rim;
use crate::{Interface, Memory};

/// Linear piece of the curve p(h).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Piece {
    pub(super) from: Rim,
    pub(super) to: Rim,
    /// Slope dp/dh.
    pub(super) slope: f64,
    /// Force per ΔM relative to the friction limit, G\*γ/(μE\*), in [-1, 1]: the slope over κ, or the mean over a curved growth path.
    pub(super) share: f64,
}

/// Relative tolerance at which a slope counts as the friction limit, so that the piece was made by slip.
// Far above rounding, and far below the slopes that growth leaves.
pub(super) const LAID_BY_SLIP: f64 = 1e-9;

/// Returns the pieces from the centre to the edge, with neighbours of equal slope merged, and the rest position in the centre, m.
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
                    // Each spring of a row is limited individually, so slopes at the limit have rounding errors.
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
