//! Standard normal distribution: cumulative probability and its inverse.

use std::f64::consts::FRAC_1_SQRT_2;

/// Numerator of R for |p - 1/2| <= 0.425, in powers of 0.180625 - (p - 1/2)^2, highest power first.
const CENTRE_TOP: [f64; 8] = [
    2509.0809287301227,
    33430.57558358813,
    67265.7709270087,
    45921.95393154987,
    13731.69376550946,
    1971.5909503065513,
    133.14166789178438,
    3.3871328727963665,
];
/// Denominator of R for |p - 1/2| <= 0.425, highest power first.
const CENTRE_BOTTOM: [f64; 8] = [
    5226.495278852854,
    28729.085735721943,
    39307.89580009271,
    21213.794301586597,
    5394.196021424751,
    687.1870074920579,
    42.31333070160091,
    1.0,
];
/// Numerator of R for r <= 5, in powers of r - 1.6, highest power first.
const NEAR_TOP: [f64; 8] = [
    0.0007745450142783414,
    0.022723844989269184,
    0.2417807251774506,
    1.2704582524523684,
    3.6478483247632045,
    5.769497221460691,
    4.630337846156546,
    1.4234371107496835,
];
/// Denominator of R for r <= 5, highest power first.
const NEAR_BOTTOM: [f64; 8] = [
    1.0507500716444169e-09,
    0.0005475938084995345,
    0.015198666563616457,
    0.14810397642748008,
    0.6897673349851,
    1.6763848301838038,
    2.053191626637759,
    1.0,
];
/// Numerator of R for r > 5, in powers of r - 5, highest power first.
const FAR_TOP: [f64; 8] = [
    2.0103343992922881e-07,
    2.7115555687434876e-05,
    0.0012426609473880784,
    0.026532189526576124,
    0.29656057182850487,
    1.7848265399172913,
    5.463784911164114,
    6.657904643501103,
];
/// Denominator of R for r > 5, highest power first.
const FAR_BOTTOM: [f64; 8] = [
    2.0442631033899397e-15,
    1.421511758316446e-07,
    1.8463183175100548e-05,
    0.0007868691311456133,
    0.014875361290850615,
    0.1369298809227358,
    0.599832206555888,
    1.0,
];

/// Returns the probability that a standard normal variable is at most `z`: erfc(-z / sqrt(2)) / 2.
///
/// The result is relatively accurate in the lower tail, down to z = -37. In the upper tail, `cumulative(-z)` is the probability above `z`.
pub(crate) fn cumulative(z: f64) -> f64 {
    0.5 * math::erfc(-z * FRAC_1_SQRT_2)
}

/// Returns the quantile of the standard normal distribution for the probability `p`, to about 16 digits. Returns -+
/// infinity for p = 0 and 1.
///
/// Source: Wichura, "Algorithm AS 241: The percentage points of the normal distribution", Applied Statistics 37 (1988), 477-484, routine
/// PPND16. With q = p - 1/2, z = q R(0.180625 - q^2) in the centre. In the tails z = -+ R(r - constant) with r = sqrt(-ln(min(p, 1 - p))).
/// R is a ratio of two polynomials of degree 7.
pub(crate) fn inverse(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        return q * ratio(&CENTRE_TOP, &CENTRE_BOTTOM, 0.180625 - q * q);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    if tail <= 0.0 {
        return f64::INFINITY.copysign(q);
    }
    let r = (-math::ln(tail)).sqrt();
    let z = if r <= 5.0 {
        ratio(&NEAR_TOP, &NEAR_BOTTOM, r - 1.6)
    } else {
        ratio(&FAR_TOP, &FAR_BOTTOM, r - 5.0)
    };
    z.copysign(q)
}

/// Returns the ratio of two polynomials at `x`, with coefficients from the highest power down.
fn ratio(top: &[f64; 8], bottom: &[f64; 8], x: f64) -> f64 {
    let value = |coefficients: &[f64; 8]| coefficients.iter().fold(0.0, |sum, c| sum * x + c);
    value(top) / value(bottom)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reference: mpmath 1.4.1 at 60 digits, by Newton's method on ln(erfc(-z / sqrt(2)) / 2) = ln(p). p is the nearest
    /// f64 to the given value; values above 1/2 follow by symmetry.
    #[test]
    fn the_inverse_has_sixteen_digits() {
        let table = [
            (0.3, -0.5244005127080408),
            (0.075, -1.439531470938456),
            (0.0750001, -1.4395307645017297),
            (0.025, -1.9599639845400543),
            (0.0001, -3.7190164854556804),
            (1e-10, -6.361340902404057),
            (1e-11, -6.706023155495136),
            (1.5e-11, -6.646570887477113),
            (1e-40, -13.31092137142517),
            (1e-300, -37.0470962993612),
            (0.6, 0.2533471031357997),
            (0.925, 1.4395314709384561),
            (0.975, 1.9599639845400538),
            (0.9999, 3.7190164854557084),
            (0.9999999998835847, 6.3379577545537895),
            (0.9999999999999999, 8.209536151601387),
            (1.1102230246251565e-16, -8.209536151601387),
            (1.1641532182693481e-10, -6.3379577545537895),
            (0.5000000000009095, 2.2797651350911116e-12),
        ];
        for (p, z) in table {
            let found = inverse(p);
            assert!((found - z).abs() <= 1e-15 * z.abs(), "{p:e}: {found:?} for {z:?}");
        }
        assert_eq!((inverse(0.5), inverse(0.0), inverse(1.0)), (0.0, f64::NEG_INFINITY, f64::INFINITY));
    }

    /// Reference: erfc(-z / sqrt(2)) / 2 with mpmath 1.4.1 at 60 digits. In the tail, a rounding error of z / sqrt(2)
    /// is multiplied by z^2.
    #[test]
    fn the_cumulative_probability_keeps_its_digits_in_the_lower_tail() {
        let table = [
            (-37.0, 5.725571222524577e-300),
            (-20.0, 2.7536241186062337e-89),
            (-8.0, 6.220960574271784e-16),
            (-1.0, 0.15865525393145705),
            (0.0, 0.5),
            (0.5, 0.6914624612740131),
            (3.0, 0.9986501019683699),
        ];
        for (z, p) in table {
            let found = cumulative(z);
            assert!((found - p).abs() <= 4e-16 * (1.0 + z * z) * p, "{z}: {found:?} for {p:?}");
        }
    }
}
