//! Multistart optimisation: local searches by the Nelder–Mead simplex method from the best of several Sobol points.
//!
//! Source: Nelder and Mead, Computer Journal 7 (1965) 308, with the factors of Gao and Han, Computational Optimization and Applications 51
//! (2012) 259, for n coordinates: expansion 1 + 2/n, shrinkage 1 - 1/n. The method uses only + - * / and square roots, so results have the
//! same bits on every machine. Methods with linear or quadratic models are unsuitable, because results of drives have sharp ridges: where a
//! contact begins to slip, or where another result becomes the worst of several results.

use crate::each::each;
use crate::sweep::points::{Points, Sampling};
use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::neldermead::NelderMead;
use argmin_math::{ArgminAdd, ArgminMul, ArgminSub};
use std::cell::RefCell;

/// Number of Sobol points per local search.
pub(crate) const SCREENED: u64 = 4;
/// Edge length of the first simplex, as a fraction of the range of each coordinate.
const FIRST: f64 = 0.2;
/// Factor on the edge length of the next simplex after a simplex search without improvement.
const SHRINK: f64 = 0.25;
/// Shortest initial edge length of a simplex.
const SHORTEST: f64 = 1e-6;
/// Standard deviation of the results in a simplex below which a new simplex starts, relative to edge length times spread. The spread is the
/// difference between best and median result of the Sobol points.
const FLAT: f64 = 1e-4;
/// Smallest improvement, relative to the spread of results, for another simplex with the same edge length.
const GAIN: f64 = 1e-7;

/// Spread of results if unknown, relative to the best result.
const LEAST_SPREAD: f64 = 0.1;

/// Evaluation function: larger values are better; NaN if there is no result.
pub(crate) type Judge<'a> = dyn Fn(&[f64]) -> f64 + Sync + 'a;

/// Result of a local search.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Local {
    /// First point and its value.
    pub(crate) from: (Vec<f64>, f64),
    /// Best point and its value.
    pub(crate) to: (Vec<f64>, f64),
    /// Number of evaluated points.
    pub(crate) evaluations: usize,
}

/// Number of local searches, maximum number of evaluations of each search, seed and number of threads.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Effort {
    pub(crate) starts: u64,
    pub(crate) evaluations: usize,
    pub(crate) seed: u64,
    pub(crate) threads: usize,
}

/// Runs all local searches; the first starts at the unchanged scenario. Returns `None` if no point has a result.
pub(crate) fn search(present: &[f64], effort: Effort, judge: &Judge<'_>) -> Option<Vec<Local>> {
    let points = screened(present, effort);
    let values = each(points.len(), effort.threads, |i| judge(&points[i]));
    let mut order: Vec<usize> = (0..points.len()).filter(|i| !values[*i].is_nan()).collect();
    order.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
    let [best, middle, worst] = [*order.first()?, order[order.len() / 2], *order.last()?].map(|i| values[i]);
    // The point of the unchanged scenario is always among the start points.
    let is_present = |i: &usize| *i == 0;
    let mut chosen: Vec<usize> = order.iter().copied().filter(is_present).collect();
    chosen.extend(order.into_iter().filter(|i| !is_present(i)));
    chosen.truncate(effort.starts as usize);
    let scale = Scale { worst, spread: if best > middle { best - middle } else { 1.0 } };
    let local = |i: usize| local((&points[chosen[i]], values[chosen[i]]), effort.evaluations, (scale, judge));
    Some(each(chosen.len(), effort.threads, local))
}

/// Runs one more local search, from a point better than the results of all other local searches.
pub(crate) fn again((point, value): (&[f64], f64), evaluations: usize, judge: &Judge<'_>) -> Local {
    let spread = (LEAST_SPREAD * value.abs()).max(f64::MIN_POSITIVE);
    local((point, value), evaluations, (Scale { worst: value - value.abs(), spread }, judge))
}

/// Returns the point of the unchanged scenario, followed by the Sobol points.
fn screened(present: &[f64], effort: Effort) -> Vec<Vec<f64>> {
    let count = SCREENED * effort.starts;
    let sobol = Points::new(Sampling::Sobol, present.len(), effort.seed, count);
    let point = |i: u64| {
        let mut point = vec![0.5; present.len()];
        if let Ok(sobol) = &sobol {
            sobol.write(i, &mut point);
        }
        point
    };
    std::iter::once(present.to_vec()).chain((0..count).map(point)).collect()
}

/// Scale of the results. The worst result also replaces missing results.
#[derive(Debug, Clone, Copy)]
struct Scale {
    worst: f64,
    spread: f64,
}

/// Runs a sequence of simplex searches. Each search starts at the best point with new edges along the axes, which frees a simplex that has
/// collapsed on a ridge.
fn local(start: (&[f64], f64), most: usize, (scale, judge): (Scale, &Judge<'_>)) -> Local {
    let n = start.0.len();
    let from = (start.0.to_vec(), start.1);
    let best = RefCell::new(Local { from: from.clone(), to: from, evaluations: 0 });
    let (mut edge, mut turn) = (FIRST, 0);
    while edge > SHORTEST && best.borrow().evaluations + n + 2 <= most {
        let (begin, before) = best.borrow().to.clone();
        let solver = NelderMead::new(simplex(&begin, edge, turn)).with_sd_tolerance(FLAT * edge);
        let many = n.max(2) as f64;
        let solver = solver.and_then(|solver| solver.with_gamma(1.0 + 2.0 / many));
        let Ok(solver) = solver.and_then(|solver| solver.with_sigma(1.0 - 1.0 / many)) else { break };
        // The best point is recorded by the cost function, even if the search fails.
        let problem = Problem { scale, judge, best: &best, most };
        drop(Executor::new(problem, solver).timer(false).run());
        if best.borrow().to.1 - before <= GAIN * scale.spread {
            edge *= SHRINK;
        }
        turn += 1;
    }
    best.into_inner()
}

/// Returns a point and its neighbours along the axes, within the unit cube. The directions alternate with `turn`.
fn simplex(begin: &[f64], edge: f64, turn: usize) -> Vec<Point> {
    let neighbour = |i: usize| {
        let mut point = begin.to_vec();
        let up = point[i] < edge || point[i] + edge <= 1.0 && (i + turn).is_multiple_of(2);
        point[i] += if up { edge } else { -edge };
        Point(point)
    };
    std::iter::once(Point(begin.to_vec())).chain((0..begin.len()).map(neighbour)).collect()
}

/// Vertex of a simplex.
#[derive(Debug, Clone)]
struct Point(Vec<f64>);

impl Point {
    fn with(&self, other: &Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(a, b)| of(*a, *b)).collect())
    }
}

impl ArgminAdd<Self, Self> for Point {
    fn add(&self, other: &Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl ArgminSub<Self, Self> for Point {
    fn sub(&self, other: &Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl ArgminMul<f64, Self> for Point {
    fn mul(&self, factor: &f64) -> Self {
        Self(self.0.iter().map(|x| x * factor).collect())
    }
}

/// Cost function of the simplex method.
struct Problem<'a> {
    scale: Scale,
    judge: &'a Judge<'a>,
    best: &'a RefCell<Local>,
    most: usize,
}

impl CostFunction for Problem<'_> {
    type Param = Point;
    type Output = f64;

    /// Returns (worst result - result) divided by the spread of results. Points outside the unit cube are projected onto the cube.
    fn cost(&self, point: &Point) -> Result<f64, Error> {
        let mut local = self.best.borrow_mut();
        if local.evaluations >= self.most {
            return Err(Error::msg("no evaluations are left"));
        }
        local.evaluations += 1;
        let point: Vec<f64> = point.0.iter().map(|x| x.clamp(0.0, 1.0)).collect();
        let value = (self.judge)(&point);
        let value = if value.is_nan() { self.scale.worst } else { value };
        if value > local.to.1 {
            local.to = (point, value);
        }
        Ok(-(value - self.scale.worst) / self.scale.spread)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optimum::shape::{self, Drawing};
    use stickslip_scenario::{Basis, Shaped};

    /// Rosenbrock's valley, and a linear function with its maximum at bounds: the exact optima are known.
    #[test]
    fn valleys_and_bounds_are_followed_to_their_ends() {
        let valley = |p: &[f64]| {
            let [x, y] = [4.0 * p[0] - 2.0, 4.0 * p[1] - 2.0];
            -(1.0 - x) * (1.0 - x) - 100.0 * (y - x * x) * (y - x * x)
        };
        let (point, value) = best(search(&[0.1, 0.9], effort(400), &valley));
        assert!(value > -1e-6 && point.iter().all(|x| (x - 0.75).abs() < 1e-3), "{point:?} {value}");
        let slope = |p: &[f64]| p[0] - 2.0 * p[1];
        assert_eq!(best(search(&[0.5; 2], effort(120), &slope)).0, [1.0, 0.0]);
        let nowhere = |_: &[f64]| f64::NAN;
        assert_eq!(search(&[0.5; 2], effort(120), &nowhere), None);
    }

    /// The number of threads has no effect on the result.
    #[test]
    fn the_number_of_threads_changes_nothing() {
        let wave = |p: &[f64]| (p[0] * 7.0).fract() - p[1] * p[1];
        let on = |threads: usize| search(&[0.5; 2], Effort { threads, ..effort(60) }, &wave);
        assert_eq!(on(1), on(5));
    }

    fn effort(evaluations: usize) -> Effort {
        Effort { starts: 8, evaluations, seed: 1, threads: 2 }
    }

    /// Returns the best of all local searches.
    fn best(locals: Option<Vec<Local>>) -> (Vec<f64>, f64) {
        locals.unwrap().into_iter().map(|local| local.to).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
    }

    /// A slider too heavy to follow moves with the median velocity of the foot. For two harmonics sin θ + b sin 2θ with
    /// |b| ≤ 1/4, it is -2b; in units of half the stroke 2b/(√(1-y²)(1+2by)), 4by² + y = 2b. The maximum
    /// 0.454167 is at b = 1/4, on a sharp ridge.
    #[test]
    fn two_harmonics_move_a_heavy_slider_fastest_at_a_quarter() {
        let shaped = Shaped {
            path: "waveforms.drive".to_owned(),
            waveform: 0,
            basis: Basis::Harmonics(2),
            period: [1.0; 2],
            window: [-1.0, 1.0],
            slew: None,
            bandwidth: None,
            gain: 1.0,
            unit: "m",
        };
        let speed = |point: &[f64]| {
            let drawing = Drawing::new(&shaped, 1.0, point);
            let Drawing::Harmonics(_, terms) = drawing else { return f64::NAN };
            let rate = |i: usize| {
                let angle = std::f64::consts::TAU * (i as f64 + 0.5) / 4000.0;
                let term = |(k, [s, c]): (usize, &[f64; 2])| {
                    let k = (k + 1) as f64;
                    k * (s * math::cos(k * angle) - c * math::sin(k * angle))
                };
                terms.iter().enumerate().map(term).sum::<f64>()
            };
            let mut rates: Vec<f64> = (0..4000).map(rate).collect();
            rates.sort_by(f64::total_cmp);
            f64::midpoint(rates[1999], rates[2000])
        };
        let (point, value) = best(search(&[0.5; 3], effort(300), &speed));
        assert!((value - 0.454_166_692).abs() < 1e-3, "{point:?} {value}");
        let Drawing::Harmonics(_, terms) = Drawing::new(&shaped, 1.0, &point) else { return };
        let [b, phase] = [terms[1][0].abs() / terms[0][0], terms[1][1] / terms[0][0]];
        assert!((b - 0.25).abs() < 1e-3 && phase.abs() < 1e-3, "{b} {phase}");
        assert_eq!(shape::dimensions(&shaped), 3);
    }
}
