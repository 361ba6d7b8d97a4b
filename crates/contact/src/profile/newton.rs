//! The inverse of a profile's function where it has none in closed form.

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
