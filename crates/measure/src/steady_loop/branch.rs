//! The branches of a steady loop, as a family of curves, and the figures of a loop that has them.

/// A branch from one reversal to the other over the share x of the way: B(x) = height · (ρx + (1 - ρ) g(x)/g(1)) with
/// g(x) = 1 - (1 - min(x/y, 1))ⁿ.
///
/// n = 1 is an elastic-plastic element, n = 3/2 a ball, n = 2 a cone, each at constant load, in partial (y > 1) and in gross slip; ρ is the share
/// of an elastic line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Branch {
    /// Share y of the way after which all slips.
    pub(super) way: f64,
    /// Power n.
    pub(super) power: f64,
    /// Share ρ.
    pub(super) elastic: f64,
}

impl Branch {
    /// B(x) of height 1.
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

    /// Slope at the reversal.
    pub(super) fn slope(&self) -> f64 {
        self.elastic + (1.0 - self.elastic) * self.power / self.way / self.graded(1.0)
    }

    /// Area of the loop of height 1 over a way of 1: twice the integral of B, less one.
    pub(super) fn area(&self) -> f64 {
        let mean = 1.0 / (self.power + 1.0);
        let integral = if self.way <= 1.0 {
            1.0 - self.way * mean
        } else {
            let left = 1.0 - 1.0 / self.way;
            1.0 - self.way * mean * (1.0 - math::exp((self.power + 1.0) * math::ln(left)))
        };
        // An elastic line encloses nothing.
        (1.0 - self.elastic) * (2.0 * integral / self.graded(1.0) - 1.0).max(0.0)
    }

    /// Half the opening, in ways, at a level above the middle, in heights; none beyond the ends.
    pub(super) fn half_opening(&self, level: f64) -> Option<f64> {
        let down = self.place(0.5 - level)?;
        let up = self.place(0.5 + level)?;
        Some((0.5 * (1.0 - down - up)).max(0.0))
    }

    /// Where B is a height between 0 and 1.
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
