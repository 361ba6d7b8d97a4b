//! How far a coordinate goes over a stretch of time.

/// Extremes of a coordinate over a stretch of time, and the largest fall and rise between two moments in order.
///
/// Stretches that follow one another join by [`Self::join`], which is associative; [`Self::NONE`] is its neutral element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Least position, m, and the first time at which it is reached, s.
    pub least: [f64; 2],
    /// Largest position, m, and the first time at which it is reached, s.
    pub most: [f64; 2],
    /// Largest fall after a maximum: max x(t₁) - x(t₂) over t₁ ≤ t₂, m.
    pub fall: f64,
    /// Largest rise after a minimum: max x(t₂) - x(t₁) over t₁ ≤ t₂, m.
    pub rise: f64,
}

impl Extent {
    /// No position yet.
    pub const NONE: Self =
        Self { least: [f64::INFINITY, 0.0], most: [f64::NEG_INFINITY, 0.0], fall: 0.0, rise: 0.0 };

    /// A single position, m, at a time, s.
    pub fn at(x: f64, t: f64) -> Self {
        Self { least: [x, t], most: [x, t], fall: 0.0, rise: 0.0 }
    }

    /// This stretch and the one after it.
    #[must_use]
    pub fn join(self, later: Self) -> Self {
        Self {
            least: if later.least[0] < self.least[0] { later.least } else { self.least },
            most: if later.most[0] > self.most[0] { later.most } else { self.most },
            fall: self.fall.max(later.fall).max(self.most[0] - later.least[0]),
            rise: self.rise.max(later.rise).max(later.most[0] - self.least[0]),
        }
    }

    /// Whether it holds no position.
    pub fn is_none(&self) -> bool {
        self.least[0] > self.most[0]
    }

    /// Peak to peak, m.
    pub fn width(&self) -> f64 {
        self.most[0] - self.least[0]
    }
}

#[cfg(test)]
mod tests {
    use super::Extent;

    #[test]
    fn joined_stretches_have_the_falls_and_rises_of_the_whole() {
        let x = [0.0, 3.0, 1.0, 2.5, -0.5, 0.5, 4.0, 3.5];
        let point = |k: usize| Extent::at(x[k], k as f64);
        let part = |from: usize, to: usize| (from..to).map(point).fold(Extent::NONE, Extent::join);
        let whole = part(0, x.len());
        // By hand: from 3 down to -0.5, from -0.5 up to 4.
        assert_eq!((whole.least, whole.most), ([-0.5, 4.0], [4.0, 6.0]));
        assert_eq!((whole.fall, whole.rise, whole.width()), (3.5, 4.5, 4.5));
        for cut in 0..=x.len() {
            assert_eq!(part(0, cut).join(part(cut, x.len())), whole);
        }
        assert!(Extent::NONE.is_none() && !whole.is_none());
    }
}
