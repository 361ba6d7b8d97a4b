//! Maximum of a curve by golden section search between the neighbours of the best known point.
//!
//! Source: Kiefer, *Proceedings of the American Mathematical Society* 4 (1953) 502. The search finds the maximum of a unimodal curve. For
//! other curves the search returns a value at least as large as the largest known value.

/// 1/φ.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Maximum number of evaluations.
const MOST: u32 = 60;

/// An evaluated point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    /// Position of the point.
    pub at: f64,
    /// Value of the curve at the point.
    pub value: f64,
    /// Uncertainty of the value.
    pub error: f64,
}

/// Result of the search for a maximum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Best evaluated point.
    pub best: Seen,
    /// Interval that contains the maximum.
    pub within: [f64; 2],
    /// Number of evaluations.
    pub runs: u32,
}

impl Seen {
    /// Returns whether both values are equal within their uncertainties.
    fn may_equal(&self, other: &Self) -> bool {
        (self.value - other.value).abs() <= self.error + other.error
    }

    fn better(self, other: Self) -> Self {
        if other.value > self.value { other } else { self }
    }
}

impl Peak {
    /// Narrows the interval of the maximum to a relative tolerance. The search ends earlier when the values are equal
    /// within their uncertainties.
    ///
    /// `known` is the best point so far. `try_at` evaluates a position; its second argument is the progress of the
    /// search, 0 to 1, on a logarithmic scale of the interval width.
    ///
    /// # Errors
    /// Returns the first error of `try_at`.
    pub fn narrow<E>(
        known: Seen,
        [mut low, mut high]: [f64; 2],
        tolerance: f64,
        mut try_at: impl FnMut(f64, f64) -> Result<Seen, E>,
    ) -> Result<Self, E> {
        let whole = high - low;
        let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        let [left, right] = inner(low, high);
        let (mut left, mut right, mut runs) = (try_at(left, 0.0)?, try_at(right, 0.0)?, 2);
        let mut best = known.better(left).better(right);
        while runs < MOST && high - low > tolerance * best.at.abs() {
            if left.may_equal(&right) && left.may_equal(&best) && right.may_equal(&best) {
                break;
            }
            let behind = math::ln(whole / (high - low)) / math::ln(whole / (tolerance * best.at.abs()));
            let behind = behind.clamp(0.0, 1.0);
            let next = if left.value >= right.value {
                (high, right) = (right.at, left);
                left = try_at(inner(low, high)[0], behind)?;
                left
            } else {
                (low, left) = (left.at, right);
                right = try_at(inner(low, high)[1], behind)?;
                right
            };
            runs += 1;
            best = best.better(next);
        }
        Ok(Self { best, within: [low, high], runs })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn found(of: impl Fn(f64) -> f64, known: f64, tolerance: f64, error: f64) -> Peak {
        let seen = |at| Seen { at, value: of(at), error };
        Peak::narrow(seen(known), [0.5, 1.0], tolerance, |at, _| Ok::<_, Infallible>(seen(at))).unwrap()
    }

    #[test]
    fn a_parabola_has_its_peak_where_it_is() {
        let peak = found(|at| 2.0 - (at - 0.7).powi(2), 0.6, 1e-4, 0.0);
        assert!((peak.best.at - 0.7).abs() < 1e-4 && peak.best.value > 2.0 - 1e-8, "{peak:?}");
        assert!(peak.runs < 25, "{peak:?}");
    }

    #[test]
    fn it_says_no_worse_than_what_was_known() {
        // Golden section search misses a narrow spike. The result must still be the known maximum.
        let peak = found(|at| if at == 0.6 { 9.0 } else { 1.0 - at }, 0.6, 1e-3, 0.0);
        assert_eq!((peak.best.at, peak.best.value), (0.6, 9.0));
    }

    /// Values with an uncertainty of 1e-4 determine the maximum of a parabola only to ±√2e-4: beyond that, two values on the parabola are
    /// equal. The inner points of golden section search are 0.236 of the interval apart.
    #[test]
    fn errors_end_the_search_where_they_hide_the_peak() {
        for top in [0.6, 0.7, 0.83] {
            let peak = found(|at| 2.0 - (at - top).powi(2), 0.75, 1e-6, 1e-4);
            assert!(peak.within[0] <= top && top <= peak.within[1], "{top}: {peak:?}");
            assert!((0.5e-2..0.12).contains(&(peak.within[1] - peak.within[0])), "{top}: {peak:?}");
            assert!(peak.runs < 12, "{top}: {peak:?}");
        }
    }
}
