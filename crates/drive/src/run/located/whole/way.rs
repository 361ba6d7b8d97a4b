//! Interpolation inside a half step of step doubling.

use crate::run::stretch::Stretch;

/// Half step, with components and time derivatives at both ends.
pub(super) struct Way<'y> {
    pub(super) from: (f64, &'y [f64]),
    pub(super) to: (f64, &'y [f64]),
    pub(super) slopes: &'y [Vec<f64>; 2],
    pub(super) free: usize,
}

impl Way<'_> {
    /// Returns component `i` at time t inside the half step.
    ///
    /// Positions use the quintic polynomial through positions, velocities and accelerations of both ends. Other components use the cubic
    /// Hermite interpolant.
    pub(super) fn value(&self, i: usize, t: f64) -> f64 {
        let ((t0, y0), (t1, y1)) = (self.from, self.to);
        if t >= t1 {
            return y1[i];
        }
        let (h, [k0, k1], n) = (t1 - t0, self.slopes, self.free);
        let s = (t - t0) / h;
        let (left, square) = (1.0 - s, s * (1.0 - s));
        let (rise, first, last) = (y1[i] - y0[i], h * k0[i], h * k1[i]);
        let cubic = y0[i] + s * rise + square * (left * (first - rise) - s * (last - rise));
        if i >= n {
            return cubic;
        }
        // The quintic adds what the cubic lacks of both accelerations.
        let bend = h * h;
        let (from, to) = (bend * k0[n + i] - 6.0 * rise + 4.0 * first + 2.0 * last, {
            bend * k1[n + i] + 6.0 * rise - 2.0 * first - 4.0 * last
        });
        cubic + 0.5 * square * square * (left * from + s * to)
    }
}

impl Stretch for Way<'_> {
    const TURNS: bool = true;

    fn fill(&mut self, t: f64, y: &mut [f64]) {
        y.iter_mut().enumerate().for_each(|(i, y)| *y = self.value(i, t));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reproduces x = t⁵ - t³ and an integral q = t³ exactly.
    #[test]
    fn a_way_has_the_degrees_of_its_ends() {
        let x = |t: f64| t.powi(5) - t.powi(3);
        let v = |t: f64| 5.0 * t.powi(4) - 3.0 * t.powi(2);
        let a = |t: f64| 20.0 * t.powi(3) - 6.0 * t;
        let y = |t: f64| [x(t), v(t), t.powi(3)];
        let slopes = |t: f64| vec![v(t), a(t), 3.0 * t.powi(2)];
        let (from, to) = (0.3, 1.7);
        let (begin, end, ends) = (y(from), y(to), [slopes(from), slopes(to)]);
        let way = Way { from: (from, &begin), to: (to, &end), slopes: &ends, free: 1 };
        for t in [0.3, 0.31, 0.9, 1.2, 1.69, 1.7] {
            assert!((way.value(0, t) - x(t)).abs() < 1e-13, "{t}");
            assert!((way.value(2, t) - t.powi(3)).abs() < 1e-13, "{t}");
        }
    }
}
