//! The inverse of a profile's function where it has none in closed form: of a convex one from a start, of any other that rises in a
//! bracket.

/// Most steps; what converges takes three to six.
const STEPS: usize = 60;

/// Relative step at which the search ends: the next one, by quadratic convergence, would change nothing.
// At a border the second derivative of g has a root singularity and the order falls to 1.5: 1e-11 still leaves 3e-17.
const ENOUGH: f64 = 1e-11;

/// The x > 0 at which a rising, convex function takes the value `wanted` > 0, from a start above 0; `at` gives value and slope.
///
/// Newton's method: the first step leads beyond the root of a convex function, and from there they descend on it. None may take
/// more than three quarters away, so that a start far off ends all the same.
pub(super) fn root(wanted: f64, start: f64, at: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut x = start;
    for _ in 0..STEPS {
        let (value, slope) = at(x);
        let step = (value - wanted) / slope;
        if !step.is_finite() {
            break;
        }
        x = (x - step).max(0.25 * x);
        if step.abs() <= ENOUGH * x {
            break;
        }
    }
    x
}

/// The s in [0, 1] at which a function that rises is 0, from a guess; `at` gives value and slope. 0 or 1 where it has no root between.
///
/// Newton's method inside a bracket: seldom more than four steps, and halves where a slope is none or leads out of it.
#[inline]
pub(super) fn between(guess: f64, at: impl Fn(f64) -> (f64, f64)) -> f64 {
    const HALVES: usize = 80;
    let (mut low, mut high) = (0.0, 1.0);
    let mut s = if guess > 0.0 && guess < 1.0 { guess } else { 0.5 };
    for _ in 0..HALVES {
        let (error, slope) = at(s);
        if error > 0.0 {
            high = s;
        } else {
            low = s;
        }
        let next = s - error / slope;
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        let step = (next - s).abs();
        s = next;
        if step <= 2.0 * f64::EPSILON * s {
            break;
        }
    }
    s
}
