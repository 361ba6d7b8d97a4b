//! Cube root of an `f64`.

/// Constant of the first guess x^(1/3), which is computed from the bits of x; the relative error of the guess is at most 3.2 %.
const THIRD: u64 = 0x2a9f_7000_0000_0000;
/// Coefficients of a cubic polynomial for x^(-1/3), found by the Remez algorithm. The error is at most 1.5e-6 for x from 0.904 to
/// 1.094.
const CORRECTION: [f64; 4] =
    [1.731_604_385_595_784, -1.304_638_287_634_387_6, 0.747_786_776_536_794_2, -0.174_754_338_719_011_37];
/// Rounding increment and bit mask that keep 26 digits of the mantissa, so that the square of the result is exact.
const PLACES: [u64; 2] = [1 << 26, !((1 << 27) - 1)];

/// Returns the cube root ∛x with a relative error of at most ε (`f64::EPSILON`).
///
/// The first guess divides exponent and mantissa by three. A cubic polynomial corrects the guess. One step of Halley's method
/// follows, with a truncation error of 1e-18. The bits of the result are the same on every machine.
#[inline]
pub fn cbrt(x: f64) -> f64 {
    if !(f64::MIN_POSITIVE..f64::INFINITY).contains(&x) {
        return libm::cbrt(x);
    }
    let guess = f64::from_bits(x.to_bits() / 3 + THIRD);
    let r = guess * guess * (guess / x);
    let [a, b, c, d] = CORRECTION;
    let near = guess * (a + r * (b + r * (c + r * d)));
    let t = f64::from_bits((near.to_bits() + PLACES[0]) & PLACES[1]);
    let q = x / (t * t);
    t + t * ((q - t) / (t + t + q))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubes_have_their_roots() {
        // The roots of the standard library are rounded correctly.
        let mut x = 1e-300_f64;
        while x < 1e300 {
            let (root, right) = (cbrt(x), x.cbrt());
            assert!((root - right).abs() <= f64::EPSILON * right, "{x}: {root} {right}");
            x *= 1.001_234_567;
        }
        for whole in 1..1000_u32 {
            let whole = f64::from(whole);
            assert!((cbrt(whole * whole * whole) - whole).abs() == 0.0, "{whole}");
        }
    }

    #[test]
    fn what_is_no_ordinary_number_goes_to_the_library() {
        for x in [0.0, -8.0, 1e-310, f64::INFINITY, f64::MIN_POSITIVE] {
            assert!((cbrt(x) - x.cbrt()).abs() <= f64::EPSILON * x.abs() || cbrt(x) == x, "{x}");
        }
        assert!(cbrt(f64::NAN).is_nan());
    }
}
