//! Slopes from values on both sides of a place, or on one, and how far they may be off.
//!
//! A polynomial through values at distances that shrink by a fixed share is what Richardson's extrapolation of differences
//! comes to (L. F. Richardson, *Phil. Trans. R. Soc. A* 210 (1911) 307). Through values far out it misses bends, through values
//! near by it magnifies noise. As in C. J. F. Ridders, *Adv. Eng. Softw.* 4 (1982) 75, all stretches of neighbouring distances
//! are tried: the bends that one misses are what changes when its outermost or its innermost distance is left out, its noise is
//! that of the values times the sum of its weights. The stretch for which both together are least is taken. Far out neighbouring
//! distances may agree by accident, as where all of them are beyond a bend: a stretch that one nearer by contradicts is left out, and
//! its error is at least what the next two make of it.

/// A distance, or a pair of them to both sides, with the values there.
pub(super) type Level = Vec<(f64, f64)>;

/// A value, how far it may be off, and the largest distance that it is from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Estimate {
    pub(super) value: f64,
    pub(super) error: f64,
    pub(super) reach: f64,
}

/// What is asked of a function at the place itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    Value,
    Slope,
}

/// Fewest and most distances in a stretch: by then rounding alone is left.
const FEWEST: usize = 3;
const MOST: usize = 4;
/// How many stretches nearer by must agree within the error: that of one alone may be small by accident.
const WITNESSES: usize = 2;
/// Bends that matter, as a share of a slope.
const COUNTS: f64 = 1e-6;
/// Noise is a standard deviation; an error is what hardly any is beyond.
const HARDLY_ANY: f64 = 4.0;

/// A stretch of levels.
struct Stretch {
    estimate: Estimate,
    /// How much of its error are bends.
    bends: f64,
}

/// The stretch of these levels alone.
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

/// The best estimate from levels, the outermost first, with the value at the place itself where it belongs to them. None from
/// fewer than three levels.
pub(super) fn estimate(levels: &[Level], own: Option<f64>, wanted: Wanted, noise: f64) -> Option<Estimate> {
    let mut best: Option<Estimate> = None;
    // The best of each outermost distance, the nearest last.
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

/// Whether levels still nearer would say more: the nearest of these bend by more than noise and by more than counts.
pub(super) fn bends_near_by(levels: &[Level], own: Option<f64>, noise: f64) -> bool {
    let Some(first) = levels.len().checked_sub(FEWEST) else { return false };
    let Stretch { estimate: Estimate { value, error, .. }, bends } =
        stretch(&levels[first..], own, Wanted::Slope, noise);
    bends > 0.5 * error && bends > COUNTS * value.abs()
}

/// The value or the slope at 0 of the polynomial through some points, and by how much noise of theirs is magnified in it.
fn extrapolate(points: &[(f64, f64)], wanted: Wanted) -> (f64, f64) {
    let weights = (0..points.len()).map(|i| weight(points, i, wanted));
    let (mut value, mut squares) = (0.0, 0.0);
    for (weight, (_, y)) in weights.zip(points) {
        value += weight * y;
        squares += weight * weight;
    }
    (value, squares.sqrt())
}

/// Weight of point `i`: the value or the slope at 0 of Lagrange's polynomial, 1 there and 0 at all others.
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

/// Standard deviation of the noise of values at equal distances, by their fourth differences, which leave little of anything
/// smooth: of independent noise their variance is 70 times its own (J. J. Moré, S. M. Wild, *SIAM J. Sci. Comput.* 33 (2011)
/// 1292). None of fewer than five.
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

    /// Noise of standard deviation 1, evenly spread, which is the same in every run of the test (Steele's mixer of bits).
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
        // Without the value itself a parabola is all that is left to compare with.
        for (own, sharp) in [(None, 1e-5), (Some(2.0), 1e-8)] {
            let slope = estimate(&above(f, 0.1, 7), own, Wanted::Slope, 1e-16).unwrap();
            assert!((slope.value - 3.0).abs() <= slope.error && slope.error < sharp, "{own:?} {slope:?}");
        }
        let value = estimate(&above(f, 0.1, 7), None, Wanted::Value, 1e-16).unwrap();
        assert!((value.value - 2.0).abs() <= value.error && value.error < 1e-9, "{value:?}");
    }

    /// Bends of any size beside noise of any size: sin(kx + 1) has the slope k cos 1.
    #[test]
    fn errors_hold_what_is_off() {
        for wave in [0.3, 5.0, 100.0, 3e3] {
            for noise in [1e-15, 1e-12, 1e-9, 1e-6] {
                let f = |x: f64| (wave * x + 1.0).sin() + noise * rough(x);
                let wanted = wave * 1.0_f64.cos();
                let slope = estimate(&both(f, 1.0 / 128.0, 7), None, Wanted::Slope, noise).unwrap();
                let off = (slope.value - wanted).abs();
                assert!(off <= slope.error, "{wave} {noise:e}: {off:e} {slope:?}");
                // And they are no empty words: noise over the distance at which bends begin.
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

    /// Beyond a bend a figure may be flat, or smooth in another way: what is near by decides.
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
