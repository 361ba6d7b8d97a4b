//! Quadrature rule of Gauss's method: nodes, weights, and integrals of the interpolant of slopes.

use super::{Each, NODES};
use std::array;
use std::sync::LazyLock;

/// Gauss–Legendre nodes in [-1, 1], and half their weights.
pub(super) const PLACES: Each =
    [-0.906_179_845_938_664, -0.538_469_310_105_683_1, 0.0, 0.538_469_310_105_683_1, 0.906_179_845_938_664];
pub(super) const SHARES: Each = [
    0.118_463_442_528_094_54,
    0.239_314_335_249_683_24,
    0.284_444_444_444_444_44,
    0.239_314_335_249_683_24,
    0.118_463_442_528_094_54,
];

pub(super) fn dot(a: &[f64], b: &Each) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Coefficients of the method over [0, 1].
pub(super) struct Rule {
    /// Legendre polynomials at the nodes.
    values: [[f64; NODES + 1]; NODES],
    /// Coefficients a_ij: integral of the interpolated slopes from the start to each node.
    pub(super) inner: [Each; NODES],
    /// Weights that give the Legendre coefficients 1 to 4 of a function from its values at the nodes.
    tail: [Each; NODES - 1],
    /// Weights of all integrals for an even step of length 1.
    even: Reach,
}

/// Returns the Legendre polynomials at x.
fn legendre(x: f64) -> [f64; NODES + 1] {
    let mut values = [1.0, x, 0.0, 0.0, 0.0, 0.0];
    for k in 1..NODES {
        let n = k as f64;
        values[k + 1] = ((2.0 * n + 1.0) * x * values[k] - n * values[k - 1]) / (n + 1.0);
    }
    values
}

impl Rule {
    /// Returns the weights of the slopes in the integral from -1 to x, scaled to [0, 1]: a_j = b_j Σ (2k + 1) P_k(c_j) ∫P_k.
    pub(super) fn row(&self, x: f64) -> Each {
        let ends = legendre(x);
        let integral = |k: usize| if k == 0 { x + 1.0 } else { ends[k + 1] - ends[k - 1] };
        let integrals: Each = array::from_fn(integral);
        array::from_fn(|j| 0.5 * SHARES[j] * dot(&self.values[j], &integrals))
    }
}

pub(super) static RULE: LazyLock<Rule> = LazyLock::new(|| {
    let values = PLACES.map(legendre);
    let tail = array::from_fn(|k| {
        let order = k + 1;
        array::from_fn(|j| (2.0 * order as f64 + 1.0) * SHARES[j] * values[j][order])
    });
    let mut rule = Rule { values, inner: [[0.0; NODES]; NODES], tail, even: Reach::default() };
    rule.inner = PLACES.map(|x| rule.row(x));
    rule.even = Reach::by(&rule, [1.0; NODES]);
    rule
});

/// Weights of the slopes in the single and double time integrals, from the start to each node and to the end of the step.
#[derive(Debug, Clone, Default)]
pub(super) struct Reach {
    pub(super) paces: Each,
    pub(super) once: [Each; NODES],
    pub(super) twice: [Each; NODES],
    /// Time from the start to each node, and length of the step, s.
    pub(super) time: Each,
    pub(super) length: f64,
    pub(super) end_once: Each,
    pub(super) end_twice: Each,
    pub(super) tail: [Each; NODES - 1],
}

impl Reach {
    pub(super) fn of(paces: Each) -> Self {
        let (rule, [pace, ..]) = (&*RULE, paces);
        if paces.iter().all(|other| *other == pace) {
            return rule.even.times(pace);
        }
        Self::by(rule, paces)
    }

    /// Returns the weights of an even step whose length is `pace` times the length of this step.
    fn times(&self, pace: f64) -> Self {
        let once = |row: &Each| row.map(|a| pace * a);
        let twice = |row: &Each| row.map(|a| pace * pace * a);
        Self {
            paces: once(&self.paces),
            once: self.once.each_ref().map(once),
            twice: self.twice.each_ref().map(twice),
            time: once(&self.time),
            length: pace * self.length,
            end_once: once(&self.end_once),
            end_twice: twice(&self.end_twice),
            tail: self.tail.each_ref().map(once),
        }
    }

    fn by(rule: &Rule, paces: Each) -> Self {
        let once: [Each; NODES] = array::from_fn(|i| array::from_fn(|j| rule.inner[i][j] * paces[j]));
        let end_once: Each = array::from_fn(|j| SHARES[j] * paces[j]);
        let after =
            |first: &Each| -> Each { array::from_fn(|j| (0..NODES).map(|k| first[k] * once[k][j]).sum()) };
        Self {
            twice: array::from_fn(|i| after(&once[i])),
            end_twice: after(&end_once),
            time: array::from_fn(|i| once[i].iter().sum()),
            length: end_once.iter().sum(),
            tail: rule.tail.map(|row| array::from_fn(|j| row[j] * paces[j])),
            once,
            end_once,
            paces,
        }
    }
}
