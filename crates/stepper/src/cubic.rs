//! Cubic Hermite interpolation of an event function within a step.

use crate::Point;

/// Cubic Hermite interpolant p = y₀ + θ(m₀ + θ(c + θe)) on a step of length h; θ is the fraction of the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    /// Value at the start.
    pub y0: f64,
    /// Derivative at the start, 1/s.
    pub dy0: f64,
    /// Value at the end.
    pub y1: f64,
    /// Derivative at the end, 1/s.
    pub dy1: f64,
    /// Length of the step h, s.
    pub h: f64,
}

impl Cubic {
    /// Returns the coefficients m₀, c and e.
    fn coefficients(&self) -> [f64; 3] {
        let (m0, m1, rise) = (self.h * self.dy0, self.h * self.dy1, self.y1 - self.y0);
        [m0, 3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise]
    }

    /// Returns an approximate zero as a fraction of the step, for `y0` > 0 and `y1` < 0. If Newton's method leaves the step, the result is
    /// the zero of the chord.
    ///
    /// The result is a starting point for [`root_near`](crate::root_near): two Newton steps from the zero of the chord.
    #[must_use]
    pub fn root(&self) -> f64 {
        let Self { y0, y1, .. } = *self;
        let [m0, c, e] = self.coefficients();
        // The guess needs no evaluation of the event function and saves about one in a search.
        let chord = y0 / (y0 - y1);
        let mut x = chord;
        for _ in 0..2 {
            let slope = m0 + x * (2.0 * c + 3.0 * x * e);
            x -= (y0 + x * (m0 + x * (c + x * e))) / slope;
        }
        if x > 0.0 && x < 1.0 { x } else { chord }
    }

    /// Returns true if the cubic certainly stays above `level` in the whole step. The test uses the Bézier control points, whose convex
    /// hull contains the curve. If the result is false, the cubic may still stay above.
    #[must_use]
    pub fn stays_above(&self, level: f64) -> bool {
        let third = self.h / 3.0;
        let (first, last) = (self.y0 + third * self.dy0, self.y1 - third * self.dy1);
        self.y0 > level && first > level && last > level && self.y1 > level
    }

    /// Returns the minimum inside the step: x is its position as a fraction θ of the step (0 < θ < 1), y its value. None without a minimum.
    ///
    /// The minimum detects an event function that becomes negative and positive again within a step.
    #[must_use]
    pub fn dip(&self) -> Option<Point> {
        let y0 = self.y0;
        let [m0, c, e] = self.coefficients();
        // The minimum is where p' = 0 and p''/2 = c + 3 e θ = +√disc.
        let disc = c * c - 3.0 * e * m0;
        if disc.is_nan() || disc <= 0.0 {
            return None;
        }
        let root = disc.sqrt();
        // Two forms of the same root, each free of cancellation.
        let theta = if c > 0.0 { -m0 / (c + root) } else { (root - c) / (3.0 * e) };
        let inside = theta > 0.0 && theta < 1.0;
        inside.then_some(Point { x: theta, y: y0 + theta * (m0 + theta * (c + theta * e)) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dip(y0: f64, dy0: f64, y1: f64, dy1: f64, h: f64) -> Option<Point> {
        Cubic { y0, dy0, y1, dy1, h }.dip()
    }

    #[test]
    fn dip_of_a_parabola_and_of_a_cubic() {
        // (t-0.2)^2 - 0.01 over a step of 0.5: minimum at t = 0.2, that is θ = 0.4.
        let Point { x: theta, y: low } = dip(0.03, -0.4, 0.08, 0.6, 0.5).unwrap();
        assert!((theta - 0.4).abs() < 1e-15 && (low + 0.01).abs() < 1e-16);
        // t^3 - t on [-1, 1]: minimum -2/(3√3) at 1/√3; its maximum is not taken for one.
        let Point { x: theta, y: low } = dip(0.0, 2.0, 0.0, 2.0, 2.0).unwrap();
        let x = 1.0 / 3.0_f64.sqrt();
        assert!((theta - 0.5 * (x + 1.0)).abs() < 1e-15 && (low + 2.0 * x / 3.0).abs() < 1e-15);
        // The same upside down.
        let Point { x: theta, y: low } = dip(0.0, -2.0, 0.0, -2.0, 2.0).unwrap();
        assert!((theta - 0.5 * (1.0 - x)).abs() < 1e-15 && (low + 2.0 * x / 3.0).abs() < 1e-15);
    }

    #[test]
    fn no_dip_in_lines_rises_humps_and_constants() {
        assert_eq!(dip(1.0, 1.0, 2.0, 1.0, 1.0), None);
        assert_eq!(dip(1.0, 0.0, 1.0, 0.0, 1.0), None);
        assert_eq!(dip(0.0, 0.0, 1.0, 2.0, 1.0), None);
        assert_eq!(dip(1.0, 1.0, 1.0, -1.0, 1.0), None);
        assert_eq!(dip(f64::NAN, -1.0, 1.0, 1.0, 1.0), None);
    }
}
