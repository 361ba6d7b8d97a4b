//! Zeros of a function within a step, found by bracketing.

/// Largest number of iterations: three times the number of bisections that any bracket of `f64` needs.
const MOST: u32 = 3 * 2200;

/// Point (x, y) of a graph.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// Abscissa.
    pub x: f64,
    /// Ordinate.
    pub y: f64,
}

/// Two points of a graph with values of opposite sign, between which the function has a zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// First point.
    pub from: Point,
    /// Second point, on either side of the first.
    pub to: Point,
}

/// Returns a zero of `f` in a bracket. `tolerance` is half the width of the final bracket, in the unit of x; it is at least the spacing of
/// floating-point numbers there.
///
/// The result is the middle of the bracket of [`narrow`], or a point where `f` is exactly zero.
pub fn root(f: impl FnMut(f64) -> f64, bracket: Bracket, tolerance: f64) -> f64 {
    root_near(f, bracket, 0.5, tolerance)
}

/// Returns a zero of `f` in a bracket, like [`root()`]. The search begins at `guess`, a fraction of the bracket.
pub fn root_near(f: impl FnMut(f64) -> f64, bracket: Bracket, guess: f64, tolerance: f64) -> f64 {
    let (left, right) = search(f, bracket, guess, tolerance);
    0.5 * (left + right)
}

/// Narrows a bracket to (left, right), with right - left at most 2·`tolerance` up to rounding. `f(left)` has the sign of the first point
/// and `f(right)` the sign of the second. If `f` is exactly zero at a point, both are this point.
///
/// Uses Chandrupatla's method (Adv. Eng. Softw. 28, 145, 1997): inverse quadratic interpolation if the last three points allow it,
/// otherwise bisection. The method needs at most three times the evaluations of bisection; smooth functions need five to seven.
///
/// A value that is NaN ends the search at its point. For ends of equal sign both results are the end with the smaller magnitude.
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
    // Derivatives of event functions are not exact, so no method with derivatives is used. `new` is the latest point, `old` the
    // end across the zero, `last` the point before.
    let (mut new, mut old) = (bracket.to, bracket.from);
    // Without a finite guess the search begins in the middle.
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
        // A NaN width cannot be narrowed.
        if width.is_nan() || width <= 2.0 * tolerance {
            break;
        }
        // At least the tolerance away from both ends, so that the last step closes the bracket.
        let least = tolerance / width;
        part = inverse_quadratic(new, old, last).clamp(least, 1.0 - least);
    }
    if (new.y > 0.0) == (fa > 0.0) { (new.x, old.x) } else { (old.x, new.x) }
}

/// Returns where the inverse parabola through three points crosses zero, as a fraction from `new` to `old`. If the parabola is not
/// monotone, returns the middle.
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

    /// Returns the bracket between two abscissas.
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
        // Difficult zeros in closed form, as in the ITP paper: flat, steep, multiple, jump.
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
