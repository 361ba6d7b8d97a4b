//! Posterior sampling of the branch parameters, amplitude and time lag of a steady loop.

use super::branch::Branch;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Number of phase bins into which a period is divided.
pub(super) const BINS: usize = 256;
/// Number of intervals per period of the tabulated displacement.
const TABLE: usize = 2048;
/// Number of Markov chains, number of their steps, and number of discarded initial steps.
const WALKERS: usize = 24;
const STEPS: usize = 400;
const FORGOTTEN: usize = 160;
/// Number of steps of a Markov chain per kept sample. The others are discarded, because consecutive steps are correlated.
const KEPT: usize = 4;
/// Largest stretch factor of a step of the Markov chains (Goodman and Weare 2010).
const STRETCH: f64 = 2.0;
/// Largest time lag, in periods.
const LAG: f64 = 0.05;
/// Bounds of the parameters: lag, ln y, and the coordinates of n and ρ.
///
/// Coordinates of n below 1 and of ρ outside of 0 to 1 are set to these limits. The special values n = 1, ρ = 0 and ρ = 1 then have a
/// finite probability.
const BOUNDS: [[f64; 2]; 4] = [[-LAG, LAG], [-4.6, 1.8], [0.6, 2.6], [-0.5, 1.2]];

/// Maximum correlation of neighbouring bins that is taken into account.
const MOST_ALIKE: f64 = 0.95;
/// Minimum noise, relative to the largest force.
const LEAST: f64 = 1e-7;
/// Maximum number of iterations of the optimisation, and relative step of the finite differences.
const ROUNDS: usize = 40;
const DIFFERENCE: f64 = 1e-6;

/// Parameters: lag in periods, ln y, coordinate of n, coordinate of ρ.
type Place = [f64; 4];

/// A steady loop averaged over one period.
#[derive(Debug, Clone)]
pub(super) struct Folded {
    /// Phase, mean force and number of rows of each bin.
    pub(super) bins: Vec<[f64; 3]>,
    /// Sum of squared deviations of the rows from the means of their bins, and its degrees of freedom.
    pub(super) within: [f64; 2],
    /// Tabulated relative displacement versus phase ([`Folded::shares`]).
    pub(super) shares: Vec<f64>,
    /// Phase of the minimum displacement.
    pub(super) turn: f64,
}

/// Posterior sample: time lag in periods, branch, height of the branch, N, and middle of the force range, N.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub(super) lag: f64,
    pub(super) branch: Branch,
    pub(super) height: f64,
    pub(super) middle: f64,
}

/// Best fitting height and middle of the forces for a given branch and lag, with the sum of squared residuals.
struct Fit {
    squares: f64,
    height: f64,
    middle: f64,
    /// Reciprocal variance of the height for unit noise.
    weight: f64,
}

impl Folded {
    /// Returns the relative displacement, from 0 (minimum) to 1 (maximum), at equally spaced phases from 0 to 2π.
    pub(super) fn shares(u: impl Fn(f64) -> f64, [low, high]: [f64; 2]) -> Vec<f64> {
        (0..=TABLE).map(|k| (u(TAU * k as f64 / TABLE as f64) - low) / (high - low)).collect()
    }

    /// Returns the relative displacement at a phase, from 0 (minimum) to 1 (maximum).
    pub(super) fn share(&self, phase: f64) -> f64 {
        let place = phase.rem_euclid(TAU) / TAU * TABLE as f64;
        let k = (place as usize).min(TABLE - 1);
        self.shares[k] + (place - k as f64) * (self.shares[k + 1] - self.shares[k])
    }

    /// Returns the relative displacement since the last reversal before a phase, and whether this reversal was the maximum.
    fn way(&self, phase: f64) -> (f64, bool) {
        let share = self.share(phase);
        let goes_down = phase.rem_euclid(TAU) < self.turn;
        ((if goes_down { 1.0 - share } else { share }).clamp(0.0, 1.0), goes_down)
    }

    /// Returns the force of the model at a phase, relative to the middle, for a branch of height 1.
    fn model(&self, branch: &Branch, lag: f64, phase: f64) -> f64 {
        let (way, goes_down) = self.way(phase - TAU * lag);
        let value = branch.at(way) - 0.5;
        if goes_down { -value } else { value }
    }

    fn fit(&self, place: &Place) -> Fit {
        let branch = branch(place);
        let (mut w, mut x, mut y, mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        for [phase, force, rows] in &self.bins {
            let value = self.model(&branch, place[0], *phase);
            w += rows;
            x += rows * value;
            y += rows * force;
            xx += rows * value * value;
            xy += rows * value * force;
            yy += rows * force * force;
        }
        let (xx, xy, yy) = (xx - x * x / w, xy - x * y / w, yy - y * y / w);
        let height = if xx > 0.0 { xy / xx } else { 0.0 };
        let middle = (y - height * x) / w;
        Fit { squares: (yy - height * xy).max(0.0), height, middle, weight: xx }
    }

    /// Returns the weighted residuals of all bins for the best fitting height and middle, and this fit.
    fn left(&self, place: &Place) -> (DVector<f64>, Fit) {
        let (fit, branch) = (self.fit(place), branch(place));
        let left = self.bins.iter().map(|[phase, force, rows]| {
            rows.sqrt() * (force - fit.middle - fit.height * self.model(&branch, place[0], *phase))
        });
        let left = DVector::from_iterator(self.bins.len(), left);
        (left.clone(), Fit { squares: left.norm_squared(), ..fit })
    }

    /// Returns the best parameters for a given sign of the force, with a free or a known lag.
    ///
    /// The Levenberg–Marquardt method starts from the best grid point for each of three exponents.
    fn best(&self, lag: Option<f64>, is_turned: bool) -> (f64, Place) {
        let lags: Vec<f64> = match lag {
            Some(lag) => vec![lag],
            None => (-10..=10).map(|k| LAG * f64::from(k) / 10.0).collect(),
        };
        let mut starts = [1.0, 1.5, 2.0].map(|power| (f64::INFINITY, [0.0, 0.0, power, 0.0]));
        for start in &mut starts {
            let power = start.1[2];
            let elastic = [-0.1, 0.3].into_iter();
            let all = lags.iter().flat_map(|lag| {
                let ways = elastic.clone().flat_map(|elastic| (-8..=3).map(move |way| (elastic, way)));
                ways.map(|(elastic, way)| [*lag, 0.45 * f64::from(way), power, elastic])
            });
            for place in all.chain(lags.iter().map(|lag| [*lag, 0.0, power, 0.9])) {
                let fit = self.fit(&place);
                if fit.squares < start.0 && (fit.height < 0.0) == is_turned {
                    *start = (fit.squares, place);
                }
            }
        }
        let ends = starts.map(|start| self.improve(start, usize::from(lag.is_some()), is_turned));
        ends.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or(starts[0])
    }

    /// Optimises the parameters from index `first` on; earlier parameters are constant.
    fn improve(&self, start: (f64, Place), first: usize, is_turned: bool) -> (f64, Place) {
        let (mut squares, mut place) = start;
        if squares.is_infinite() {
            return start;
        }
        let mut damping = 1e-2;
        for _ in 0..ROUNDS {
            let (left, _) = self.left(&place);
            let mut slopes = DMatrix::zeros(left.len(), 4);
            for k in first..4 {
                let [low, high] = BOUNDS[k];
                let step = if place[k] + DIFFERENCE * (high - low) > high { -DIFFERENCE } else { DIFFERENCE };
                let mut next = place;
                next[k] += step * (high - low);
                slopes.set_column(k, &((self.left(&next).0 - &left) / (step * (high - low))));
            }
            let (normal, right) = (slopes.transpose() * &slopes, slopes.transpose() * &left);
            let before = squares;
            for _ in 0..8 {
                let mut damped = normal.clone();
                for k in 0..4 {
                    damped[(k, k)] += damping * normal[(k, k)] + f64::MIN_POSITIVE.sqrt();
                }
                let Some(step) = damped.cholesky().map(|factors| factors.solve(&right)) else { break };
                let next: Place =
                    std::array::from_fn(|k| (place[k] - step[k]).clamp(BOUNDS[k][0], BOUNDS[k][1]));
                let (_, fit) = self.left(&next);
                if fit.squares < squares && (fit.height < 0.0) == is_turned {
                    (squares, place) = (fit.squares, next);
                    damping *= 0.2;
                    break;
                }
                damping *= 5.0;
            }
            if squares >= before * (1.0 - 1e-9) {
                break;
            }
        }
        (squares, place)
    }

    /// Returns whether the measured force has the opposite sign, and the difference of the sums of squares relative to the noise variance.
    pub(super) fn sense(&self) -> (bool, f64) {
        let (driving, resisting) = (self.best(None, false), self.best(None, true));
        let is_turned = resisting.0 < driving.0;
        let (noise, _) = self.noise(driving.0.min(resisting.0));
        (is_turned, (driving.0 - resisting.0).abs() / noise)
    }

    /// Returns the noise variance of a row, and the root mean square misfit of the best branch.
    ///
    /// The noise is the scatter of the rows within bins. If the bins deviate significantly more from the branch, their deviations determine
    /// the noise. Otherwise the misfit is 0.
    fn noise(&self, squares: f64) -> (f64, f64) {
        let count = self.bins.len() as f64;
        let rows: f64 = self.bins.iter().map(|bin| bin[2]).sum();
        let force = self.bins.iter().map(|bin| bin[1].abs()).fold(0.0, f64::max);
        let between = squares / (count - 6.0).max(1.0);
        let pooled = (squares + self.within[0]) / (rows - 6.0).max(1.0);
        let within = self.within[0] / self.within[1].max(1.0);
        let is_other = between > within * (1.0 + 4.0 * (2.0 / count).sqrt());
        let least = (LEAST * force).powi(2).max(f64::MIN_POSITIVE);
        let noise = if is_other || self.within[1] < 1.0 { between.max(pooled) } else { pooled };
        (noise.max(least), if is_other { (squares / rows).sqrt() } else { 0.0 })
    }

    /// Returns the number of bins that count as one independent bin, because the residuals of neighbouring bins are correlated.
    fn likeness(&self, place: &Place) -> f64 {
        let (left, _) = self.left(place);
        let next: f64 = (0..left.len()).map(|k| left[k] * left[(k + 1) % left.len()]).sum();
        let share = (next / left.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, MOST_ALIKE);
        (1.0 + share) / (1.0 - share)
    }

    /// Samples the parameters from the posterior distribution, with a free or a known lag. The second result is the misfit, N.
    pub(super) fn sample(&self, lag: Option<f64>) -> (Vec<Sample>, f64) {
        let (best, place) = self.best(lag, false);
        let (noise, misfit) = self.noise(best);
        let noise = if misfit > 0.0 { noise * self.likeness(&place) } else { noise };
        let first = usize::from(lag.is_some());
        let mut random = Random(ChaCha8Rng::from_seed([7; 32]));
        let log = |place: &Place| {
            let is_within = place.iter().zip(BOUNDS).all(|(value, [low, high])| (low..=high).contains(value));
            if !is_within {
                return f64::NEG_INFINITY;
            }
            let fit = self.fit(place);
            // The likelihood is marginalised over the height, which has a uniform prior.
            if fit.height > 0.0 {
                -0.5 * fit.squares / noise - 0.5 * math::ln(fit.weight)
            } else {
                f64::NEG_INFINITY
            }
        };
        let widths = self.widths(&place, best + noise, first);
        let mut walkers: Vec<(Place, f64)> = Vec::with_capacity(WALKERS);
        while walkers.len() < WALKERS {
            let mut start = place;
            for k in first..4 {
                start[k] = (start[k] + widths[k] * random.normal()).clamp(BOUNDS[k][0], BOUNDS[k][1]);
            }
            let value = log(&start);
            walkers.push(if value.is_finite() { (start, value) } else { (place, log(&place)) });
        }
        let mut samples = Vec::new();
        for step in 0..STEPS {
            for w in 0..WALKERS {
                let other = (w + 1 + random.below(WALKERS - 1)) % WALKERS;
                let stretch = (1.0 + (STRETCH - 1.0) * random.uniform()).powi(2) / STRETCH;
                let (at, before) = walkers[w];
                let mut next = at;
                for k in first..4 {
                    next[k] = walkers[other].0[k] + stretch * (at[k] - walkers[other].0[k]);
                }
                let after = log(&next);
                let dimensions = (4 - first) as f64;
                if math::ln(random.uniform()) < (dimensions - 1.0) * math::ln(stretch) + after - before {
                    walkers[w] = (next, after);
                }
                if step >= FORGOTTEN && step % KEPT == 0 {
                    samples.push(self.draw(&walkers[w].0, noise, &mut random));
                }
            }
        }
        (samples, misfit)
    }

    /// Returns for each parameter from index `first` on a distance at which the sum of squares does not exceed `limit` on both sides.
    fn widths(&self, place: &Place, limit: f64, first: usize) -> Place {
        std::array::from_fn(|k| {
            let [low, high] = BOUNDS[k];
            let mut width = 0.3 * (high - low);
            for _ in 0..40 {
                let is_far = [1.0, -1.0].into_iter().all(|sign| {
                    let mut next = *place;
                    next[k] = (next[k] + sign * width).clamp(low, high);
                    self.fit(&next).squares > limit
                });
                if k < first || !is_far {
                    break;
                }
                width *= 0.6;
            }
            width
        })
    }

    fn draw(&self, place: &Place, noise: f64, random: &mut Random) -> Sample {
        let fit = self.fit(place);
        let rows: f64 = self.bins.iter().map(|bin| bin[2]).sum();
        Sample {
            lag: place[0],
            branch: branch(place),
            height: (fit.height + (noise / fit.weight).sqrt() * random.normal()).max(0.0),
            middle: fit.middle + (noise / rows).sqrt() * random.normal(),
        }
    }
}

fn branch(place: &Place) -> Branch {
    Branch { way: math::exp(place[1]), power: place[2].max(1.0), elastic: place[3].clamp(0.0, 1.0) }
}

/// Random numbers with a fixed seed, so that results are reproducible.
struct Random(ChaCha8Rng);

impl Random {
    /// Returns a number between 0 and 1.
    fn uniform(&mut self) -> f64 {
        ((self.0.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        ((self.uniform() * count as f64) as usize).min(count - 1)
    }

    /// Returns a standard normal number (Box–Muller method).
    fn normal(&mut self) -> f64 {
        (-2.0 * math::ln(self.uniform())).sqrt() * math::cos(TAU * self.uniform())
    }
}
