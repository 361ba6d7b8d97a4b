//! Fields of power-law profiles: closed forms for integer exponents, series without cancellation for others.
//!
//! For g = B|x|ⁿ pressed to the radius a, h = Baⁿ:
//!
//! * ∫ᵣᵃ g'/√(x²-r²) dx = (nh/a) jₙ(r/a), jₙ(ρ) = ∫_ρ¹ xⁿ⁻¹/√(x²-ρ²) dx (4.34), with (n-1) jₙ = √(1-ρ²) + (n-2)ρ² jₙ₋₂, j₁ = artanh
//!   √(1-ρ²), j₂ = √(1-ρ²);
//! * w = h ωₙ(a/r) outside the contact, ωₙ(s) = (2/π) ∫₀ˢ (1-(x/s)ⁿ)/√(1-x²) dx (4.36).

use crate::profile::kappa;
use crate::quadrature::kronrod;
use std::f64::consts::FRAC_2_PI;

/// Largest integer exponent for which the recurrence is used.
const WHOLE: f64 = 64.0;
/// Limit of ρ = r/a between quadrature (above) and series (below).
// At 1/2 the 15-point rule has an error below 1e-16, and the terms of the series decrease by a factor of four.
const MIDDLE: f64 = 0.5;
/// Largest exponent for which one quadrature panel is accurate to 1e-14.
const STEEP: f64 = 10.0;
/// Smallest sⁿ for the recurrence of ωₙ, which loses accuracy as 1/sⁿ.
const LEAST: f64 = 1e-2;
/// Largest number of panels.
const MOST: f64 = 100.0;
/// Number of terms of the series at [`MIDDLE`]: 4⁻²⁶ = 2e-16.
const TERMS: usize = 26;

/// Power law g = B|x|ⁿ with precomputed constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PowerField {
    /// Exponent n.
    exponent: f64,
    /// Value jₙ(1/2) for non-integer exponents.
    inner: f64,
    /// Exponent, if it is an integer of at most [`WHOLE`].
    whole: Option<u32>,
    /// Factor κₙ of f = g/κₙ (4.20).
    kappa: f64,
    /// Coefficients of (π/2) ωₙ(s)/s in s².
    far: [f64; TERMS],
}

impl PowerField {
    /// Creates the field of an exponent n > 0.
    pub(super) fn new(exponent: f64) -> Self {
        let whole = (exponent.fract() == 0.0 && exponent <= WHOLE).then_some(exponent as u32);
        let (mut far, mut term) = ([0.0; TERMS], 1.0);
        for (k, coefficient) in far.iter_mut().enumerate() {
            let odd = 2.0 * k as f64 + 1.0;
            *coefficient = term * exponent / (odd * (exponent + odd));
            term *= odd / (odd + 1.0);
        }
        let mut field = Self { exponent, inner: 0.0, whole, kappa: kappa(exponent), far };
        if whole.is_none() {
            field.inner = field.outer(MIDDLE);
        }
        field
    }

    /// Returns the gap f = g/κₙ, m.
    pub(super) fn gap(&self, depth: f64) -> f64 {
        depth / self.kappa
    }

    /// Returns ∫ g'/√(x²-r²) dx from r to x > r ≥ 0, dimensionless, with `h` = g(x), m. At r = 0 it is infinite for n ≤ 1.
    #[inline]
    pub(super) fn slope_integral(&self, h: f64, x: f64, r: f64) -> f64 {
        self.exponent * h / x * self.moment(r, x)
    }

    /// Returns ∫ g'/√(x²-r²) dx between two radii above r, given as pairs (h, x). The integral is finite for every r.
    #[inline]
    pub(super) fn slope_between(&self, low: (f64, f64), high: (f64, f64), r: f64) -> f64 {
        if r > 0.0 || self.exponent > 1.0 {
            return self.slope_integral(high.0, high.1, r) - self.slope_integral(low.0, low.1, r);
        }
        // n ∫ Bxⁿ⁻² dx, for r = 0 and n ≤ 1.
        let (n, ratio) = (self.exponent, math::ln(high.1 / low.1));
        let e = n - 1.0;
        let steps = if e == 0.0 { ratio } else { -math::exp_m1(-e * ratio) / e };
        n * high.0 / high.1 * steps
    }

    /// Returns jₙ(r/x).
    #[inline]
    fn moment(&self, r: f64, x: f64) -> f64 {
        let rho = r / x;
        // The product of sum and difference avoids cancellation at the edge.
        let root = ((x - r) * (x + r)).sqrt() / x;
        match self.whole {
            Some(2) => root,
            Some(whole) => whole_moment(whole, rho, root),
            None if rho >= MIDDLE => self.outer(rho),
            None => self.series(rho),
        }
    }

    /// Returns jₙ(ρ) = ∫₀^Y (ρ²+y²)^{(n-2)/2} dy with Y = √(1-ρ²), by quadrature. The integrand is smooth for Y ≤ √3 ρ.
    fn outer(&self, rho: f64) -> f64 {
        let (root, half) = (((1.0 - rho) * (1.0 + rho)).sqrt(), 0.5 * self.exponent - 1.0);
        self.panels([0.0, root], |y| math::powf(rho * rho + y * y, half))
    }

    /// Integrates f over a range in a number of panels that depends on the exponent.
    fn panels(&self, [from, to]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
        let panels = (self.exponent / STEEP).ceil().clamp(1.0, MOST);
        let step = (to - from) / panels;
        let panel = |k: u32| kronrod([from + step * f64::from(k), from + step * f64::from(k + 1)], &f).0;
        (0..panels as u32).map(panel).sum()
    }

    /// Returns jₙ(ρ) = ∫_{2ρ}¹ + ∫_ρ^{2ρ} by a series.
    ///
    /// The second integral is (2ρ)ⁿ⁻¹ jₙ(1/2). The first is Σ cₖ ρ²ᵏ (1-(2ρ)ᵉ)/e with e = n-1-2k and 1/√(1-t) = Σ cₖ tᵏ.
    fn series(&self, rho: f64) -> f64 {
        let n = self.exponent;
        if rho == 0.0 {
            return if n > 1.0 { 1.0 / (n - 1.0) } else { f64::INFINITY };
        }
        let (double, square) = (rho / MIDDLE, rho * rho);
        let (fade, log) = (math::powf(double, n - 1.0), math::ln(double));
        let mut sum = fade * self.inner;
        // Terms cₖρ²ᵏ, and cₖρ²ᵏ(2ρ)ᵉ, which decrease by a factor of 4.
        let (mut term, mut lower) = (1.0, fade);
        for k in (0..TERMS).map(|k| k as f64) {
            let e = n - 1.0 - 2.0 * k;
            sum += match e.abs() {
                // For small e both ends are nearly equal.
                0.0 => -term * log,
                tiny if tiny < 0.1 => -term * math::exp_m1(e * log) / e,
                _ => (term - lower) / e,
            };
            let next = (k + 0.5) / (k + 1.0);
            (term, lower) = (term * next * square, lower * next * MIDDLE * MIDDLE);
        }
        sum
    }

    /// Returns ωₙ(s), s = a/r ≤ 1.
    pub(super) fn outside(&self, s: f64) -> f64 {
        let n = self.exponent;
        if s <= MIDDLE {
            // Σ cₖ s²ᵏ⁺¹ [1/(2k+1) - 1/(n+1+2k)], all terms positive.
            return FRAC_2_PI * s * self.far.iter().rev().fold(0.0, |sum, c| sum * (s * s) + c);
        }
        if let Some(whole) = self.whole
            && s.powi(whole as i32) > LEAST
        {
            return FRAC_2_PI * whole_outside(whole, s);
        }
        // ∫(1-(sin φ/s)ⁿ)dφ up to sin φ = s: quadrature above [`MIDDLE`], series below.
        let (from, to) = (math::asin(MIDDLE), math::asin(s));
        let inside = MIDDLE / s;
        let share = |phi: f64| 1.0 - math::powf(math::sin(phi) / s, n);
        let outer = self.panels([from, to], share);
        // Below [`MIDDLE`], 1-(x/s)ⁿ = q [1-(2x)ⁿ] + 1-q with q = (1/2s)ⁿ.
        let q = math::powf(inside, n);
        FRAC_2_PI * (q * self.outside(MIDDLE) / FRAC_2_PI + from * (1.0 - q) + outer)
    }
}

/// Returns (π/2) ωₙ(s) for an integer n: arcsin s - Kₙ/sⁿ with Kₙ = ∫₀^{arcsin s} sinⁿ, n Kₙ = (n-1) Kₙ₋₂ - sⁿ⁻¹√(1-s²).
fn whole_outside(n: u32, s: f64) -> f64 {
    let (angle, cosine) = (math::asin(s), ((1.0 - s) * (1.0 + s)).sqrt());
    // Kₘ/sᵐ.
    let (mut share, from) = if n % 2 == 1 { ((1.0 - cosine) / s, 3) } else { (angle, 2) };
    for m in (from..=n).step_by(2) {
        let m = f64::from(m);
        share = ((m - 1.0) * share / (s * s) - cosine / s) / m;
    }
    angle - share
}

/// Returns jₙ(ρ) for an integer n, with `root` = √(1-ρ²).
fn whole_moment(n: u32, rho: f64, root: f64) -> f64 {
    let square = rho * rho;
    let (mut moment, from) = if n % 2 == 1 { (math::ln((1.0 + root) / rho), 3) } else { (root, 4) };
    if n % 2 == 1 && rho == 0.0 {
        return if n == 1 { f64::INFINITY } else { 1.0 / f64::from(n - 1) };
    }
    for m in (from..=n).step_by(2) {
        let m = f64::from(m);
        moment = (root + (m - 2.0) * square * moment) / (m - 1.0);
    }
    moment
}
