//! Power laws in three dimensions: closed forms for whole exponents, series that never cancel for the others.
//!
//! Of g = B|x|ⁿ pressed to the radius a, h = Baⁿ:
//!
//! * ∫ᵣᵃ g'/√(x²-r²) dx = (nh/a) jₙ(r/a), jₙ(ρ) = ∫_ρ¹ xⁿ⁻¹/√(x²-ρ²) dx (4.34), with
//!   (n-1) jₙ = √(1-ρ²) + (n-2)ρ² jₙ₋₂, j₁ = artanh √(1-ρ²), j₂ = √(1-ρ²);
//! * w = h ωₙ(a/r) beyond the contact, ωₙ(s) = (2/π) ∫₀ˢ (1-(x/s)ⁿ)/√(1-x²) dx (4.36).

use crate::profile::kappa;
use crate::quadrature::kronrod;
use std::f64::consts::FRAC_2_PI;

/// Largest whole exponent that is reached by the recurrence.
// A step takes 1 ns; beyond, the series is as fast.
const WHOLE: f64 = 64.0;
/// The middle of the range of ρ = r/a: quadrature over the outer part, a series over the inner one.
// At 1/2 fifteen nodes err by less than 1e-16, and terms of the series fall by a factor of four.
const MIDDLE: f64 = 0.5;
/// Exponent that one panel of the quadrature is good for, to 1e-14.
const STEEP: f64 = 10.0;
/// The recurrence for ωₙ loses 1/sⁿ in digits: the least sⁿ for it.
const LEAST: f64 = 1e-2;
/// Most panels.
const MOST: f64 = 100.0;
/// Terms of the series at [`MIDDLE`]: 4⁻²⁶ = 2e-16.
const TERMS: usize = 26;

/// One power law g = B|x|ⁿ, with what its integrals have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PowerField {
    /// n.
    exponent: f64,
    /// jₙ(1/2), of exponents that are not whole.
    inner: f64,
    /// The exponent, where it is whole and not too large.
    whole: Option<u32>,
    /// κₙ of f = g/κₙ (4.20).
    kappa: f64,
    /// Coefficients of (π/2) ωₙ(s)/s in s².
    far: [f64; TERMS],
}

impl PowerField {
    /// Of the exponent n > 0.
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

    /// f = g/κₙ, m.
    pub(super) fn gap(&self, depth: f64) -> f64 {
        depth / self.kappa
    }

    /// ∫ g'/√(x²-r²) dx from r to x > r ≥ 0, dimensionless; `h` = g(x), m. At r = 0 infinite for n ≤ 1.
    #[inline]
    pub(super) fn slope_integral(&self, h: f64, x: f64, r: f64) -> f64 {
        self.exponent * h / x * self.moment(r, x)
    }

    /// The same between two radii above r, of heights (`low`, `high`): where the lower one is not below r no singularity is
    /// between them.
    #[inline]
    pub(super) fn slope_between(&self, low: (f64, f64), high: (f64, f64), r: f64) -> f64 {
        if r > 0.0 || self.exponent > 1.0 {
            return self.slope_integral(high.0, high.1, r) - self.slope_integral(low.0, low.1, r);
        }
        // n ∫ Bxⁿ⁻² dx where each of the two is infinite.
        let (n, ratio) = (self.exponent, math::ln(high.1 / low.1));
        let e = n - 1.0;
        let steps = if e == 0.0 { ratio } else { -math::exp_m1(-e * ratio) / e };
        n * high.0 / high.1 * steps
    }

    /// jₙ(r/x).
    #[inline]
    fn moment(&self, r: f64, x: f64) -> f64 {
        let rho = r / x;
        // From the difference of the radii: 1 - ρ² would lose half of its digits at the edge.
        let root = ((x - r) * (x + r)).sqrt() / x;
        match self.whole {
            Some(2) => root,
            Some(whole) => whole_moment(whole, rho, root),
            None if rho >= MIDDLE => self.outer(rho),
            None => self.series(rho),
        }
    }

    /// jₙ(ρ) = ∫₀^Y (ρ²+y²)^{(n-2)/2} dy, Y = √(1-ρ²): smooth as long as Y is no more than √3 ρ.
    fn outer(&self, rho: f64) -> f64 {
        let (root, half) = (((1.0 - rho) * (1.0 + rho)).sqrt(), 0.5 * self.exponent - 1.0);
        self.panels([0.0, root], |y| math::powf(rho * rho + y * y, half))
    }

    /// ∫f over a range in as many panels as a steep power needs.
    fn panels(&self, [from, to]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
        let panels = (self.exponent / STEEP).ceil().clamp(1.0, MOST);
        let step = (to - from) / panels;
        let panel = |k: u32| kronrod([from + step * f64::from(k), from + step * f64::from(k + 1)], &f).0;
        (0..panels as u32).map(panel).sum()
    }

    /// jₙ(ρ) = ∫_{2ρ}¹ + ∫_ρ^{2ρ}: the second is (2ρ)ⁿ⁻¹ jₙ(1/2), the first Σ cₖ ρ²ᵏ (1-(2ρ)ᵉ)/e with e = n-1-2k,
    /// 1/√(1-t) = Σ cₖ tᵏ.
    fn series(&self, rho: f64) -> f64 {
        let n = self.exponent;
        if rho == 0.0 {
            return if n > 1.0 { 1.0 / (n - 1.0) } else { f64::INFINITY };
        }
        let (double, square) = (rho / MIDDLE, rho * rho);
        let (fade, log) = (math::powf(double, n - 1.0), math::ln(double));
        let mut sum = fade * self.inner;
        // cₖρ²ᵏ, and cₖρ²ᵏ(2ρ)ᵉ: the latter falls by 1/4 from term to term.
        let (mut term, mut lower) = (1.0, fade);
        for k in (0..TERMS).map(|k| k as f64) {
            let e = n - 1.0 - 2.0 * k;
            sum += match e.abs() {
                // Where e is next to nothing both ends are nearly the same.
                0.0 => -term * log,
                tiny if tiny < 0.1 => -term * math::exp_m1(e * log) / e,
                _ => (term - lower) / e,
            };
            let next = (k + 0.5) / (k + 1.0);
            (term, lower) = (term * next * square, lower * next * MIDDLE * MIDDLE);
        }
        sum
    }

    /// ωₙ(s), s = a/r ≤ 1.
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
        // ∫(1-(sin φ/s)ⁿ)dφ up to sin φ = s: from the middle on all is smooth, what is below is the series'.
        let (from, to) = (math::asin(MIDDLE), math::asin(s));
        let inside = MIDDLE / s;
        let share = |phi: f64| 1.0 - math::powf(math::sin(phi) / s, n);
        let outer = self.panels([from, to], share);
        // Below it 1-(x/s)ⁿ = q [1-(2x)ⁿ] + 1-q with q = (1/2s)ⁿ.
        let q = math::powf(inside, n);
        FRAC_2_PI * (q * self.outside(MIDDLE) / FRAC_2_PI + from * (1.0 - q) + outer)
    }
}

/// arcsin s - Kₙ/sⁿ with Kₙ = ∫₀^{arcsin s} sinⁿ, n Kₙ = (n-1) Kₙ₋₂ - sⁿ⁻¹√(1-s²), of a whole exponent.
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

/// jₙ of a whole exponent.
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
