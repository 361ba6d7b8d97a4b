//! Nyström's method of order 5, for steps that an event is expected to cut.
//!
//! Source: E. J. Nyström, *Über die numerische Integration von Differentialgleichungen*, Acta Soc. Sci. Fennicae 50 (1925) No.
//! 13; E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., Springer 1993, table II.14.2.
//!
//! A step has four stages and the acceleration at its end, which the next step reuses: four evaluations, or five after a discontinuity. The
//! dense output costs no evaluation. Positions follow the polynomial of degree 5 with positions, velocities and accelerations of both ends;
//! velocities are its derivative. Quadratures are the integral of the cubic polynomial through the rates.
//!
//! The last stage is at c = 1, but its position differs from the end of the step. If the acceleration at the end replaces that of the last
//! stage, the velocity has order 3. The difference of both velocities is the error estimate. For ẍ = -x the estimate is at most 8e-4 h⁴,
//! the error of the step 5e-4 h⁶, and the error of the dense output 1e-3 h⁵.
//!
//! This estimate vanishes for rates that depend on time only, because both accelerations belong to the same time. A second estimate
//! extrapolates the Legendre coefficients of the cubic polynomial through the rates at the stages.

use super::tableau::END;
use super::track::dot;
use super::{Conservative, Nystrom, Storage, Track};

/// Number of stages.
const STAGES: usize = 4;

/// Nodes c.
const NODES: [f64; STAGES] = [0.0, 0.2, 2.0 / 3.0, 1.0];

/// Coefficients of the stage positions: x(c) = x + c h v + h² Σ a k.
const POSITIONS: [[f64; 3]; STAGES] = [
    [0.0, 0.0, 0.0],
    [1.0 / 50.0, 0.0, 0.0],
    [-1.0 / 27.0, 7.0 / 27.0, 0.0],
    [3.0 / 10.0, -2.0 / 35.0, 9.0 / 35.0],
];

/// Weights of the position at the end: x + h v + h² Σ b k.
const POSITION: [f64; 3] = [14.0 / 336.0, 100.0 / 336.0, 54.0 / 336.0];

/// Weights of a velocity or quadrature at the end: v + h Σ b' k.
const VELOCITY: [f64; STAGES] = [14.0 / 336.0, 125.0 / 336.0, 162.0 / 336.0, 35.0 / 336.0];

/// Coefficients of the integral up to θ of the cubic polynomial through the stage rates, divided by θ. Each stage has one row; the row sums
/// are [`VELOCITY`].
const INTEGRALS: [[f64; STAGES]; STAGES] = [
    [1.0, -15.0 / 4.0, 14.0 / 3.0, -15.0 / 8.0],
    [0.0, 125.0 / 28.0, -625.0 / 84.0, 375.0 / 112.0],
    [0.0, -27.0 / 28.0, 27.0 / 7.0, -135.0 / 56.0],
    [0.0, 1.0 / 4.0, -13.0 / 12.0, 15.0 / 16.0],
];

/// Weights of the Legendre coefficients of degree 1, 2 and 3 of the cubic polynomial through the stage rates.
const LEGENDRE: [[f64; STAGES]; 3] = [
    [-1.0 / 8.0, -75.0 / 112.0, 27.0 / 56.0, 5.0 / 16.0],
    [11.0 / 24.0, -125.0 / 336.0, -27.0 / 56.0, 19.0 / 48.0],
    [-3.0 / 8.0, 75.0 / 112.0, -27.0 / 56.0, 3.0 / 16.0],
];

/// Result of the quadrature with weights [`VELOCITY`] for the Legendre polynomial of degree 5, whose exact integral is zero.
const MISSED: f64 = 0.28;

impl<N: Storage> Nystrom<N> {
    /// Computes the stages, the state at the end of the step and the accelerations there.
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

    /// Computes the positions of stage `J` and evaluates the accelerations there.
    #[inline(always)]
    fn advance_fifth<const J: usize, S: Conservative + ?Sized>(&mut self, system: &S, t: f64) {
        let h = self.step;
        for (to, track) in self.stage.as_mut().iter_mut().zip(self.tracks.as_ref()) {
            *to = track.x + h * (NODES[J] * track.v + h * dot(&POSITIONS[J], &track.k, J));
        }
        self.evaluate(system, t, J);
    }

    /// Returns the error of velocities in units of `scale`, and of quadratures for which `scale` has a value.
    ///
    /// The first estimate is raised to the power 7/4 and the second to 7/6, so that both are of order h⁷, like the estimate of the method
    /// of order 8. Errors of positions are smaller by a factor h.
    pub(super) fn error_of_fifth(&self, scale: &[f64]) -> f64 {
        let (h, n) = (self.step, self.positions());
        let (mut largest, mut missed, mut sum) = (0.0_f64, 0.0_f64, 0.0);
        for (track, scale) in self.tracks.as_ref().iter().zip(&scale[n..]) {
            let error = (h * VELOCITY[3] * (track.k[END] - track.k[3]) / scale).abs();
            largest = largest.max(error);
            missed = missed.max((h * track.missed() / scale).abs());
            // Comparisons ignore NaN, a sum does not.
            sum += error;
        }
        sum += self.end.as_ref().iter().sum::<f64>();
        let by_difference = largest * largest.sqrt() * largest.sqrt().sqrt();
        if sum.is_finite() { by_difference.max(missed * math::cbrt(missed.sqrt())) } else { f64::INFINITY }
    }

    /// Computes the dense output.
    pub(super) fn interpolate_fifth(&mut self) {
        let n = self.positions();
        let (positions, quadratures) = self.tracks.as_mut().split_at_mut(n);
        positions.iter_mut().for_each(Track::join_ends);
        quadratures.iter_mut().for_each(Track::join_stages);
    }
}

impl Track {
    /// Estimates the quadrature error of the mean rate from the Legendre coefficient of degree 5. The decrease of the coefficients
    /// extrapolates this coefficient from degree 3.
    fn missed(&self) -> f64 {
        let size = |weights: &[f64]| dot(weights, &self.k, STAGES).abs();
        let (first, second, third) = (size(&LEGENDRE[0]), size(&LEGENDRE[1]), size(&LEGENDRE[2]));
        let before = first.max(second);
        if third < before { MISSED * third * (third / before) } else { MISSED * third }
    }

    /// Computes the polynomial of degree 5 with position, velocity and acceleration of both ends, and its derivative. The computation uses
    /// accelerations only, because rounding would dominate differences of positions in short steps.
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

    /// Computes the integral of the cubic polynomial through the stage rates.
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

    /// Returns Σ a_ij v_j.
    fn apply(v: [f64; STAGES]) -> [f64; STAGES] {
        POSITIONS.map(|row| weigh(&row, v))
    }

    fn power(exponent: i32) -> [f64; STAGES] {
        NODES.map(|c| c.powi(exponent))
    }

    /// Returns the Legendre polynomial of a degree over [0, 1] at the nodes.
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
        // Hairer, Nørsett, Wanner, theorem II.14.2 and table II.14.3: special Nyström trees up to order 5, for velocities …
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
        // … and for positions, up to one order less.
        let conditions =
            [(power(0), 2.0), (power(1), 6.0), (power(2), 12.0), (power(3), 20.0), (apply(power(1)), 120.0)];
        for (k, (tree, order)) in conditions.into_iter().enumerate() {
            assert!((weigh(&POSITION, tree) * order - 1.0).abs() < 1e-14, "{k}");
        }
        assert!((weigh(&POSITION, power(4)) * 30.0 - 1.0).abs() > 1e-3);
        // Each Legendre polynomial has itself as its only coefficient.
        for (degree, weights) in LEGENDRE.iter().enumerate() {
            for (k, polynomial) in [shifted(1), shifted(2), shifted(3)].into_iter().enumerate() {
                let exact = f64::from(u8::from(k == degree));
                assert!((weigh(weights, polynomial) - exact).abs() < 1e-14, "{degree} {k}");
            }
            assert!(weigh(weights, power(0)).abs() < 1e-14);
        }
        assert!((weigh(&VELOCITY, shifted(5)) - MISSED).abs() < 1e-14);
        // Rows of positions sum to half the square of their node; integrals sum to the weights at θ = 1.
        for (row, node) in POSITIONS.into_iter().zip(NODES) {
            assert!((row.iter().sum::<f64>() - 0.5 * node * node).abs() < 1e-15);
        }
        for (column, weight) in INTEGRALS.into_iter().zip(VELOCITY) {
            assert!((column.iter().sum::<f64>() - weight).abs() < 1e-15);
        }
    }
}
