//! The largest normal pressure of a contact.

use crate::Interface;
use crate::profile::Peak;
use crate::quadrature::GAUSS;
use std::f64::consts::PI;

/// Panels of the quadrature, drawn together towards the edge, where the steep profiles are steepest.
// 4096 change nothing above 5e-13, up to exponents of 40 000 and spheres pressed to 0.9999 of their radius; 16 would do for all
// but the steepest (5e-14 at n = 4000).
const PANELS: u32 = 64;
/// Sections of the search for the largest pressure: each leaves 0.618 of the range.
// Half of them leave 2e-10 for n = 40 and 4e-4 for n = 40 000, whose hill is narrow; 80 change nothing above 1e-14.
const SECTIONS: u32 = 48;

impl Interface {
    /// Largest normal pressure at indentation d, Pa; 0 while the contact is open.
    ///
    /// p(r) = (E\*/π) ∫ᵣᵃ g'(x)/√(x²-r²) dx, the integral of (4.34). For g ~ xⁿ, 1 < n ≤ 2, it is largest in the middle,
    /// p = E\*d/(πa) n/(n-1), in Hertz' contact 2E\*d/(πa); for n > 2 between middle and edge, where it is searched for
    /// (relative error below 1e-9). Infinite at the tip of a cone and of anything sharper and at the edge of a flat
    /// punch; none for a list of springs and a normal law, which have no shape in three dimensions.
    pub fn peak_pressure(&self, d: f64) -> Option<f64> {
        let profile = self.profile();
        let peak = profile.peak()?;
        let a = profile.radius(d);
        if a == 0.0 {
            return Some(0.0);
        }
        let mean_slope = self.normal_modulus() * d / (PI * a);
        Some(match peak {
            Peak::Unbounded => f64::INFINITY,
            Peak::Middle(n) => mean_slope * n / (n - 1.0),
            Peak::Between => self.normal_modulus() / PI * largest(|t| self.slope_integral(a, t)),
        })
    }

    /// ∫ᵣᵃ g'(x)/√(x²-r²) dx at r² = ta², by x² = r² + (a²-r²)s²: then √(a²-r²) ∫₀¹ g'(x)/x ds, without singularity.
    fn slope_integral(&self, a: f64, t: f64) -> f64 {
        let panel = |k: u32| {
            let node = |&(x, weight): &(f64, f64)| {
                let left = 1.0 - (f64::from(k) + 0.5 * (1.0 + x)) / f64::from(PANELS);
                let s = 1.0 - left.powi(3);
                let at = a * (t + (1.0 - t) * s * s).sqrt();
                1.5 / f64::from(PANELS) * weight * left * left * self.profile().depth_slope(at) / at
            };
            2.0 * GAUSS.iter().map(node).sum::<f64>()
        };
        a * (1.0 - t).sqrt() * (0..PANELS).map(panel).sum::<f64>()
    }
}

/// Largest value on [0, 1] of a function with one hill, by golden sections.
fn largest(f: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut from, mut to) = (0.0, 1.0);
    let (mut left, mut right) = (1.0 - GOLDEN, GOLDEN);
    let (mut at_left, mut at_right) = (f(left), f(right));
    let mut best = f(0.0).max(at_left).max(at_right);
    for _ in 0..SECTIONS {
        if at_left >= at_right {
            (to, right, at_right) = (right, left, at_left);
            left = to - GOLDEN * (to - from);
            at_left = f(left);
        } else {
            (from, left, at_left) = (left, right, at_right);
            right = from + GOLDEN * (to - from);
            at_right = f(right);
        }
        best = best.max(at_left).max(at_right);
    }
    best
}

#[cfg(test)]
mod tests {
    use crate::{Interface, Pair, Profile};
    use std::f64::consts::PI;

    /// Peak pressure over E\*d/(πa).
    fn peak(profile: Profile, d: f64) -> f64 {
        let law = Interface::new(Pair::from_moduli(3.0, 2.0).unwrap(), profile, 0.3).unwrap();
        law.peak_pressure(d).unwrap() * PI * law.profile().radius(d) / (3.0 * d)
    }

    #[test]
    fn powers_have_their_closed_forms() {
        let close = |got: f64, want: f64| assert!((got / want - 1.0).abs() < 1e-9, "{got}, {want}");
        // Hertz: p = 3F/(2πa²) = 2E*d/(πa).
        close(peak(Profile::paraboloid(0.7).unwrap(), 1e-4), 2.0);
        close(peak(Profile::power(5.0, 1.5).unwrap(), 1e-4), 3.0);
        // n = 4: √(1-t)(4/3)(1+2t), largest at t = 1/2; n = 6: √(1-t)(2/5)(3+4t+8t²), at the root of 8t² = 4t+1.
        close(peak(Profile::power(5.0, 4.0).unwrap(), 1e-4), 0.5_f64.sqrt() * 8.0 / 3.0);
        let t = (1.0 + 3.0_f64.sqrt()) / 4.0;
        close(
            peak(Profile::power(5.0, 6.0).unwrap(), 1e-4),
            (1.0 - t).sqrt() * 0.4 * (3.0 + 4.0 * t + 8.0 * t * t),
        );
    }

    #[test]
    fn a_shallow_sphere_is_a_paraboloid_and_a_deep_one_is_not() {
        // a/R = 1e-2; p differs by (a/R)² in order of magnitude.
        let law = |profile| Interface::new(Pair::from_moduli(3.0, 2.0).unwrap(), profile, 0.3).unwrap();
        let sphere = law(Profile::sphere(1.0).unwrap()).peak_pressure(1e-4).unwrap();
        let paraboloid = law(Profile::paraboloid(1.0).unwrap()).peak_pressure(1e-4).unwrap();
        assert!((sphere / paraboloid - 1.0).abs() < 1e-4 && sphere > paraboloid, "{sphere}, {paraboloid}");
        // In the middle p = (E*/π)∫₀ᵃ g'/x dx with g'/x = [atanh(x/R) + (x/R)/(1-x²/R²)]/x, summed by midpoints.
        let a: f64 = 0.5;
        let n = 200_000;
        let slope = |x: f64| (x.atanh() + x / (1.0 - x * x)) / x;
        let sum: f64 = (0..n).map(|k| slope(a * (f64::from(k) + 0.5) / f64::from(n))).sum();
        let want = 3.0 / PI * sum * a / f64::from(n);
        let got = law(Profile::sphere(1.0).unwrap()).peak_pressure(a * a.atanh()).unwrap();
        assert!((got / want - 1.0).abs() < 1e-9, "{got}, {want}");
    }

    #[test]
    fn tips_and_edges_have_no_bound_and_lists_no_pressure() {
        assert_eq!(peak(Profile::cone(0.1).unwrap(), 1e-4), f64::INFINITY);
        assert_eq!(peak(Profile::flat(0.1).unwrap(), 1e-4), f64::INFINITY);
        let list = Profile::foundation(&[0.0, 1e-5], &[1e-3, 1e-3]).unwrap();
        let law = |profile| Interface::new(Pair::from_moduli(3.0, 2.0).unwrap(), profile, 0.3).unwrap();
        assert_eq!(law(list).peak_pressure(1e-4), None);
        assert_eq!(law(Profile::sphere(1.0).unwrap()).peak_pressure(-1e-4), Some(0.0));
    }
}
