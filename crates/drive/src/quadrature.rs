//! Gauss–Legendre quadrature that tells how far it can be trusted.

use std::sync::LazyLock;

/// Nodes of the finest rule.
const MOST: usize = 32;
/// Errors below which a rule is not worth trying: so smooth are few functions.
const HOPELESS: [f64; 3] = [1e-3, 1e-8, 1e-16];
/// How much more than c² is allowed for: of two functions with the same last coefficients one is the rougher.
const CAUTION: f64 = 10.0;
/// Newton steps to a node: from Tricomi's guess three reach the last place.
const NEWTON: usize = 4;

/// A node of one rule.
#[derive(Debug, Clone, Copy, Default)]
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

/// The nodes of one rule; those beyond its number are of no meaning.
struct Rule {
    nodes: [Node; MOST],
    count: usize,
}

/// The rules of 4 to 32 nodes, exact for polynomials up to degree 7 to 63, each made when it is asked for first.
static RULES: [LazyLock<Rule>; 4] = [
    LazyLock::new(|| Rule::new(4)),
    LazyLock::new(|| Rule::new(8)),
    LazyLock::new(|| Rule::new(16)),
    LazyLock::new(|| Rule::new(MOST)),
];

/// Mean of a function over [0, 1], by the coarsest rule whose relative error is below `allowed`, or else by the finest.
/// Begins with a rule from which that can be hoped for, where [0, 1] is but a `part` of the range that the function changes
/// over.
#[inline]
pub(crate) fn mean(allowed: f64, part: f64, f: impl Fn(f64) -> f64) -> Mean {
    let needed = allowed / (part * part * part * part);
    let first = HOPELESS.iter().filter(|hopeless| needed < **hopeless).count();
    let mut mean = Mean { value: f64::NAN, error: f64::INFINITY, asked: 0 };
    for rule in &RULES[first..] {
        let asked = mean.asked + rule.count as u64;
        mean = Mean { asked, ..rule.mean(&f) };
        if mean.error <= allowed {
            break;
        }
    }
    mean
}

impl Rule {
    /// The rule of n nodes, at most [`MOST`]: zeros of the Legendre polynomial by Newton's method.
    fn new(n: usize) -> Self {
        let mut nodes = [Node::default(); MOST];
        for (i, node) in nodes[..n].iter_mut().enumerate() {
            *node = Node::new(n, i);
        }
        // What rounding leaves of the sum of all weights, 1.
        let sum: f64 = nodes.iter().map(|node| node.weight).sum();
        for node in &mut nodes {
            node.weight /= sum;
            node.last = node.last.map(|last| last * node.weight);
        }
        Self { nodes, count: n }
    }

    /// The mean by this rule. One of n nodes is exact up to degree 2n - 1: where the coefficients of the polynomial through
    /// its values, of degree n - 1, have fallen to c, its own error is about c².
    fn mean(&self, f: impl Fn(f64) -> f64) -> Mean {
        let (mut value, mut last) = (0.0, [0.0; 2]);
        for node in &self.nodes[..self.count] {
            let y = f(node.at);
            value += node.weight * y;
            last[0] += node.last[0] * y;
            last[1] += node.last[1] * y;
        }
        let tail = last[0].abs() + last[1].abs();
        let error = CAUTION * (tail / value).powi(2);
        Mean { value, error: if value.is_finite() { error } else { f64::INFINITY }, asked: 0 }
    }
}

impl Node {
    /// Node `i` of n; its weight and shares before they are made to sum up.
    fn new(n: usize, i: usize) -> Self {
        let count = n as f64;
        let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (count + 0.5)).cos();
        for _ in 0..NEWTON {
            let [_, before, at] = legendre(n, x);
            x -= at * (x * x - 1.0) / (count * (x * at - before));
        }
        let [second, first, _] = legendre(n, x);
        let weight = (1.0 - x * x) / (count * first).powi(2);
        Self { at: 0.5 + 0.5 * x, weight, last: [(2.0 * count - 1.0) * first, (2.0 * count - 3.0) * second] }
    }
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
        for (level, rule) in RULES.iter().enumerate() {
            let degree = 2 * rule.count - 1;
            for power in 0..=degree as i32 {
                let exact = 1.0 / f64::from(power + 1);
                let mean = rule.mean(|x| x.powi(power)).value;
                assert!((mean - exact).abs() < 2e-15, "{level} {power}: {mean} {exact}");
            }
            let beyond = rule.mean(|x| x.powi(degree as i32 + 1)).value;
            assert!(level > 1 || (beyond - 1.0 / (degree as f64 + 2.0)).abs() > 1e-14);
        }
    }

    #[test]
    fn the_error_is_below_its_estimate() {
        // ∫₀¹ dx/(1 + (x/w)²) = w atan(1/w), poles at ±iw.
        for width in [0.3, 1.0, 3.0] {
            for rule in &RULES {
                let mean = rule.mean(|x: f64| 1.0 / (1.0 + (x / width).powi(2)));
                let error = (mean.value - width * (1.0 / width).atan()).abs();
                assert!(
                    error <= mean.value * mean.error.max(1e-15),
                    "{width} {}: {error} {}",
                    rule.count,
                    mean.error
                );
            }
        }
    }

    #[test]
    fn the_coarsest_rule_that_serves_is_taken() {
        let asked = |allowed: f64| mean(allowed, 1.0, |x| 1.0 / (1.0 + x * x));
        assert_eq!([1e-1, 1e-5, 1e-9].map(|allowed| asked(allowed).asked), [4, 8, 16]);
        assert!(mean(1e-12, 1.0, |x| x.sqrt()).error > 1e-12, "no rule serves a root at its branch point");
    }
}
