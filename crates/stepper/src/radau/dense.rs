//! Dense output: the interpolating polynomial of degree 5 through the start and the stages.

use super::Radau;
use super::tableau::{NODES, STAGES, Stages};

/// Divided differences c of a component over the start and the nodes: y₀ + s(c₀ + (s-n₀)(c₁ + (s-n₁)(c₂ + …))), with the nodes n of all
/// stages but the last.
pub(super) type Polynomial = Stages;

impl Radau {
    /// Computes the dense output of the attempted step, unless already known. Needs no evaluation.
    pub(super) fn interpolate(&mut self) {
        if self.dense_known {
            return;
        }
        for (c, z) in self.polynomials.iter_mut().zip(&self.z) {
            *c = differences(z);
        }
        self.dense_known = true;
    }

    /// Returns the polynomial of component `i` if the dense output is known.
    pub(super) fn polynomial(&self, i: usize) -> Option<&Polynomial> {
        self.polynomials.get(i).filter(|_| self.dense_known)
    }

    /// Returns the fraction of the attempted step at time t (s), exactly 1 at the end of the step.
    pub(super) fn fraction(&self, t: f64) -> f64 {
        if t == self.extent.target { 1.0 } else { (t - self.extent.time) / self.extent.step }
    }
}

/// Returns the divided differences of values z at the nodes, and of 0 at the start.
fn differences(z: &Stages) -> Polynomial {
    let mut c: Stages = super::lanes(|i| z[i] / NODES[i]);
    for order in 1..STAGES {
        for i in (order..STAGES).rev() {
            c[i] = (c[i] - c[i - 1]) / (NODES[i] - NODES[i - order]);
        }
    }
    c
}

/// Returns the change of a component since the start of the step, at fraction s.
#[inline]
pub(super) fn rise(c: &Polynomial, s: f64) -> f64 {
    let mut value = c[STAGES - 1];
    for i in (0..STAGES - 1).rev() {
        value = c[i] + (s - NODES[i]) * value;
    }
    s * value
}

/// Returns the derivative of the polynomial with respect to s.
pub(super) fn rate(c: &Polynomial, s: f64) -> f64 {
    let (mut value, mut slope) = (c[STAGES - 1], 0.0);
    for i in (0..STAGES - 1).rev() {
        slope = value + (s - NODES[i]) * slope;
        value = c[i] + (s - NODES[i]) * value;
    }
    value + s * slope
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Interpolates s - 3s⁵, with the derivative 1 - 15s⁴, exactly.
    #[test]
    fn polynomials_of_degree_5_are_met() {
        let c = differences(&NODES.map(|s| s - 3.0 * s.powi(5)));
        for s in [0.0, 0.1, 0.5, 0.9, 1.0, 1.1_f64] {
            assert!((rise(&c, s) - (s - 3.0 * s.powi(5))).abs() < 1e-14);
            assert!((rate(&c, s) - (1.0 - 15.0 * s.powi(4))).abs() < 1e-13);
        }
    }
}
