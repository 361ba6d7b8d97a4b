//! Motion on one branch: turning points and time.

use super::Rule;
use crate::masing::Branch;

/// Maximum number of iterations for a turning point or a position. Four reach full accuracy.
const STEPS: usize = 20;
/// Relative step of a root, and step of t, below which the next step is of the order of rounding errors.
const NEAR_ROOT: f64 = 1e-5;
const NEAR_PLACE: f64 = 1e-7;

/// Motion on one branch, with t = tan(θ/4) as variable.
pub(super) struct Arc {
    scale: f64,
    /// Initial z; root z₂; difference z₂ - z₁; distance of the initial z below z₂.
    start: f64,
    high: f64,
    range: f64,
    passed: f64,
    /// √z₂, and the factor, numerator and denominator of 1/√(2K) = factor √[(√z₂ + y) above/below], in powers of y = √z.
    root: f64,
    factor: f64,
    above: [f64; 3],
    below: [f64; 5],
}

impl Arc {
    /// Returns the motion that starts at u with speed ν.
    #[inline]
    pub(super) fn new(branch: &Branch, u: f64, speed: f64) -> Self {
        let scale = branch.scale;
        let (b, d) = (2.0 * scale * (branch.start + scale), 0.8 * scale * scale);
        let z = branch.height(u).max(0.0);
        let (y, energy) = (z.sqrt(), speed * speed);
        // ν² at z = 0.
        let rest = energy - z * (b - d * z * y);
        let [up, down] = turning([b, d], y, energy, rest < 0.0);
        let a = y + up;
        // If there is no turning point before z = 0, the root of A + Bz is used as z₁.
        let (low, divided, above, below) = if rest < 0.0 {
            let c = y + down;
            let (sum, product) = (a + c, a * c);
            let square = sum * sum - product;
            (c * c, sum, [c, 1.0, 0.0], [product * square, sum * square, sum * sum, sum, 0.0])
        } else {
            let (e, a2) = (rest / b, a * a);
            let whole = a2 + e;
            (-e, whole, [e, 0.0, 1.0], [e * a2 * a2, e * a2 * a, a2 * whole, a * whole, whole])
        };
        let factor = (divided / d).sqrt();
        let passed = up * (y + a);
        Self { scale, start: z, high: a * a, range: a * a - low, passed, root: a, factor, above, below }
    }

    /// Returns t at the start, and t where a lower z is reached, or `None` if the motion turns back before.
    pub(super) fn span(&self, end: f64) -> (f64, Option<f64>) {
        let to = (end > self.high - self.range).then(|| self.parameter(self.passed + (self.start - end)));
        (self.parameter(self.passed), to)
    }

    /// Returns t at a distance `fall` below z₂.
    fn parameter(&self, fall: f64) -> f64 {
        fall.sqrt() / (self.range.sqrt() + (self.range - fall).max(0.0).sqrt())
    }

    /// Returns the distance from the start to t.
    pub(super) fn way(&self, t: f64) -> f64 {
        let sine = 2.0 * t / (1.0 + t * t);
        self.scale * (self.range * sine * sine - self.passed)
    }

    /// Returns the speed ν at t.
    pub(super) fn speed(&self, t: f64) -> f64 {
        let share = 1.0 / (1.0 + t * t);
        2.0 * self.range * t * (1.0 - t * t) * share * share * share / (self.factor * self.slowness(t))
    }

    /// Returns (1/√(2K)) dθ/dt, divided by four times the factor.
    #[inline(always)]
    fn slowness(&self, t: f64) -> f64 {
        let share = 1.0 / (1.0 + t * t);
        let sine = 2.0 * t * share;
        let z = self.high - self.range * sine * sine;
        let y = (if z > 0.0 { z } else { 0.0 }).sqrt();
        let ([p, q, r], [e, f, g, h, i]) = (self.above, self.below);
        let above = (self.root + y) * (p + y * (q + y * r));
        let below = e + y * (f + y * (g + y * (h + y * i)));
        share * (above / below).sqrt()
    }

    /// Returns the time between two values of t.
    pub(super) fn time<const N: usize>(&self, (from, to): (f64, f64), rule: &Rule<N>) -> f64 {
        let mut slowness = [0.0; N];
        for (slowness, node) in slowness.iter_mut().zip(&rule.nodes) {
            *slowness = self.slowness(from + (to - from) * node);
        }
        let sum: f64 = slowness.iter().zip(&rule.weights).map(|(slowness, weight)| weight * slowness).sum();
        4.0 * self.scale * self.factor * (to - from) * sum
    }

    /// Returns the parameter t at a time after `from`. `whole` is the time from `from` to `to`.
    pub(super) fn at<const N: usize>(
        &self,
        (time, whole): (f64, f64),
        (from, to): (f64, f64),
        rule: &Rule<N>,
    ) -> f64 {
        let unit = 4.0 * self.scale * self.factor;
        // Initial guess: the slowness varies linearly with t.
        let (first, last) = (self.slowness(from), self.slowness(to));
        let share = time / whole * 0.5 * (first + last);
        let root = (first * first + 2.0 * share * (last - first)).sqrt();
        let mut at = from + (to - from) * 2.0 * share / (first + root);
        let mut left = (time - self.time((from, at), rule)) / unit;
        for _ in 0..STEPS {
            let step = left / self.slowness(at);
            // For such short steps, Gauss–Legendre quadrature with three nodes is sufficient.
            let (middle, off) = (at + 0.5 * step, 0.5 * step * 0.6_f64.sqrt());
            let aside = self.slowness(middle - off) + self.slowness(middle + off);
            left -= step * (5.0 * aside + 8.0 * self.slowness(middle)) / 18.0;
            at += step;
            if step.abs() <= NEAR_PLACE {
                break;
            }
        }
        at
    }
}

/// Returns the distances from y to the upper and the lower turning point, in y = √z, by Halley's method. If the motion does not turn back
/// before z = 0 (`!returns`), only the upper distance has a meaning.
fn turning([b, d]: [f64; 2], y: f64, energy: f64, returns: bool) -> [f64; 2] {
    let (z, cube) = (y * y, y * y * y);
    let c = [energy, y * (2.0 * b - 5.0 * d * cube), b - 10.0 * d * cube, -10.0 * d * z, -5.0 * d * y, -d];
    // ν² = energy + pull (z' - z) - ½bend (z' - z)², to second order.
    let (pull, bend) = (b - 2.5 * d * cube, 3.75 * d * y);
    let swing = (pull * pull + 2.0 * bend * energy).sqrt();
    let guess = |rise: f64| rise / ((z + rise).max(0.0).sqrt() + y);
    // From rest, the start is the turning point.
    let up = if energy > 0.0 { guess((pull + swing) / bend) } else { 0.0 };
    let mut roots = [up, if returns { guess((pull - swing) / bend) } else { up }];
    for _ in 0..STEPS {
        let [first, second] = [halley(&c, roots[0]), halley(&c, roots[1])];
        roots = [roots[0] - first, roots[1] - second];
        if (first.abs() <= NEAR_ROOT * roots[0].abs()) & (second.abs() <= NEAR_ROOT * roots[1].abs()) {
            break;
        }
    }
    roots
}

/// Returns the step of Halley's method for a root of a polynomial.
#[inline(always)]
fn halley(c: &[f64; 6], x: f64) -> f64 {
    let value = c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))));
    let slope = c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * (4.0 * c[4] + x * 5.0 * c[5])));
    let bend = c[2] + x * (3.0 * c[3] + x * (6.0 * c[4] + x * 10.0 * c[5]));
    value * slope / (slope * slope - value * bend)
}
