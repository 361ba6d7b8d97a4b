//! A contact in partial slip as it acts on a single slider.

use std::array;

/// A contact in partial slip, its heights counted by their roots.
#[derive(Debug, Clone, Copy)]
pub(super) struct PartialSlip {
    /// αN(1 m) = 2αc/5.
    gain: f64,
    /// λ.
    pub(super) lean: f64,
    /// h at the start, m, and its root.
    pub(super) height: f64,
    root: f64,
    /// Roots of h at both turning points; the second may lie beyond the centre, at a height below zero.
    ends: [f64; 2],
    beyond: f64,
    /// Its part of K is that cubic in √h over the two sums of √h and the roots at the ends.
    cubic: [f64; 4],
}

impl PartialSlip {
    pub(super) fn new(gain: f64, lean: f64, height: f64) -> Self {
        let root = height.sqrt();
        Self { gain, lean, height, root, ends: [root; 2], beyond: 0.0, cubic: [0.0; 4] }
    }

    /// Takes up the turning points: the second divided difference of h^{5/2} over them and h is, with a and c the roots at
    /// the ends, S = a+c, P = ac and y = √h, [Sy³ + S²y² + S(S²-P)y + P(S²-P)]/[(a+y)(y+c)S].
    pub(super) fn swing_between(&mut self, low: f64, high: f64) {
        let height = |q: f64| self.height - self.lean * q;
        // A slide that would turn only beyond the centre has no root of a height there.
        self.beyond = height(high).min(0.0);
        self.ends = [height(low).max(0.0).sqrt(), height(high).max(0.0).sqrt()];
        let (sum, product) = (self.ends[0] + self.ends[1], self.ends[0] * self.ends[1]);
        let (scale, square) = (self.gain * self.lean, sum * sum - product);
        self.cubic = [scale * product * square / sum, scale * square, scale * sum, scale];
    }

    /// Its parts of b at the start and of its first two derivatives; m/s², 1/s², 1/(m s²).
    #[inline(always)]
    pub(super) fn start(&self) -> [f64; 3] {
        let bend = -3.75 * self.gain * self.lean * self.root;
        [2.5 * self.gain * self.root * self.height, bend, -0.5 * bend * self.lean / self.height]
    }

    /// Its part of K at q, 1/s².
    #[inline(always)]
    pub(super) fn stiffness<const N: usize>(&self, q: [f64; N]) -> [f64; N] {
        let heights = q.map(|q| above(self.height - self.lean * q));
        // One branch for all nodes: the cubic of the usual case stays free of it.
        if self.beyond < 0.0 {
            return heights.map(|height| self.stiffness_beyond(height));
        }
        let ([a, c], [k0, k1, k2, k3]) = (self.ends, self.cubic);
        heights.map(f64::sqrt).map(|y| (((k3 * y + k2) * y + k1) * y + k0) / ((a + y) * (y + c)))
    }

    /// The same at a height where the slide would turn only beyond the centre.
    fn stiffness_beyond(&self, height: f64) -> f64 {
        let (a, y) = (self.ends[0], height.sqrt());
        let (inner, outer) = (mean_power(a, y), height * height * y / (height - self.beyond));
        self.gain * self.lean * (inner - outer) / (a * a - self.beyond)
    }

    /// Its parts of the mean of b up to q, of b there and of its slope; m/s², m/s², 1/s².
    #[inline(always)]
    pub(super) fn pull<const N: usize>(&self, q: [f64; N]) -> [[f64; N]; 3] {
        let heights = q.map(|q| self.height - self.lean * q);
        let inside = heights.map(above);
        let roots = inside.map(f64::sqrt);
        // Beyond the centre the mean goes on over nothing.
        let share = |i: usize| if heights[i] < 0.0 { self.height / (self.height - heights[i]) } else { 1.0 };
        [
            array::from_fn(|i| self.gain * mean_power(self.root, roots[i]) * share(i)),
            array::from_fn(|i| 2.5 * self.gain * roots[i] * inside[i]),
            roots.map(|y| -3.75 * self.gain * self.lean * y),
        ]
    }
}

/// A height, or nothing.
#[inline(always)]
fn above(height: f64) -> f64 {
    if height > 0.0 { height } else { 0.0 }
}

/// (a⁵ - b⁵)/(a² - b²) of two roots, not both zero: 5/2 of the mean of h^{3/2} between their squares, without a difference.
#[inline(always)]
fn mean_power(a: f64, b: f64) -> f64 {
    let (a2, b2, ab) = (a * a, b * b, a * b);
    (a2 * a2 + b2 * b2 + ab * (a2 + ab + b2)) / (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// h^{5/2}, whose divided differences the closed forms are; nothing below zero.
    fn power(h: f64) -> f64 {
        h.max(0.0).powf(2.5)
    }

    fn divided(a: f64, b: f64) -> f64 {
        (power(a) - power(b)) / (a - b)
    }

    #[test]
    fn stiffness_is_a_second_divided_difference() {
        // Turning points inside, at and beyond the centre, h = 0.8 - 0.5 q.
        for (low, high) in [(-0.4, 1.2), (0.0, 1.6), (-1.0, 3.0)] {
            let mut slip = PartialSlip::new(3.0, 0.5, 0.8);
            slip.swing_between(low, high);
            let height = |q: f64| 0.8 - 0.5 * q;
            for q in [-0.3, 0.1, 0.6, 1.1] {
                let (a, h, c) = (height(low), height(q), height(high));
                let exact = 3.0 * 0.5 * (divided(a, h) - divided(h, c)) / (a - c);
                let [stiffness] = slip.stiffness([q]);
                assert!((stiffness / exact - 1.0).abs() < 1e-14, "{low} {high} {q}");
            }
        }
    }

    /// A swing of 1e-12 of the height: a difference of powers would have lost all but four digits.
    #[test]
    fn no_swing_is_too_small_for_its_digits() {
        let mut slip = PartialSlip::new(3.0, 0.5, 0.8);
        slip.swing_between(-1e-12, 1e-12);
        let curvature = 3.0 * 0.5 * 0.5 * 3.75 * 0.8_f64.sqrt();
        let [stiffness] = slip.stiffness([3e-13]);
        assert!((stiffness / curvature - 1.0).abs() < 1e-11);
    }

    #[test]
    fn pull_is_mean_value_and_slope_of_the_force() {
        let slip = PartialSlip::new(3.0, 0.5, 0.8);
        for q in [-0.7, 0.3, 1.5, 2.5] {
            let h = 0.8 - 0.5 * q;
            let root = f64::max(h, 0.0).sqrt();
            let exact = [3.0 * divided(0.8, h), 7.5 * root.powi(3), -3.0 * 0.5 * 3.75 * root];
            for (found, exact) in slip.pull([q]).as_flattened().iter().zip(exact) {
                assert!((found - exact).abs() < 1e-14 * (1.0 + exact.abs()), "{q}: {found} {exact}");
            }
        }
    }
}
