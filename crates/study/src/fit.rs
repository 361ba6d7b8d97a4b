//! Least-squares fit of scenario parameters to a measured loop or trajectory, with confidence intervals. Parameters
//! that the data cannot distinguish are reported.
//!
//! Modules in reading order: `data`, measured rows; `model`, the simulation of these rows; `squares`, the minimisation. This file evaluates
//! the result of the minimisation.

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

/// Thresholds for undetermined directions in the space of the logarithms of the parameters. A direction is undetermined if its standard
/// deviation is at least `FREE`, or if its singular value relative to the largest one is at most `WEAK`.
const FREE: f64 = 3.0;
const WEAK: f64 = 1e-6;
/// Smallest component, relative to the largest, for a parameter to be reported in an undetermined direction.
const SHARE: f64 = 0.2;
/// Number of lowest harmonics along the loop that contain most of the residual of a wrong model.
const HARMONICS: usize = 6;
/// Quantile of the normal distribution above which the model does not fit. Each of the two tests has a significance level of 0.0005.
const MISFIT: f64 = 3.29;
/// Residual, relative to the largest force, below which a model fits regardless of the noise; and 97.5 % quantile of the normal
/// distribution.
const LITTLE: f64 = 1e-3;
const NORMAL: f64 = 1.96;

/// Settings of a fit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Asked {
    /// Key paths of the free parameters.
    pub free: Vec<String>,
    /// Name of the contact, if there are several.
    pub contact: Option<String>,
    /// Channel of the measured displacement, such as `rig.x`; default: the displacement of the contact.
    pub displacement: Option<String>,
    /// Channel of the measured force; default: the tangential force of the contact.
    pub force: Option<String>,
    /// Standard deviation of the force in a row, N; default: estimated from the rows.
    pub noise: Option<f64>,
    /// Number of bootstrap samples for the intervals; 0 for intervals of linear theory.
    pub bootstrap: usize,
}

/// A fitted parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// Key path.
    pub path: String,
    /// SI unit.
    pub unit: &'static str,
    /// Value in the scenario.
    pub start: f64,
    /// Fitted value of the parameter.
    pub value: f64,
    /// Standard deviation.
    pub sd: f64,
    /// Lower end of the 95 % interval.
    pub low: f64,
    /// Upper end of the 95 % interval.
    pub high: f64,
}

/// Result of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Parameters in the requested order.
    pub parameters: Vec<Fitted>,
    /// Correlation matrix of the errors of the parameters.
    pub correlations: Vec<Vec<f64>>,
    /// Sum of squared residuals divided by the variance of the noise.
    pub chi_squared: f64,
    /// Number of rows minus the numbers of parameters and force offset.
    pub degrees_of_freedom: f64,
    /// Standard deviation of the force in a row, N.
    pub noise: f64,
    /// Number of simulated variants.
    pub runs: usize,
    /// Whether the residual is consistent with noise, at a significance level of 0.001.
    pub model_fits: bool,
    /// Measured data.
    pub data: Data,
    /// Forces of the model including the fitted offset, N.
    pub force: Vec<f64>,
}

/// Fits parameters of a scenario to measured data.
///
/// # Errors
/// Fails if parameters or channels do not exist, or the model cannot follow the data. Fails if the data cannot
/// distinguish the parameters, the fit does not converge, or the watcher interrupts.
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
    // Noise of the displacement acts on the force through the slope of the loop, which is known after the first fit.
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

/// Checks whether the data distinguish all parameters, by singular value decomposition.
///
/// # Errors
/// Returns [`FitError::Undetermined`] with the parameters of each undetermined direction.
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

/// Returns the parameters fitted to bootstrap samples of the data. The watcher receives the number of finished samples.
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

/// Returns whether the residual is concentrated in the first harmonics along the loop. The residual of noise contains all harmonics.
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

/// Returns the normal quantile of a ratio of two variances, from its F distribution (Wilson and Hilferty 1931; Paulson
/// 1942).
fn beyond(quotient: f64, above: f64, below: f64) -> f64 {
    let [a, b] = [above, below].map(|freedom| 2.0 / (9.0 * freedom));
    let root = math::cbrt(quotient);
    ((1.0 - b) * root - (1.0 - a)) / (a + b * root * root).sqrt()
}

impl Model<'_> {
    /// Returns a parameter with its interval, from bootstrap samples if there are any.
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
    /// Returns the content of `fit.json` without data rows.
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

    /// Returns the arguments of `--set` for the fitted scenario.
    #[must_use]
    pub fn assignments(&self) -> Vec<String> {
        self.parameters.iter().map(|fitted| format!("{}={:e}", fitted.path, fitted.value)).collect()
    }
}
