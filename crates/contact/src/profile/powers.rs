//! Sum of powers f = ΣAᵢr^{nᵢ}: g = ΣBᵢ|x|^{nᵢ} with Bᵢ = κ(nᵢ)Aᵢ.
//!
//! M = 2∫x dg = Σ 2nᵢ/(nᵢ+1) Bᵢ a^{nᵢ+1} and N = ∫M dg = ΣΣ 2nᵢnⱼ/((nᵢ+1)(nᵢ+nⱼ+1)) BᵢBⱼ a^{nᵢ+nⱼ+1}, where g(a) = h. All
//! coefficients are at least 0, so there is no cancellation.

use super::error::positive;
use super::kappa::kappa;
use super::kind::{Kind, Peak};
use super::{Profile, ProfileError, Shape};

/// Sum of powers with at least one coefficient above 0.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Powers {
    terms: Vec<Term>,
}

/// Term B|x|ⁿ.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Term {
    /// Coefficient B, m^{1-n}, above 0.
    coefficient: f64,
    exponent: f64,
    /// Factor `κ_n`.
    kappa: f64,
}

impl Profile {
    /// Creates a sum of powers f = ΣAr^n from terms (A, n): A ≥ 0 in m^{1-n}, n > 0, both finite.
    ///
    /// # Errors
    ///
    /// Fails if there is no coefficient above 0, if a coefficient is below 0, or if an exponent is not above 0.
    pub fn powers(terms: &[(f64, f64)]) -> Result<Self, ProfileError> {
        let mut kept = Vec::with_capacity(terms.len());
        for (index, &(coefficient, exponent)) in terms.iter().enumerate() {
            let in_term = |_| ProfileError::TermExponent { index, value: exponent };
            positive(exponent, ProfileError::Exponent).map_err(in_term)?;
            let kappa = kappa(exponent);
            if !(coefficient >= 0.0 && (kappa * coefficient).is_finite()) {
                return Err(ProfileError::TermCoefficient { index, value: coefficient });
            }
            if coefficient > 0.0 {
                kept.push(Term { coefficient: kappa * coefficient, exponent, kappa });
            }
        }
        match kept[..] {
            [] => Err(ProfileError::NoTerm),
            // A single term is treated as a power law.
            [Term { coefficient, exponent, .. }] => Self::foundation_power(coefficient, exponent),
            _ => Ok(Self { shape: Shape::Powers(Powers { terms: kept }) }),
        }
    }
}

impl Term {
    /// Returns B aⁿ.
    fn at(&self, a: f64) -> f64 {
        self.coefficient * power(a, self.exponent)
    }

    /// Returns 2n/(n+1).
    fn force_factor(&self) -> f64 {
        2.0 * self.exponent / (self.exponent + 1.0)
    }
}

/// Returns aⁿ; small integer exponents by multiplication.
fn power(a: f64, n: f64) -> f64 {
    const MOST: f64 = 16.0;
    if n.fract() == 0.0 && n <= MOST { a.powi(n as i32) } else { math::powf(a, n) }
}

impl Powers {
    /// Returns the a at which the sum of factor·Bᵢ·a^{nᵢ+more} equals `wanted`, by Newton's method in logarithms.
    // In logarithms the sum is convex, so the iterates decrease monotonically after the first step, also for exponents below 1.
    fn root(&self, wanted: f64, factor: impl Fn(&Term) -> f64, more: f64) -> f64 {
        const STEPS: usize = 60;
        const ENOUGH: f64 = 1e-10;
        // A single term reaches the value at a larger a than the sum.
        let alone = |term: &Term| {
            math::powf(wanted / (factor(term) * term.coefficient), 1.0 / (term.exponent + more))
        };
        let mut a = self.terms.iter().map(alone).fold(f64::INFINITY, f64::min);
        for _ in 0..STEPS {
            let (mut sum, mut slope) = (0.0, 0.0);
            for term in &self.terms {
                let value = factor(term) * term.at(a) * math::powf(a, more);
                sum += value;
                slope += (term.exponent + more) * value;
            }
            let step = math::ln_1p((wanted - sum) / sum) * (sum / slope);
            if !step.is_finite() {
                break;
            }
            a *= math::exp(step);
            if step.abs() <= ENOUGH {
                break;
            }
        }
        a
    }

    fn radius(&self, h: f64) -> f64 {
        self.root(h, |_| 1.0, 0.0)
    }
}

impl Kind for Powers {
    fn reduced_stiffness(&self, h: f64) -> f64 {
        2.0 * self.radius(h)
    }

    fn reduced_force(&self, h: f64) -> f64 {
        let a = self.radius(h);
        a * self.terms.iter().map(|term| term.force_factor() * term.at(a)).sum::<f64>()
    }

    fn reduced_energy(&self, h: f64) -> f64 {
        let a = self.radius(h);
        let against = |term: &Term| {
            let part = |other: &Term| other.exponent / (term.exponent + other.exponent + 1.0) * other.at(a);
            term.force_factor() * term.at(a) * self.terms.iter().map(part).sum::<f64>()
        };
        a * self.terms.iter().map(against).sum::<f64>()
    }

    fn height_of_reduced_force(&self, force: f64) -> f64 {
        self.depth(self.root(force, Term::force_factor, 1.0))
    }

    fn depth(&self, a: f64) -> f64 {
        self.terms.iter().map(|term| term.at(a)).sum()
    }

    fn depth_slope(&self, a: f64) -> f64 {
        self.terms.iter().map(|term| term.exponent * term.at(a)).sum::<f64>() / a
    }

    fn gap(&self, r: f64) -> Option<f64> {
        Some(self.terms.iter().map(|term| term.at(r) / term.kappa).sum())
    }

    /// Returns that the pressure is unbounded at the tip if an exponent is at most 1.
    fn peak(&self) -> Option<Peak> {
        let has_tip = self.terms.iter().any(|term| term.exponent <= 1.0);
        Some(if has_tip { Peak::Unbounded } else { Peak::Between })
    }

    /// Returns Σ n/(n-1) B aⁿ⁻¹.
    // Numerical quadrature is inaccurate for exponents near 1, where g'/x is nearly singular in the centre.
    fn middle_slope_integral(&self, a: f64) -> Option<f64> {
        let part = |term: &Term| term.exponent / (term.exponent - 1.0) * term.at(a) / a;
        Some(if self.peak() == Some(Peak::Unbounded) {
            f64::INFINITY
        } else {
            self.terms.iter().map(part).sum()
        })
    }

    /// Returns the exponent from the term with the lowest n, which is the largest term near the axis.
    fn first_power(&self) -> f64 {
        let lowest = self.terms.iter().fold(f64::INFINITY, |lowest, term| lowest.min(term.exponent));
        1.0 + lowest.recip()
    }

    fn is_strictly_convex(&self) -> bool {
        true
    }
}
