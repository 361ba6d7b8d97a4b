//! Sobol indices: variance-based sensitivity of a result to each parameter.

/// Number of terms per sample from which the indices of one parameter are computed.
const TERMS: usize = 6;

/// Sobol indices of one parameter, pure numbers. All indices are NaN if the result does not vary or there is only one sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Index {
    /// First-order index: fraction of the variance that would vanish if this parameter were known.
    pub(crate) first: f64,
    /// Total index: fraction of the variance that would remain if all other parameters were known.
    pub(crate) total: f64,
    /// Standard error of `first` for independent samples; an upper bound for a Sobol sequence.
    pub(crate) first_error: f64,
    /// Standard error of `total` for independent samples; an upper bound for a Sobol sequence.
    pub(crate) total_error: f64,
}

/// Accumulates the results f(A), f(B) and f(AB_i) sample by sample. A and B are independent samples, and AB_i is A with parameter i from B.
/// The memory of the accumulator does not grow with the number of samples.
///
/// V is the variance of f(A) and f(B) together, and results are relative to their mean over all samples:
///
/// - first order: mean(f(B) (f(AB_i) - f(A))) / V: A. Saltelli et al., Computer Physics Communications 181 (2010),
///   259-270, table 2 (b);
/// - total: mean((f(A) - f(AB_i))^2) / (2 V): M. J. W. Jansen, Computer Physics Communications 117 (1999), 35-43.
///
/// The mean is known only after the last sample. Sums are therefore relative to the first result, which preserves digits, and `finish`
/// corrects these sums exactly. The indices equal the results of the program SALib.
#[derive(Debug, Clone)]
pub(crate) struct Accumulator {
    /// f(A) of the first sample.
    origin: f64,
    samples: u64,
    /// Sum of the results f(A), relative to the origin.
    sum_a: f64,
    /// For each parameter, sums over all samples of the products of two terms.
    products: Vec<[[f64; TERMS]; TERMS]>,
}

impl Accumulator {
    /// Creates an accumulator for `dimensions` parameters.
    pub(crate) fn new(dimensions: usize) -> Self {
        Self { origin: 0.0, samples: 0, sum_a: 0.0, products: vec![[[0.0; TERMS]; TERMS]; dimensions] }
    }

    /// Adds one sample: f(A), f(B) and f(AB_i) of each parameter i. All values must be finite.
    pub(crate) fn take(&mut self, f_a: f64, f_b: f64, f_ab: &[f64]) {
        if self.samples == 0 {
            self.origin = f_a;
        }
        self.samples += 1;
        let (a, b) = (f_a - self.origin, f_b - self.origin);
        self.sum_a += a;
        for (products, f_ab) in self.products.iter_mut().zip(f_ab) {
            let change = f_ab - f_a;
            let terms = [1.0, a + b, 0.5 * (a * a + b * b), change, b * change, 0.5 * change * change];
            for (row, x) in products.iter_mut().zip(terms) {
                row.iter_mut().zip(terms).for_each(|(sum, y)| *sum += x * y);
            }
        }
    }

    /// Returns the indices of each parameter from the samples added so far.
    pub(crate) fn finish(&self) -> Vec<Index> {
        let mean = self.mean();
        self.products.iter().map(|products| self.index(products, mean)).collect()
    }

    /// Returns the mean of all results f(A), f(B) and f(AB_i), relative to the origin.
    fn mean(&self) -> f64 {
        let Some(both) = self.products.first().map(|products| products[0][1]) else { return 0.0 };
        let mixed: f64 = self.products.iter().map(|products| products[0][3] + self.sum_a).sum();
        (both + mixed) / (self.samples as f64 * (self.products.len() + 2) as f64)
    }

    /// Returns both indices of one parameter. Each index is a ratio of means M / V.
    ///
    /// The contributions m and v of a sample to M and V are linear combinations of the terms of the sample. The standard error is
    /// sqrt(mean((m - index v)^2) / (n - 1)) / V (delta method).
    fn index(&self, products: &[[f64; TERMS]; TERMS], mean: f64) -> Index {
        let n = self.samples as f64;
        let [_, sum, square, change, product, half_square] = products[0].map(|sum| sum / n);
        let middle = 0.5 * sum;
        let variance = square - middle * middle;
        if !(variance > 0.0 && n > 1.0) {
            return Index { first: f64::NAN, total: f64::NAN, first_error: f64::NAN, total_error: f64::NAN };
        }
        let error = |index: f64, [on_change, on_product, on_half_square]: [f64; 3]| {
            let v = [middle * middle, -middle, 1.0].map(|weight| -index * weight);
            let weights = [v[0], v[1], v[2], on_change, on_product, on_half_square];
            (quadratic(products, &weights).max(0.0) / (n * (n - 1.0))).sqrt() / variance
        };
        let first = (product - mean * change) / variance;
        let total = half_square / variance;
        let (first_error, total_error) = (error(first, [-mean, 1.0, 0.0]), error(total, [0.0, 0.0, 1.0]));
        Index { first, total, first_error, total_error }
    }
}

/// Returns the sum over all samples of the squared linear combination of terms, from the sums of products of terms.
fn quadratic(products: &[[f64; TERMS]; TERMS], weights: &[f64; TERMS]) -> f64 {
    let along = |row: &[f64; TERMS]| row.iter().zip(weights).map(|(sum, weight)| sum * weight).sum::<f64>();
    products.iter().zip(weights).map(|(row, weight)| weight * along(row)).sum()
}

#[cfg(test)]
mod tests {
    use super::super::points::Points;
    use super::*;
    use std::f64::consts::PI;

    /// Returns the indices of a function on the unit cube from n samples. A has the first k coordinates of a Sobol point, B the last k.
    fn indices<const K: usize>(n: u64, f: impl Fn(&[f64]) -> f64) -> Vec<Index> {
        let points = Points::unshifted(2 * K, n).unwrap();
        let mut accumulator = Accumulator::new(K);
        let mut point = vec![0.0; 2 * K];
        for index in 0..n {
            points.write(index, &mut point);
            let (a, b) = point.split_at(K);
            let mixed: [f64; K] = std::array::from_fn(|i| {
                let mut row = a.to_vec();
                row[i] = b[i];
                f(&row)
            });
            accumulator.take(f(a), f(b), &mixed);
        }
        accumulator.finish()
    }

    /// Ishigami's function with a = 7, b = 0.1.
    fn ishigami(u: &[f64]) -> f64 {
        let [x, y, z] = [u[0], u[1], u[2]].map(|u| -PI + 2.0 * PI * u);
        let sine = math::sin(y);
        math::sin(x) * (1.0 + 0.1 * z * z * z * z) + 7.0 * sine * sine
    }

    fn near(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
        let off = found.iter().zip(expected).any(|(x, y)| (x - y).abs() > tolerance);
        assert!(!off, "{found:?} for {expected:?}");
    }

    fn split(found: &[Index]) -> ([f64; 3], [f64; 3]) {
        (std::array::from_fn(|i| found[i].first), std::array::from_fn(|i| found[i].total))
    }

    /// Reference: S1 and ST of `SALib.analyze.sobol.analyze(..., calc_second_order=False)`, SALib 1.6.0, for the same samples. Samples:
    /// SciPy 1.17.1's `qmc.Sobol(6, scramble=False, bits=32).random(1024) + 2**-33`; Ishigami's function in NumPy 2.4.6.
    const FIRST: [f64; 3] = [0.332955075203446, 0.4413139385461684, 0.01857841297473376];
    const TOTAL: [f64; 3] = [0.5581790457112, 0.44328458402858145, 0.24214937334017256];

    #[test]
    fn the_indices_are_salibs() {
        let (first, total) = split(&indices::<3>(1024, ishigami));
        near(first, FIRST, 1e-12);
        near(total, TOTAL, 1e-12);
    }

    /// 1e6 + f is rounded to 1e-10. The sums must not lose further digits.
    #[test]
    fn a_great_mean_costs_no_digits() {
        let (first, total) = split(&indices::<3>(1024, |u| 1e6 + ishigami(u)));
        near(first, FIRST, 2e-12);
        near(total, TOTAL, 2e-12);
    }

    /// Reference: `S1_conf` and `ST_conf` of the same run divided by 1.96, bootstrap estimates from 2000 resamples (seed 7).
    #[test]
    fn the_standard_errors_are_those_of_a_bootstrap() {
        let bootstrap = [
            (0.03210154912846059, 0.044025801805495327),
            (0.02756853161086744, 0.020575732725849474),
            (0.028182140194535063, 0.013528889277413483),
        ];
        for (index, (first, total)) in indices::<3>(1024, ishigami).into_iter().zip(bootstrap) {
            assert!((index.first_error / first - 1.0).abs() < 0.06, "{index:?}");
            assert!((index.total_error / total - 1.0).abs() < 0.06, "{index:?}");
        }
    }

    /// T. Ishigami and T. Homma, ISUMA 1990: V1 = (1 + b pi^4 / 5)^2 / 2, V2 = a^2 / 8, and V13 = b^2 pi^8 (1/18 - 1/50).
    #[test]
    fn ishigamis_function_has_its_closed_indices() {
        let (first, total) = split(&indices::<3>(1 << 16, ishigami));
        let fourth = PI * PI * PI * PI;
        let root = 1.0 + 0.1 * fourth / 5.0;
        let (v1, v2, v13) =
            (root * root / 2.0, 49.0 / 8.0, 0.01 * fourth * fourth * (1.0 / 18.0 - 1.0 / 50.0));
        let v = v1 + v2 + v13;
        near(first, [v1 / v, v2 / v, 0.0], 1e-3);
        near(total, [(v1 + v13) / v, v2 / v, v13 / v], 1e-3);
    }

    /// Product of independent factors with means m and variances s: V = prod(m^2 + s) - prod(m^2). The first-order
    /// index is s_i prod(m_j^2) / V and the total one s_i prod(m_j^2 + s_j) / V, over j other than i.
    #[test]
    fn a_product_has_its_closed_indices() {
        let ranges = [[0.5, 1.5], [1.0, 4.0], [-1.0, 2.0]];
        let value = |i: usize, u: &[f64]| ranges[i][0] + u[i] * (ranges[i][1] - ranges[i][0]);
        let (first, total) = split(&indices::<3>(1 << 14, |u| value(0, u) * value(1, u) * value(2, u)));
        let square = ranges.map(|[low, high]| (low + high) * (low + high) / 4.0);
        let spread = ranges.map(|[low, high]| (high - low) * (high - low) / 12.0);
        let sum: [f64; 3] = std::array::from_fn(|i| square[i] + spread[i]);
        let v = sum.iter().product::<f64>() - square.iter().product::<f64>();
        let others = |of: [f64; 3], i: usize| of[(i + 1) % 3] * of[(i + 2) % 3];
        near(first, std::array::from_fn(|i| spread[i] * others(square, i) / v), 1e-3);
        near(total, std::array::from_fn(|i| spread[i] * others(sum, i) / v), 1e-3);
    }

    #[test]
    fn a_result_that_does_not_vary_has_no_indices() {
        let found = indices::<2>(64, |_| 0.1);
        assert!(
            found.len() == 2 && found.iter().all(|index| index.first.is_nan() && index.total_error.is_nan())
        );
        assert!(Accumulator::new(1).finish()[0].total.is_nan());
        assert!(Accumulator::new(0).finish().is_empty());
    }
}
