//! Power laws g = B|x|ⁿ: closed forms throughout.

use super::error::positive;
use super::kappa::kappa;
use super::kind::{Kind, Peak};
use super::{Profile, ProfileError, Shape};

/// g = |x|ⁿ/s, s = 1/B: a(h) = (sh)^{1/n}, m = 2a, M = mh n/(n+1), N = Mh n/(2n+1).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Power {
    /// s, m^{n-1}; the radius of curvature R of a paraboloid.
    scale: f64,
    exponent: f64,
    root: Root,
    /// 2n/(n+1).
    force_factor: f64,
    /// n/(2n+1).
    energy_factor: f64,
}

/// How the n-th root is taken: by the cheapest exact operation there is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Root {
    First,
    Second,
    Third,
    Fourth,
    Eighth,
    /// x^{1/n} = x^q (1 + δ ln x), where q is the double nearest to 1/n and δ what it lacks.
    // Without δ the error grows with |ln x|: up to 7ε for x = 1e-12 and n = 2.5, with it up to ε.
    Any {
        q: f64,
        delta: f64,
    },
}

impl Profile {
    /// A cone f = r tanθ, given its slope tanθ: g = (π/2) tanθ |x|.
    pub fn cone(slope: f64) -> Result<Self, ProfileError> {
        let slope = positive(slope, ProfileError::Slope)?;
        Ok(Self { shape: Shape::Power(Power::new(std::f64::consts::FRAC_PI_2 * slope, 1.0)?) })
    }

    /// A paraboloid f = r²/2R of radius of curvature R (m), the Hertz contact: g = x²/R, M = (4/3)√R h^{3/2}.
    pub fn paraboloid(radius: f64) -> Result<Self, ProfileError> {
        let radius = positive(radius, ProfileError::Radius)?;
        Ok(Self { shape: Shape::Power(Power::paraboloid(radius)?) })
    }

    /// A power law f = A rⁿ, A in m^{1-n}, n > 0: g = `κ_n` A |x|ⁿ, `κ_n` = √π Γ(n/2+1)/Γ((n+1)/2).
    pub fn power(coefficient: f64, exponent: f64) -> Result<Self, ProfileError> {
        positive(coefficient, ProfileError::Coefficient)?;
        positive(exponent, ProfileError::Exponent)?;
        let foundation = kappa(exponent) * coefficient;
        Ok(Self { shape: Shape::Power(Power::new(foundation, exponent)?) })
    }

    /// A power law given by its foundation, g = B |x|ⁿ, B in m^{1-n}, n > 0.
    pub fn foundation_power(coefficient: f64, exponent: f64) -> Result<Self, ProfileError> {
        Ok(Self { shape: Shape::Power(Power::new(coefficient, exponent)?) })
    }
}

impl Power {
    /// g = B|x|ⁿ.
    fn new(coefficient: f64, exponent: f64) -> Result<Self, ProfileError> {
        positive(coefficient, ProfileError::Coefficient)?;
        positive(exponent, ProfileError::Exponent)?;
        let scale = 1.0 / coefficient;
        if !scale.is_finite() {
            return Err(ProfileError::Coefficient(coefficient));
        }
        Ok(Self::of_scale(scale, exponent))
    }

    /// g = x²/R, R taken as it is and not by way of 1/R.
    fn paraboloid(radius: f64) -> Result<Self, ProfileError> {
        Ok(Self::of_scale(positive(radius, ProfileError::Radius)?, 2.0))
    }

    /// g = |x|ⁿ/s.
    fn of_scale(scale: f64, n: f64) -> Self {
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

    /// a(h), h > 0.
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

    /// M(h) and N(h), h > 0.
    #[inline]
    pub(super) fn reduced_sums(&self, h: f64) -> [f64; 2] {
        let reduced_force = self.reduced_force(h);
        [reduced_force, self.energy_factor * h * reduced_force]
    }

    /// M(h) and m(h), h > 0.
    #[inline]
    pub(super) fn force_and_stiffness(&self, h: f64) -> [f64; 2] {
        let radius = self.radius(h);
        [self.force_factor * h * radius, 2.0 * radius]
    }

    /// The roots that cost a call, kept out of the way of those that do not.
    #[inline(never)]
    fn other_root(&self, x: f64) -> f64 {
        match self.root {
            Root::First => x,
            Root::Second => x.sqrt(),
            Root::Third => math::cbrt(x),
            Root::Fourth => x.sqrt().sqrt(),
            Root::Eighth => x.sqrt().sqrt().sqrt(),
            // Of a height next to none nothing is left, and its logarithm is none.
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

    /// M(h) = 2n/(n+1) h a, m².
    #[inline]
    fn reduced_force(&self, h: f64) -> f64 {
        self.force_factor * h * self.radius(h)
    }

    /// N(h) = n/(2n+1) h M, m³.
    #[inline]
    fn reduced_energy(&self, h: f64) -> f64 {
        let [_, reduced_energy] = self.reduced_sums(h);
        reduced_energy
    }

    /// g(a) = aⁿ/s, m.
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

    /// h^{n+1} = (M/k)ⁿ/s with k = 2n/(n+1).
    fn height_of_reduced_force(&self, reduced_force: f64) -> f64 {
        let y = reduced_force / self.force_factor;
        match self.root {
            Root::First => (y / self.scale).sqrt(),
            Root::Second => math::cbrt(y / self.scale * y),
            _ => {
                let n = self.exponent;
                let h = math::powf(y, n / (n + 1.0)) / math::powf(self.scale, 1.0 / (n + 1.0));
                // The rounded exponents cost 4ε at n = 2.5 and 7ε at n = 5: one Newton step leaves 1.5ε.
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

    /// At the tip of a cone and of anything sharper; in the middle up to the paraboloid.
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
