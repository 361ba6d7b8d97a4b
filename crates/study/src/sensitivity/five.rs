//! Slope from four runs at two distances on both sides of the parameter value, and the run of the unchanged scenario.

use super::Slope;

/// Ratio of the outer to the inner distance of a pair of runs.
pub(super) const RATIO: f64 = 4.0;
/// Factor from the standard deviation of the noise to an error bound.
const HARDLY_ANY: f64 = 4.0;
/// Largest relative deviation of the difference between both sides' slopes from its expected decrease. A larger deviation indicates a
/// corner.
const KINK: f64 = 0.5;

/// Values of a result at 0, ±h/4 and ±h.
#[derive(Debug, Clone, Copy)]
pub(super) struct Five {
    own: f64,
    /// Outer and inner pair of runs: values below and above, and the distance.
    pairs: [([f64; 2], f64); 2],
}

impl Five {
    /// Creates the stencil from the values of the result at 0, -h, h, -h/4 and h/4, each with its distance.
    pub(super) fn new([(_, own), below, above, near_below, near_above]: [(f64, f64); 5]) -> Self {
        let pair = |below: (f64, f64), above: (f64, f64)| ([below.1, above.1], 0.5 * (above.0 - below.0));
        Self { own, pairs: [pair(below, above), pair(near_below, near_above)] }
    }

    /// Returns the central difference of a pair of runs.
    fn central(&self, pair: usize) -> f64 {
        let ([below, above], distance) = self.pairs[pair];
        (above - below) / (2.0 * distance)
    }

    /// Returns the second difference of a pair of runs.
    fn bend(&self, pair: usize) -> f64 {
        let ([below, above], _) = self.pairs[pair];
        (above - self.own) + (below - self.own)
    }

    /// Returns the standard deviation of the noise of a value, from the fourth difference of the five values. For a smooth function the
    /// second difference of the inner pair is a sixteenth of the second difference of the outer pair.
    pub(super) fn noise(&self) -> f64 {
        let square = RATIO * RATIO;
        // For independent noise, the variance of the fourth difference is 2 (r⁴ + 1) + 4 (r² - 1)² times the variance of a value.
        let variance = 2.0 * (square * square + 1.0) + 4.0 * (square - 1.0) * (square - 1.0);
        (square * self.bend(1) - self.bend(0)).abs() / variance.sqrt()
    }

    /// Returns the slope at 0 with its error: Richardson's extrapolation of both central differences (*Philosophical Transactions of the
    /// Royal Society A* 210 (1911) 307) or the outer central difference, whichever has the smaller error. Returns `None` at a corner, where
    /// the difference of both sides' slopes is not proportional to the distance.
    pub(super) fn slope(&self, noise: f64) -> Option<Slope> {
        let [outer, inner] = [0, 1].map(|pair| self.bend(pair) / self.pairs[pair].1);
        let doubt = HARDLY_ANY * 2.5 * noise / self.pairs[1].1;
        let expected = outer / RATIO;
        if (inner - expected).abs() > KINK * expected.abs() + doubt {
            return None;
        }
        let [far, near] = [0, 1].map(|pair| self.central(pair));
        let square = RATIO * RATIO;
        let missed = (near - far) / (square - 1.0);
        let noises = self.pairs.map(|(_, distance)| HARDLY_ANY * noise / (2.0_f64.sqrt() * distance));
        // The difference of both central differences gives the error due to the third derivative. The remaining error is of the order of
        // the square of this error.
        let left = (missed * missed / near.abs().max(f64::MIN_POSITIVE)).min(missed.abs());
        let both = (near + missed, left + noises[1] * square / (square - 1.0) + missed.abs() / square);
        let one = (far, missed.abs() * square + noises[0]);
        let (value, error) = if both.1 <= one.1 { both } else { one };
        Some(Slope { value, error, reach: self.pairs[0].1 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn five(f: impl Fn(f64) -> f64, h: f64) -> Five {
        Five::new([0.0, -h, h, -h / RATIO, h / RATIO].map(|at| (at, f(at))))
    }

    /// sin(kx + 1) has the slope k cos 1. The noise alternates in sign, the worst case for central differences.
    #[test]
    fn errors_hold_what_is_off() {
        for wave in [0.01, 0.3, 5.0, 30.0, 100.0] {
            for noise in [0.0, 1e-13, 1e-10, 1e-8] {
                let rough = |x: f64| noise * x.signum();
                let slope = five(|x| (wave * x + 1.0).sin() + rough(x), 1e-3).slope(noise).unwrap();
                let off = (slope.value - wave * 1.0_f64.cos()).abs();
                assert!(off <= slope.error + 1e-12, "{wave} {noise:e}: {off:e} {slope:?}");
                assert!(slope.error < 1e-4 * wave + 4e4 * noise + 1e-9, "{wave} {noise:e}: {slope:?}");
            }
        }
    }

    #[test]
    fn a_kink_has_no_slope() {
        for kink in [1.0, 1e-2, 1e-4] {
            assert_eq!(five(|x| x.sin() + kink * x.abs(), 1e-3).slope(1e-13), None, "{kink}");
        }
        assert!(five(|x| x.sin() + 2.0 * x * x, 1e-3).slope(1e-13).is_some());
    }

    #[test]
    fn noise_is_what_no_smooth_figure_has() {
        assert!(five(|x| (3.0 * x).exp(), 1e-3).noise() < 1e-11);
        let one_off = five(|x| x + if x == 1e-3 { 1e-6 } else { 0.0 }, 1e-3);
        assert!((one_off.noise() / 1e-6 * 1150.0_f64.sqrt() - 1.0).abs() < 0.2, "{:e}", one_off.noise());
    }
}
