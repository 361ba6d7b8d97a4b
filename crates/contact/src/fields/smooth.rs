//! Any profile in three dimensions, by quadrature from its foundation g(x), with an estimate of the error.
//!
//! Where g or its slope is not smooth, at 0 and at the [borders](crate::Profile) of the profile, g' may grow like 1/√(x-b)
//! just outside. Between two of them x² = b² + s² takes that away, and s = δ sinh t the singularity at r, which lies δ before
//! or after b in squares, however small δ is.

use crate::Profile;
use crate::quadrature::kronrod;
use std::f64::consts::FRAC_2_PI;

/// Of a place on a border the distance, as a share of the radius, from which on inwards the integrand is a power of it.
const ON_BORDER: f64 = 1e-9;
/// What the distance is divided by to learn of that power.
const CLOSER: f64 = 1e3;
/// Least power of an integral that is taken for finite.
const LEAST_POWER: f64 = 1e-3;

/// A value and an estimate of its error.
pub(super) type Estimate = (f64, f64);

/// ∫ᵣˣ g'(ξ)/√(ξ²-r²) dξ, dimensionless, r < x; infinite at a tip or where a worn edge was.
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
        // Distance, in squares, of the other of r and the border.
        let other = if i == 0 { below } else { r };
        let delta = ((low - other) * (low + other)).sqrt();
        let at = |s: f64| (low * low + s * s).sqrt();
        let part = if i > 0 {
            // r lies below this border: dξ/√(ξ²-r²) = s dt/ξ.
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

/// The same from one radius to another, both above r: finite wherever r lies.
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

/// ∫ h(s) ds/s from 0 to `span`, h ~ sᵉ below `delta`: h/e from there, the rest in panels of about a unit of ln s. Infinite
/// where h does not fade.
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

/// ∫₀ˣ arcsin(ξ/r) dg, m, x ≤ r.
pub(super) fn arc_integral(profile: &Profile, x: f64, r: f64) -> Estimate {
    let inside = profile.borders().iter().copied().take_while(|border| *border < x);
    let ends: Vec<f64> = std::iter::once(0.0).chain(inside).chain([x]).collect();
    let mut total = (0.0, 0.0);
    for pair in ends.windows(2) {
        let (low, high) = (pair[0], pair[1]);
        let middle = 0.5 * (low + high);
        let at = |s: f64| (low * low + s * s).sqrt();
        let span = ((middle - low) * (middle + low)).sqrt();
        // At the lower end g' may be singular, at the upper one arcsin.
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

/// f(r), m: what a foundation is in three dimensions, by Abel's inversion f = g - (2/π) ∫₀ʳ arcsin(x/r) dg.
pub(super) fn gap(profile: &Profile, r: f64) -> Estimate {
    if r <= 0.0 {
        return (0.0, 0.0);
    }
    let (integral, error) = arc_integral(profile, r, r);
    (profile.depth(r) - FRAC_2_PI * integral, error)
}

/// ∫f(s, ds/dt) dt over s = δ sinh t from 0 to `span`, in panels of about a unit of t.
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
