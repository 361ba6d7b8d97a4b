//! Slopes and limits by polynomial extrapolation from both sides or one side, with error estimates.
//!
//! The polynomial through values at geometrically decreasing distances is Richardson's extrapolation (*Philosophical Transactions of the
//! Royal Society A* 210 (1911) 307). Large distances cause truncation errors, small distances magnify noise. As in Ridders, *Advances in
//! Engineering Software* 4 (1982) 75, all ranges of neighbouring distances are tried. The truncation error is the change of the estimate if
//! the outermost or innermost distance is omitted. The noise of the estimate is the noise of the values times the norm of the weights. The
//! range with the smallest sum of truncation error and noise is chosen.
//!
//! Outer distances may agree by accident, for example beyond a corner. A range that contradicts a range nearer to the point is rejected.
//! The error of a range is at least its difference to the next two ranges.

/// Values at one distance, or at a pair of distances on both sides.
pub(super) type Level = Vec<(f64, f64)>;

/// Estimate with its error and the largest distance from which it was computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Estimate {
    pub(super) value: f64,
    pub(super) error: f64,
    pub(super) reach: f64,
}

/// Requested quantity, evaluated at distance 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    Value,
    Slope,
}

/// Minimum and maximum number of distances in a range. More distances would only add rounding errors.
const FEWEST: usize = 3;
const MOST: usize = 4;
/// Number of inner ranges that must agree within the error, because a single range may agree by accident.
const WITNESSES: usize = 2;
/// Smallest relevant truncation error, relative to the slope.
const COUNTS: f64 = 1e-6;
/// Factor from the standard deviation of the noise to an error bound.
const HARDLY_ANY: f64 = 4.0;

/// Estimate from one range of levels.
struct Stretch {
    estimate: Estimate,
    /// Truncation error, which is one part of the error.
    bends: f64,
}

/// Returns the estimate from all given levels.
fn stretch(levels: &[Level], own: Option<f64>, wanted: Wanted, noise: f64) -> Stretch {
    let fit = |levels: &[Level]| {
        let own = own.map(|value| (0.0, value));
        let points: Vec<(f64, f64)> = own.into_iter().chain(levels.iter().flatten().copied()).collect();
        extrapolate(&points, wanted)
    };
    let (value, magnified) = fit(levels);
    let missed =
        [fit(&levels[1..]), fit(&levels[..levels.len() - 1])].map(|(other, _)| (value - other).abs());
    let bends = missed[0].max(missed[1]);
    let error = bends + HARDLY_ANY * magnified * noise;
    let reach = levels[0].iter().fold(0.0, |most: f64, (at, _)| most.max(at.abs()));
    Stretch { estimate: Estimate { value, error, reach }, bends }
}

/// Returns the best estimate from levels, the outermost first. `own` is the value at distance 0, if it belongs to the same smooth branch.
/// Returns `None` for fewer than three levels.
pub(super) fn estimate(levels: &[Level], own: Option<f64>, wanted: Wanted, noise: f64) -> Option<Estimate> {
    let mut best: Option<Estimate> = None;
    // Best estimate for each outermost distance; the innermost last.
    let mut nearer: Vec<Estimate> = Vec::new();
    for first in (0..levels.len().saturating_sub(FEWEST - 1)).rev() {
        let ends = first + FEWEST..=levels.len().min(first + MOST);
        let found = ends.map(|end| stretch(&levels[first..end], own, wanted, noise).estimate);
        let found = found.filter(|found| found.error.is_finite());
        let Some(one) = found.reduce(|a, b| if b.error < a.error { b } else { a }) else { continue };
        let apart = |other: &Estimate| (one.value - other.value).abs();
        let is_contradicted = nearer.iter().any(|other| apart(other) > one.error + other.error);
        let unlike = nearer.iter().rev().take(WITNESSES).map(apart).fold(0.0, f64::max);
        let told = Estimate { error: one.error.max(unlike), ..one };
        if !is_contradicted && best.is_none_or(|best| told.error < best.error) {
            best = Some(told);
        }
        nearer.push(one);
    }
    best
}

/// Returns whether smaller distances would improve the slope: truncation errors are relevant and exceed the noise.
pub(super) fn bends_near_by(levels: &[Level], own: Option<f64>, noise: f64) -> bool {
    let Some(first) = levels.len().checked_sub(FEWEST) else { return false };
    let Stretch { estimate: Estimate { value, error, .. }, bends } =
        stretch(&levels[first..], own, Wanted::Slope, noise);
    bends > 0.5 * error && bends > COUNTS * value.abs()
}

/// Returns value or slope at 0 of the polynomial through some points, and the factor by which noise is amplified.
fn extrapolate(points: &[(f64, f64)], wanted: Wanted) -> (f64, f64) {
    let weights = (0..points.len()).map(|i| weight(points, i, wanted));
    let (mut value, mut squares) = (0.0, 0.0);
    for (weight, (_, y)) in weights.zip(points) {
        value += weight * y;
        squares += weight * weight;
    }
    (value, squares.sqrt())
}

/// Returns the weight of point `i`: value or slope of its Lagrange polynomial at 0.
fn weight(points: &[(f64, f64)], i: usize, wanted: Wanted) -> f64 {
    let own = points[i].0;
    let product = |left_out: usize| -> f64 {
        let others = points.iter().enumerate().filter(|(j, _)| *j != i && *j != left_out);
        others.map(|(_, (other, _))| other / (other - own)).product()
    };
    match wanted {
        Wanted::Value => product(i),
        Wanted::Slope => {
            (0..points.len()).filter(|k| *k != i).map(|k| product(k) / (own - points[k].0)).sum()
        }
    }
}

/// Returns the standard deviation of noise from fourth differences of equidistant values. Returns `None` for fewer than five values.
///
/// Smooth functions have small fourth differences. For independent noise, the variance of a fourth difference is 70 times the variance of a
/// value (Moré and Wild, *SIAM Journal on Scientific Computing* 33 (2011) 1292).
pub(super) fn noise(values: &[f64]) -> Option<f64> {
    let fourth = |w: &[f64]| w[0] - 4.0 * w[1] + 6.0 * w[2] - 4.0 * w[3] + w[4];
    let squares: Vec<f64> = values.windows(5).map(|window| fourth(window).powi(2) / 70.0).collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    (!squares.is_empty()).then(|| mean.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn both(f: impl Fn(f64) -> f64, outermost: f64, count: i32) -> Vec<Level> {
        let at = |k: i32| outermost * 4.0_f64.powi(-k);
        (0..count).map(|k| vec![(-at(k), f(-at(k))), (at(k), f(at(k)))]).collect()
    }

    fn above(f: impl Fn(f64) -> f64, outermost: f64, count: i32) -> Vec<Level> {
        let at = |k: i32| outermost * 4.0_f64.powi(-k);
        (0..count).map(|k| vec![(at(k), f(at(k)))]).collect()
    }

    /// Reproducible uniform noise with standard deviation 1 (Steele's bit mixer).
    fn rough(x: f64) -> f64 {
        let mixed = (x.to_bits() ^ (x.to_bits() >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let share = ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
        12.0_f64.sqrt() * (share - 0.5)
    }

    #[test]
    fn polynomials_are_found_to_rounding() {
        let f = |x: f64| 2.0 + 3.0 * x - 5.0 * x.powi(2) + 7.0 * x.powi(3);
        let slope = estimate(&both(f, 0.1, 4), None, Wanted::Slope, 1e-16).unwrap();
        assert!((slope.value - 3.0).abs() < 1e-12 && (slope.value - 3.0).abs() <= slope.error, "{slope:?}");
        // Without the value itself, only a parabola is available for comparison.
        for (own, sharp) in [(None, 1e-5), (Some(2.0), 1e-8)] {
            let slope = estimate(&above(f, 0.1, 7), own, Wanted::Slope, 1e-16).unwrap();
            assert!((slope.value - 3.0).abs() <= slope.error && slope.error < sharp, "{own:?} {slope:?}");
        }
        let value = estimate(&above(f, 0.1, 7), None, Wanted::Value, 1e-16).unwrap();
        assert!((value.value - 2.0).abs() <= value.error && value.error < 1e-9, "{value:?}");
    }

    /// Curvature and noise of any size: sin(kx + 1) has the slope k cos 1.
    #[test]
    fn errors_hold_what_is_off() {
        for wave in [0.3, 5.0, 100.0, 3e3] {
            for noise in [1e-15, 1e-12, 1e-9, 1e-6] {
                let f = |x: f64| (wave * x + 1.0).sin() + noise * rough(x);
                let wanted = wave * 1.0_f64.cos();
                let slope = estimate(&both(f, 1.0 / 128.0, 7), None, Wanted::Slope, noise).unwrap();
                let off = (slope.value - wanted).abs();
                assert!(off <= slope.error, "{wave} {noise:e}: {off:e} {slope:?}");
                // The error is not too large, either: noise divided by the distance at which curvature matters.
                let scale = wave.max(1.0) * noise.powf(0.6) * 1e3;
                assert!(slope.error <= scale.max(1e-10), "{wave} {noise:e}: {slope:?} {scale:e}");
            }
        }
    }

    #[test]
    fn a_kink_has_two_slopes() {
        let f = |x: f64| x.sin() + x.abs();
        let right = estimate(&above(f, 0.01, 6), Some(0.0), Wanted::Slope, 1e-16).unwrap();
        let left = estimate(&above(|x| f(-x), 0.01, 6), Some(0.0), Wanted::Slope, 1e-16).unwrap();
        assert!((right.value - 2.0).abs() <= right.error && (left.value).abs() <= left.error);
        assert!(right.error + left.error < 1e-6);
    }

    /// Beyond a corner the result may be constant or have another slope: values near the point decide.
    #[test]
    fn what_agrees_far_out_is_not_taken_for_what_is_near() {
        for bend in [1e-4, 1e-5, 1e-6] {
            let f = |x: f64| 5.0 + x + bend * (x / bend).tanh();
            for levels in [both(f, 1.0 / 128.0, 12), above(f, 1.0 / 128.0, 12)] {
                let slope = estimate(&levels, Some(5.0), Wanted::Slope, 1e-15).unwrap();
                assert!((slope.value - 2.0).abs() <= slope.error && slope.error < 1e-3, "{bend:e} {slope:?}");
                let value = estimate(&levels, None, Wanted::Value, 1e-15).unwrap();
                assert!((value.value - 5.0).abs() <= value.error, "{bend:e} {value:?}");
            }
            assert!(bends_near_by(&above(f, 1.0 / 128.0, 7), Some(5.0), 1e-15), "{bend:e}");
        }
        assert!(!bends_near_by(&above(f64::exp, 1.0 / 128.0, 7), Some(1.0), 1e-13));
    }

    #[test]
    fn noise_is_measured_beside_what_is_smooth() {
        let values: Vec<f64> =
            (-50..=50).map(|k| f64::from(k) * 1e-6).map(|x| (300.0 * x).exp() + 1e-11 * rough(x)).collect();
        let found = noise(&values).unwrap();
        assert!((found / 1e-11 - 1.0).abs() < 0.3, "{found:e}");
        assert_eq!(noise(&values[..4]), None);
    }
}
