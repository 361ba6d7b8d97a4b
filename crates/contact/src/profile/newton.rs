//! Numerical inverse of an increasing function, by Newton's method. For functions that are not convex, a bracket is used.

/// Largest number of steps; usually three to six are needed.
const STEPS: usize = 60;

/// Relative step at which the iteration ends; with quadratic convergence the next step would be negligible.
// At a border the order of convergence is 1.5, and the error is then 3e-17.
const ENOUGH: f64 = 1e-11;

/// Returns the x > 0 at which an increasing, convex function has the value `wanted` > 0.
///
/// `at` returns value and slope. Newton's method starts at `start` > 0. After the first step the iterates decrease monotonically. A
/// step reduces x by at most three quarters, so that the iteration also ends for a poor start.
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

/// Returns the zero in [0, 1] of an increasing function; 0 or 1 if there is no zero in between.
///
/// `at` returns value and slope. Newton's method is combined with bisection, which replaces steps that leave the bracket.
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
