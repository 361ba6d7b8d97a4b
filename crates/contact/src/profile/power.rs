//! Power laws g = B|x|ⁿ, with closed forms.

use super::error::positive;
use super::kappa::kappa;
use super::kind::{Kind, Peak};
use super::{Profile, ProfileError, Shape};

/// Power law g = |x|ⁿ/s with s = 1/B: a(h) = (sh)^{1/n}, m = 2a, M = mh n/(n+1), N = Mh n/(2n+1).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Power {
    /// Scale s, m^{n-1}; for a paraboloid the radius of curvature R.
    scale: f64,
    exponent: f64,
    root: Root,
    /// Factor 2n/(n+1).
    force_factor: f64,
    /// Factor n/(2n+1).
    energy_factor: f64,
}

/// Method of the n-th root.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Root {
    First,
    Second,
    Third,
    Fourth,
    Eighth,
    /// x^{1/n} = x^q (1 + δ ln x), where q is 1/n rounded to a double and δ the rounding error.
    // Without δ the relative error would grow with |ln x|.
    Any {
        q: f64,
        delta: f64,
    },
}

impl Profile {
    /// Creates a cone f = r tanθ from its slope tanθ: g = (π/2) tanθ |x|.
    pub fn cone(slope: f64) -> Result<Self, ProfileError> {
        let slope = positive(slope, ProfileError::Slope)?;
        Ok(Self { shape: Shape::Power(Power::new(std::f64::consts::FRAC_PI_2 * slope, 1.0)?) })
    }

    /// Creates a paraboloid f = r²/2R of radius of curvature R (m), the Hertz contact: g = x²/R, M = (4/3)√R h^{3/2}.
    pub fn paraboloid(radius: f64) -> Result<Self, ProfileError> {
        let radius = positive(radius, ProfileError::Radius)?;
        Ok(Self { shape: Shape::Power(Power::paraboloid(radius)?) })
    }

    /// Creates a power law f = A rⁿ, A in m^{1-n}, n > 0: g = `κ_n` A |x|ⁿ, `κ_n` = √π Γ(n/2+1)/Γ((n+1)/2).
    pub fn power(coefficient: f64, exponent: f64) -> Result<Self, ProfileError> {
        positive(coefficient, ProfileError::Coefficient)?;
        positive(exponent, ProfileError::Exponent)?;
        let foundation = kappa(exponent) * coefficient;
        Ok(Self { shape: Shape::Power(Power::new(foundation, exponent)?) })
    }

    /// Creates a power law from its one-dimensional profile g = B |x|ⁿ, B in m^{1-n}, n > 0.
    pub fn foundation_power(coefficient: f64, exponent: f64) -> Result<Self, ProfileError> {
        Ok(Self { shape: Shape::Power(Power::new(coefficient, exponent)?) })
    }
}

impl Power {
    /// Creates g = B|x|ⁿ.
    fn new(coefficient: f64, exponent: f64) -> Result<Self, ProfileError> {
        positive(coefficient, ProfileError::Coefficient)?;
        positive(exponent, ProfileError::Exponent)?;
        let scale = 1.0 / coefficient;
        if !scale.is_finite() {
            return Err(ProfileError::Coefficient(coefficient));
        }
        Ok(Self::of_scale(scale, exponent))
    }

    /// Creates g = x²/R without the rounding of 1/R.
    fn paraboloid(radius: f64) -> Result<Self, ProfileError> {
        Ok(Self::of_scale(positive(radius, ProfileError::Radius)?, 2.0))
    }

    /// Creates g = |x|ⁿ/s.
    pub(super) fn of_scale(scale: f64, n: f64) -> Self {
        let root = match n {
            1.0 => Root::First,
            2.0 => Root::Second,
            3.0 => Root::Third,
            4.0 => Root::Fourth,
            8.0 => Root::Eighth,
            _ => {
                let q = 1.0 / n;
                Root::Any { q, delta: math::mul_add(-q, n, 1.0) / n }
            }
        };
        Self {
            scale,
            exponent: n,
            root,
            force_factor: 2.0 * n / (n + 1.0),
            energy_factor: n / (2.0 * n + 1.0),
        }
    }

    /// Returns a(h), h > 0.
    #[inline]
    fn radius(&self, h: f64) -> f64 {
        let x = self.scale * h;
        match self.root {
            Root::Second => x.sqrt(),
            Root::First => x,
            Root::Fourth => x.sqrt().sqrt(),
            _ => self.other_root(x),
        }
    }

    /// Returns M(h) and N(h), h > 0.
    #[inline]
    pub(super) fn reduced_sums(&self, h: f64) -> [f64; 2] {
        let reduced_force = self.reduced_force(h);
        [reduced_force, self.energy_factor * h * reduced_force]
    }

    /// Returns M(h) and m(h), h > 0.
    #[inline]
    pub(super) fn force_and_stiffness(&self, h: f64) -> [f64; 2] {
        let radius = self.radius(h);
        [self.force_factor * h * radius, 2.0 * radius]
    }

    /// Returns the roots that need a function call. A separate function keeps the code of the other roots short.
    #[inline(never)]
    fn other_root(&self, x: f64) -> f64 {
        match self.root {
            Root::First => x,
            Root::Second => x.sqrt(),
            Root::Third => math::cbrt(x),
            Root::Fourth => x.sqrt().sqrt(),
            Root::Eighth => x.sqrt().sqrt().sqrt(),
            // The logarithm of 0 is not defined.
            Root::Any { .. } if x == 0.0 => 0.0,
            Root::Any { q, delta } => math::powf(x, q) * (1.0 + delta * math::ln(x)),
        }
    }
}

impl Kind for Power {
    #[inline]
    fn reduced_stiffness(&self, h: f64) -> f64 {
        2.0 * self.radius(h)
    }

    /// Returns M(h) = 2n/(n+1) h a, m².
    #[inline]
    fn reduced_force(&self, h: f64) -> f64 {
        self.force_factor * h * self.radius(h)
    }

    /// Returns N(h) = n/(2n+1) h M, m³.
    #[inline]
    fn reduced_energy(&self, h: f64) -> f64 {
        let [_, reduced_energy] = self.reduced_sums(h);
        reduced_energy
    }

    /// Returns g(a) = aⁿ/s, m.
    #[inline]
    fn depth(&self, a: f64) -> f64 {
        let power = match self.root {
            Root::First => a,
            Root::Second => a * a,
            Root::Third => a * a * a,
            Root::Fourth => (a * a) * (a * a),
            Root::Eighth => {
                let fourth = (a * a) * (a * a);
                fourth * fourth
            }
            Root::Any { .. } => math::powf(a, self.exponent),
        };
        power / self.scale
    }

    /// Solves h^{n+1} = (M/k)ⁿ/s with k = 2n/(n+1).
    fn height_of_reduced_force(&self, reduced_force: f64) -> f64 {
        let y = reduced_force / self.force_factor;
        match self.root {
            Root::First => (y / self.scale).sqrt(),
            Root::Second => math::cbrt(y / self.scale * y),
            _ => {
                let n = self.exponent;
                let h = math::powf(y, n / (n + 1.0)) / math::powf(self.scale, 1.0 / (n + 1.0));
                // One Newton step corrects the error due to rounded exponents.
                let slope = self.reduced_stiffness(h);
                if slope > 0.0 && slope.is_finite() {
                    h - (self.reduced_force(h) - reduced_force) / slope
                } else {
                    h
                }
            }
        }
    }

    fn depth_slope(&self, a: f64) -> f64 {
        self.exponent * self.depth(a) / a
    }

    fn gap(&self, r: f64) -> Option<f64> {
        Some(self.depth(r) / kappa(self.exponent))
    }

    /// Returns the location of the largest pressure: the tip for n ≤ 1, the centre for 1 < n ≤ 2, and otherwise in between.
    fn peak(&self) -> Option<Peak> {
        Some(match self.exponent {
            n if n <= 1.0 => Peak::Unbounded,
            n if n <= 2.0 => Peak::Middle(n),
            _ => Peak::Between,
        })
    }

    fn is_strictly_convex(&self) -> bool {
        true
    }

    fn first_power(&self) -> f64 {
        1.0 + self.exponent.recip()
    }

    fn exponent(&self) -> Option<f64> {
        Some(self.exponent)
    }
}
