//! Exact sphere. With η = h/R, s = a/R and t = artanh s, η = s t, and
//!
//! * m = 2Rs, M = R²[(s²+1)t - s],
//! * N = R³[(4/3)η²s - (2η-2/3)I - (2/3)K], I = ∫₀ˢ x artanh x dx = [(s²-1)t + s]/2, K = ∫₀ᵗ τ tanh τ dτ = t²/2 + t ln(1+q) -
//!   [π²/12 + Li₂(-q)]/2, q = e^{-2t}.
//!
//! M is (4.26) for the sphere. N follows from N = ∫₀ᵃ(h-g)²dx by integration by parts. Both formulas have cancellation at small s.
//! For small η a power series of the inverse of η = s artanh s is used, whose integrals have no cancellation.
//!
//! For s → 0 the results approach the paraboloid: m = 2√(Rh), M = (4/3)√R h^{3/2}.

use super::error::positive;
use super::kind::{Kind, Peak};
use super::{Profile, ProfileError, Shape};

/// Sphere of radius R, m.
// At a/R = 0.1 the paraboloid of equal curvature is 0.17 % too stiff at equal indentation.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sphere {
    radius: f64,
}

/// Number of terms of the series.
const TERMS: usize = 20;

/// Largest η of the series, which is a/R = 0.648. The truncation error is 3e-18.
// Up to η = 0.6 series and closed forms agree to 2e-16. For small η the closed forms lose accuracy.
const SERIES_END: f64 = 0.5;

/// Coefficients of s = √η Σ cₖηᵏ, the inverse of η = s artanh s = Σ s^{2k+2}/(2k+1); c₁ = -1/6, c₂ = -1/360, c₃ = 11/5040.
const RATIO: [f64; TERMS] = [
    1.0,
    -0.16666666666666666,
    -0.002777777777777778,
    0.0021825396825396826,
    0.000747905643738977,
    0.00010826686173908396,
    -1.793717960219283e-05,
    -1.5742192019473766e-05,
    -4.385505449405401e-06,
    -1.9676657477001152e-07,
    3.6635311401833907e-07,
    1.7022218544241752e-07,
    3.0707188929590216e-08,
    -6.054259808882989e-09,
    -6.0369138315322924e-09,
    -1.872887220681542e-09,
    -9.677417529600484e-11,
    1.8029324267645432e-10,
    8.984198616787132e-11,
    1.7332516127075533e-11,
];

/// Coefficients of M/R² = η^{3/2} Σ 2cₖ/(k+3/2) ηᵏ.
const AREA: [f64; TERMS] = integrated(RATIO, 2.0, 1.5);

/// Coefficients of N/R³ = η^{5/2} Σ 2cₖ/((k+3/2)(k+5/2)) ηᵏ.
static VOLUME: [f64; TERMS] = integrated(AREA, 1.0, 2.5);

/// Returns the coefficients of factor·Σ cₖ/(k+power) ηᵏ.
const fn integrated(series: [f64; TERMS], factor: f64, power: f64) -> [f64; TERMS] {
    let mut result = series;
    let mut k = 0;
    while k < TERMS {
        result[k] = factor * series[k] / (k as f64 + power);
        k += 1;
    }
    result
}

/// Returns Σ cₖxᵏ by four interleaved Horner chains.
// Interleaved chains are faster, because the terms of one chain depend on each other.
#[inline]
fn sum(c: &[f64; TERMS], x: f64) -> f64 {
    let (x2, mut chains) = (x * x, [c[16], c[17], c[18], c[19]]);
    let x4 = x2 * x2;
    for k in [12, 8, 4, 0] {
        for (lane, chain) in chains.iter_mut().enumerate() {
            *chain = *chain * x4 + c[k + lane];
        }
    }
    (chains[0] + chains[1] * x) + (chains[2] + chains[3] * x) * x2
}

/// Returns t of t tanh t = η, for η ≥ [`SERIES_END`].
///
/// Newton's method is limited to the bracket η < t < η + 0.2785, the largest value of 2t/(e^{2t}+1). The start value is accurate to
/// 2e-3, so that three steps are sufficient.
fn invert(eta: f64) -> f64 {
    // The limit ensures an end for every argument, including NaN.
    const STEPS: usize = 8;
    let fit = 5.0747 + eta * (-7.59144 + eta * (12.87772 + eta * (-7.41881 + eta * 2.08249)));
    let (low, high) = (eta, eta + 0.2785);
    let mut t = eta + 1.0 / fit;
    for _ in 0..STEPS {
        let e = math::exp(-2.0 * t);
        let tanh = (1.0 - e) / (1.0 + e);
        let slope = tanh + 4.0 * t * e / ((1.0 + e) * (1.0 + e));
        let step = (t * tanh - eta) / slope;
        t = (t - step).clamp(low, high);
        // With quadratic convergence the next step would be below 1e-17.
        if step.abs() <= 1e-8 {
            break;
        }
    }
    t
}

/// Returns Li₂(-q) for 0 ≤ q < 0.22, by u = -ln(1+q): Σ Bₙ uⁿ⁺¹/(n+1)! (DLMF 25.12), with a truncation error below 1e-17.
fn dilogarithm(log1q: f64) -> f64 {
    let (u, w) = (-log1q, log1q * log1q);
    let tail = 1.0 / 36.0 + w * (-1.0 / 3600.0 + w * (1.0 / 211_680.0 + w * (-1.0 / 10_886_400.0)));
    u - 0.25 * w + u * w * tail
}

impl Profile {
    /// Creates an exact sphere of radius R (m): f = R-√(R²-r²), g = (x/2) ln((R+x)/(R-x)).
    ///
    /// Compared with the paraboloid at equal indentation, the contact radius is smaller by (a/R)²/6, 1.7e-5 at a/R = 0.01.
    pub fn sphere(radius: f64) -> Result<Self, ProfileError> {
        Ok(Self { shape: Shape::Sphere(Sphere { radius: positive(radius, ProfileError::Radius)? }) })
    }
}

/// Returns the terms of N/R³ = η^{5/2} Σ aₖηᵏ that exceed `last` times the first term; `None` for η beyond the range of the series.
pub(super) fn energy_terms(eta: f64, last: f64) -> Option<&'static [f64]> {
    let counts = |k: &usize| (VOLUME[*k] * eta.powi(*k as i32)).abs() > last * VOLUME[0];
    let count = 1 + (1..TERMS).rev().find(counts).unwrap_or(0);
    (eta <= SERIES_END).then(|| &VOLUME[..count])
}

impl Sphere {
    /// Returns the radius R, m.
    pub(super) fn radius(&self) -> f64 {
        self.radius
    }

    /// Largest a/R of the profile.
    const LARGEST_RATIO: f64 = 0.999;
}

impl Kind for Sphere {
    /// Returns the gap R-√(R²-r²), m; `None` beyond the sphere.
    fn gap(&self, r: f64) -> Option<f64> {
        // The form r²/(R+√(R²-r²)) avoids cancellation.
        let rest = (self.radius - r) * (self.radius + r);
        (rest >= 0.0).then(|| r * r / (self.radius + rest.sqrt()))
    }

    /// Returns the largest indentation of the profile, m.
    fn reach(&self) -> Option<f64> {
        Some(self.depth(Self::LARGEST_RATIO * self.radius))
    }

    /// Returns g(a) = a artanh(a/R), m; infinite from the equator on.
    fn depth(&self, a: f64) -> f64 {
        let s = a / self.radius;
        if s < 1.0 { a * math::atanh(s) } else { f64::INFINITY }
    }

    /// Returns g'(a) = artanh s + s/(1-s²), s = a/R.
    fn depth_slope(&self, a: f64) -> f64 {
        let s = a / self.radius;
        if s < 1.0 { math::atanh(s) + s / (1.0 - s * s) } else { f64::INFINITY }
    }

    /// Returns m(h) = 2Rs, m.
    #[inline]
    fn reduced_stiffness(&self, h: f64) -> f64 {
        2.0 * self.radius * ratio(h / self.radius)
    }

    /// Returns M(h), m².
    #[inline]
    fn reduced_force(&self, h: f64) -> f64 {
        self.radius * self.radius * reduced_force(h / self.radius)
    }

    /// Returns N(h), m³.
    fn reduced_energy(&self, h: f64) -> f64 {
        let eta = h / self.radius;
        let reduced_energy = if eta <= SERIES_END {
            eta * eta * eta.sqrt() * sum(&VOLUME, eta)
        } else {
            let t = invert(eta);
            reduced_energy_beyond(eta, t)
        };
        self.radius * self.radius * self.radius * reduced_energy
    }

    /// Newton's method on M, which is convex in h: the iterates decrease monotonically after the first step.
    fn height_of_reduced_force(&self, force: f64) -> f64 {
        // At most four steps are needed between 1e-6 and 3.8 radii; other arguments may need more.
        const STEPS: usize = 60;
        let wanted = force / (self.radius * self.radius);
        let hertz = math::cbrt(0.5625 * wanted * wanted);
        let mut eta = if wanted < 1.0 { hertz * (1.0 + hertz / 15.0) } else { 0.5 * (wanted + 1.0) };
        for _ in 0..STEPS {
            let step = (reduced_force(eta) - wanted) / (2.0 * ratio(eta));
            if !step.is_finite() {
                break;
            }
            eta = (eta - step).max(0.5 * eta);
            if step.abs() <= 1e-9 * eta {
                break;
            }
        }
        eta * self.radius
    }

    fn peak(&self) -> Option<Peak> {
        Some(Peak::Between)
    }

    fn first_power(&self) -> f64 {
        1.5
    }

    fn is_strictly_convex(&self) -> bool {
        true
    }
}

/// Returns s = a/R at η.
#[inline]
fn ratio(eta: f64) -> f64 {
    if eta <= SERIES_END { eta.sqrt() * sum(&RATIO, eta) } else { (eta / invert(eta)).min(1.0) }
}

/// Returns M/R² at η.
#[inline]
fn reduced_force(eta: f64) -> f64 {
    if eta <= SERIES_END {
        return eta * eta.sqrt() * sum(&AREA, eta);
    }
    let t = invert(eta);
    let s = eta / t;
    (s * s + 1.0) * t - s
}

/// Returns N/R³ at η beyond the series.
fn reduced_energy_beyond(eta: f64, t: f64) -> f64 {
    const TWELFTH_PI2: f64 = std::f64::consts::PI * std::f64::consts::PI / 12.0;
    let s = eta / t;
    let log1q = math::ln_1p(math::exp(-2.0 * t));
    let first = 0.5 * ((s * s - 1.0) * t + s);
    let second = 0.5 * t * t + t * log1q - 0.5 * (TWELFTH_PI2 + dilogarithm(log1q));
    eta * eta * s * (4.0 / 3.0) - (2.0 * eta - 2.0 / 3.0) * first - second * (2.0 / 3.0)
}
