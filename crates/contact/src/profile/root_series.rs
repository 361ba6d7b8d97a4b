//! Elastic energies that are a root of the height times a short series.

use super::{Profile, Shape, sphere};

/// Exponents of power laws whose energy has this form.
const ROOTS: [u32; 4] = [1, 2, 3, 4];
/// Relative size of terms that are negligible in a double.
const LAST_PLACE: f64 = 1e-17;

/// Series of the energy N(h) = c h^{2+1/n} Σ aₖ (h/L)ᵏ of a profile.
///
/// The form exists for power laws r, r², r³, r⁴ with a single term, and for the sphere. Divided differences of the energy are then
/// rational functions of n-th roots of the heights. The mean of a force over any range therefore has a closed form without cancellation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RootSeries {
    /// Root n, 1 to 4.
    pub root: u32,
    /// Factor c, m^{1-1/n}.
    pub factor: f64,
    /// Curvature 1/L, 1/m; 0 for a single term.
    pub curvature: f64,
    /// Coefficients aₖ.
    pub terms: &'static [f64],
}

impl Profile {
    /// Returns the series of N up to an indentation (m), exact to rounding; `None` if there is no such series.
    ///
    /// For a power law of exponent n, N = N(1 m) h^{2+1/n}. For the sphere, N = √R h^{5/2} Σ aₖ (h/R)ᵏ.
    pub fn root_series(&self, depth: f64) -> Option<RootSeries> {
        if let Shape::Sphere(sphere) = &self.shape {
            let radius = sphere.radius();
            let terms = sphere::energy_terms(depth / radius, LAST_PLACE)?;
            return Some(RootSeries { root: 2, factor: radius.sqrt(), curvature: radius.recip(), terms });
        }
        let exponent = self.exponent()?;
        let root = ROOTS.into_iter().find(|root| f64::from(*root) == exponent)?;
        Some(RootSeries { root, factor: self.reduced_energy(1.0), curvature: 0.0, terms: &[1.0] })
    }
}

impl RootSeries {
    /// Returns V(x₀), V\[x₀, x₁\] and V\[x₀, x₁, x₂\]: the series V(x) = Σ aₖ (x/L)ᵏ and its divided differences.
    ///
    /// The heights (m) may coincide. Horner's rule computes each result without a difference.
    #[inline]
    pub fn divided(&self, heights: [f64; 3]) -> [f64; 3] {
        let x = heights.map(|height| self.curvature * height);
        let mut sums = [0.0; 3];
        for term in self.terms.iter().rev() {
            // (xW)[x₀…xᵢ] = xᵢW[x₀…xᵢ] + W[x₀…xᵢ₋₁]
            sums = [sums[0] * x[0] + term, sums[1] * x[1] + sums[0], sums[2] * x[2] + sums[1]];
        }
        [sums[0], self.curvature * sums[1], self.curvature * self.curvature * sums[2]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares the series with N of the profile.
    #[test]
    fn it_is_the_energy_of_the_profile() {
        let profiles = [
            Profile::cone(0.01),
            Profile::paraboloid(1e-3),
            Profile::power(1e3, 3.0),
            Profile::power(1e12, 4.0),
            Profile::sphere(1e-3),
        ];
        for profile in profiles.map(Result::unwrap) {
            for depth in [1e-12, 3e-7, 1e-5, 4e-4] {
                let Some(RootSeries { root, factor, curvature, terms }) = profile.root_series(depth) else {
                    panic!("{profile:?}")
                };
                for h in [depth, 0.7 * depth, 1e-3 * depth] {
                    let sum = terms.iter().rev().fold(0.0, |sum, term| sum * (curvature * h) + term);
                    let energy = factor * h * h * h.powf(f64::from(root).recip()) * sum;
                    let off = (energy / profile.reduced_energy(h) - 1.0).abs();
                    assert!(off < 4e-15, "{profile:?} {h}: {off:e}");
                }
            }
        }
    }

    /// Compares with differences for distant heights and with derivatives for equal ones.
    #[test]
    fn divided_differences_are_those_of_the_series() {
        let series = RootSeries { root: 2, factor: 1.0, curvature: 0.5, terms: &[1.0, -0.4, 0.3, 0.2] };
        let value = |x: f64| 1.0 - 0.2 * x + 0.075 * x * x + 0.025 * x * x * x;
        let first = |a: f64, b: f64| (value(a) - value(b)) / (a - b);
        let exact = [value(0.3), first(0.3, 1.1), (first(0.3, 1.1) - first(1.1, 2.0)) / (0.3 - 2.0)];
        for (found, exact) in series.divided([0.3, 1.1, 2.0]).into_iter().zip(exact) {
            assert!((found - exact).abs() < 1e-15, "{found} {exact}");
        }
        let exact = [value(2.0), -0.2 + 0.15 * 2.0 + 0.075 * 4.0, 0.075 + 0.075 * 2.0];
        for (found, exact) in series.divided([2.0; 3]).into_iter().zip(exact) {
            assert!((found - exact).abs() < 1e-15, "{found} {exact}");
        }
    }

    #[test]
    fn others_have_none() {
        assert_eq!(Profile::power(1.0, 2.5).unwrap().root_series(1e-6), None);
        assert_eq!(Profile::flat(1e-3).unwrap().root_series(1e-6), None);
        assert_eq!(Profile::sphere(1e-3).unwrap().root_series(6e-4), None, "beyond the series");
        assert_eq!(
            Profile::sphere(1e-3).unwrap().root_series(1e-7).map(|series| series.terms.len()),
            Some(4)
        );
    }
}
