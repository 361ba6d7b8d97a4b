//! Noise estimation and smoothing of measured values.

/// Returns the standard deviation of the noise of equally spaced samples.
///
/// It is estimated from fourth differences, which remove smooth signals. The median of their magnitudes is used, because single jumps do
/// not affect it. The noise is assumed to be normal.
#[must_use]
pub fn noise(values: &[f64]) -> f64 {
    let fourth = |five: &[f64]| (five[0] - 4.0 * five[1] + 6.0 * five[2] - 4.0 * five[3] + five[4]).abs();
    let mut all: Vec<f64> = values.windows(5).map(fourth).collect();
    if all.is_empty() {
        return 0.0;
    }
    let middle = all.len() / 2;
    let (_, median, _) = all.select_nth_unstable_by(middle, f64::total_cmp);
    // For normal noise, the median magnitude is 0.6745 σ. The sum of the squared binomial coefficients is 70.
    *median / 0.674_49 / 70.0_f64.sqrt()
}

/// Smooths values at ascending times by local parabolas.
///
/// Each value is replaced by the least-squares parabola through the points within half a `window` before and after it.
#[must_use]
pub fn smoothed(points: &[[f64; 2]], window: f64) -> Vec<f64> {
    let half = 0.5 * window;
    let at = |row: usize| {
        let [time, value] = points[row];
        let first = points.partition_point(|point| point[0] < time - half);
        let last = points.partition_point(|point| point[0] <= time + half);
        let part = &points[first..last];
        // In coordinates relative to the point, the value of the parabola is its constant coefficient.
        let mut sums = [0.0; 5];
        let mut right = [0.0; 3];
        for [t, v] in part {
            let x = (t - time) / half;
            let mut power = 1.0;
            for (k, sum) in sums.iter_mut().enumerate() {
                *sum += power;
                if k < 3 {
                    right[k] += power * v;
                }
                power *= x;
            }
        }
        let [a, b, c, d, e] = sums;
        let minors = [c * e - d * d, b * e - c * d, b * d - c * c];
        let whole = a * minors[0] - b * minors[1] + c * minors[2];
        if part.len() < 4 || whole.abs() < 1e-9 * (a * c * e).abs() {
            return value;
        }
        (right[0] * minors[0] - right[1] * minors[1] + right[2] * minors[2]) / whole
    };
    (0..points.len()).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parabolas_pass_and_noise_is_lessened() {
        let parabola = |t: f64| 3.0 - 2.0 * t + 0.7 * t * t;
        let times = (0..200).map(|k| 0.01 * f64::from(k) + 0.003 * f64::from(k % 3));
        let points: Vec<[f64; 2]> = times.map(|t| [t, parabola(t)]).collect();
        for (point, own) in points.iter().zip(smoothed(&points, 0.2)) {
            assert!((own - point[1]).abs() < 1e-12, "{point:?}: {own}");
        }
        // Of n equal weights a parabola keeps 9/(4n) of the variance in the middle.
        let draw = |k: usize| {
            let mixed = (k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            ((mixed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * 12.0_f64.sqrt()
        };
        let noisy: Vec<[f64; 2]> = (0..2000).map(|k| [k as f64, draw(k)]).collect();
        let left = smoothed(&noisy, 40.0);
        let variance = left[100..1900].iter().map(|value| value * value).sum::<f64>() / 1800.0;
        assert!(variance < 2.0 * 9.0 / 4.0 / 41.0, "{variance}");
        let deviation = noise(&noisy.iter().map(|point| point[1]).collect::<Vec<_>>());
        assert!((deviation - 1.0).abs() < 0.2, "{deviation}");
    }
}
