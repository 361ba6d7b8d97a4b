//! Family of curves for the branches of a steady loop.

/// Force on a branch from one reversal to the next, as a function of the relative displacement x from 0 to 1.
///
/// B(x) = height · (ρx + (1 - ρ) g(x)/g(1)) with g(x) = 1 - (1 - min(x/y, 1))ⁿ. Gross slip starts at x = y; y > 1 is partial slip. At
/// constant load, n = 1 is an elastic-plastic element, n = 3/2 a ball and n = 2 a cone. The term with ρ represents a linear elastic part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Branch {
    /// Relative displacement x = y at which gross slip starts.
    pub(super) way: f64,
    /// Exponent n.
    pub(super) power: f64,
    /// Weight ρ of the linear elastic part.
    pub(super) elastic: f64,
}

impl Branch {
    /// Returns B(x) for height 1.
    pub(super) fn at(&self, x: f64) -> f64 {
        self.elastic * x + (1.0 - self.elastic) * self.graded(x) / self.graded(1.0)
    }

    fn graded(&self, x: f64) -> f64 {
        let left = 1.0 - x / self.way;
        if left <= 0.0 {
            return 1.0;
        }
        1.0 - if self.power == 1.0 { left } else { math::exp(self.power * math::ln(left)) }
    }

    /// Returns the slope of the branch at the reversal, x = 0.
    pub(super) fn slope(&self) -> f64 {
        self.elastic + (1.0 - self.elastic) * self.power / self.way / self.graded(1.0)
    }

    /// Returns the loop area for height 1 and stroke 1: twice the integral of B, minus 1.
    pub(super) fn area(&self) -> f64 {
        let mean = 1.0 / (self.power + 1.0);
        let integral = if self.way <= 1.0 {
            1.0 - self.way * mean
        } else {
            let left = 1.0 - 1.0 / self.way;
            1.0 - self.way * mean * (1.0 - math::exp((self.power + 1.0) * math::ln(left)))
        };
        // The elastic part does not contribute to the area.
        (1.0 - self.elastic) * (2.0 * integral / self.graded(1.0) - 1.0).max(0.0)
    }

    /// Returns half the opening, relative to the stroke, at a force `level` above the middle, relative to the height of the branch.
    ///
    /// Returns `None` outside of the loop.
    pub(super) fn half_opening(&self, level: f64) -> Option<f64> {
        let down = self.place(0.5 - level)?;
        let up = self.place(0.5 + level)?;
        Some((0.5 * (1.0 - down - up)).max(0.0))
    }

    /// Returns the relative displacement x at which B(x), of height 1, equals `height`, by bisection.
    fn place(&self, height: f64) -> Option<f64> {
        if !(0.0..=1.0).contains(&height) {
            return None;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if self.at(middle) < height { low = middle } else { high = middle }
        }
        Some(0.5 * (low + high))
    }
}
