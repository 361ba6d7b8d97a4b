//! Sums over the springs of a row, in eight parallel lanes.
//!
//! Spring i always belongs to lane i mod 8, and the lanes are added in a fixed order. Equal springs therefore give equal bits. The compiler
//! vectorizes each loop over lanes. Springs in contact are always the first springs, so every sum covers a contiguous range.

use super::chord::Chord;
use super::springs::Cells;
use crate::Apex;

/// Number of lanes.
const LANES: usize = 8;

/// Returns the sum of the lanes, in a fixed order.
#[inline]
fn total(lanes: &[f64; LANES]) -> f64 {
    let [a, b, c, d, e, f, g, h] = *lanes;
    ((a + e) + (b + f)) + ((c + g) + (d + h))
}

/// Limits x to ±limit, for limit ≥ 0.
// Two comparisons are faster than `f64::clamp`, which also handles NaN.
#[inline(always)]
pub(super) fn clamp(x: f64, limit: f64) -> f64 {
    let x = if x > limit { limit } else { x };
    if x < -limit { -limit } else { x }
}

/// Returns Σ length·stretch of springs in contact before and after a move, m².
#[inline]
pub(super) fn shear(cells: Cells<'_>, anchors: &[f64], to: Apex, slope: f64) -> f64 {
    let one = |h: f64, length: f64, anchor: f64| length * clamp(to.u - anchor, slope * (to.d - h));
    let (heights, rest_h) = cells.heights.as_chunks::<LANES>();
    let (lengths, rest_l) = cells.lengths.as_chunks::<LANES>();
    let (anchors, rest_a) = anchors.as_chunks::<LANES>();
    let mut lanes = [0.0; LANES];
    for ((h, l), a) in heights.iter().zip(lengths).zip(anchors) {
        for i in 0..LANES {
            lanes[i] += one(h[i], l[i], a[i]);
        }
    }
    for (i, ((&h, &l), &a)) in rest_h.iter().zip(rest_l).zip(rest_a).enumerate() {
        lanes[i] += one(h, l, a);
    }
    total(&lanes)
}

/// Returns Σ length·(u-p) of sticking springs, m².
pub(super) fn stuck(cells: Cells<'_>, anchors: &[f64], u: f64) -> f64 {
    let (lengths, rest_l) = cells.lengths.as_chunks::<LANES>();
    let (anchors, rest_a) = anchors.as_chunks::<LANES>();
    let mut lanes = [0.0; LANES];
    for (l, a) in lengths.iter().zip(anchors) {
        for i in 0..LANES {
            lanes[i] += l[i] * (u - a[i]);
        }
    }
    for (i, (&l, &a)) in rest_l.iter().zip(rest_a).enumerate() {
        lanes[i] += l * (u - a);
    }
    total(&lanes)
}

/// Sums over the springs in contact before and after a move.
#[derive(Clone, Copy, Default)]
pub(super) struct Tally {
    /// Sum of length·stretch, m².
    pub(super) shear: f64,
    /// Length that sticks, m.
    pub(super) stick: f64,
    /// Length that slips forward minus length that slips backward, m.
    pub(super) slip: f64,
}

/// Returns the sums over springs in contact before and after a move.
#[inline]
pub(super) fn tally(cells: Cells<'_>, anchors: &[f64], to: Apex, slope: f64) -> Tally {
    let (mut shear, mut stick, mut slip) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    let mut one = |i: usize, h: f64, length: f64, anchor: f64| {
        let limit = slope * (to.d - h);
        let trial = to.u - anchor;
        shear[i] += length * clamp(trial, limit);
        let ahead = if trial >= limit { length } else { 0.0 };
        let behind = if trial <= -limit { length } else { 0.0 };
        slip[i] += ahead - behind;
        stick[i] += if trial.abs() < limit { length } else { 0.0 };
    };
    let (heights, rest_h) = cells.heights.as_chunks::<LANES>();
    let (lengths, rest_l) = cells.lengths.as_chunks::<LANES>();
    let (anchors, rest_a) = anchors.as_chunks::<LANES>();
    for ((h, l), a) in heights.iter().zip(lengths).zip(anchors) {
        for i in 0..LANES {
            one(i, h[i], l[i], a[i]);
        }
    }
    for (i, ((&h, &l), &a)) in rest_h.iter().zip(rest_l).zip(rest_a).enumerate() {
        one(i, h, l, a);
    }
    Tally { shear: total(&shear), stick: total(&stick), slip: total(&slip) }
}

/// Returns Σ length·(d-h), m².
pub(super) fn pressed_force(cells: Cells<'_>, d: f64) -> f64 {
    cells.heights.iter().zip(cells.lengths).map(|(h, length)| length * (d - h)).sum()
}

/// Updates the rest positions of springs in contact at the end of a path. Returns the friction work over G\*, m³.
pub(super) fn slide(cells: Cells<'_>, anchors: &mut [f64], chord: &Chord) -> f64 {
    let one = |h: f64, length: f64, anchor: &mut f64| {
        let slide = chord.slide(h, *anchor);
        *anchor = slide.anchor;
        length * slide.work
    };
    let (heights, rest_h) = cells.heights.as_chunks::<LANES>();
    let (lengths, rest_l) = cells.lengths.as_chunks::<LANES>();
    let (anchors, rest_a) = anchors.as_chunks_mut::<LANES>();
    let mut lanes = [0.0; LANES];
    for ((h, l), a) in heights.iter().zip(lengths).zip(anchors) {
        for i in 0..LANES {
            lanes[i] += one(h[i], l[i], &mut a[i]);
        }
    }
    for (i, ((&h, &l), a)) in rest_h.iter().zip(rest_l).zip(rest_a).enumerate() {
        lanes[i] += one(h, l, a);
    }
    total(&lanes)
}
