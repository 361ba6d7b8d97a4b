//! Local friction work per area, the local form of (4.40)–(4.42).
//!
//! While the contact slips in direction σ, the level L = σu - κd increases and the slip front moves inwards to the radius c. In the
//! ring c < r < a the surfaces slide over each other by
//!
//! σ ds = (2/π) arccos(c/r) dL,
//!
//! for any slip memory. The formula follows from the superposition (4.35), in which the motion of the front cancels. The work per
//! area is μ p ds with the pressure p(r; d). At constant d the sum over a piece of the memory is an exact difference of normal
//! deflections. For a changing d it is an integral over the angle arccos(c/r), whose integrand is smooth.

use super::Kernel;
use super::kernel::Rim;
use super::pieces::{self, Piece};
use crate::quadrature::kronrod;
use crate::{Apex, Interface, Memory, Profile, Segment};
use std::f64::consts::FRAC_2_PI;

/// Error tolerance of the work at changing indentation, relative to the work of the mean pressure over the full slip distance.
// The error estimate compares rules of 7 and 15 points and is larger than the true error.
const ACCURACY: f64 = 1e-7;
/// Error tolerance for profiles whose pressure is itself computed by quadrature.
const ACCURACY_BY_QUADRATURE: f64 = 1e-5;
/// Largest number of bisections of the integral.
const DEEPEST: u32 = 24;

/// Friction work per area at given radii, accumulated over a history.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionMap {
    radii: Vec<f64>,
    work: Vec<f64>,
    way: Vec<f64>,
}

/// Part of a straight path: either gross slip, or the limit line removes one piece of the previous memory curve.
struct Drag {
    /// Levels of the limit line at start and end, m.
    level: [f64; 2],
    /// Indentations at start and end, m.
    depth: [f64; 2],
    /// Heights of the slip front at start and end, m; `None` in gross slip.
    front: Option<[f64; 2]>,
}

impl FrictionMap {
    /// Creates the map at given radii, m, with zero work.
    pub fn new(radii: Vec<f64>) -> Self {
        let zeros = vec![0.0; radii.len()];
        Self { work: zeros.clone(), way: zeros, radii }
    }

    /// Returns the radii, m.
    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// Returns the accumulated friction work per area, J/m².
    pub fn work(&self) -> &[f64] {
        &self.work
    }

    /// Returns the accumulated sliding distance of the surfaces in both directions, m.
    pub fn way(&self) -> &[f64] {
        &self.way
    }

    /// Adds the work of a segment that will be committed to `memory`. A list of springs has no radii, so nothing is added.
    pub fn follow(&mut self, law: &Interface, memory: &Memory, segment: Segment) {
        let (to, from) = (segment.end(), memory.apex());
        let Some(kernel) = Kernel::of(law.profile()) else { return };
        if matches!(segment, Segment::Grown { .. }) || from.d <= 0.0 && to.d <= 0.0 {
            return;
        }
        let (pieces, centre) = pieces::of(law, memory);
        // The path begins at first touch for an open contact, and ends where the contact opens.
        let crossing = |d: f64| Apex { d, u: from.u + (to.u - from.u) * (d - from.d) / (to.d - from.d) };
        let start = if from.d < 0.0 { crossing(0.0) } else { from };
        let end = if to.d < 0.0 { crossing(0.0) } else { to };
        let old = Old { pieces: &pieces, centre: if pieces.is_empty() { start.u } else { centre } };
        for drag in old.drags(law.stick_slope(), start, end) {
            for (k, &r) in self.radii.iter().enumerate() {
                let (work, way) = drag.at(law, &kernel, r);
                self.work[k] += work;
                self.way[k] += way;
            }
        }
    }
}

/// Memory curve before a straight path.
struct Old<'a> {
    pieces: &'a [Piece],
    /// Rest position in the centre, m.
    centre: f64,
}

impl Old<'_> {
    /// Returns the breakpoints (h, p), m, from the centre to the edge.
    fn corners(&self) -> Vec<(f64, f64)> {
        let mut p = self.centre;
        let next = self.pieces.iter().map(|piece| {
            p += piece.slope * (piece.to.h - piece.from.h);
            (piece.to.h, p)
        });
        std::iter::once((0.0, self.centre)).chain(next).collect()
    }

    /// Returns the parts of a straight path in which the contact slips.
    fn drags(&self, limit: f64, from: Apex, to: Apex) -> Vec<Drag> {
        let (rise, travel) = (to.d - from.d, to.u - from.u);
        let mut drags = Vec::new();
        if travel.abs() > -limit * rise.min(-rise) && travel != 0.0 {
            self.drag(limit, travel.signum(), [from, to], &mut drags);
        } else if rise < 0.0 {
            // If both limit lines would slip, the side of the old curve decides, and the path may cross the curve.
            let corners = self.corners();
            let mut apex = from;
            let path = |d: f64| from.u + travel * (d - from.d) / rise;
            for pair in corners.windows(2).rev() {
                let ((low, p), (high, q)) = (pair[0], pair[1]);
                if low >= apex.d || high <= to.d {
                    continue;
                }
                let anchor = |h: f64| p + (q - p) * (h - low) / (high - low);
                let (top, bottom) = (high.min(from.d), low.max(to.d));
                let beside = [path(top) - anchor(top), path(bottom) - anchor(bottom)];
                if beside[0] * beside[1] < 0.0 {
                    let d = top + (bottom - top) * beside[0] / (beside[0] - beside[1]);
                    let crossing = Apex { d, u: path(d) };
                    self.drag(limit, beside[0].signum(), [apex, crossing], &mut drags);
                    apex = crossing;
                }
            }
            let below = corners.partition_point(|(h, _)| *h < to.d).clamp(1, corners.len().max(2) - 1);
            let beside = match (corners.get(below - 1), corners.get(below)) {
                (Some((low, p)), Some((high, q))) => to.u - (p + (q - p) * (to.d - low) / (high - low)),
                _ => travel,
            };
            // A path along the curve itself slips by rounding only.
            let sense = if beside == 0.0 { 1.0 } else { beside.signum() };
            self.drag(limit, sense, [apex, to], &mut drags);
        }
        drags
    }

    /// Adds the parts of a straight path with slip in one direction.
    fn drag(&self, limit: f64, sense: f64, [from, to]: [Apex; 2], drags: &mut Vec<Drag>) {
        let level = |h: f64, p: f64| sense * p - limit * h;
        let ends = [level(from.d, from.u), level(to.d, to.u)];
        let mut add = |[low, high]: [f64; 2], front: Option<[f64; 2]>| {
            let share = |at: f64| ((at - ends[0]) / (ends[1] - ends[0])).clamp(0.0, 1.0);
            let depth = [low, high].map(|at| from.d + (to.d - from.d) * share(at));
            drags.push(Drag { level: [low, high], depth, front });
        };
        let corners = self.corners();
        let mut reached = ends[0];
        for pair in corners.windows(2).rev() {
            let ((h, p), (top, q)) = (pair[0], pair[1]);
            let (inner, outer) = (level(h, p), level(top, q));
            let (begin, end) = (outer.max(ends[0]), inner.min(ends[1]));
            if end > begin && inner > outer {
                let front = |at: f64| (h + (top - h) * (inner - at) / (inner - outer)).clamp(h, top);
                add([begin, end], Some([front(begin), front(end)]));
            }
            reached = reached.max(inner.min(ends[1]));
        }
        if ends[1] > reached {
            add([reached.max(corners.first().map_or(reached, |(h, p)| level(*h, *p))), ends[1]], None);
        }
    }
}

impl Drag {
    /// Returns the work per area, J/m², and the sliding distance, m, at a radius.
    fn at(&self, law: &Interface, kernel: &Kernel<'_>, r: f64) -> (f64, f64) {
        let (profile, limit) = (law.profile(), law.friction() * law.normal_modulus());
        let here = Rim { h: profile.depth(r), x: r };
        let Some(part) = self.touching(profile, here) else { return (0.0, 0.0) };
        let pressure = |d: f64| kernel.pressure(Rim { h: d, x: profile.radius(d) }, r).0;
        let steady = part.depth[0] == part.depth[1];
        let rise = part.level[1] - part.level[0];
        let depth_at = |share: f64| part.depth[0] + (part.depth[1] - part.depth[0]) * share;
        // The tolerance is relative to the work at the largest indentation over the full distance.
        let deepest = part.depth[0].max(part.depth[1]);
        let accuracy = if matches!(kernel, Kernel::Any(_)) { ACCURACY_BY_QUADRATURE } else { ACCURACY };
        let wanted = accuracy * deepest / profile.radius(deepest) * rise;
        let Some(front) = part.front else {
            // Substitution d = g(r) + τ², because the pressure rises like a root at first touch.
            let roots = part.depth.map(|d| (d - here.h).max(0.0).sqrt());
            let (low, high) = (roots[0].min(roots[1]), roots[0].max(roots[1]));
            let mean = if steady || pressure(deepest) == f64::INFINITY {
                pressure(deepest)
            } else {
                let by_root =
                    |root: f64| if root > 0.0 { 2.0 * root * pressure(here.h + root * root) } else { 0.0 };
                adaptive([low, high], wanted * (deepest - here.h) / rise, DEEPEST, &by_root)
                    / (part.depth[0] - part.depth[1]).abs()
            };
            // Without friction the work is 0, even at an infinite pressure.
            return (if limit * rise > 0.0 { limit * mean * rise } else { 0.0 }, rise);
        };
        let [outer, inner] = front.map(|h| Rim { h, x: profile.radius(h) });
        let outer = if outer.x > r { here } else { outer };
        if inner.x >= outer.x {
            return (0.0, 0.0);
        }
        let steep = rise / (front[0] - front[1]);
        let sunk = |rim: Rim| kernel.deflection(profile, rim, r).0;
        let way = steep * ((outer.h - inner.h) - (sunk(outer) - sunk(inner))).max(0.0);
        if steady {
            return (if limit * way > 0.0 { limit * pressure(deepest) * way } else { 0.0 }, way);
        }
        let angles = [outer, inner].map(|rim| math::acos((rim.x / r).min(1.0)));
        let work = adaptive(angles, wanted, DEEPEST, &|angle: f64| {
            let x = r * math::cos(angle);
            let share = (front[0] - profile.depth(x)) / (front[0] - front[1]);
            let slid = FRAC_2_PI * angle * steep * profile.depth_slope(x) * r * math::sin(angle);
            if slid > 0.0 { pressure(depth_at(share)) * slid } else { 0.0 }
        });
        (limit * work, way)
    }

    /// Returns the part of the path in which the given radius is in contact; `None` if there is no such part.
    fn touching(&self, profile: &Profile, here: Rim) -> Option<Self> {
        let [from, to] = self.depth;
        // The fraction of the path at which the indentation equals the height g(r).
        let touches = |d: f64| profile.radius(d) > here.x;
        let cross = ((here.h - from) / (to - from)).clamp(0.0, 1.0);
        let shares = match [from, to].map(touches) {
            [false, false] => return None,
            [true, true] => [0.0, 1.0],
            [true, false] => [0.0, cross],
            [false, true] => [cross, 1.0],
        };
        let cut = |ends: [f64; 2]| shares.map(|share| ends[0] + (ends[1] - ends[0]) * share);
        let part = Self { level: cut(self.level), depth: cut(self.depth), front: self.front.map(cut) };
        (part.level[1] > part.level[0]).then_some(part)
    }
}

/// Integrates f over a range by bisection until the error estimate is below `wanted`.
fn adaptive(range: [f64; 2], wanted: f64, halvings: u32, f: &impl Fn(f64) -> f64) -> f64 {
    let (value, error) = kronrod(range, f);
    // QUADPACK's error estimate: if both rules nearly agree, the finer one is much better than their difference.
    let error = error * (200.0 * error / value.abs()).sqrt().min(1.0);
    // The pressure below a sharp tip is unbounded.
    if error <= wanted || halvings == 0 || !value.is_finite() {
        return value;
    }
    let middle = 0.5 * (range[0] + range[1]);
    let half = |range| adaptive(range, 0.5 * wanted, halvings - 1, f);
    half([range[0], middle]) + half([middle, range[1]])
}
