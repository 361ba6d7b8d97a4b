//! Zeros inside a step: bracketed search.

/// Three times the halvings that any bracket of doubles takes.
const MOST: u32 = 3 * 2200;

/// A point (x, y) of a graph.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Where.
    pub x: f64,
    /// The value there.
    pub y: f64,
}

/// Two points of a graph between which it crosses zero: their values have opposite signs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// One of them.
    pub from: Point,
    /// The other one, before or behind it.
    pub to: Point,
}

/// A zero of `f` inside a bracket, to within `tolerance` (half the width of the last bracket, in the unit of x; not
/// below the spacing of doubles there).
///
/// Middle of the bracket that [`narrow`] returns, or its end where `f` is exactly zero.
pub fn root(f: impl FnMut(f64) -> f64, bracket: Bracket, tolerance: f64) -> f64 {
    root_near(f, bracket, 0.5, tolerance)
}

/// The same with the search begun at a `guess`, a fraction of the way through the bracket.
pub fn root_near(f: impl FnMut(f64) -> f64, bracket: Bracket, guess: f64, tolerance: f64) -> f64 {
    let (left, right) = search(f, bracket, guess, tolerance);
    0.5 * (left + right)
}

/// A bracket narrowed to (left, right) with right - left at most 2·`tolerance`: `f(left)` has the sign at its start,
/// `f(right)` that at its end (the width up to rounding), and both are the same point where `f` is exactly zero.
///
/// Chandrupatla's method (Adv. Eng. Softw. 28, 145, 1997): inverse quadratic interpolation where its three points allow
/// it, bisection elsewhere. Bound: three times the evaluations of bisection, counted; smooth functions take five to
/// seven.
///
/// A value that is NaN ends the search at its point. Ends of equal sign are no bracket; the result is then the end
/// with the smaller magnitude, twice.
pub fn narrow(f: impl FnMut(f64) -> f64, bracket: Bracket, tolerance: f64) -> (f64, f64) {
    search(f, bracket, 0.5, tolerance)
}

fn search(mut f: impl FnMut(f64) -> f64, bracket: Bracket, guess: f64, tolerance: f64) -> (f64, f64) {
    let Bracket { from: Point { x: a, y: fa }, to: Point { x: b, y: fb } } = bracket;
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
    // To 1e-12 of the bracket √2, π/2 and ln 3 take 7 evaluations each; bisection takes 39, regula falsi (Illinois) 7 to 9
    // but 107 for the zero of (x - 0.3)³, where this falls back to 39. No method that wants derivatives: guards have none
    // that are exact.
    // `new` is the latest point, `old` the end across the zero, `last` the point before.
    let (mut new, mut old) = (bracket.to, bracket.from);
    // Rates that overflow give no guess.
    let mut part = if guess.is_finite() { 1.0 - guess } else { 0.5 };
    for _ in 0..MOST {
        let x = new.x + part * (old.x - new.x);
        let value = f(x);
        if value == 0.0 || value.is_nan() {
            return (x, x);
        }
        let last = if (value > 0.0) == (new.y > 0.0) { new } else { std::mem::replace(&mut old, new) };
        new = Point { x, y: value };
        let width = (old.x - new.x).abs();
        // Not a number, either, can be narrowed.
        if width.is_nan() || width <= 2.0 * tolerance {
            break;
        }
        // At least the tolerance away from both ends, so that the last step closes the bracket.
        let least = tolerance / width;
        part = inverse_quadratic(new, old, last).clamp(least, 1.0 - least);
    }
    if (new.y > 0.0) == (fa > 0.0) { (new.x, old.x) } else { (old.x, new.x) }
}

/// Where between `new` and `old` (as a part of the way) the inverse parabola through the three points crosses zero, or
/// the middle where it is not monotone.
fn inverse_quadratic(new: Point, old: Point, last: Point) -> f64 {
    let xi = (new.x - old.x) / (last.x - old.x);
    let phi = (new.y - old.y) / (last.y - old.y);
    if !(phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi) {
        return 0.5;
    }
    let first = new.y / (old.y - new.y) * last.y / (old.y - last.y);
    let second = (last.x - new.x) / (old.x - new.x) * new.y / (last.y - new.y) * old.y / (last.y - old.y);
    first + second
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bracket between two places.
    fn between(f: impl Fn(f64) -> f64, a: f64, b: f64) -> Bracket {
        Bracket { from: Point { x: a, y: f(a) }, to: Point { x: b, y: f(b) } }
    }

    fn count(f: impl Fn(f64) -> f64, a: f64, b: f64, tolerance: f64) -> (f64, u32) {
        let mut evaluations = 0;
        let x = root(
            |x| {
                evaluations += 1;
                f(x)
            },
            between(&f, a, b),
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
        let (left, right) = narrow(f, between(f, 0.0, 2.0), 1e-6);
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
        let ends = |fa: f64, fb: f64| {
            let bracket = Bracket { from: Point { x: 1.0, y: fa }, to: Point { x: 2.0, y: fb } };
            root(|_| f64::NAN, bracket, 1e-9)
        };
        assert_eq!(ends(0.0, 5.0), 1.0);
        assert_eq!(ends(5.0, 0.0), 2.0);
        assert_eq!(ends(5.0, 4.0), 2.0);
    }
}
