//! Path of a contact within a step, with the end of the force-law branch and kinks of the force law.

use crate::contact::Motion;
use stickslip_contact::Branch;

/// Fraction of the step, from its start, in which kinks are ignored, because the previous step was cut there.
const PASSED: f64 = 0.125;

/// Returns where the branch of a contact ends, as a fraction of the step, and the sense of the next branch.
///
/// `left` is the remaining length of the memory piece at the end of the step, m.
pub(super) fn end_of(branch: &Branch, left: f64, way: Way<'_>) -> Option<(f64, f64)> {
    let sense = branch.sense();
    if left < 0.0 {
        return Some((way.reaches(branch), sense));
    }
    let turned = sense * way.to.du < 0.0;
    turned.then(|| (way.turn().unwrap_or(0.0), -sense))
}

/// Returns the first kink of the full force law in a step, as a fraction of the step.
///
/// Applies under a varying normal force. Kinks are touch, separation, and zeros of the slip-edge velocities u̇ ± κḋ,
/// with κ the `slope`. Kinks in the first [`PASSED`] of the step are ignored.
pub(super) fn kink(slope: f64, Way { from, to, duration }: Way<'_>) -> Option<f64> {
    if from.d <= 0.0 && to.d <= 0.0 {
        return None;
    }
    let touches = ((from.d > 0.0) != (to.d > 0.0)).then(|| from.d / (from.d - to.d));
    // Without friction there is no slip edge.
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

/// Motion of a contact in a step, as the cubic Hermite interpolant of both ends.
#[derive(Clone, Copy)]
pub(super) struct Way<'a> {
    pub(super) from: &'a Motion,
    pub(super) to: &'a Motion,
    /// Duration, s.
    pub(super) duration: f64,
}

impl Way<'_> {
    /// Returns u at fraction s of the step, m.
    ///
    /// u = s u₁ + (1-s) u₀ + hs(1-s)[(1-s)(u̇₀-m) - s(u̇₁-m)] with the mean velocity m.
    pub(super) fn at(&self, s: f64) -> f64 {
        let way = self.to.u - self.from.u;
        let mean = way / self.duration;
        let bend = (1.0 - s) * (self.from.du - mean) - s * (self.to.du - mean);
        self.from.u + s * way + self.duration * s * (1.0 - s) * bend
    }

    /// Returns du/ds at fraction s of the step, m: h[u̇₀ + 2(3m - 2u̇₀ - u̇₁)s + 3(u̇₀ + u̇₁ - 2m)s²].
    fn slope(&self, s: f64) -> f64 {
        let [a, b, c] = self.rates();
        self.duration * ((a * s + b) * s + c)
    }

    /// Returns the coefficients of u̇ as a polynomial in s, m/s: those of s², s and 1.
    fn rates(&self) -> [f64; 3] {
        let (v0, v1, mean) = (self.from.du, self.to.du, (self.to.u - self.from.u) / self.duration);
        [3.0 * (v0 + v1 - 2.0 * mean), 2.0 * (3.0 * mean - 2.0 * v0 - v1), v0]
    }

    /// Returns where u̇ changes sign, as a fraction of the step. `None` if rounding leaves no zero.
    pub(super) fn turn(&self) -> Option<f64> {
        let [a, b, c] = self.rates();
        let root = (b * b - 4.0 * a * c).sqrt();
        let q = -0.5 * (b + root.copysign(b));
        [c / q, q / a].into_iter().find(|s| (0.0..=1.0).contains(s))
    }

    /// Returns where slip reaches the end of the branch's memory piece, as a fraction of the step.
    fn reaches(&self, branch: &Branch) -> f64 {
        let margin = |u: f64| branch.margin(self.to.d, u);
        let (first, last) = (margin(self.from.u), margin(self.to.u));
        let mut s = if first > 0.0 { first / (first - last) } else { 0.0 };
        // The linear estimate has an error of order h², and each Newton step squares it.
        for _ in 0..2 {
            let step = margin(self.at(s)) / (branch.sense() * self.slope(s));
            s = if step.is_finite() { (s + step).clamp(0.0, 1.0) } else { s };
        }
        s
    }
}
