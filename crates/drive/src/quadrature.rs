//! Gaussian quadrature that tells how far it can be trusted.
//!
//! Time of a swing and of a lift-off is a mean over [0, 1] of a smooth function. Rules of 4, 8, 16 and 32
//! nodes are tried in turn from the first that may do; each tells its error from the last coefficients of the
//! polynomial through its values, without a second rule. Nothing is allocated, and the compiler makes every rule. Over whole arcs
//! from turn to turn the nodes are Chebyshev's, equally spaced in the angle: there the function goes on evenly beyond both ends.

use crate::sine::sine;
use std::array;
use std::f64::consts::PI;

/// Nodes of the finest rule.
// 64 change no run. With 16 drives at a tolerance of 1e-13 take up to a third more evaluations.
const MOST: usize = 32;
/// Errors below which a rule is not worth trying: so smooth are few functions.
// Ten times as large they make a free decay at 1e-9 60 % dearer. A tenth saves some drives a quarter of their evaluations
// there, for errors half as large again.
const HOPELESS: [f64; 3] = [1e-3, 1e-8, 1e-16];
/// How much more than c² is allowed for: of two functions with the same last coefficients one is the rougher.
// 1 saves P1 16 % of its evaluations at 1e-6, for three times the error; 100 costs 51 %, for a sixtieth.
const CAUTION: f64 = 10.0;
/// Newton steps to a node: from Tricomi's guess three reach the last place.
// Two leave P1 at 1e-9 an error of 3.5e-10 u_c instead of 3e-13.
const NEWTON: usize = 4;

/// Values that are asked for together: a function of so many numbers takes hardly longer than one of a single number.
pub(crate) const LANES: usize = 4;

/// Numbers that are worked on together.
pub(crate) type Lanes = [f64; LANES];

/// What they come to.
#[inline(always)]
pub(crate) fn total([a, b, c, d]: Lanes) -> f64 {
    (a + b) + (c + d)
}

/// Four nodes of a rule.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Nodes {
    /// Where in the interval, 0 to 1.
    pub(crate) at: Lanes,
    /// Their shares in the mean, and in the two last Legendre coefficients of the polynomial through all values.
    pub(crate) shares: [Lanes; 3],
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
pub(crate) struct Rule {
    nodes: [Nodes; MOST / LANES],
    count: usize,
}

/// The rules of 4 to 32 nodes, exact for polynomials up to degree 7 to 63.
pub(crate) static RULES: [Rule; 4] = [Rule::new(4), Rule::new(8), Rule::new(16), Rule::new(MOST)];

/// The same over an arc, of Gauss and Chebyshev.
pub(crate) static ARCS: [Rule; 4] = [Rule::arc(4), Rule::arc(8), Rule::arc(16), Rule::arc(MOST)];

/// Mean over the angle θ from 0 to π of a smooth function of sin²(θ/2), as [`mean`] finds it.
#[inline]
pub(crate) fn mean_over_arc(allowed: f64, f: impl Fn(Lanes) -> Lanes) -> Mean {
    first_that_serves(&ARCS, (allowed, allowed), f)
}

/// Mean of a function over [0, 1], by the coarsest rule whose relative error is below `allowed`, or else by the finest.
/// Begins with a rule from which that can be hoped for, where [0, 1] is but a `part` of the range that the function changes
/// over.
#[inline]
pub(crate) fn mean(allowed: f64, part: f64, f: impl Fn(Lanes) -> Lanes) -> Mean {
    // On a part of the range the coefficients fall faster: a coarser rule has the same hope.
    let needed = allowed / (part * part * part * part);
    first_that_serves(&RULES, (allowed, needed), f)
}

/// The rules of which so small an error can be hoped for, the coarsest first.
#[inline(always)]
pub(crate) fn worth_trying(rules: &[Rule; 4], needed: f64) -> std::slice::Iter<'_, Rule> {
    let first = HOPELESS.iter().filter(|hopeless| needed < **hopeless).count();
    rules[first..].iter()
}

/// The mean by the first rule whose error is below `allowed`, beginning where that can be hoped for of what is `needed`.
#[inline(always)]
fn first_that_serves(rules: &[Rule; 4], (allowed, needed): (f64, f64), f: impl Fn(Lanes) -> Lanes) -> Mean {
    let mut mean = Mean { value: f64::NAN, error: f64::INFINITY, asked: 0 };
    for rule in worth_trying(rules, needed) {
        let asked = mean.asked + rule.count as u64;
        // Nodes of Gauss are not nested: nothing of the coarser rule can be used again, but its values are
        // counted.
        mean = Mean { asked, ..rule.mean(&f) };
        if mean.error <= allowed {
            break;
        }
    }
    mean
}

impl Rule {
    /// The rule of n nodes, at most [`MOST`]: zeros of the Legendre polynomial by Newton's method.
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
            // What rounding leaves of the sum of all weights, 1.
            let weight = weight / sum;
            rule.put(i, at, [weight, second * weight, first * weight]);
        }
        rule
    }

    /// The rule of n nodes, at most [`MOST`], in the middle of n equal parts of the angle: exact for cosines up to degree 2n - 1.
    const fn arc(n: usize) -> Self {
        let (mut rule, mut i) = (Self::without_nodes(n), 0);
        let weight = 1.0 / n as f64;
        while i < n {
            // θ = π(2i+1)/(2n); node i lies at sin²(θ/2).
            let half = sine(PI * (2 * i + 1) as f64 / (4 * n) as f64);
            let second = 2.0 * weight * cosine((n - 2) * (2 * i + 1), n);
            let first = 2.0 * weight * cosine((n - 1) * (2 * i + 1), n);
            rule.put(i, half * half, [weight, second, first]);
            i += 1;
        }
        rule
    }

    /// Its nodes, four by four.
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

    /// The mean by this rule. One of n nodes is exact up to degree 2n - 1: where the coefficients of the polynomial through
    /// its values, of degree n - 1, have fallen to c, its own error is about c².
    #[inline(always)]
    fn mean(&self, f: impl Fn(Lanes) -> Lanes) -> Mean {
        let mut sums = [[0.0; LANES]; 3];
        for nodes in self.nodes() {
            // Four at once: roots and quotients of one node do not wait for those of another.
            let y = f(nodes.at);
            sums = array::from_fn(|k| array::from_fn(|i| sums[k][i] + nodes.shares[k][i] * y[i]));
        }
        let [value, second, first] = sums.map(total);
        // Two coefficients: of an even or odd function every other one vanishes.
        let tail = second.abs() + first.abs();
        let error = CAUTION * (tail / value).powi(2);
        Mean { value, error: if value.is_finite() { error } else { f64::INFINITY }, asked: 0 }
    }
}

/// Node `i` of n: where it is, its weight before all are made to sum up, and by how much its shares in the two last
/// Legendre coefficients are larger.
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
    // 1/((1-x²) P'²) does not change with x to first order: what rounding leaves of a node leaves no trace in its weight.
    let slope = count * (first - x * at);
    [
        0.5 + 0.5 * x,
        (1.0 - x * x) / (slope * slope),
        (2.0 * count - 3.0) * second,
        (2.0 * count - 1.0) * first,
    ]
}

/// Legendre polynomials of degrees n - 2, n - 1 and n at x, n ≥ 2.
const fn legendre(n: usize, x: f64) -> [f64; 3] {
    let (mut p, mut degree) = ([0.0, 1.0, x], 2);
    while degree <= n {
        let k = degree as f64;
        p = [p[1], p[2], ((2.0 * k - 1.0) * x * p[2] - (k - 1.0) * p[1]) / k];
        degree += 1;
    }
    p
}

/// cos(πj/(2n)): no angle is rounded that lies beyond a right one.
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
        // ⟨1/(1 + x)⟩ = 1/√2: the estimate holds, and the coarsest rule that serves is taken.
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
