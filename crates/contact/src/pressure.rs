//! Largest normal pressure of a contact.

use crate::profile::Peak;
use crate::quadrature::GAUSS;
use crate::{Interface, Profile};
use std::f64::consts::PI;

/// Number of quadrature panels, divided among the parts between profile borders. Panels are shorter towards both ends of a part.
const PANELS: usize = 64;
/// Smallest number of panels of a part.
const FEWEST: usize = 8;
/// Smallest number of panels per unit of v, with x = r cosh v.
const PER_UNIT: f64 = 4.0;
/// Number of radii at which the search for the maximum starts, closer together towards the edge.
const PLACES: u32 = 32;
/// Largest number of profile borders near which the search has additional radii.
const MOST: usize = 2;
/// Number of golden-section steps; each reduces the range to 0.618 of its length.
const SECTIONS: u32 = 40;

impl Interface {
    /// Returns the largest normal pressure at indentation d, Pa; 0 for an open contact.
    ///
    /// The pressure is p(r) = (E\*/π) ∫ᵣᵃ g'(x)/√(x²-r²) dx, from (4.34). For g ~ xⁿ with 1 < n ≤ 2 the maximum is in the centre: p =
    /// E\*d/(πa) n/(n-1), for a Hertz contact 2E\*d/(πa). For n > 2, sums of powers, rounded edges and tables the maximum is found
    /// numerically. The relative error of the maximum is below 1e-9, for tables in addition to the error of g'. The pressure is infinite at
    /// a sharp tip and at the edge of a flat punch. Returns `None` for a list of springs and a normal law, which define no shape in three
    /// dimensions.
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
            Peak::Between => self.normal_modulus() / PI * self.largest_slope_integral(a),
        })
    }

    /// Returns the maximum of ∫ᵣᵃ g'(x)/√(x²-r²) dx over r, from sampled radii and a golden-section search near the best sample.
    fn largest_slope_integral(&self, a: f64) -> f64 {
        let profile = self.profile();
        let at = |r: f64| slope_integral(profile, a, r);
        // A rounded edge raises the pressure near it, even far inside the contact.
        let beside = |border: &f64| [0.7, 0.95, 1.0, 1.05, 1.3].map(|share| share * border);
        let even = (1..PLACES).map(|k| a * (1.0 - (f64::from(k) / f64::from(PLACES)).powi(4)).sqrt());
        let mut places: Vec<f64> = profile.borders().iter().take(MOST).flat_map(beside).chain(even).collect();
        places.retain(|r| *r > 0.0 && *r < a);
        places.sort_by(f64::total_cmp);
        places.insert(0, 0.0);
        let values: Vec<f64> = places.iter().map(|r| at(*r)).collect();
        let highest = (0..values.len()).fold(0, |best, i| if values[i] > values[best] { i } else { best });
        let from = places[highest.saturating_sub(1)];
        let to = places.get(highest + 1).copied().unwrap_or(a);
        largest([from, to], at).max(values[highest])
    }
}

/// Returns ∫ᵣᵃ g'(x)/√(x²-r²) dx, integrated separately between the borders of the profile.
fn slope_integral(profile: &Profile, a: f64, r: f64) -> f64 {
    if r == 0.0
        && let Some(middle) = profile.middle_slope_integral(a)
    {
        return middle;
    }
    let inside = profile.borders().iter().copied().filter(|border| *border > r && *border < a);
    let ends: Vec<f64> = std::iter::once(r).chain(inside).chain([a]).collect();
    let panels = (PANELS / (ends.len() - 1)).max(FEWEST);
    let part = |pair: &[f64]| {
        let (from, to) = (pair[0], pair[1]);
        if r == 0.0 {
            return graded([from, to], panels, |x| profile.depth_slope(x) / x);
        }
        // The substitution x = r cosh v removes the root singularity.
        let angle = |x: f64| math::asinh(((x - r) * (x + r)).sqrt() / r);
        let range = [angle(from), angle(to)];
        let panels = panels.max((PER_UNIT * (range[1] - range[0])).ceil() as usize);
        graded(range, panels, |v| profile.depth_slope((r * math::cosh(v)).clamp(from, to)))
    };
    ends.windows(2).map(part).sum()
}

/// Integrates f over a range in panels that are shorter towards both ends, by s = y³(10-15y+6y²).
fn graded([from, to]: [f64; 2], panels: usize, f: impl Fn(f64) -> f64) -> f64 {
    let panel = |k: usize| {
        let node = |&(x, weight): &(f64, f64)| {
            let y = (k as f64 + 0.5 * (1.0 + x)) / panels as f64;
            // The distance is taken from the nearer end to avoid cancellation.
            let rest = 1.0 - y;
            let s = |y: f64| y * y * y * (10.0 - y * (15.0 - 6.0 * y));
            let at = if y < 0.5 { from + (to - from) * s(y) } else { to - (to - from) * s(rest) };
            30.0 * y * y * rest * rest * weight * f(at)
        };
        GAUSS.iter().map(node).sum::<f64>()
    };
    (to - from) * (0..panels).map(panel).sum::<f64>() / panels as f64
}

/// Returns the maximum of a function with one maximum in a range, by golden-section search.
fn largest([mut from, mut to]: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut left, mut right) = (to - GOLDEN * (to - from), from + GOLDEN * (to - from));
    let (mut at_left, mut at_right) = (f(left), f(right));
    let mut best = at_left.max(at_right);
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
    use crate::profile::kappa;
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

    /// Compares the central and the largest pressure, times π/E\*, with closed forms for sums of powers at a = 1.
    #[test]
    fn sums_of_powers_have_theirs() {
        let law = |terms: &[(f64, f64)]| {
            let terms: Vec<(f64, f64)> = terms.iter().map(|(b, n)| (b / kappa(*n), *n)).collect();
            let profile = Profile::powers(&terms).unwrap();
            Interface::new(Pair::from_moduli(PI, 2.0).unwrap(), profile, 0.3).unwrap()
        };
        let peak = |terms: &[(f64, f64)]| {
            let law = law(terms);
            law.peak_pressure(law.profile().depth(1.0)).unwrap()
        };
        let close = |got: f64, want: f64| assert!((got / want - 1.0).abs() < 1e-9, "{got}, {want}");
        // If no exponent is above 2, the maximum is in the centre: Σ n/(n-1) B aⁿ⁻¹.
        for n in [1.01, 1.2, 1.5, 1.9, 2.0] {
            close(peak(&[(1.0, n), (1e-3, 2.0)]), n / (n - 1.0) + 2e-3);
        }
        close(peak(&[(1.0, 1.2), (1.0, 1.5), (1.0, 2.0)]), 11.0);
        // x² and x⁶: √(1-t) [2 + 6((1-t)²/5 + 2t(1-t)/3 + t²)], t = r². There may be a second maximum outside the centre.
        let of_six = |t: f64| 6.0 * ((1.0 - t) * (1.0 - t) / 5.0 + 2.0 * t * (1.0 - t) / 3.0 + t * t);
        for six in [0.05, 0.3, 1.0, 10.0] {
            let at = |k: u32| {
                let t = f64::from(k) / 1e6;
                (1.0 - t).sqrt() * (2.0 + six * of_six(t))
            };
            close(peak(&[(1.0, 2.0), (six, 6.0)]), (0..1_000_000).map(at).fold(0.0, f64::max));
        }
        // The term x^1.2 has its maximum of 6 in the centre; the term 10x⁶ has one outside.
        let six = (0..1_000_000)
            .map(|k| f64::from(k) / 1e6)
            .map(|t| (1.0 - t).sqrt() * of_six(t))
            .fold(0.0, f64::max);
        close(peak(&[(1.0, 1.2), (1e-9, 6.0)]), 6.0 + 1.2e-9);
        let both = peak(&[(1.0, 1.2), (10.0, 6.0)]);
        assert!(both > 10.0 * six && both < 10.0 * six + 6.0 && both > 18.0, "{both}, {six}");
        assert_eq!(peak(&[(1e-6, 1.0), (1.0, 2.0)]), f64::INFINITY);
    }

    /// Returns the maximum of a function on [0, 1] with one maximum, by repeated sampling.
    fn highest(f: impl Fn(f64) -> f64) -> f64 {
        let (mut from, mut to) = (0.0, 1.0);
        for _ in 0..5 {
            let at = |k: u32| from + (to - from) * f64::from(k) / 100.0;
            let k = (1..100).max_by(|i, k| f(at(*i)).total_cmp(&f(at(*k)))).unwrap();
            (from, to) = (at(k - 1), at(k + 1));
        }
        f(0.5 * (from + to))
    }

    #[test]
    fn a_rounded_edge_has_its_own() {
        // R = 1: g' = 2w - b arctan(w/b), w² = x²-b². The substitution is x² = r²+s² beyond b and x² = b²+s² inside. Simpson's rule
        // uses s = z³(10-15z+6z²), which is smooth at b.
        let b = 0.1_f64;
        for a in [0.101, 0.12, 0.2, 1.0, 5.0] {
            let pressure = |share: f64| {
                let r = share * a;
                let low = r.max(b);
                let span = ((a - low) * (a + low)).sqrt();
                let f = |z: f64| {
                    let s = span * z * z * z * (10.0 - z * (15.0 - 6.0 * z));
                    let rate = 30.0 * span * z * z * (1.0 - z) * (1.0 - z);
                    let x = low.hypot(s);
                    let w = (((low - b) * (low + b)) + s * s).sqrt();
                    let root = (((low - r) * (low + r)) + s * s).sqrt();
                    if root == 0.0 { 0.0 } else { (2.0 * w - b * (w / b).atan()) * s / (x * root) * rate }
                };
                let n = 4000;
                let weight = |k: u32| f64::from([2, 4][k as usize % 2]);
                (1..n).map(|k| weight(k) * f(f64::from(k) / f64::from(n))).sum::<f64>() / (3.0 * f64::from(n))
            };
            let profile = Profile::rounded_flat(b, 1.0).unwrap();
            let law = Interface::new(Pair::from_moduli(PI, 2.0).unwrap(), profile, 0.3).unwrap();
            let (got, want) = (law.peak_pressure(law.profile().depth(a)).unwrap(), highest(pressure));
            assert!((got / want - 1.0).abs() < 1e-9, "{a}: {got}, {want}");
        }
    }

    #[test]
    fn a_table_of_a_ball_has_the_pressure_of_the_ball() {
        let table = |cells: u32, end: f64, f: fn(f64) -> f64, kinks: &[f64]| {
            let at = |k: u32| end * f64::from(k) / f64::from(cells);
            let points: Vec<(f64, f64)> = (0..=cells).map(|k| (at(k), f(at(k)))).collect();
            Profile::table(&points, kinks).unwrap()
        };
        for cells in 2..=200 {
            let profile = table(cells, 4e-4, |r| r * r / 0.01, &[]);
            let ratio = peak(profile, 7e-6);
            assert!((ratio - 2.0).abs() < 1e-9, "{cells}: {ratio}");
        }
        // A kink without a change of slope, and a profile that is no cubic.
        let kink = 4e-4 * 30.0 / 60.0;
        assert!((peak(table(60, 4e-4, |r| r * r / 0.01, &[kink]), 7e-6) - 2.0).abs() < 1e-9);
        let sphere = peak(Profile::sphere(1.0).unwrap(), 0.1);
        for cells in [10, 20, 50, 200] {
            let ratio = peak(table(cells, 0.5, |r| 1.0 - (1.0 - r * r).sqrt(), &[]), 0.1);
            let within = 0.1 / f64::from(cells * cells);
            assert!((ratio / sphere - 1.0).abs() < within, "{cells}: {ratio}, {sphere}");
        }
        // Tables with a tip and with an edge.
        assert_eq!(peak(table(60, 1.0, |r| r, &[]), 0.1), f64::INFINITY);
        assert_eq!(peak(table(60, 1.0, |r| 1e-3 * r + r * r, &[]), 0.1), f64::INFINITY);
        assert_eq!(peak(table(10, 1.0, |r| (r - 0.3).max(0.0), &[0.3]), 0.1), f64::INFINITY);
    }

    #[test]
    fn a_shallow_sphere_is_a_paraboloid_and_a_deep_one_is_not() {
        // At a/R = 1e-2 the pressures differ by the order (a/R)².
        let law = |profile| Interface::new(Pair::from_moduli(3.0, 2.0).unwrap(), profile, 0.3).unwrap();
        let sphere = law(Profile::sphere(1.0).unwrap()).peak_pressure(1e-4).unwrap();
        let paraboloid = law(Profile::paraboloid(1.0).unwrap()).peak_pressure(1e-4).unwrap();
        assert!((sphere / paraboloid - 1.0).abs() < 1e-4 && sphere > paraboloid, "{sphere}, {paraboloid}");
        // Pressure in the centre: p = (E*/π)∫₀ᵃ g'/x dx with g'/x = [atanh(x/R) + (x/R)/(1-x²/R²)]/x, by the midpoint rule.
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
