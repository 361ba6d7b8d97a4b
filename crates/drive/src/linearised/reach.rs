//! Stability limits of fixed-step methods.

use super::Linearised;
use nalgebra::{Complex, ComplexField};

/// Number of bisections for a stability limit, to the last bit.
const HALVINGS: u32 = 64;

/// Stability limits of a method, s.
#[derive(Clone, Copy)]
pub(crate) struct Reach {
    /// Limit for the motion of bodies with a largest angular frequency, rad/s.
    pub(super) motion: fn(&Linearised, f64) -> f64,
    /// Limit for a first-order state with this eigenvalue, 1/s.
    pub(super) state: fn(&Complex<f64>) -> f64,
}

impl Reach {
    /// Limits of velocity Verlet.
    pub(crate) const VERLET: Self = Self { motion: Linearised::longest_verlet_step, state: verlet_reach };
    /// Limits of the classical Runge–Kutta method.
    pub(crate) const RK4: Self = Self { motion: Linearised::longest_rk4_step, state: rk4_reach };
}

/// Returns the largest step of the classical Runge–Kutta method for which x' = `rate` x does not grow, s. In the left half-plane the
/// stability region is star-shaped, contains the half disc |z| < 2.6 and lies within |z| = 3.
pub(super) fn rk4_reach(rate: &Complex<f64>) -> f64 {
    let growth = |h: f64| {
        let z = rate * h;
        (((z / 4.0 + 1.0) * z / 3.0 + 1.0) * z / 2.0 + 1.0) * z + 1.0
    };
    // Near 0 the growth factor differs from 1 by rounding only, so the half disc is tested first.
    longest(3.0 / rate.modulus(), |h| h * rate.modulus() < 2.6 || growth(h).modulus() <= 1.0)
}

/// Returns the longest stable step of velocity Verlet for a first-order state, s; the method is then Adams–Bashforth of order 2. The roots
/// of ξ² - (1 + 3z/2) ξ + z/2 must be in the unit circle: for a real decay, z ≥ -1. For a growing state the limit is 1/|λ|.
fn verlet_reach(rate: &Complex<f64>) -> f64 {
    let most = 1.0 / rate.modulus();
    if rate.re >= 0.0 {
        return most;
    }
    longest(most, |h| {
        let z = rate * h;
        let half = (z * 1.5 + 1.0) / 2.0;
        let root = ComplexField::sqrt(half * half - z / 2.0);
        (half + root).modulus().max((half - root).modulus()) <= 1.0 + f64::EPSILON
    })
}

/// Returns the largest h up to `most` for which `stable` holds, if the stable values are an interval from 0.
pub(super) fn longest(most: f64, stable: impl Fn(f64) -> bool) -> f64 {
    let (mut good, mut bad) = (0.0, most);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (good + bad);
        if stable(middle) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    good
}
