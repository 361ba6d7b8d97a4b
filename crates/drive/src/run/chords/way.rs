//! The way of a contact in a step, and where its branch ends on it, or its law has a kink.

use crate::contact::Motion;
use stickslip_contact::Branch;

/// Share of a step in which a kink of the whole law counts as passed: where a step was cut at one, it comes again.
const PASSED: f64 = 0.125;

/// Where the branch of a contact ends on its way, as a share of it, and the sense of the next one; `left` is what is left of its piece
/// at the end, m.
pub(super) fn end_of(branch: &Branch, left: f64, way: Way<'_>) -> Option<(f64, f64)> {
    let sense = branch.sense();
    if left < 0.0 {
        return Some((way.reaches(branch), sense));
    }
    let turned = sense * way.to.du < 0.0;
    turned.then(|| (way.turn().unwrap_or(0.0), -sense))
}

/// Where the law of a contact under a moving normal has its first kink on its way, as a share of it: it touches or parts, or an edge of its
/// wedge, at the speeds u̇ ± κḋ, begins to drag or ceases to, κ the `slope` of the limit. One in the first [`PASSED`] is none.
pub(super) fn kink(slope: f64, Way { from, to, duration }: Way<'_>) -> Option<f64> {
    if from.d <= 0.0 && to.d <= 0.0 {
        return None;
    }
    let touches = ((from.d > 0.0) != (to.d > 0.0)).then(|| from.d / (from.d - to.d));
    // Without friction nothing drags.
    let edges = [slope, -slope].into_iter().filter(|slope| *slope != 0.0).filter_map(|slope| {
        let edge = |at: &Motion| Motion { u: at.u + slope * at.d, du: at.du + slope * at.dd, ..*at };
        let (from, to) = (edge(from), edge(to));
        if from.du * to.du >= 0.0 {
            return None;
        }
        Way { from: &from, to: &to, duration }.turn()
    });
    touches.into_iter().chain(edges).filter(|share| *share > PASSED).reduce(f64::min)
}

/// The way of a contact in a step, by the cubic through both its ends.
#[derive(Clone, Copy)]
pub(super) struct Way<'a> {
    pub(super) from: &'a Motion,
    pub(super) to: &'a Motion,
    /// s.
    pub(super) duration: f64,
}

impl Way<'_> {
    /// u at a share of the time, m: s u₁ + (1-s) u₀ + hs(1-s)[(1-s)(u̇₀-m) - s(u̇₁-m)], m the mean rate.
    pub(super) fn at(&self, s: f64) -> f64 {
        let way = self.to.u - self.from.u;
        let mean = way / self.duration;
        let bend = (1.0 - s) * (self.from.du - mean) - s * (self.to.du - mean);
        self.from.u + s * way + self.duration * s * (1.0 - s) * bend
    }

    /// Its derivative by the share, m: u̇₀ + 2(3m - 2u̇₀ - u̇₁)s + 3(u̇₀ + u̇₁ - 2m)s², times h.
    fn slope(&self, s: f64) -> f64 {
        let [a, b, c] = self.rates();
        self.duration * ((a * s + b) * s + c)
    }

    /// Coefficients of u̇ over the share, of the square first, m/s.
    fn rates(&self) -> [f64; 3] {
        let (v0, v1, mean) = (self.from.du, self.to.du, (self.to.u - self.from.u) / self.duration);
        [3.0 * (v0 + v1 - 2.0 * mean), 2.0 * (3.0 * mean - 2.0 * v0 - v1), v0]
    }

    /// Where u turns, as a share of the time; none where rounding leaves no turn.
    pub(super) fn turn(&self) -> Option<f64> {
        let [a, b, c] = self.rates();
        let root = (b * b - 4.0 * a * c).sqrt();
        let q = -0.5 * (b + root.copysign(b));
        [c / q, q / a].into_iter().find(|s| (0.0..=1.0).contains(s))
    }

    /// Where a branch's piece is used up, as a share of the time.
    fn reaches(&self, branch: &Branch) -> f64 {
        let margin = |u: f64| branch.margin(self.to.d, u);
        let (first, last) = (margin(self.from.u), margin(self.to.u));
        let mut s = if first > 0.0 { first / (first - last) } else { 0.0 };
        // The chord is h² off, and each step of Newton's squares that.
        for _ in 0..2 {
            let step = margin(self.at(s)) / (branch.sense() * self.slope(s));
            s = if step.is_finite() { (s + step).clamp(0.0, 1.0) } else { s };
        }
        s
    }
}
