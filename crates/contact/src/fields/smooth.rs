//! Fields of any profile, by quadrature over its foundation g(x), with an error estimate.
//!
//! At 0 and at the [borders](crate::Profile) b of the profile, g or its slope is not smooth, and g' may grow like 1/√(x-b). Between
//! two borders the substitution x² = b² + s² removes this singularity. The substitution s = δ sinh t removes the singularity at r,
//! where δ² = |b² - r²|.

use crate::Profile;
use crate::quadrature::kronrod;
use std::f64::consts::FRAC_2_PI;

/// Relative distance from a border below which the integrand is treated as a power of the distance.
const ON_BORDER: f64 = 1e-9;
/// Factor between the two distances from which the power is determined.
const CLOSER: f64 = 1e3;
/// Smallest power at which an integral counts as finite.
const LEAST_POWER: f64 = 1e-3;

/// Value and estimate of its error.
pub(super) type Estimate = (f64, f64);

/// Returns ∫ᵣˣ g'(ξ)/√(ξ²-r²) dξ, dimensionless, for r < x; infinite at a sharp tip and at the border of a flat.
pub(super) fn slope_integral(profile: &Profile, x: f64, r: f64) -> Estimate {
    let borders = profile.borders();
    let first = borders.partition_point(|border| *border <= r);
    let below = first.checked_sub(1).map_or(0.0, |i| borders[i]);
    let inside = borders[first..].iter().copied().take_while(|border| *border < x);
    let ends: Vec<f64> = std::iter::once(r).chain(inside).chain([x]).collect();
    let mut total = (0.0, 0.0);
    for (i, pair) in ends.windows(2).enumerate() {
        let (low, high) = (pair[0], pair[1]);
        let span = ((high - low) * (high + low)).sqrt();
        // Distance δ, in squares, between r and the border.
        let other = if i == 0 { below } else { r };
        let delta = ((low - other) * (low + other)).sqrt();
        let at = |s: f64| (low * low + s * s).sqrt();
        let part = if i > 0 {
            // r is below this border: dξ/√(ξ²-r²) = s dt/ξ.
            by_logarithm(delta, span, |s, _| profile.depth_slope(at(s)) * s / at(s))
        } else if delta > 0.0 {
            by_logarithm(delta, span, |s, rate| profile.depth_slope(at(s)) / at(s) * rate)
        } else {
            from_border(ON_BORDER * x, span, |s| profile.depth_slope(at(s)) * s / at(s))
        };
        total = (total.0 + part.0, total.1 + part.1);
    }
    total
}

/// Returns ∫ g'(ξ)/√(ξ²-r²) dξ between two radii above r; the integral is finite for every r.
pub(super) fn slope_between(profile: &Profile, [from, to]: [f64; 2], r: f64) -> Estimate {
    let inside = profile.borders().iter().copied().filter(|border| *border > from && *border < to);
    let ends: Vec<f64> = std::iter::once(from).chain(inside).chain([to]).collect();
    let mut total = (0.0, 0.0);
    for pair in ends.windows(2) {
        let (low, high) = (pair[0], pair[1]);
        let (span, delta) = (((high - low) * (high + low)).sqrt(), ((low - r) * (low + r)).sqrt());
        let at = |s: f64| (low * low + s * s).sqrt();
        let part = by_logarithm(delta, span, |s, _| profile.depth_slope(at(s)) * s / at(s));
        total = (total.0 + part.0, total.1 + part.1);
    }
    total
}

/// Returns ∫ h(s) ds/s from 0 to `span`, with h ~ sᵉ below `delta`; infinite if h does not approach 0.
///
/// The part below `delta` is h/e. The rest is integrated in panels of about one unit of ln s.
fn from_border(delta: f64, span: f64, h: impl Fn(f64) -> f64) -> Estimate {
    let [near, nearer] = [h(delta), h(delta / CLOSER)];
    let power = math::ln(near / nearer) / math::ln(CLOSER);
    let tail = match near {
        near if near <= 0.0 => 0.0,
        _ if power < LEAST_POWER => return (f64::INFINITY, 0.0),
        near => near / power,
    };
    let end = math::ln(span / delta);
    let panels = end.ceil().max(1.0);
    let mut total = (tail, 0.0);
    for k in 0..panels as u32 {
        let share = |k: f64| end * k / panels;
        let (value, error) =
            kronrod([share(f64::from(k)), share(f64::from(k) + 1.0)], |t| h(delta * math::exp(t)));
        total = (total.0 + value, total.1 + error);
    }
    total
}

/// Returns ∫₀ˣ arcsin(ξ/r) dg, m, for x ≤ r.
pub(super) fn arc_integral(profile: &Profile, x: f64, r: f64) -> Estimate {
    let inside = profile.borders().iter().copied().take_while(|border| *border < x);
    let ends: Vec<f64> = std::iter::once(0.0).chain(inside).chain([x]).collect();
    let mut total = (0.0, 0.0);
    for pair in ends.windows(2) {
        let (low, high) = (pair[0], pair[1]);
        let middle = 0.5 * (low + high);
        let at = |s: f64| (low * low + s * s).sqrt();
        let span = ((middle - low) * (middle + low)).sqrt();
        // g' may be singular at the lower end, arcsin at the upper end.
        let lower = kronrod([0.0, span], |s| {
            let x = at(s);
            math::asin((x / r).min(1.0)) * profile.depth_slope(x) * s / x
        });
        let angles = [math::asin(middle / r), math::asin((high / r).min(1.0))];
        let upper = kronrod(angles, |phi| {
            phi * profile.depth_slope((r * math::sin(phi)).min(high)) * r * math::cos(phi)
        });
        total = (total.0 + lower.0 + upper.0, total.1 + lower.1 + upper.1);
    }
    total
}

/// Returns the gap f(r), m, by Abel's inversion f = g - (2/π) ∫₀ʳ arcsin(x/r) dg.
pub(super) fn gap(profile: &Profile, r: f64) -> Estimate {
    if r <= 0.0 {
        return (0.0, 0.0);
    }
    let (integral, error) = arc_integral(profile, r, r);
    (profile.depth(r) - FRAC_2_PI * integral, error)
}

/// Integrates f(s, ds/dt) over t with s = δ sinh t from 0 to `span`, in panels of about one unit of t.
fn by_logarithm(delta: f64, span: f64, f: impl Fn(f64, f64) -> f64) -> Estimate {
    let end = math::asinh(span / delta);
    let panels = end.ceil().max(1.0);
    let mut total = (0.0, 0.0);
    for k in 0..panels as u32 {
        let share = |k: f64| end * k / panels;
        let range = [share(f64::from(k)), share(f64::from(k) + 1.0)];
        let (value, error) = kronrod(range, |t| f(delta * math::sinh(t), delta * math::cosh(t)));
        total = (total.0 + value, total.1 + error);
    }
    total
}
