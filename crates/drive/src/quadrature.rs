//! Gaussian quadrature with an error estimate.
//!
//! The time of an oscillation or a lift-off is a mean of a smooth function over [0, 1]. Rules with 4, 8, 16 and 32 nodes are tried in
//! order. Each rule estimates its error from the last coefficients of the interpolating polynomial. Rules are compile-time constants.
//! Between two turning points the function is periodic in an angle, so equally spaced Gauss–Chebyshev nodes are used.

use crate::sine::sine;
use std::f64::consts::PI;

/// Number of nodes of the finest rule.
const MOST: usize = 32;
/// Requested errors below which rules with 4, 8 and 16 nodes are not tried.
const HOPELESS: [f64; 3] = [1e-3, 1e-8, 1e-16];
/// Safety factor of the error estimate c².
const CAUTION: f64 = 10.0;
/// Number of Newton steps to a node; three steps from Tricomi's approximation reach rounding.
const NEWTON: usize = 4;

/// Number of values that are evaluated together (SIMD).
pub(crate) const LANES: usize = 4;

/// Values that are evaluated together.
pub(crate) type Lanes = [f64; LANES];

/// Returns a function of every lane.
// The loops of this and the next function are inlined in every build; those of `map` and `from_fn` of arrays only if crates are optimised
// together.
#[inline(always)]
pub(crate) fn each<const L: usize>(mut of: [f64; L], f: impl Fn(f64) -> f64) -> [f64; L] {
    let mut i = 0;
    while i < L {
        of[i] = f(of[i]);
        i += 1;
    }
    of
}

/// Returns lanes by their index.
#[inline(always)]
pub(crate) fn lanes<const L: usize>(f: impl Fn(usize) -> f64) -> [f64; L] {
    let mut made = [0.0; L];
    let mut i = 0;
    while i < L {
        made[i] = f(i);
        i += 1;
    }
    made
}

/// Returns their sum.
#[inline(always)]
pub(crate) fn total([a, b, c, d]: Lanes) -> f64 {
    (a + b) + (c + d)
}

/// Four nodes of a rule.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Nodes {
    /// Positions in the interval, 0 to 1.
    pub(crate) at: Lanes,
    /// Weights of the mean, and weights of the last two Legendre coefficients of the interpolating polynomial.
    pub(crate) shares: [Lanes; 3],
}

/// A mean and its error estimate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mean {
    pub(crate) value: f64,
    /// Estimated relative error.
    pub(crate) error: f64,
    /// Number of evaluations.
    pub(crate) asked: u64,
}

/// Nodes of a rule; entries beyond `count` are unused.
pub(crate) struct Rule {
    nodes: [Nodes; MOST / LANES],
    count: usize,
}

/// Gauss–Legendre rules with 4 to 32 nodes, exact for polynomials up to degree 7 to 63.
pub(crate) static RULES: [Rule; 4] = [Rule::new(4), Rule::new(8), Rule::new(16), Rule::new(MOST)];

/// Gauss–Chebyshev rules with 4 to 32 nodes.
pub(crate) static ARCS: [Rule; 4] = [Rule::arc(4), Rule::arc(8), Rule::arc(16), Rule::arc(MOST)];

/// Returns the mean over the angle θ from 0 to π of a smooth function of sin²(θ/2), with the rule chosen as in [`mean`].
#[inline]
pub(crate) fn mean_over_arc(allowed: f64, f: impl Fn(Lanes) -> Lanes) -> Mean {
    first_that_serves(&ARCS, (allowed, allowed), f)
}

/// Returns the mean of a function over [0, 1] by the coarsest rule whose relative error is below `allowed`, or by the finest.
///
/// `part` is the length of [0, 1] relative to the range over which the function changes; it determines the first rule tried.
#[inline]
pub(crate) fn mean(allowed: f64, part: f64, f: impl Fn(Lanes) -> Lanes) -> Mean {
    // On a part of the range the coefficients decrease faster.
    let needed = allowed / (part * part * part * part);
    first_that_serves(&RULES, (allowed, needed), f)
}

/// Returns the rules that may reach an error, the coarsest first.
#[inline(always)]
pub(crate) fn worth_trying(rules: &[Rule; 4], needed: f64) -> std::slice::Iter<'_, Rule> {
    let first = HOPELESS.iter().filter(|hopeless| needed < **hopeless).count();
    rules[first..].iter()
}

/// Returns the mean by the first rule whose error is below `allowed`, starting with the first that may reach `needed`.
#[inline(always)]
fn first_that_serves(rules: &[Rule; 4], (allowed, needed): (f64, f64), f: impl Fn(Lanes) -> Lanes) -> Mean {
    let mut mean = Mean { value: f64::NAN, error: f64::INFINITY, asked: 0 };
    for rule in worth_trying(rules, needed) {
        let asked = mean.asked + rule.count as u64;
        // Gauss nodes are not nested, so all evaluations count.
        mean = Mean { asked, ..rule.mean(&f) };
        if mean.error <= allowed {
            break;
        }
    }
    mean
}

impl Rule {
    /// Returns the Gauss–Legendre rule of n nodes, at most [`MOST`], by Newton's method.
    const fn new(n: usize) -> Self {
        let (mut made, mut sum, mut i) = ([[0.0; 4]; MOST], 0.0, 0);
        while i < n {
            made[i] = node(n, i);
            sum += made[i][1];
            i += 1;
        }
        let mut rule = Self::without_nodes(n);
        while i > 0 {
            i -= 1;
            let [at, weight, second, first] = made[i];
            // Normalises the weights to the sum 1.
            let weight = weight / sum;
            rule.put(i, at, [weight, second * weight, first * weight]);
        }
        rule
    }

    /// Returns the Gauss–Chebyshev rule of n nodes, at most [`MOST`], exact for cosines up to degree 2n - 1.
    const fn arc(n: usize) -> Self {
        let (mut rule, mut i) = (Self::without_nodes(n), 0);
        let weight = 1.0 / n as f64;
        while i < n {
            // θ = π(2i+1)/(2n); node i is at sin²(θ/2).
            let half = sine(PI * (2 * i + 1) as f64 / (4 * n) as f64);
            let second = 2.0 * weight * cosine((n - 2) * (2 * i + 1), n);
            let first = 2.0 * weight * cosine((n - 1) * (2 * i + 1), n);
            rule.put(i, half * half, [weight, second, first]);
            i += 1;
        }
        rule
    }

    /// Returns the nodes of the rule in groups of four.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = &Nodes> {
        self.nodes[..self.count / LANES].iter()
    }

    const fn without_nodes(count: usize) -> Self {
        Self { nodes: [Nodes { at: [0.0; LANES], shares: [[0.0; LANES]; 3] }; MOST / LANES], count }
    }

    const fn put(&mut self, i: usize, at: f64, [mean, second, first]: [f64; 3]) {
        let (nodes, lane) = (&mut self.nodes[i / LANES], i % LANES);
        nodes.at[lane] = at;
        nodes.shares[0][lane] = mean;
        nodes.shares[1][lane] = second;
        nodes.shares[2][lane] = first;
    }

    /// Returns the mean by this rule. A rule of n nodes is exact up to degree 2n - 1. If the coefficients of the interpolating polynomial
    /// have decreased to c, the error of the mean is about c².
    #[inline(always)]
    fn mean(&self, f: impl Fn(Lanes) -> Lanes) -> Mean {
        let mut sums = [[0.0; LANES]; 3];
        for nodes in self.nodes() {
            // Four nodes are evaluated together.
            let y = f(nodes.at);
            for (sums, shares) in sums.iter_mut().zip(&nodes.shares) {
                *sums = lanes(|i| sums[i] + shares[i] * y[i]);
            }
        }
        let [value, second, first] = [total(sums[0]), total(sums[1]), total(sums[2])];
        // Two coefficients, because every second one of an even or odd function vanishes.
        let tail = second.abs() + first.abs();
        let error = CAUTION * (tail / value).powi(2);
        Mean { value, error: if value.is_finite() { error } else { f64::INFINITY }, asked: 0 }
    }
}

/// Returns, for node `i` of n, its position, unnormalised weight and factors of the last two Legendre coefficients.
const fn node(n: usize, i: usize) -> [f64; 4] {
    let (count, mut steps) = (n as f64, 0);
    // Tricomi's guess.
    let mut x = -cosine(4 * i + 3, 2 * n + 1);
    while steps < NEWTON {
        let [_, before, at] = legendre(n, x);
        x -= at * (x * x - 1.0) / (count * (x * at - before));
        steps += 1;
    }
    let [second, first, at] = legendre(n, x);
    // 1/((1-x²) P'²) is stationary in x, so rounding of a node hardly affects its weight.
    let slope = count * (first - x * at);
    [
        0.5 + 0.5 * x,
        (1.0 - x * x) / (slope * slope),
        (2.0 * count - 3.0) * second,
        (2.0 * count - 1.0) * first,
    ]
}

/// Returns the Legendre polynomials of degrees n - 2, n - 1 and n at x, n ≥ 2.
const fn legendre(n: usize, x: f64) -> [f64; 3] {
    let (mut p, mut degree) = ([0.0, 1.0, x], 2);
    while degree <= n {
        let k = degree as f64;
        p = [p[1], p[2], ((2.0 * k - 1.0) * x * p[2] - (k - 1.0) * p[1]) / k];
        degree += 1;
    }
    p
}

/// Returns cos(πj/(2n)), reducing the angle to the first quadrant.
const fn cosine(j: usize, n: usize) -> f64 {
    let j = j % (4 * n);
    let j = if j > 2 * n { 4 * n - j } else { j };
    let right = PI / (2 * n) as f64;
    if j > n { -sine(right * (j - n) as f64) } else { sine(right * (n - j) as f64) }
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
                let mean = rule.mean(|x| x.map(|x| x.powi(power))).value;
                assert!((mean - exact).abs() < 2e-15, "{level} {power}: {mean} {exact}");
            }
            let beyond = rule.mean(|x| x.map(|x| x.powi(degree as i32 + 1))).value;
            assert!(level > 1 || (beyond - 1.0 / (degree as f64 + 2.0)).abs() > 1e-14);
        }
    }

    /// Means of x^m over the angle are Wallis' products, (1/2)(3/4)…((2m-1)/(2m)).
    #[test]
    fn arcs_are_exact_up_to_the_degree_of_each_rule() {
        for rule in &ARCS {
            for degree in 0..2 * rule.count as i32 {
                let exact: f64 = (1..=degree).map(|k| 1.0 - 0.5 / f64::from(k)).product();
                let mean = rule.mean(|x| x.map(|x| x.powi(degree))).value;
                assert!((mean - exact).abs() < 2e-15, "{} {degree}: {mean} {exact}", rule.count);
            }
        }
        // ⟨1/(1 + x)⟩ = 1/√2.
        for (allowed, count) in [(1e-1, 4), (1e-7, 8), (1e-12, 16)] {
            let mean = mean_over_arc(allowed, |x| x.map(|x| (1.0 + x).recip()));
            let off = (mean.value * 2.0_f64.sqrt() - 1.0).abs();
            assert!(
                off <= mean.error.max(4e-16) && mean.error <= allowed && mean.asked == count,
                "{mean:?} {off:e}"
            );
        }
    }

    #[test]
    fn the_error_is_below_its_estimate() {
        // ∫₀¹ dx/(1 + (x/w)²) = w atan(1/w), poles at ±iw.
        for width in [0.3, 1.0, 3.0] {
            for rule in &RULES {
                let mean = rule.mean(|x| x.map(|x| 1.0 / (1.0 + (x / width).powi(2))));
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
        let asked = |allowed: f64| mean(allowed, 1.0, |x| x.map(|x| 1.0 / (1.0 + x * x)));
        assert_eq!([1e-1, 1e-5, 1e-9].map(|allowed| asked(allowed).asked), [4, 8, 16]);
        assert!(
            mean(1e-12, 1.0, |x| x.map(f64::sqrt)).error > 1e-12,
            "no rule serves a root at its branch point"
        );
    }
}
