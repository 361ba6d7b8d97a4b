//! Gauss's method of order 10 for linear equations, many columns at a time.
//!
//! The coefficients of a linear equation are asked for at five nodes of a step and never again: where they are dear, and known along a
//! motion that another method has found, no method asks for less.

mod elimination;
mod rule;

use elimination::{solve, wide_of};
use rule::{PLACES, RULE, Reach, SHARES, dot};
use std::array;

/// Nodes of a step.
pub const NODES: usize = 5;

/// A number for each node.
pub type Each = [f64; NODES];

/// What a linear equation is at a node: the slopes of `rates` components by all of them, row by row, and what they are of each column
/// besides.
#[derive(Debug, Clone, Default)]
pub struct Coefficients {
    /// Row by row.
    pub matrix: Vec<f64>,
    /// Row by row, a number for each column; empty where there is nothing.
    pub forcing: Vec<f64>,
}

/// Which components there are: positions, then as many velocities and perhaps more; the velocities are the slopes of the positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Components {
    /// Positions.
    pub positions: usize,
    /// Components whose slopes the coefficients tell: velocities and what follows them.
    pub rates: usize,
    /// Components of a column, of which the last ones may be none of these.
    pub stride: usize,
}

/// One step of Gauss's method for columns y of ẋ = v, ẇ = A(t)y + b(t), w being v and what follows it.
///
/// With the slopes r_j of w at the nodes, x_i = x + τ_i v + Σ(a²)_ij r_j and w_i = w + Σ a_ij r_j solve one linear system for all columns.
///
/// Source: Hairer, Lubich, Wanner, *Geometric Numerical Integration*, 2nd ed., section II.1.3.
#[derive(Debug, Clone, Default)]
pub struct Gauss {
    reach: Reach,
    /// The linear system, its right sides at the end of each row.
    system: Vec<f64>,
    /// The slopes at the nodes, row by row.
    right: Vec<f64>,
    end: Vec<f64>,
}

impl Gauss {
    /// Places of the nodes over [0, 1].
    #[must_use]
    pub fn places() -> Each {
        PLACES.map(|x| 0.5 * (1.0 + x))
    }

    /// Time to each node, and to the end, of a step in which it goes at `paces` per step at the nodes, s: as the method itself has it.
    #[must_use]
    pub fn times(paces: Each) -> (Each, f64) {
        let add = |weights: &Each| weights.iter().zip(&paces).map(|(weight, pace)| weight * pace).sum();
        (RULE.inner.each_ref().map(add), add(&SHARES))
    }

    /// Tries a step in which time goes at `paces` per step at the [`NODES`] nodes, s: an even one has its length for all of them. Tells how the rates'
    /// slopes look by their Legendre coefficients, in units of `scale`; infinite where there is no result.
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

    /// The columns at the end of the step tried.
    #[must_use]
    pub fn end(&self) -> &[f64] {
        &self.end
    }

    /// The positions of the columns at a part of the step tried, others as they began, by the method's own polynomial: of order 5 there.
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

    /// Adds to `sums`, row by row a number for each column, what the rows of `slopes` come to over the step tried: integrals on which
    /// nothing depends, `columns` being what it began with.
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

    /// The linear system of the slopes at all nodes.
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
                    // A place goes on with its velocity.
                    for (right, column) in right.iter_mut().zip(columns.chunks_exact(stride)) {
                        let ahead = if p < positions { time * column[positions + p] } else { 0.0 };
                        *right += a * (column[p] + ahead);
                    }
                }
            }
        }
    }

    /// The columns at the end, from the slopes at the nodes.
    fn finish(&mut self, of: Components, columns: &[f64]) {
        let Components { positions, rates, stride } = of;
        let count = columns.len().checked_div(stride).unwrap_or(0);
        self.end.clear();
        self.end.extend_from_slice(columns);
        let (reach, right) = (&self.reach, &self.right);
        for (number, end) in self.end.chunks_exact_mut(stride).enumerate() {
            for c in 0..rates {
                let slopes: Each = array::from_fn(|j| right[(j * rates + c) * count + number]);
                // The velocity is that of before until its place has gone on with it.
                if c < positions {
                    end[c] += reach.length * end[positions + c] + dot(&reach.end_twice, &slopes);
                }
                end[positions + c] += dot(&reach.end_once, &slopes);
            }
        }
    }
}

/// How slopes over a step look by their Legendre coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tail {
    /// The last coefficient.
    pub last: f64,
    /// What the tenth one is, which the method misses, where they go on to fall as they do: in a constant proportion, as those of what has
    /// a root near by.
    pub rest: f64,
}

impl Tail {
    /// Of four coefficients, which may vanish by turns: two of them have as much as the two before by a proportion, of which
    /// the cube leads from there to the tenth.
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

    /// ẍ = -ω²x - 2cẋ by its place and by its speed over `steps` of one time unit.
    fn led(steps: u32, graded: bool) -> Vec<f64> {
        let node = Coefficients { matrix: vec![-4.0, -0.2], forcing: Vec::new() };
        let (nodes, h) = (vec![node; NODES], f64::from(steps).recip());
        let mut gauss = Gauss::default();
        let mut columns = vec![1.0, 0.0, 0.0, 1.0];
        for k in 0..steps {
            // The first step goes as the square of its part.
            let paces = if graded && k == 0 { Gauss::places().map(|s| 2.0 * s * h) } else { [h; NODES] };
            assert!(gauss.attempt((paces, &nodes), ONE, &columns, &[1.0]).last.is_finite());
            columns.copy_from_slice(gauss.end());
        }
        columns
    }

    /// A damped swing has a closed form; errors fall with the tenth power of the step. In a graded one time goes with the square of its
    /// part, which halves the order.
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

    /// Inside a step a swing is met to a few parts in a million, and at its end as by the step itself.
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

    /// Over a swing x = cos t from 0 to 1 the integral of 2x + 3ẋ + t, in closed form.
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

    /// ẍ = t² from rest: x = t⁴/12, forced alone.
    #[test]
    fn a_forcing_is_integrated_twice() {
        let nodes = Gauss::places().map(|t| Coefficients { matrix: vec![0.0, 0.0], forcing: vec![t * t] });
        let mut gauss = Gauss::default();
        let Tail { last, .. } = gauss.attempt(([1.0; NODES], &nodes), ONE, &[0.0, 0.0], &[1.0]);
        assert!((gauss.end()[0] - 1.0 / 12.0).abs() < 1e-15 && (gauss.end()[1] - 1.0 / 3.0).abs() < 1e-15);
        assert!(last < 1e-15, "{last:e}");
    }
}
