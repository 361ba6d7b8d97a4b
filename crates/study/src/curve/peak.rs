//! The best point of a curve, by golden section between the neighbours of the best one known.
//!
//! Source: Kiefer, *Proc. Amer. Math. Soc.* 4 (1953) 502. It finds a peak of a curve that rises to it and falls from it; of a
//! ragged one it finds a good place near the best one known, and says no worse.

/// 1/φ.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Most places that are tried.
const MOST: u32 = 60;

/// A best place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Where.
    pub at: f64,
    /// How large.
    pub value: f64,
    /// Between which places it lies.
    pub within: [f64; 2],
    /// Places that were tried.
    pub runs: u32,
}

impl Peak {
    /// Narrows the range in which the largest value lies to a share of its place; `known` is the best place so far.
    ///
    /// # Errors
    /// Those of a place that cannot be tried.
    pub fn narrow<E>(
        known: (f64, f64),
        [mut low, mut high]: [f64; 2],
        tolerance: f64,
        mut try_at: impl FnMut(f64) -> Result<f64, E>,
    ) -> Result<Self, E> {
        let (mut best, mut runs) = (known, 0);
        let mut look = |at: f64, runs: &mut u32| -> Result<(f64, f64), E> {
            *runs += 1;
            Ok((at, try_at(at)?))
        };
        let inner = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        let [left, right] = inner(low, high);
        let (mut left, mut right) = (look(left, &mut runs)?, look(right, &mut runs)?);
        while runs < MOST && high - low > tolerance * best.0.abs() {
            for seen in [left, right] {
                if seen.1 > best.1 {
                    best = seen;
                }
            }
            if left.1 >= right.1 {
                (high, right) = (right.0, left);
                left = look(inner(low, high)[0], &mut runs)?;
            } else {
                (low, left) = (left.0, right);
                right = look(inner(low, high)[1], &mut runs)?;
            }
        }
        for seen in [left, right] {
            if seen.1 > best.1 {
                best = seen;
            }
        }
        Ok(Self { at: best.0, value: best.1, within: [low, high], runs })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    #[test]
    fn a_parabola_has_its_peak_where_it_is() {
        let of = |at: f64| 2.0 - (at - 0.7).powi(2);
        let peak = Peak::narrow((0.6, of(0.6)), [0.5, 1.0], 1e-4, |at| Ok::<_, Infallible>(of(at))).unwrap();
        assert!((peak.at - 0.7).abs() < 1e-4 && peak.value > 2.0 - 1e-8 && peak.runs < 25, "{peak:?}");
    }

    #[test]
    fn it_says_no_worse_than_what_was_known() {
        // A spike between falls: golden section does not see it, and keeps it.
        let of = |at: f64| if at == 0.6 { 9.0 } else { 1.0 - at };
        let peak = Peak::narrow((0.6, 9.0), [0.5, 1.0], 1e-3, |at| Ok::<_, Infallible>(of(at))).unwrap();
        assert_eq!((peak.at, peak.value), (0.6, 9.0));
    }
}
