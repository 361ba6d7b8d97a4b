//! Quadratic interpolation of a rate within a step: p(σ) = a + bσ + cσ², 0 ≤ σ ≤ 1. The integral of p over σ is the change in the step.

/// Rate within a step, as the coefficients of a quadratic polynomial in σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pace([f64; 3]);

impl Pace {
    /// Creates the polynomial from its integral `given` and its values at both ends.
    pub(crate) fn between(given: f64, first: f64, last: f64) -> Self {
        Self([first, 6.0 * given - 4.0 * first - 2.0 * last, 3.0 * (first + last) - 6.0 * given])
    }

    /// Creates the polynomial from its integral `given` and its value and slope at the end.
    pub(crate) fn ending(given: f64, last: f64, slope: f64) -> Self {
        let c = 3.0 * (0.5 * slope - last + given);
        let b = slope - 2.0 * c;
        Self([last - b - c, b, c])
    }

    /// Creates a linear polynomial from its integral `given` and its value at the end.
    pub(crate) fn straight(given: f64, last: f64) -> Self {
        let b = 2.0 * (last - given);
        Self([last - b, b, 0.0])
    }

    /// Returns the integral of the positive part of the polynomial.
    pub(crate) fn risen(self) -> f64 {
        let cuts = self.turns();
        let ends = cuts.into_iter().chain([1.0]);
        let starts = [0.0].into_iter().chain(cuts);
        starts.zip(ends).map(|(from, to)| (self.until(to) - self.until(from)).max(0.0)).sum()
    }

    /// Returns the largest magnitude within the step and at its end, without the start, which belongs to the previous step.
    pub(crate) fn most(self) -> f64 {
        let Self([_, b, c]) = self;
        let extreme = -0.5 * b / c;
        let extreme = if extreme > 0.0 && extreme < 1.0 { extreme } else { 1.0 };
        self.at(extreme).abs().max(self.at(1.0).abs())
    }

    fn at(self, part: f64) -> f64 {
        let Self([a, b, c]) = self;
        a + part * (b + part * c)
    }

    /// Returns the integral from 0 to `part`.
    fn until(self, part: f64) -> f64 {
        let Self([a, b, c]) = self;
        part * (a + part * (0.5 * b + part * c / 3.0))
    }

    /// Returns the zeros within the step in ascending order; a missing zero is given as 0.
    fn turns(self) -> [f64; 2] {
        let Self([a, b, c]) = self;
        let root = (b * b - 4.0 * a * c).sqrt();
        // The first root has no cancellation; the second root follows from the product a/c of both roots.
        let sum = -0.5 * (b + root.copysign(b));
        let within = |part: f64| if part > 0.0 && part < 1.0 { part } else { 0.0 };
        let [one, two] = [within(a / sum), within(sum / c)];
        [one.min(two), one.max(two)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The polynomial (σ - ¼)(σ - ¾) has the integral σ³/3 - σ²/2 + 3σ/16 and is negative between its roots.
    #[test]
    fn a_rate_of_two_turns_is_known_by_what_bounds_it() {
        let until = |x: f64| x * x * x / 3.0 - 0.5 * x * x + 0.1875 * x;
        let (given, risen) = (until(1.0), until(0.25) + until(1.0) - until(0.75));
        for pace in [Pace::between(given, 0.1875, 0.1875), Pace::ending(given, 0.1875, 1.0)] {
            assert!((pace.risen() - risen).abs() < 1e-15, "{pace:?}: {}", pace.risen());
            assert!((pace.most() - 0.1875).abs() < 1e-15, "{}", pace.most());
        }
        // The extremum between the ends is larger than both end values.
        let hill = Pace::between(4.0 / 6.0, 0.0, 0.0);
        assert!((hill.most() - 1.0).abs() < 1e-15 && (hill.risen() - 2.0 / 3.0).abs() < 1e-15);
    }

    /// The positive part of a linear rate from a to b is a triangle or a trapezoid.
    #[test]
    fn what_comes_back_within_a_step_is_not_taken_off() {
        for (a, b) in [(3.0, -1.0), (-1.0, 3.0), (1.0, 2.0), (-1.0, -2.0), (2.0, 0.0), (0.0, 2.0), (0.0, 0.0)]
        {
            let above = |x: f64| 0.5 * f64::max(x, 0.0).powi(2);
            let area = if a == b { f64::max(a, 0.0) } else { (above(b) - above(a)) / (b - a) };
            let given = 0.5 * (a + b);
            for pace in [Pace::straight(given, b), Pace::between(given, a, b), Pace::ending(given, b, b - a)]
            {
                assert!((pace.risen() - area).abs() < 1e-15, "{a} {b}: {}", pace.risen());
            }
        }
    }
}
