//! Numbers of a scenario fitted to a measured loop or to rows of a trajectory: least squares, with intervals, and with the names of numbers that the data cannot tell
//! apart.
//!
//! In reading order: `data`, what was measured; `model`, what a variant of the scenario has in its place; `squares`, the search; this file, what is
//! told of its end.

mod data;
mod error;
mod model;
mod squares;

pub use data::Data;
pub use error::FitError;

use crate::each::each;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use model::Model;
use nalgebra::{DMatrix, DVector};
use serde_json::{Map, Value, json};
use squares::{Found, Squares};
use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip_run::measured::{How, Measured};
use stickslip_run::{Job, Watcher};

/// A direction of the numbers, as logarithms, is free along which the data leave more than so many e-folds, or in which they say so little
/// beside the others.
const FREE: f64 = 3.0;
const WEAK: f64 = 1e-6;
/// Numbers with at least this share of the largest part of a free direction are in it.
const SHARE: f64 = 0.2;
/// Harmonics along the loop in which a wrong model leaves most of what it leaves.
const HARMONICS: usize = 6;
/// Quantile of the normal distribution beyond which a model does not fit: each of two tests at 0.0005.
const MISFIT: f64 = 3.29;
/// What is left of a model that fits whatever the noise, as a share of the largest force: loops of rows are no better.
const LITTLE: f64 = 1e-3;
const NORMAL: f64 = 1.96;

/// What is to be fitted, and to what.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Asked {
    /// Key paths of the numbers that are free.
    pub free: Vec<String>,
    /// Name of the contact, where there are several.
    pub contact: Option<String>,
    /// Channel that the measured displacement is, such as `rig.x`; by default the displacement of the contact.
    pub displacement: Option<String>,
    /// Channel that the measured force is; by default the tangential force of the contact.
    pub force: Option<String>,
    /// Standard deviation of the force of a row, N; by default it is found from the rows.
    pub noise: Option<f64>,
    /// Number of drawn data sets from which intervals are taken; 0 for those of the linear theory.
    pub bootstrap: usize,
}

/// A number that was fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// Its key path.
    pub path: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// As the scenario has it.
    pub start: f64,
    /// As it fits best.
    pub value: f64,
    /// Standard deviation.
    pub sd: f64,
    /// Low end of the interval of 95 %.
    pub low: f64,
    /// High end.
    pub high: f64,
}

/// What came of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The numbers in the order asked for.
    pub parameters: Vec<Fitted>,
    /// Correlations of their errors.
    pub correlations: Vec<Vec<f64>>,
    /// Sum of the squares of what is left, over the variance of the noise.
    pub chi_squared: f64,
    /// Rows less numbers, and less the offset of the force.
    pub degrees_of_freedom: f64,
    /// Standard deviation of the force of a row, N.
    pub noise: f64,
    /// How many variants of the scenario were computed.
    pub runs: usize,
    /// Whether what is left is noise: the probability of as much by chance is more than 0.001.
    pub model_fits: bool,
    /// The data, and the forces of the model with its offset, N.
    pub data: Data,
    /// Forces of the model.
    pub force: Vec<f64>,
}

/// Fits numbers of a scenario.
///
/// # Errors
/// Numbers or channels that are not there, data that the model cannot follow, numbers that the data cannot tell apart; the watcher's wish.
pub fn fit(
    job: &Job,
    (measured, how): (&mut Measured, &How),
    asked: &Asked,
    (cores, watcher): (usize, &(dyn Watcher + Sync)),
) -> Result<Fit, FitError> {
    let model = Model::new(job, asked, watcher)?;
    let data = model.data(measured, how)?;
    let squares = Squares { model: &model, data: &data, weights: data.weights(None) };
    let start = vec![0.0; asked.free.len()];
    told_apart(&squares.slopes(&start)?, data.sigma(asked.noise), &asked.free)?;
    let first = squares.least(&start)?;
    // The noise of displacements counts by the slope of the loop.
    let squares = Squares { weights: data.weights(Some(&first.force)), ..squares };
    let mut found = squares.least(&first.place)?;
    found.runs += first.runs;
    let slopes = squares.slopes(&found.place)?;
    let freedom = (data.force.len() as f64 - found.place.len() as f64 - 1.0).max(1.0);
    let own = (found.squares / freedom).sqrt();
    let sigma = asked.noise.unwrap_or(own);
    told_apart(&slopes, sigma, &asked.free)?;
    let covariance = (slopes.transpose() * &slopes).try_inverse().ok_or(FitError::NoFit)? * sigma.powi(2);
    let drawn = drawn(&squares, &found, (sigma, asked.bootstrap), cores)?;
    let largest = found.force.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
    let noise = asked.noise.or(data.noise).unwrap_or(own).max(1e-9 * largest);
    let chi_squared = found.squares / noise.powi(2);
    let known = asked.noise.map(|_| f64::INFINITY).or(data.noise.map(|_| data.freedom));
    let is_too_much = known
        .is_some_and(|freedom_of_noise| beyond(chi_squared / freedom, freedom, freedom_of_noise) > MISFIT);
    let parameters = (0..found.place.len()).map(|k| model.fitted(k, &found.place, &covariance, &drawn));
    let deviation = |k: usize| covariance[(k, k)].sqrt();
    let correlation = |i: usize, j: usize| covariance[(i, j)] / (deviation(i) * deviation(j));
    let count = found.place.len();
    Ok(Fit {
        parameters: parameters.collect(),
        correlations: (0..count).map(|i| (0..count).map(|j| correlation(i, j)).collect()).collect(),
        chi_squared,
        degrees_of_freedom: freedom,
        noise: sigma,
        runs: found.runs + 4 * count,
        model_fits: own <= LITTLE * largest || !is_too_much && !is_smooth(&found.left),
        force: found.force,
        data,
    })
}

/// Refuses numbers that the data cannot tell apart: directions of their logarithms in which hardly anything changes.
fn told_apart(slopes: &DMatrix<f64>, sigma: f64, free: &[String]) -> Result<(), FitError> {
    let parts = slopes.clone().svd(false, true);
    let Some(directions) = parts.v_t else { return Ok(()) };
    let most = parts.singular_values.max();
    let mut groups = Vec::new();
    for (k, value) in parts.singular_values.iter().enumerate() {
        if *value > WEAK * most && FREE * value > sigma {
            continue;
        }
        let direction = directions.row(k);
        let largest = direction.amax();
        let inside = free.iter().zip(direction.iter()).filter(|(_, part)| part.abs() > SHARE * largest);
        groups.push(inside.map(|(path, _)| path.clone()).collect());
    }
    if groups.is_empty() { Ok(()) } else { Err(FitError::Undetermined(groups)) }
}

/// Places fitted to data that are drawn about the best ones; the watcher is told how many there are.
fn drawn(
    squares: &Squares<'_>,
    found: &Found,
    (sigma, count): (f64, usize),
    cores: usize,
) -> Result<Vec<Vec<f64>>, FitError> {
    let (watcher, done) = (squares.model.watcher, AtomicUsize::new(0));
    let one = |seed: usize| {
        let mut random = ChaCha8Rng::seed_from_u64(seed as u64);
        let mut uniform = || ((random.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64;
        let mut normal = || (-2.0 * math::ln(uniform())).sqrt() * math::cos(TAU * uniform());
        let mut data = squares.data.clone();
        for (row, force) in data.force.iter_mut().enumerate() {
            *force = found.force[row] + sigma / squares.weights[row].sqrt() * normal();
        }
        let squares = Squares { model: squares.model, data: &data, weights: squares.weights.clone() };
        let place = squares.least(&found.place).ok().map(|found| found.place);
        watcher.reached((done.fetch_add(1, Ordering::Relaxed) + 1) as f64);
        place
    };
    let places = each(count, cores, one).into_iter().flatten().collect();
    if watcher.goes_on() { Ok(places) } else { Err(FitError::Interrupted) }
}

/// Whether what is left lies in the first harmonics along the loop far more than noise would.
fn is_smooth(left: &DVector<f64>) -> bool {
    let rows = left.len();
    let mut inside = 0.0;
    for h in 1..=HARMONICS {
        let (mut a, mut b) = (0.0, 0.0);
        for (row, left) in left.iter().enumerate() {
            let (sin, cos) = math::sin_cos(TAU * h as f64 * row as f64 / rows as f64);
            a += left * cos;
            b += left * sin;
        }
        inside += 2.0 * (a * a + b * b) / rows as f64;
    }
    let within = 2.0 * HARMONICS as f64;
    let others = rows as f64 - within - 3.0;
    let rest = (left.norm_squared() - inside).max(f64::MIN_POSITIVE);
    others > within && beyond((inside / within) / (rest / others), within, others) > MISFIT
}

/// By how many standard deviations a quotient of two variances is too large (Wilson and Hilferty 1931; Paulson 1942).
fn beyond(quotient: f64, above: f64, below: f64) -> f64 {
    let [a, b] = [above, below].map(|freedom| 2.0 / (9.0 * freedom));
    let root = math::cbrt(quotient);
    ((1.0 - b) * root - (1.0 - a)) / (a + b * root * root).sqrt()
}

impl Model<'_> {
    /// A number at a place, with its interval: of the drawn places where there are any.
    fn fitted(&self, k: usize, place: &[f64], covariance: &DMatrix<f64>, drawn: &[Vec<f64>]) -> Fitted {
        let quantity = &self.free[k];
        let value = quantity.at(place[k]);
        let deviation = covariance[(k, k)].sqrt();
        let mut ends = [-NORMAL, NORMAL].map(|by| quantity.at(place[k] + by * deviation));
        let mut sd = quantity.slope(place[k]).abs() * deviation;
        if drawn.len() > 1 {
            let mut values: Vec<f64> = drawn.iter().map(|place| quantity.at(place[k])).collect();
            values.sort_unstable_by(f64::total_cmp);
            let at = |share: f64| values[((share * values.len() as f64) as usize).min(values.len() - 1)];
            ends = [at(0.025), at(0.975)];
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let squares = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
            sd = (squares / (values.len() - 1) as f64).sqrt();
        }
        let [low, high] = if ends[0] <= ends[1] { ends } else { [ends[1], ends[0]] };
        Fitted {
            path: quantity.path.clone(),
            unit: quantity.unit,
            start: quantity.start,
            value,
            sd,
            low,
            high,
        }
    }
}

impl Fit {
    /// All of it but the rows, for machines.
    #[must_use]
    pub fn json(&self) -> Value {
        let mut parameters = Map::new();
        for Fitted { path, unit, start, value, sd, low, high } in &self.parameters {
            let told =
                json!({ "value": value, "low": low, "high": high, "sd": sd, "unit": unit, "start": start });
            parameters.insert(path.clone(), told);
        }
        json!({
            "parameters": parameters,
            "correlations": self.correlations,
            "chi_squared": self.chi_squared,
            "degrees_of_freedom": self.degrees_of_freedom,
            "noise_N": self.noise,
            "runs": self.runs,
            "undetermined": [],
            "model_fits": self.model_fits,
        })
    }

    /// The assignments that make the scenario the fitted one.
    #[must_use]
    pub fn assignments(&self) -> Vec<String> {
        self.parameters.iter().map(|fitted| format!("{}={:e}", fitted.path, fitted.value)).collect()
    }
}
