//! A contact in partial slip as a single slider feels it.

/// A contact in partial slip, its heights counted by their roots.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spring {
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

impl Spring {
    pub(super) fn new(gain: f64, lean: f64, height: f64) -> Self {
        let root = height.sqrt();
        Self { gain, lean, height, root, ends: [root; 2], beyond: 0.0, cubic: [0.0; 4] }
    }

    /// Takes up the turning points: the second divided difference of h^{5/2} over them and h is, with a and c the roots at
    /// the ends, S = a+c, P = ac and y = √h, [Sy³ + S²y² + S(S²-P)y + P(S²-P)]/[(a+y)(y+c)S].
    pub(super) fn swing_between(&mut self, low: f64, high: f64) {
        let height = |q: f64| self.height - self.lean * q;
        self.beyond = height(high).min(0.0);
        self.ends = [height(low).max(0.0).sqrt(), height(high).max(0.0).sqrt()];
        let (sum, product) = (self.ends[0] + self.ends[1], self.ends[0] * self.ends[1]);
        let (scale, square) = (self.gain * self.lean, sum * sum - product);
        self.cubic = [scale * product * square / sum, scale * square, scale * sum, scale];
    }

    /// Its part of K at q, 1/s².
    #[inline(always)]
    pub(super) fn stiffness(&self, q: f64) -> f64 {
        let height = (self.height - self.lean * q).max(0.0);
        let (y, [a, c], [k0, k1, k2, k3]) = (height.sqrt(), self.ends, self.cubic);
        if self.beyond < 0.0 {
            return self.stiffness_beyond(height, y);
        }
        (((k3 * y + k2) * y + k1) * y + k0) / ((a + y) * (y + c))
    }

    /// The same where the slide would turn only beyond the centre.
    fn stiffness_beyond(&self, height: f64, y: f64) -> f64 {
        let a = self.ends[0];
        let (inner, outer) = (mean_power(a, y), height * height * y / (height - self.beyond));
        self.gain * self.lean * (inner - outer) / (a * a - self.beyond)
    }

    /// Its parts of the mean of b up to q, of b there and of its slope; m/s², m/s², 1/s².
    #[inline(always)]
    pub(super) fn pull(&self, q: f64) -> [f64; 3] {
        let height = self.height - self.lean * q;
        let (y, inside) = (height.max(0.0).sqrt(), height.max(0.0));
        let start = self.height * self.height * self.root;
        let mean = if height > 0.0 { mean_power(self.root, y) } else { start / (self.height - height) };
        [self.gain * mean, 2.5 * self.gain * y * inside, -3.75 * self.gain * self.lean * y]
    }
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
            let mut spring = Spring::new(3.0, 0.5, 0.8);
            spring.swing_between(low, high);
            let height = |q: f64| 0.8 - 0.5 * q;
            for q in [-0.3, 0.1, 0.6, 1.1] {
                let (a, h, c) = (height(low), height(q), height(high));
                let exact = 3.0 * 0.5 * (divided(a, h) - divided(h, c)) / (a - c);
                assert!((spring.stiffness(q) / exact - 1.0).abs() < 1e-14, "{low} {high} {q}");
            }
        }
    }

    /// A swing of 1e-12 of the height: a difference of powers would have lost all but four digits.
    #[test]
    fn no_swing_is_too_small_for_its_digits() {
        let mut spring = Spring::new(3.0, 0.5, 0.8);
        spring.swing_between(-1e-12, 1e-12);
        let curvature = 3.0 * 0.5 * 0.5 * 3.75 * 0.8_f64.sqrt();
        assert!((spring.stiffness(3e-13) / curvature - 1.0).abs() < 1e-11);
    }

    #[test]
    fn pull_is_mean_value_and_slope_of_the_force() {
        let spring = Spring::new(3.0, 0.5, 0.8);
        for q in [-0.7, 0.3, 1.5, 2.5] {
            let h = 0.8 - 0.5 * q;
            let root = f64::max(h, 0.0).sqrt();
            let exact = [3.0 * divided(0.8, h), 7.5 * root.powi(3), -3.0 * 0.5 * 3.75 * root];
            for (found, exact) in spring.pull(q).into_iter().zip(exact) {
                assert!((found - exact).abs() < 1e-14 * (1.0 + exact.abs()), "{q}: {found} {exact}");
            }
        }
    }
}
