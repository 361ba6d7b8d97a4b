//! Gauss–Legendre quadrature with a number of nodes fixed at compile time.

use std::f64::consts::PI;

/// Nodes in (0, 1) and weights of Gauss–Legendre quadrature.
#[derive(Debug, Clone, Copy)]
pub struct Rule<const N: usize> {
    pub(super) nodes: [f64; N],
    pub(super) weights: [f64; N],
}

impl<const N: usize> Default for Rule<N> {
    /// Computes the zeros of the Legendre polynomial by Newton's method.
    fn default() -> Self {
        let [mut nodes, mut weights] = [[0.0; N]; 2];
        for (i, (node, weight)) in nodes.iter_mut().zip(&mut weights).enumerate() {
            let mut x = -math::cos(PI * (i as f64 + 0.75) / (N as f64 + 0.5));
            let mut slope = 0.0;
            for _ in 0..5 {
                let (mut before, mut value) = (1.0, x);
                for k in 2..=N {
                    let k = k as f64;
                    (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
                }
                slope = N as f64 * (x * value - before) / (x * x - 1.0);
                x -= value / slope;
            }
            (*node, *weight) = (0.5 + 0.5 * x, ((1.0 - x * x) * slope * slope).recip());
        }
        Self { nodes, weights }
    }
}
