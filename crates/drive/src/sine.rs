//! Sine of an angle in the first quadrant, as an inlined and constant function.

/// Coefficients (-1)ᵏ/(2k+1)! of the sine series.
const TERMS: [f64; 10] = {
    let (mut terms, mut term, mut k) = ([0.0; 10], 1.0, 0);
    while k < 10 {
        terms[k] = term;
        term /= -(((2 * k + 2) * (2 * k + 3)) as f64);
        k += 1;
    }
    terms
};

/// Returns the sine of an angle from 0 to π/2 by its series, with an error below 3e-16.
#[inline(always)]
pub(crate) const fn sine(x: f64) -> f64 {
    let square = x * x;
    let fourth = square * square;
    // Even and odd terms are summed separately, for parallel execution.
    let even = TERMS[2] + fourth * (TERMS[4] + fourth * (TERMS[6] + fourth * TERMS[8]));
    let odd = TERMS[3] + fourth * (TERMS[5] + fourth * (TERMS[7] + fourth * TERMS[9]));
    x * (1.0 + square * (TERMS[1] + square * (even + square * odd)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn the_series_is_the_sine() {
        let worst = (0..=1000).map(|i| 0.5 * PI * f64::from(i) / 1000.0).map(|x| (sine(x) - x.sin()).abs());
        assert!(worst.fold(0.0, f64::max) < 4e-16);
    }
}
