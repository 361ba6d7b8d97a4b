//! Gauss's implicit Runge–Kutta method of order 10 for linear equations with many right-hand sides (columns).
//!
//! Each step evaluates the coefficients of the equation once at each of five nodes. The method suits variational equations along a known
//! motion, whose coefficients are expensive.

mod elimination;
mod rule;

use elimination::{solve, wide_of};
use rule::{PLACES, RULE, Reach, SHARES, dot};
use std::array;

/// Number of nodes in a step.
pub const NODES: usize = 5;

/// Array with one number per node.
pub type Each = [f64; NODES];

/// Coefficients A and b of a linear equation at one node.
#[derive(Debug, Clone, Default)]
pub struct Coefficients {
    /// Matrix A, row by row: derivatives of the slopes of the `rates` components by all positions and rates.
    pub matrix: Vec<f64>,
    /// Inhomogeneous term b, row by row, one number per column; empty if zero.
    pub forcing: Vec<f64>,
}

/// Layout of the components in a column: positions, as many velocities, then further components. The velocities are the slopes of the
/// positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Components {
    /// Number of positions.
    pub positions: usize,
    /// Number of velocities and further components, whose slopes follow from the coefficients.
    pub rates: usize,
    /// Length of a column, which may have further entries after these components.
    pub stride: usize,
}

/// One step of Gauss's method for columns y with ẋ = v and ẇ = A(t)y + b(t). w contains v and the components that follow v.
///
/// The slopes r_j of w at the nodes satisfy x_i = x + τ_i v + Σ(a²)_ij r_j and w_i = w + Σ a_ij r_j. One linear system gives the slopes for
/// all columns.
///
/// Source: Hairer, Lubich, Wanner, *Geometric Numerical Integration*, 2nd ed., section II.1.3.
#[derive(Debug, Clone, Default)]
pub struct Gauss {
    reach: Reach,
    /// Linear system for the slopes, with the right-hand sides at the end of each row.
    system: Vec<f64>,
    /// Slopes at the nodes, row by row.
    right: Vec<f64>,
    end: Vec<f64>,
}

impl Gauss {
    /// Returns the positions of the nodes in [0, 1].
    #[must_use]
    pub fn places() -> Each {
        PLACES.map(|x| 0.5 * (1.0 + x))
    }

    /// Returns the times from the start of a step to each node and to its end (s), with the rounding of the method. `paces` are dt/ds at
    /// the nodes (s), with s the fraction of the step.
    #[must_use]
    pub fn times(paces: Each) -> (Each, f64) {
        let add = |weights: &Each| weights.iter().zip(&paces).map(|(weight, pace)| weight * pace).sum();
        (RULE.inner.each_ref().map(add), add(&SHARES))
    }

    /// Attempts a step with dt/ds = `paces` at the [`NODES`] nodes (s). In an even step all paces equal the step length.
    ///
    /// Returns the last Legendre coefficients of the slopes in units of `scale`, or infinity if the linear system is singular.
    pub fn attempt(
        &mut self,
        (paces, nodes): (Each, &[Coefficients]),
        of: Components,
        columns: &[f64],
        scale: &[f64],
    ) -> Tail {
        let count = columns.len().checked_div(of.stride).unwrap_or(0);
        self.reach = Reach::of(paces);
        self.set_up(nodes, of, columns);
        if !solve(&mut self.system, NODES * of.rates, count, &mut self.right) {
            return Tail { last: f64::INFINITY, rest: f64::INFINITY };
        }
        self.finish(of, columns);
        let mut tail = Tail::default();
        for (c, scale) in (0..of.rates).zip(scale) {
            for column in 0..count {
                let slopes: Each = array::from_fn(|j| self.right[(j * of.rates + c) * count + column]);
                let coefficient = |weights: &Each| dot(weights, &slopes).abs() / scale;
                tail = tail.or(Tail::of(self.reach.tail.each_ref().map(coefficient)));
            }
        }
        tail
    }

    /// Returns the columns at the end of the attempted step.
    #[must_use]
    pub fn end(&self) -> &[f64] {
        &self.end
    }

    /// Writes the columns at fraction `part` of the step into `to`. Positions follow the method's polynomial of order 5; all other
    /// components keep their values at the start.
    pub fn positions(&self, part: f64, of: Components, columns: &[f64], to: &mut Vec<f64>) {
        let Components { positions, rates, stride } = of;
        let count = columns.len().checked_div(stride).unwrap_or(0);
        let (row, reach) = (RULE.row(2.0 * part - 1.0), &self.reach);
        let first: Each = array::from_fn(|k| row[k] * reach.paces[k]);
        let mut twice = [0.0; NODES];
        for (first, once) in first.iter().zip(&reach.once) {
            twice.iter_mut().zip(once).for_each(|(twice, once)| *twice += first * once);
        }
        let time: f64 = first.iter().sum();
        to.clear();
        to.extend_from_slice(columns);
        for (number, to) in to.chunks_exact_mut(stride).enumerate() {
            for p in 0..positions {
                let slopes: Each = array::from_fn(|j| self.right[(j * rates + p) * count + number]);
                to[p] += time * to[positions + p] + dot(&twice, &slopes);
            }
        }
    }

    /// Adds to `sums` the integrals of linear forms over the attempted step; no component depends on these integrals. `slopes` has the
    /// forms at the nodes, `columns` the start of the step. `sums` has one row per form and one number per column.
    pub fn integrate(&self, slopes: &[Coefficients], of: Components, columns: &[f64], sums: &mut [f64]) {
        let Components { positions, rates, stride } = of;
        let (count, wide) = (columns.len().checked_div(stride).unwrap_or(0), positions + rates);
        for (node, slopes) in slopes.iter().enumerate() {
            let (reach, share) = (&self.reach, self.reach.end_once[node]);
            for (number, column) in columns.chunks_exact(stride).enumerate() {
                let rate = |j: usize, c: usize| self.right[(j * rates + c) * count + number];
                let reached = |row: &Each, c: usize| -> f64 { (0..NODES).map(|j| row[j] * rate(j, c)).sum() };
                let at = |p: usize| match p.checked_sub(positions) {
                    Some(c) => column[p] + reached(&reach.once[node], c),
                    None => {
                        column[p] + reach.time[node] * column[positions + p] + reached(&reach.twice[node], p)
                    }
                };
                let rows = sums.chunks_exact_mut(count).zip(slopes.matrix.chunks_exact(wide));
                for (row, (sums, matrix)) in rows.enumerate() {
                    let acting = matrix.iter().enumerate().filter(|(_, a)| **a != 0.0);
                    let slope: f64 = acting.map(|(p, a)| a * at(p)).sum();
                    let forcing = slopes.forcing.get(row * count + number).copied().unwrap_or(0.0);
                    sums[number] += share * (slope + forcing);
                }
            }
        }
    }

    /// Assembles the linear system for the slopes at all nodes.
    fn set_up(&mut self, nodes: &[Coefficients], of: Components, columns: &[f64]) {
        let Components { positions, rates, stride } = of;
        let (size, wide) = (NODES * rates, positions + rates);
        let count = columns.len().checked_div(stride).unwrap_or(0);
        self.system.clear();
        let room = wide_of(size, count);
        self.system.resize(size * room, 0.0);
        let mut lines = self.system.chunks_exact_mut(room);
        for (i, node) in nodes.iter().enumerate() {
            let (once, twice, time) = (&self.reach.once[i], &self.reach.twice[i], self.reach.time[i]);
            for (c, row) in node.matrix.chunks_exact(wide).enumerate() {
                let Some(line) = lines.next() else { return };
                let (line, right) = line.split_at_mut(size);
                let right = &mut right[..count];
                line[i * rates + c] = 1.0;
                if !node.forcing.is_empty() {
                    right.copy_from_slice(&node.forcing[c * count..(c + 1) * count]);
                }
                for (p, a) in row.iter().enumerate().filter(|(_, a)| **a != 0.0) {
                    let (to, reached) = p.checked_sub(positions).map_or((p, twice), |rate| (rate, once));
                    for (j, reached) in reached.iter().enumerate() {
                        line[j * rates + to] -= a * reached;
                    }
                    // The position at a node includes the displacement by the initial velocity.
                    for (right, column) in right.iter_mut().zip(columns.chunks_exact(stride)) {
                        let ahead = if p < positions { time * column[positions + p] } else { 0.0 };
                        *right += a * (column[p] + ahead);
                    }
                }
            }
        }
    }

    /// Computes the columns at the end of the step from the slopes at the nodes.
    fn finish(&mut self, of: Components, columns: &[f64]) {
        let Components { positions, rates, stride } = of;
        let count = columns.len().checked_div(stride).unwrap_or(0);
        self.end.clear();
        self.end.extend_from_slice(columns);
        let (reach, right) = (&self.reach, &self.right);
        for (number, end) in self.end.chunks_exact_mut(stride).enumerate() {
            for c in 0..rates {
                let slopes: Each = array::from_fn(|j| right[(j * rates + c) * count + number]);
                // The position is updated first: it needs the velocity at the start.
                if c < positions {
                    end[c] += reach.length * end[positions + c] + dot(&reach.end_twice, &slopes);
                }
                end[positions + c] += dot(&reach.end_once, &slopes);
            }
        }
    }
}

/// Last Legendre coefficients of the slopes over a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tail {
    /// Last Legendre coefficient that the nodes determine.
    pub last: f64,
    /// Estimate of the tenth Legendre coefficient, which the nodes do not determine. The estimate extrapolates with a constant ratio, which
    /// is valid for functions with a nearby singularity.
    pub rest: f64,
}

impl Tail {
    /// Estimates the tail from four coefficients. The last two are compared with the two before, because for symmetric functions every
    /// second coefficient is zero. The cube of this ratio extrapolates to the tenth coefficient.
    fn of([first, second, third, fourth]: [f64; 4]) -> Self {
        let (before, after) = (first.max(second), third.max(fourth));
        let falls = if after < before { after / before } else { 1.0 };
        Self { last: fourth, rest: if after == 0.0 { 0.0 } else { after * falls.powi(3) } }
    }

    fn or(self, other: Self) -> Self {
        Self { last: self.last.max(other.last), rest: self.rest.max(other.rest) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: Components = Components { positions: 1, rates: 1, stride: 2 };

    /// Solves ẍ = -ω²x - 2cẋ for two columns, the derivatives by initial position and velocity, over one unit of time.
    fn led(steps: u32, graded: bool) -> Vec<f64> {
        let node = Coefficients { matrix: vec![-4.0, -0.2], forcing: Vec::new() };
        let (nodes, h) = (vec![node; NODES], f64::from(steps).recip());
        let mut gauss = Gauss::default();
        let mut columns = vec![1.0, 0.0, 0.0, 1.0];
        for k in 0..steps {
            // In the first step time is the square of the fraction.
            let paces = if graded && k == 0 { Gauss::places().map(|s| 2.0 * s * h) } else { [h; NODES] };
            assert!(gauss.attempt((paces, &nodes), ONE, &columns, &[1.0]).last.is_finite());
            columns.copy_from_slice(gauss.end());
        }
        columns
    }

    /// Compares a damped oscillation with its closed form. Errors are of order h¹⁰; graded steps halve the order.
    #[test]
    fn a_damped_swing_is_met_with_order_ten() {
        let (damping, omega): (f64, f64) = (0.1, (4.0_f64 - 0.01).sqrt());
        let (sine, cosine) = omega.sin_cos();
        let fade = (-damping).exp();
        let exact = [
            fade * (cosine + damping / omega * sine),
            -fade * 4.0 / omega * sine,
            fade * sine / omega,
            fade * (cosine - damping / omega * sine),
        ];
        let error = |steps: u32, graded| {
            let apart = led(steps, graded).into_iter().zip(exact).map(|(a, b)| (a - b).abs());
            apart.fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(1, false), error(2, false));
        assert!(coarse > 700.0 * fine && fine < 1e-9, "{coarse:e} {fine:e}");
        assert!(error(4, false) < 1e-12, "{:e}", error(4, false));
        assert!(error(4, true) > 30.0 * error(8, true), "{:e} {:e}", error(4, true), error(8, true));
    }

    /// Inside a step the error of an oscillation is a few parts in a million; at the end it equals that of the step.
    #[test]
    fn places_inside_a_step_are_those_of_the_swing() {
        let nodes = vec![Coefficients { matrix: vec![-1.0, 0.0], forcing: Vec::new() }; NODES];
        let (mut gauss, mut inside) = (Gauss::default(), Vec::new());
        gauss.attempt(([1.0; NODES], &nodes), ONE, &[1.0, 0.0], &[1.0]);
        for part in [0.1, 0.35, 0.8] {
            gauss.positions(part, ONE, &[1.0, 0.0], &mut inside);
            assert!((inside[0] - part.cos()).abs() < 3e-6, "{part}: {:e}", inside[0] - part.cos());
        }
        gauss.positions(1.0, ONE, &[1.0, 0.0], &mut inside);
        assert!((inside[0] - gauss.end()[0]).abs() < 1e-15);
    }

    /// Integral of 2x + 3ẋ + t for x = cos t from 0 to 1, in closed form.
    #[test]
    fn an_integral_beside_is_that_of_the_swing() {
        let nodes = vec![Coefficients { matrix: vec![-1.0, 0.0], forcing: Vec::new() }; NODES];
        let slopes = Gauss::places().map(|t| Coefficients { matrix: vec![2.0, 3.0], forcing: vec![t] });
        let (mut gauss, mut sums) = (Gauss::default(), [0.5]);
        gauss.attempt(([1.0; NODES], &nodes), ONE, &[1.0, 0.0], &[1.0]);
        gauss.integrate(&slopes, ONE, &[1.0, 0.0], &mut sums);
        let exact = 0.5 + 2.0 * 1.0_f64.sin() + 3.0 * (1.0_f64.cos() - 1.0) + 0.5;
        assert!((sums[0] - exact).abs() < 1e-9, "{:e}", sums[0] - exact);
    }

    /// ẍ = t² from rest: x = t⁴/12, from the inhomogeneous term alone.
    #[test]
    fn a_forcing_is_integrated_twice() {
        let nodes = Gauss::places().map(|t| Coefficients { matrix: vec![0.0, 0.0], forcing: vec![t * t] });
        let mut gauss = Gauss::default();
        let Tail { last, .. } = gauss.attempt(([1.0; NODES], &nodes), ONE, &[0.0, 0.0], &[1.0]);
        assert!((gauss.end()[0] - 1.0 / 12.0).abs() < 1e-15 && (gauss.end()[1] - 1.0 / 3.0).abs() < 1e-15);
        assert!(last < 1e-15, "{last:e}");
    }
}
