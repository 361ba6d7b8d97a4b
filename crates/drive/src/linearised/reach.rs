//! How long the steps of methods of fixed step may be.

use super::Linearised;
use nalgebra::{Complex, ComplexField};

/// Halvings that find a longest step to the last bit.
// 32 leave a longest step wrong by 3e-10.
const HALVINGS: u32 = 64;

/// How long a step of a fixed length may be, s.
#[derive(Clone, Copy)]
pub(crate) struct Reach {
    /// Until a motion of bodies grows.
    pub(super) motion: fn(&Linearised) -> f64,
    /// Until a state of first order grows that has this eigenvalue, 1/s.
    pub(super) state: fn(&Complex<f64>) -> f64,
}

impl Reach {
    /// Of velocity Verlet.
    pub(crate) const VERLET: Self = Self { motion: Linearised::longest_verlet_step, state: verlet_reach };
    /// Of the classical Runge–Kutta method.
    pub(crate) const RK4: Self = Self { motion: Linearised::longest_rk4_step, state: rk4_reach };
}

/// The longest step with which Runge–Kutta of order 4 keeps x' = `rate` x from growing. In the left half-plane the region
/// of stability is star-shaped, contains the half disc |z| < 2.6 and ends before |z| = 3.
pub(super) fn rk4_reach(rate: &Complex<f64>) -> f64 {
    let growth = |h: f64| {
        let z = rate * h;
        (((z / 4.0 + 1.0) * z / 3.0 + 1.0) * z / 2.0 + 1.0) * z + 1.0
    };
    // The half disc is asked first: near 0 growth differs from 1 by rounding only, and rounding may fall on
    // the wrong side.
    longest(3.0 / rate.modulus(), |h| h * rate.modulus() < 2.6 || growth(h).modulus() <= 1.0)
}

/// The same of velocity Verlet, which steps states of first order as Adams and Bashforth's method of order 2 does: the roots of
/// ξ² - (1 + 3z/2) ξ + z/2 stay in the unit circle, of a decay until z = -1. An eigenvalue that does not decay has no such
/// step; it gets one that resolves it.
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

/// The largest h up to `most` for which `stable` holds, where it holds from 0 up to that.
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
