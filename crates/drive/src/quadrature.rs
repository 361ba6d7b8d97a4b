//! Gauss–Legendre quadrature that tells how far it can be trusted.

use std::sync::LazyLock;

/// Nodes of the coarsest rule; each next one has twice as many.
const COARSEST: usize = 4;
/// Number of rules: 4, 8, 16 and 32 nodes.
const RULES: usize = 4;
/// Errors below which a rule is not worth trying: so smooth are few functions.
const HOPELESS: [f64; RULES - 1] = [1e-3, 1e-8, 1e-16];
/// How much more than c² is allowed for: of two functions with the same last coefficients one is the rougher.
const CAUTION: f64 = 10.0;
/// Newton steps to a node: from Tricomi's guess three reach the last place.
const NEWTON: usize = 4;

/// The rules of 4 to 32 nodes, exact for polynomials up to degree 7 to 63.
#[derive(Debug, Clone)]
pub(crate) struct Gauss {
    rules: Vec<Vec<Node>>,
}

/// A node of one rule.
#[derive(Debug, Clone, Copy)]
struct Node {
    /// Where in the interval, 0 to 1.
    at: f64,
    /// Its share in the mean.
    weight: f64,
    /// Its shares in the two last Legendre coefficients of the polynomial through all values.
    last: [f64; 2],
}

/// A mean, and what is known about its error.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mean {
    pub(crate) value: f64,
    /// Estimate of its relative error.
    pub(crate) error: f64,
    /// Values that were asked for.
    pub(crate) asked: u64,
}

/// The rules, made at the first run that asks for them.
pub(crate) static GAUSS: LazyLock<Gauss> = LazyLock::new(Gauss::new);

impl Gauss {
    fn new() -> Self {
        Self { rules: (0..RULES).map(|level| rule(COARSEST << level)).collect() }
    }

    /// Mean of a function over [0, 1], by the coarsest rule whose relative error is below `allowed`, or else by the finest.
    /// Begins with a rule from which that can be hoped for, where [0, 1] is but a `part` of the range that the function
    /// changes over.
    #[inline]
    pub(crate) fn mean(&self, allowed: f64, part: f64, f: impl Fn(f64) -> f64) -> Mean {
        let needed = allowed / (part * part * part * part);
        let first = HOPELESS.iter().filter(|hopeless| needed < **hopeless).count();
        let mut mean = Mean { value: f64::NAN, error: f64::INFINITY, asked: 0 };
        for rule in &self.rules[first..] {
            let asked = mean.asked + rule.len() as u64;
            mean = Mean { asked, ..judged(rule, &f) };
            if mean.error <= allowed {
                break;
            }
        }
        mean
    }
}

/// The mean by one rule. The rule of n nodes is exact up to degree 2n - 1: where the coefficients of the polynomial
/// through its values, of degree n - 1, have fallen to c, its own error is about c².
fn judged(rule: &[Node], f: impl Fn(f64) -> f64) -> Mean {
    let (mut value, mut last) = (0.0, [0.0; 2]);
    for node in rule {
        let y = f(node.at);
        value += node.weight * y;
        last[0] += node.last[0] * y;
        last[1] += node.last[1] * y;
    }
    let tail = last[0].abs() + last[1].abs();
    let error = CAUTION * (tail / value).powi(2);
    Mean { value, error: if value.is_finite() { error } else { f64::INFINITY }, asked: 0 }
}

/// Nodes and weights of the rule of n nodes: zeros of the Legendre polynomial by Newton's method.
fn rule(n: usize) -> Vec<Node> {
    let count = n as f64;
    let node = |i: usize| {
        let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (count + 0.5)).cos();
        for _ in 0..NEWTON {
            let [_, before, at] = legendre(n, x);
            x -= at * (x * x - 1.0) / (count * (x * at - before));
        }
        let [second, first, _] = legendre(n, x);
        let weight = (1.0 - x * x) / (count * first).powi(2);
        Node { at: 0.5 + 0.5 * x, weight, last: [(2.0 * count - 1.0) * first, (2.0 * count - 3.0) * second] }
    };
    let mut nodes: Vec<Node> = (0..n).map(node).collect();
    // What rounding leaves of the sum of all weights, 1.
    let sum: f64 = nodes.iter().map(|node| node.weight).sum();
    for node in &mut nodes {
        node.weight /= sum;
        node.last = node.last.map(|last| last * node.weight);
    }
    nodes
}

/// Legendre polynomials of degrees n - 2, n - 1 and n at x, n ≥ 2.
fn legendre(n: usize, x: f64) -> [f64; 3] {
    let mut p = [0.0, 1.0, x];
    for k in 2..=n {
        let k = k as f64;
        p = [p[1], p[2], ((2.0 * k - 1.0) * x * p[2] - (k - 1.0) * p[1]) / k];
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_the_degree_of_each_rule_are_exact() {
        let gauss = Gauss::new();
        for (level, rule) in gauss.rules.iter().enumerate() {
            let degree = 2 * (COARSEST << level) - 1;
            for power in 0..=degree as i32 {
                let exact = 1.0 / f64::from(power + 1);
                let mean = judged(rule, |x| x.powi(power)).value;
                assert!((mean - exact).abs() < 2e-15, "{level} {power}: {mean} {exact}");
            }
            let beyond = judged(rule, |x| x.powi(degree as i32 + 1)).value;
            assert!(level > 1 || (beyond - 1.0 / (degree as f64 + 2.0)).abs() > 1e-14);
        }
    }

    #[test]
    fn the_error_is_below_its_estimate() {
        // ∫₀¹ dx/(1 + (x/w)²) = w atan(1/w), poles at ±iw.
        let gauss = Gauss::new();
        for width in [0.3, 1.0, 3.0] {
            for rule in &gauss.rules {
                let mean = judged(rule, |x: f64| 1.0 / (1.0 + (x / width).powi(2)));
                let error = (mean.value - width * (1.0 / width).atan()).abs();
                assert!(
                    error <= mean.value * mean.error.max(1e-15),
                    "{width} {}: {error} {}",
                    rule.len(),
                    mean.error
                );
            }
        }
    }

    #[test]
    fn the_coarsest_rule_that_serves_is_taken() {
        let mean = |allowed: f64| GAUSS.mean(allowed, 1.0, |x| 1.0 / (1.0 + x * x));
        assert_eq!([1e-1, 1e-5, 1e-9].map(|allowed| mean(allowed).asked), [4, 8, 16]);
        assert!(
            GAUSS.mean(1e-12, 1.0, |x| x.sqrt()).error > 1e-12,
            "no rule serves a root at its branch point"
        );
    }
}
