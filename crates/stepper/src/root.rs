//! Zeros inside a step: bracketed search, and the dip that two positive ends hide.

/// Three times the halvings that any bracket of doubles takes.
const MOST: u32 = 3 * 2200;

/// A zero of `f` between `a` and `b`, `fa = f(a)` and `fb = f(b)` of opposite sign, to within `tolerance` (half the
/// width of the last bracket, in the unit of `a`; not below the spacing of doubles there).
///
/// Middle of the bracket that [`bracket`] returns, or its end where `f` is exactly zero.
pub fn root(f: impl FnMut(f64) -> f64, a: f64, b: f64, fa: f64, fb: f64, tolerance: f64) -> f64 {
    root_near(f, (a, b), (fa, fb), 0.5, tolerance)
}

/// The same with the search begun at a `guess`, a fraction of the way from `a` to `b`.
pub fn root_near(
    f: impl FnMut(f64) -> f64,
    (a, b): (f64, f64),
    (fa, fb): (f64, f64),
    guess: f64,
    tolerance: f64,
) -> f64 {
    let (left, right) = search(f, (a, b), (fa, fb), guess, tolerance);
    0.5 * (left + right)
}

/// Where the cubic through the values `y0` > 0 > `y1` with the slopes `dy0`, `dy1` at the ends of a step of length `h`
/// crosses zero, as a fraction of the step; the chord's crossing where the cubic is not monotone.
///
/// A guess for [`root_near`]: two steps of Newton's method from the chord's crossing.
#[must_use]
pub fn hermite_root(y0: f64, dy0: f64, y1: f64, dy1: f64, h: f64) -> f64 {
    let (m0, m1, rise) = (h * dy0, h * dy1, y1 - y0);
    let (c, e) = (3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise);
    let chord = y0 / (y0 - y1);
    let mut x = chord;
    for _ in 0..2 {
        let slope = m0 + x * (2.0 * c + 3.0 * x * e);
        x -= (y0 + x * (m0 + x * (c + x * e))) / slope;
    }
    if x > 0.0 && x < 1.0 { x } else { chord }
}

/// The bracket (left, right) of a zero of `f` with right - left at most 2·`tolerance`: `f(left)` has the sign of `fa`,
/// `f(right)` that of `fb` (the width up to rounding), and both are the same point where `f` is exactly zero.
///
/// Chandrupatla's method (Adv. Eng. Softw. 28, 145, 1997): inverse quadratic interpolation where its three points allow
/// it, bisection elsewhere. Bound: three times the evaluations of bisection, counted; smooth functions take five to
/// seven.
///
/// A value that is NaN ends the search at its point. Ends of equal sign are no bracket; the result is then the end
/// with the smaller magnitude, twice.
pub fn bracket(f: impl FnMut(f64) -> f64, a: f64, b: f64, fa: f64, fb: f64, tolerance: f64) -> (f64, f64) {
    search(f, (a, b), (fa, fb), 0.5, tolerance)
}

fn search(
    mut f: impl FnMut(f64) -> f64,
    (a, b): (f64, f64),
    (fa, fb): (f64, f64),
    guess: f64,
    tolerance: f64,
) -> (f64, f64) {
    if fa == 0.0 {
        return (a, a);
    }
    if fb == 0.0 {
        return (b, b);
    }
    if (fa > 0.0) == (fb > 0.0) {
        return if fa.abs() <= fb.abs() { (a, a) } else { (b, b) };
    }
    let spacing = f64::EPSILON * a.abs().max(b.abs()).max(f64::MIN_POSITIVE);
    let tolerance = tolerance.max(spacing);
    // `new` is the latest point, `old` the end across the zero, `last` the point before.
    let (mut new, mut old) = ((b, fb), (a, fa));
    let mut part = 1.0 - guess;
    for _ in 0..MOST {
        let x = new.0 + part * (old.0 - new.0);
        let value = f(x);
        if value == 0.0 || value.is_nan() {
            return (x, x);
        }
        let last = if (value > 0.0) == (new.1 > 0.0) { new } else { std::mem::replace(&mut old, new) };
        new = (x, value);
        let width = (old.0 - new.0).abs();
        if width <= 2.0 * tolerance {
            break;
        }
        // At least the tolerance away from both ends, so that the last step closes the bracket.
        let least = tolerance / width;
        part = inverse_quadratic(new, old, last).clamp(least, 1.0 - least);
    }
    if (new.1 > 0.0) == (fa > 0.0) { (new.0, old.0) } else { (old.0, new.0) }
}

/// Where between `new` and `old` (as a part of the way) the inverse parabola through the three points crosses zero, or
/// the middle where it is not monotone.
fn inverse_quadratic(new: (f64, f64), old: (f64, f64), last: (f64, f64)) -> f64 {
    let xi = (new.0 - old.0) / (last.0 - old.0);
    let phi = (new.1 - old.1) / (last.1 - old.1);
    if !(phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi) {
        return 0.5;
    }
    let first = new.1 / (old.1 - new.1) * last.1 / (old.1 - last.1);
    let second = (last.0 - new.0) / (old.0 - new.0) * new.1 / (last.1 - new.1) * old.1 / (last.1 - old.1);
    first + second
}

/// The interior minimum of the cubic through the values `y0`, `y1` with the slopes `dy0`, `dy1` at the ends of a step of
/// length `h`: where (as a fraction of the step, 0 < θ < 1) and how low.
///
/// Shows a guard that dips below zero and returns inside a step. None if the cubic has no minimum inside.
#[must_use]
pub fn hermite_dip(y0: f64, dy0: f64, y1: f64, dy1: f64, h: f64) -> Option<(f64, f64)> {
    let (m0, m1, rise) = (h * dy0, h * dy1, y1 - y0);
    // p = y0 + θ(m0 + θ(c + θ e)); its minimum is where p' = 0 and p''/2 = c + 3 e θ = +√disc.
    let c = 3.0 * rise - 2.0 * m0 - m1;
    let e = m0 + m1 - 2.0 * rise;
    let disc = c * c - 3.0 * e * m0;
    if disc.is_nan() || disc <= 0.0 {
        return None;
    }
    let root = disc.sqrt();
    // Two forms of the same root; each sums numbers of one sign only.
    let theta = if c > 0.0 { -m0 / (c + root) } else { (root - c) / (3.0 * e) };
    let inside = theta > 0.0 && theta < 1.0;
    inside.then_some((theta, y0 + theta * (m0 + theta * (c + theta * e))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(f: impl Fn(f64) -> f64, a: f64, b: f64, tolerance: f64) -> (f64, u32) {
        let mut evaluations = 0;
        let x = root(
            |x| {
                evaluations += 1;
                f(x)
            },
            a,
            b,
            f(a),
            f(b),
            tolerance,
        );
        (x, evaluations)
    }

    #[test]
    fn closed_form_zeros_within_the_bound() {
        // Zeros known in closed form, among the hard ones of the ITP paper: flat, steep, triple, jump.
        type Case = (fn(f64) -> f64, f64, f64, f64);
        let cases: [Case; 7] = [
            (|x| x * x - 2.0, 0.0, 2.0, std::f64::consts::SQRT_2),
            (|x| 1.0 - x * x / 2.0, 0.0, 2.0, std::f64::consts::SQRT_2),
            (f64::cos, 0.0, 3.0, std::f64::consts::FRAC_PI_2),
            (|x| (x - 0.3).powi(3), 0.0, 1.0, 0.3),
            (|x| (x - 0.9).powi(21), 0.0, 1.0, 0.9),
            (|x| (60.0 * (x - 0.123)).tanh() + 0.0, -1.0, 1.0, 0.123),
            (|x| if x < 0.777 { -1.0 } else { 1e6 }, 0.0, 1.0, 0.777),
        ];
        for (i, (f, a, b, exact)) in cases.into_iter().enumerate() {
            for tolerance in [1e-3, 1e-7, 1e-12] {
                let (x, evaluations) = count(f, a, b, tolerance);
                let bound = ((b - a) / (2.0 * tolerance)).log2().ceil() + 1.0;
                assert!(f64::from(evaluations) <= bound, "case {i}: {evaluations} > {bound}");
                assert!((x - exact).abs() <= tolerance + f64::EPSILON, "case {i}: {x} {exact}");
            }
        }
    }

    #[test]
    fn smooth_functions_are_quick() {
        let (x, evaluations) = count(|x| x.exp() - 3.0, 0.0, 2.0, 1e-13);
        assert!((x - 3.0_f64.ln()).abs() <= 1e-13);
        assert!(evaluations <= 9, "{evaluations}");
    }

    #[test]
    fn bracket_keeps_the_signs_of_its_ends() {
        let f = |x: f64| 0.25 - x * x;
        let (left, right) = bracket(f, 0.0, 2.0, f(0.0), f(2.0), 1e-6);
        assert!(f(left) > 0.0 && f(right) < 0.0 || left == right && f(left) == 0.0);
        assert!(right - left <= 2e-6);
    }

    #[test]
    fn tolerance_below_the_spacing_of_doubles_ends() {
        let (x, evaluations) = count(|t| t - 1_000.000_000_1, 1_000.0, 1_000.001, 0.0);
        assert!((x - 1_000.000_000_1).abs() < 1e-12 && evaluations < 60);
    }

    #[test]
    fn ends_that_are_zero_or_equal_in_sign() {
        assert_eq!(root(|_| f64::NAN, 1.0, 2.0, 0.0, 5.0, 1e-9), 1.0);
        assert_eq!(root(|_| f64::NAN, 1.0, 2.0, 5.0, 0.0, 1e-9), 2.0);
        assert_eq!(root(|_| f64::NAN, 1.0, 2.0, 5.0, 4.0, 1e-9), 2.0);
    }

    #[test]
    fn dip_of_a_parabola_and_of_a_cubic() {
        // (t-0.2)^2 - 0.01 over a step of 0.5: minimum at t = 0.2, that is θ = 0.4.
        let (theta, low) = hermite_dip(0.03, -0.4, 0.08, 0.6, 0.5).unwrap();
        assert!((theta - 0.4).abs() < 1e-15 && (low + 0.01).abs() < 1e-16);
        // t^3 - t on [-1, 1]: minimum -2/(3√3) at 1/√3; its maximum is not taken for one.
        let (theta, low) = hermite_dip(0.0, 2.0, 0.0, 2.0, 2.0).unwrap();
        let x = 1.0 / 3.0_f64.sqrt();
        assert!((theta - 0.5 * (x + 1.0)).abs() < 1e-15 && (low + 2.0 * x / 3.0).abs() < 1e-15);
        // The same upside down.
        let (theta, low) = hermite_dip(0.0, -2.0, 0.0, -2.0, 2.0).unwrap();
        assert!((theta - 0.5 * (1.0 - x)).abs() < 1e-15 && (low + 2.0 * x / 3.0).abs() < 1e-15);
    }

    #[test]
    fn no_dip_in_lines_rises_humps_and_constants() {
        assert_eq!(hermite_dip(1.0, 1.0, 2.0, 1.0, 1.0), None);
        assert_eq!(hermite_dip(1.0, 0.0, 1.0, 0.0, 1.0), None);
        assert_eq!(hermite_dip(0.0, 0.0, 1.0, 2.0, 1.0), None);
        assert_eq!(hermite_dip(1.0, 1.0, 1.0, -1.0, 1.0), None);
        assert_eq!(hermite_dip(f64::NAN, -1.0, 1.0, 1.0, 1.0), None);
    }
}
