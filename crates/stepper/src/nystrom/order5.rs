//! Nyström's method of order 5, for steps that something near will end.
//!
//! Source: E. J. Nyström, *Über die numerische Integration von Differentialgleichungen*, Acta Soc. Sci. Fennicae 50 (1925) No. 13;
//! E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., Springer 1993, table II.14.2.
//!
//! Four stages and the acceleration at the end, which is the first one of the next step: four evaluations, or five after a jump,
//! where order 8 takes eight or nine. The dense output costs none where that costs four more: positions by the polynomial of
//! degree 5 with the places, velocities and accelerations of both ends, velocities by its derivative, quadratures by the cubic
//! through the rates of the stages.
//!
//! The last stage stands at c = 1, but not where the step ends. The acceleration at the end in its stead makes a velocity of
//! order 3: the difference is the error told. For ẍ = -x it is at most 8e-4 h⁴, where the step itself misses by 5e-4 h⁶ and
//! its dense output by 1e-3 h⁵. Both stand at one moment: what time alone makes of a rate, as a fast follower does, the difference
//! does not see. That is told by the Legendre coefficients of the cubic through the stages: they go on to fall as they do.

use super::tableau::END;
use super::track::dot;
use super::{Conservative, Nystrom, Storage, Track};

/// Number of stages.
const STAGES: usize = 4;

/// Nodes c.
const NODES: [f64; STAGES] = [0.0, 0.2, 2.0 / 3.0, 1.0];

/// Positions of the stages: x(c) = x + c h v + h² Σ a k.
const POSITIONS: [[f64; 3]; STAGES] = [
    [0.0, 0.0, 0.0],
    [1.0 / 50.0, 0.0, 0.0],
    [-1.0 / 27.0, 7.0 / 27.0, 0.0],
    [3.0 / 10.0, -2.0 / 35.0, 9.0 / 35.0],
];

/// Position at the end: x + h v + h² Σ b k.
const POSITION: [f64; 3] = [14.0 / 336.0, 100.0 / 336.0, 54.0 / 336.0];

/// Velocity or quadrature at the end: v + h Σ b' k.
const VELOCITY: [f64; STAGES] = [14.0 / 336.0, 125.0 / 336.0, 162.0 / 336.0, 35.0 / 336.0];

/// Integral of the cubic through the rates of the stages over a fraction θ, over θ: coefficients column by column, one for each
/// stage. At θ = 1 they sum to [`VELOCITY`].
const INTEGRALS: [[f64; STAGES]; STAGES] = [
    [1.0, -15.0 / 4.0, 14.0 / 3.0, -15.0 / 8.0],
    [0.0, 125.0 / 28.0, -625.0 / 84.0, 375.0 / 112.0],
    [0.0, -27.0 / 28.0, 27.0 / 7.0, -135.0 / 56.0],
    [0.0, 1.0 / 4.0, -13.0 / 12.0, 15.0 / 16.0],
];

/// The Legendre coefficients of degree 1, 2 and 3 of that cubic.
const LEGENDRE: [[f64; STAGES]; 3] = [
    [-1.0 / 8.0, -75.0 / 112.0, 27.0 / 56.0, 5.0 / 16.0],
    [11.0 / 24.0, -125.0 / 336.0, -27.0 / 56.0, 19.0 / 48.0],
    [-3.0 / 8.0, 75.0 / 112.0, -27.0 / 56.0, 3.0 / 16.0],
];

/// What the weights make of the Legendre polynomial of degree 5, the first that they miss.
const MISSED: f64 = 0.28;

impl<N: Storage> Nystrom<N> {
    /// Takes the stages up to a time, the step's end and what acts there.
    pub(super) fn step_by_fifth<S: Conservative + ?Sized>(&mut self, system: &S, end: f64) {
        let (t, h, n) = (self.time, self.step, self.positions());
        self.advance_fifth::<1, S>(system, t + NODES[1] * h);
        self.advance_fifth::<2, S>(system, t + NODES[2] * h);
        self.advance_fifth::<3, S>(system, end);
        for (to, track) in self.stage.as_mut().iter_mut().zip(self.tracks.as_ref()) {
            *to = track.x + h * (track.v + h * dot(&POSITION, &track.k, 3));
        }
        self.end.as_mut()[..n].copy_from_slice(self.stage.as_ref());
        for (to, track) in self.end.as_mut()[n..].iter_mut().zip(self.tracks.as_ref()) {
            *to = track.v + h * dot(&VELOCITY, &track.k, STAGES);
        }
        self.evaluate(system, end, END);
    }

    /// Positions of stage `J`, and what acts there.
    #[inline(always)]
    fn advance_fifth<const J: usize, S: Conservative + ?Sized>(&mut self, system: &S, t: f64) {
        let h = self.step;
        for (to, track) in self.stage.as_mut().iter_mut().zip(self.tracks.as_ref()) {
            *to = track.x + h * (NODES[J] * track.v + h * dot(&POSITIONS[J], &track.k, J));
        }
        self.evaluate(system, t, J);
    }

    /// The error of velocities and, where `scale` has values for them, quadratures in units of `scale`, as if it fell with h⁷ as
    /// that of order 8 does: e^{7/4} of the difference, and e^{7/6} of what falls with h⁶. Positions miss less: by a part h of what
    /// velocities do.
    pub(super) fn error_of_fifth(&self, scale: &[f64]) -> f64 {
        let (h, n) = (self.step, self.positions());
        let (mut largest, mut missed, mut sum) = (0.0_f64, 0.0_f64, 0.0);
        for (track, scale) in self.tracks.as_ref().iter().zip(&scale[n..]) {
            let error = (h * VELOCITY[3] * (track.k[END] - track.k[3]) / scale).abs();
            largest = largest.max(error);
            missed = missed.max((h * track.missed() / scale).abs());
            // A comparison drops NaN, a sum does not.
            sum += error;
        }
        sum += self.end.as_ref().iter().sum::<f64>();
        let by_difference = largest * largest.sqrt() * largest.sqrt().sqrt();
        if sum.is_finite() { by_difference.max(missed * math::cbrt(missed.sqrt())) } else { f64::INFINITY }
    }

    /// The dense output.
    pub(super) fn interpolate_fifth(&mut self) {
        let n = self.positions();
        let (positions, quadratures) = self.tracks.as_mut().split_at_mut(n);
        positions.iter_mut().for_each(Track::join_ends);
        quadratures.iter_mut().for_each(Track::join_stages);
    }
}

impl Track {
    /// What the weights miss of the mean of a rate: its coefficient of degree 5, where the two degrees from 3 on take as much off as
    /// the third has less than those before.
    fn missed(&self) -> f64 {
        let [first, second, third] = LEGENDRE.each_ref().map(|weights| dot(weights, &self.k, STAGES).abs());
        let before = first.max(second);
        if third < before { MISSED * third * (third / before) } else { MISSED * third }
    }

    /// The polynomial of degree 5 with place, velocity and acceleration of both ends, and its derivative. By accelerations
    /// alone: differences of places would be rounding in a short step.
    fn join_ends(&mut self) {
        let first = self.k[0];
        let place = dot(&POSITION, &self.k, 3) - 0.5 * first;
        let (speed, bend) = (dot(&VELOCITY, &self.k, STAGES) - first, self.k[END] - first);
        let coefficients = [
            0.5 * first,
            10.0 * place - 4.0 * speed + 0.5 * bend,
            -15.0 * place + 7.0 * speed - bend,
            6.0 * place - 3.0 * speed + 0.5 * bend,
        ];
        (self.position, self.velocity) = Default::default();
        for (j, c) in coefficients.into_iter().enumerate() {
            (self.position[j], self.velocity[j]) = (c, (j + 2) as f64 * c);
        }
    }

    /// The integral of the cubic through the rates of the stages.
    fn join_stages(&mut self) {
        self.velocity = Default::default();
        for (column, rate) in INTEGRALS.iter().zip(self.k) {
            for (to, weight) in self.velocity.iter_mut().zip(column) {
                *to += weight * rate;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn weigh<const M: usize>(weights: &[f64], values: [f64; M]) -> f64 {
        weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
    }

    /// Σ a_ij v_j.
    fn apply(v: [f64; STAGES]) -> [f64; STAGES] {
        POSITIONS.map(|row| weigh(&row, v))
    }

    fn power(exponent: i32) -> [f64; STAGES] {
        NODES.map(|c| c.powi(exponent))
    }

    /// Legendre's polynomial of a degree over [0, 1] at the nodes.
    fn shifted(degree: u32) -> [f64; STAGES] {
        NODES.map(|c| {
            let (x, mut p) = (2.0 * c - 1.0, [1.0, 2.0 * c - 1.0]);
            for n in 1..degree {
                let n = f64::from(n);
                p = [p[1], ((2.0 * n + 1.0) * x * p[1] - n * p[0]) / (n + 1.0)];
            }
            p[1]
        })
    }

    fn product(a: [f64; STAGES], b: [f64; STAGES]) -> [f64; STAGES] {
        std::array::from_fn(|i| a[i] * b[i])
    }

    #[test]
    fn all_conditions_of_order_5_hold_and_one_of_order_6_does_not() {
        // Hairer, Nørsett, Wanner, theorem II.14.2 and table II.14.3: for every special Nyström tree of velocities up to order 5 …
        let conditions = [
            (power(0), 1.0),
            (power(1), 2.0),
            (power(2), 3.0),
            (power(3), 4.0),
            (apply(power(1)), 24.0),
            (power(4), 5.0),
            (product(NODES, apply(power(1))), 30.0),
            (apply(power(2)), 60.0),
        ];
        for (k, (tree, order)) in conditions.into_iter().enumerate() {
            assert!((weigh(&VELOCITY, tree) * order - 1.0).abs() < 1e-14, "{k}");
        }
        // … and of positions, one order less of the slopes.
        let conditions =
            [(power(0), 2.0), (power(1), 6.0), (power(2), 12.0), (power(3), 20.0), (apply(power(1)), 120.0)];
        for (k, (tree, order)) in conditions.into_iter().enumerate() {
            assert!((weigh(&POSITION, tree) * order - 1.0).abs() < 1e-14, "{k}");
        }
        assert!((weigh(&POSITION, power(4)) * 30.0 - 1.0).abs() > 1e-3);
        // Legendre's polynomials have themselves as coefficients.
        for (degree, weights) in LEGENDRE.iter().enumerate() {
            for (k, polynomial) in [shifted(1), shifted(2), shifted(3)].into_iter().enumerate() {
                let exact = f64::from(u8::from(k == degree));
                assert!((weigh(weights, polynomial) - exact).abs() < 1e-14, "{degree} {k}");
            }
            assert!(weigh(weights, power(0)).abs() < 1e-14);
        }
        assert!((weigh(&VELOCITY, shifted(5)) - MISSED).abs() < 1e-14);
        // Half squares of the nodes, and the weights at the end of the dense output.
        for (row, node) in POSITIONS.into_iter().zip(NODES) {
            assert!((row.iter().sum::<f64>() - 0.5 * node * node).abs() < 1e-15);
        }
        for (column, weight) in INTEGRALS.into_iter().zip(VELOCITY) {
            assert!((column.iter().sum::<f64>() - weight).abs() < 1e-15);
        }
    }
}
