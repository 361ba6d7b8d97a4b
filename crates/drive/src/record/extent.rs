//! Extremes of a coordinate over a time interval.

/// Extremes of a coordinate over a time interval, and its largest decrease and increase between two ordered times.
///
/// Adjacent intervals are combined by [`Self::join`], which is associative with the neutral element [`Self::NONE`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Smallest position, m, and the first time at which it is reached, s.
    pub least: [f64; 2],
    /// Largest position, m, and the first time at which it is reached, s.
    pub most: [f64; 2],
    /// Largest decrease: max x(t₁) - x(t₂) over t₁ ≤ t₂, m.
    pub fall: f64,
    /// Largest increase: max x(t₂) - x(t₁) over t₁ ≤ t₂, m.
    pub rise: f64,
}

impl Extent {
    /// Empty interval.
    pub const NONE: Self =
        Self { least: [f64::INFINITY, 0.0], most: [f64::NEG_INFINITY, 0.0], fall: 0.0, rise: 0.0 };

    /// Returns the extent of a single position (m) at a time (s).
    pub fn at(x: f64, t: f64) -> Self {
        Self { least: [x, t], most: [x, t], fall: 0.0, rise: 0.0 }
    }

    /// Returns the extent over this interval and the next one together.
    #[must_use]
    pub fn join(self, later: Self) -> Self {
        Self {
            least: if later.least[0] < self.least[0] { later.least } else { self.least },
            most: if later.most[0] > self.most[0] { later.most } else { self.most },
            fall: self.fall.max(later.fall).max(self.most[0] - later.least[0]),
            rise: self.rise.max(later.rise).max(later.most[0] - self.least[0]),
        }
    }

    /// Whether the interval is empty.
    pub fn is_none(&self) -> bool {
        self.least[0] > self.most[0]
    }

    /// Returns the peak-to-peak width, m.
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
        assert_eq!((whole.least, whole.most), ([-0.5, 4.0], [4.0, 6.0]));
        assert_eq!((whole.fall, whole.rise, whole.width()), (3.5, 4.5, 4.5));
        for cut in 0..=x.len() {
            assert_eq!(part(0, cut).join(part(cut, x.len())), whole);
        }
        assert!(Extent::NONE.is_none() && !whole.is_none());
    }
}
