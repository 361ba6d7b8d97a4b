//! A sum of powers f = ΣAᵢr^{nᵢ}: g = ΣBᵢ|x|^{nᵢ} with Bᵢ = κ(nᵢ)Aᵢ.
//!
//! M = 2∫x dg = Σ 2nᵢ/(nᵢ+1) Bᵢ a^{nᵢ+1} and N = ∫M dg = ΣΣ 2nᵢnⱼ/((nᵢ+1)(nᵢ+nⱼ+1)) BᵢBⱼ a^{nᵢ+nⱼ+1}, a the root of g(a) = h. No
//! coefficient is below zero, so nothing cancels.

use super::error::positive;
use super::kappa::kappa;
use super::kind::{Kind, Peak};
use super::{Profile, ProfileError, Shape};

/// A sum of powers with at least one coefficient above zero.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Powers {
    terms: Vec<Term>,
}

/// B|x|ⁿ.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Term {
    /// B, m^{1-n}, above 0.
    coefficient: f64,
    exponent: f64,
    /// `κ_n`.
    kappa: f64,
}

impl Profile {
    /// A sum of powers f = ΣAr^n over terms (A, n): A ≥ 0 in m^{1-n}, any real n > 0.
    ///
    /// # Errors
    ///
    /// Without a term above zero, for a coefficient below zero or an exponent that is not above it; both finite.
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
            // One term is a power law, and as cheap.
            [Term { coefficient, exponent, .. }] => Self::foundation_power(coefficient, exponent),
            _ => Ok(Self { shape: Shape::Powers(Powers { terms: kept }) }),
        }
    }
}

impl Term {
    /// B aⁿ.
    fn at(&self, a: f64) -> f64 {
        self.coefficient * power(a, self.exponent)
    }

    /// 2n/(n+1).
    fn force_factor(&self) -> f64 {
        2.0 * self.exponent / (self.exponent + 1.0)
    }
}

/// aⁿ, whole exponents by multiplication.
fn power(a: f64, n: f64) -> f64 {
    const MOST: f64 = 16.0;
    if n.fract() == 0.0 && n <= MOST { a.powi(n as i32) } else { math::powf(a, n) }
}

impl Powers {
    /// The a at which a sum of c·Bᵢaⁿ⁺ᵐ, c and m of the term, is `wanted`: by Newton's method in the logarithms of both.
    // There such a sum is convex, its slope between the least and the largest exponent, so that the first step lands beyond
    // the root and the others descend on it: four of them, where exponents below 1 leave g itself concave.
    fn root(&self, wanted: f64, factor: impl Fn(&Term) -> f64, more: f64) -> f64 {
        const STEPS: usize = 60;
        const ENOUGH: f64 = 1e-10;
        // Each term alone reaches it later than all together.
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

    /// At the tip, where one term alone has it there.
    fn peak(&self) -> Option<Peak> {
        let has_tip = self.terms.iter().any(|term| term.exponent <= 1.0);
        Some(if has_tip { Peak::Unbounded } else { Peak::Between })
    }

    /// Σ n/(n-1) B aⁿ⁻¹.
    // Plain panels miss a fifth of it at n = 1.2, whose g'/x grows as x^{-0.8} towards the middle.
    fn middle_slope_integral(&self, a: f64) -> Option<f64> {
        let part = |term: &Term| term.exponent / (term.exponent - 1.0) * term.at(a) / a;
        Some(if self.peak() == Some(Peak::Unbounded) {
            f64::INFINITY
        } else {
            self.terms.iter().map(part).sum()
        })
    }

    /// That of the term with the lowest exponent, which is the largest near the axis.
    fn first_power(&self) -> f64 {
        let lowest = self.terms.iter().fold(f64::INFINITY, |lowest, term| lowest.min(term.exponent));
        1.0 + lowest.recip()
    }

    fn is_strictly_convex(&self) -> bool {
        true
    }
}
