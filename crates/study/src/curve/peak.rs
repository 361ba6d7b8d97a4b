//! The best point of a curve, by golden section between the neighbours of the best one known.
//!
//! Source: Kiefer, *Proc. Amer. Math. Soc.* 4 (1953) 502. It finds a peak of a curve that rises to it and falls from it; of a
//! ragged one it finds a good place near the best one known, and says no worse.

/// 1/φ.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Most places that are tried.
const MOST: u32 = 60;

/// A place that was looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    /// Where.
    pub at: f64,
    /// How large it is there.
    pub value: f64,
    /// How far that may be off.
    pub error: f64,
}

/// A best place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// The best place that was seen.
    pub best: Seen,
    /// Between which places the peak lies.
    pub within: [f64; 2],
    /// Places that were tried.
    pub runs: u32,
}

impl Seen {
    /// Whether errors allow that both are as large.
    fn may_equal(&self, other: &Self) -> bool {
        (self.value - other.value).abs() <= self.error + other.error
    }

    fn better(self, other: Self) -> Self {
        if other.value > self.value { other } else { self }
    }
}

impl Peak {
    /// Narrows the range in which the largest value lies to a share of its place, or until errors no longer tell its places apart;
    /// `known` is the best place so far; `try_at` looks at a place, and hears how much of the way is behind, 0 to 1: by how many times
    /// the range is narrower, as a power.
    ///
    /// # Errors
    /// Those of a place that cannot be tried.
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
        // A spike between falls: golden section does not see it, and keeps it.
        let peak = found(|at| if at == 0.6 { 9.0 } else { 1.0 - at }, 0.6, 1e-3, 0.0);
        assert_eq!((peak.best.at, peak.best.value), (0.6, 9.0));
    }

    /// Values that are known to 1e-4 say where a parabola is largest to ±√2e-4 only: two places so far from it look alike, and they
    /// divide what is left as the golden section does, 0.236 of it apart.
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
