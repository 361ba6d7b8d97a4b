//! Design of a study: parameter values of each case, from grids, lists and sampled distributions.

use super::points::{Points, Sampling as Drawn};
use super::spread::Spread;
use crate::number::text;
use serde_json::{Value, json};
use stickslip_scenario::{Parameter, Sampling, ScenarioError, StudyFile, Variation};

/// Maximum number of cases: integers up to 2^53 are exact in floating point.
const MOST: u64 = 1 << 53;

/// A varied parameter.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    /// Key path.
    pub(crate) path: String,
    /// SI unit; empty for a plain number.
    pub(crate) unit: &'static str,
    pub(crate) source: Source,
}

/// Source of the values.
#[derive(Debug, Clone)]
pub(crate) enum Source {
    /// Grid or list.
    Values(Vec<f64>),
    /// Distribution.
    Spread(Spread),
}

/// Cases of a study.
///
/// A product of grids and lists has G points. Case i has sample ⌊i/G⌋ at point i mod G of this product. The last axis in the file changes
/// fastest. All grid points have the same samples, and additional cases are appended.
#[derive(Debug, Clone)]
pub(crate) struct Design {
    pub(crate) axes: Vec<Axis>,
    /// Number of cases.
    pub(crate) cases: u64,
    pub(crate) sampling: Sampling,
    /// Number of samples; for Saltelli's scheme, number of pairs of samples.
    pub(crate) samples: u64,
    seed: u64,
    /// Number of points of the product of grids and lists.
    grid: u64,
    /// Number of distributions.
    pub(crate) spreads: usize,
    points: Option<Points>,
}

impl Design {
    pub(crate) fn new(file: &StudyFile) -> Result<Self, ScenarioError> {
        if file.vary.is_empty() {
            let help = "such as \"contacts.ball.friction\": { \"uniform\": [0.1, 0.2] }".to_owned();
            return Err(file.refusal("vary", None, "no number varies", Some(help)));
        }
        let axes = file.vary.iter().map(|varied| axis(file, varied)).collect::<Result<Vec<_>, _>>()?;
        let spreads = axes.iter().filter(|axis| matches!(axis.source, Source::Spread(_))).count();
        let sampling = file.sampling.unwrap_or(if spreads > 0 { Sampling::Sobol } else { Sampling::Product });
        let refused = |key, message: &str| Err(file.refusal(key, None, message, None));
        let samples = match (file.cases, spreads, sampling) {
            (_, 1.., Sampling::Product) => {
                let message = "a product of grids has no distributions; leave \"sampling\" out, or choose another sampling";
                return refused("sampling", message);
            }
            (None, 0, _) => 1,
            (Some(_), 0, _) => {
                return refused(
                    "cases",
                    "without distributions, grids and lists determine the number of cases: leave this key out",
                );
            }
            (None, _, _) => {
                let help = "the number of samples, such as \"cases\": 1024".to_owned();
                return Err(file.refusal("vary", None, "distributions need \"cases\"", Some(help)));
            }
            (Some(0), ..) => return refused("cases", "expected at least 1 sample"),
            (Some(cases), ..) => cases,
        };
        let lengths = axes.iter().filter_map(|axis| match &axis.source {
            Source::Values(values) => Some(values.len() as u64),
            Source::Spread(_) => None,
        });
        let grid = lengths.fold(1_u64, u64::saturating_mul);
        if sampling == Sampling::Saltelli && grid > 1 {
            return refused("sampling", "Saltelli's scheme takes only distributions, no grids or lists");
        }
        let dimensions = if sampling == Sampling::Saltelli { 2 * spreads } else { spreads };
        let block = if sampling == Sampling::Saltelli { spreads as u64 + 2 } else { 1 };
        let cases = samples.saturating_mul(grid).saturating_mul(block);
        if cases > MOST {
            return refused(if spreads > 0 { "cases" } else { "vary" }, "expected at most 2^53 cases");
        }
        let drawn = match sampling {
            Sampling::Random => Drawn::Random,
            Sampling::LatinHypercube => Drawn::LatinHypercube,
            Sampling::Sobol | Sampling::Saltelli | Sampling::Product => Drawn::Sobol,
        };
        let points = (spreads > 0).then(|| Points::new(drawn, dimensions, file.seed, samples)).transpose();
        let points = points.map_err(|message| file.refusal("cases", None, &message, None))?;
        Ok(Self { axes, cases, sampling, samples, seed: file.seed, grid, spreads, points })
    }

    /// Writes the parameter values of a case, SI.
    pub(crate) fn write(&self, case: u64, numbers: &mut [f64]) {
        let (sample, mut place) = (case / self.grid, case % self.grid);
        let mut point = [0.0; 2 * FEW];
        let mut more = Vec::new();
        let point = self.point(sample, &mut point, &mut more);
        let mut next = self.spreads;
        for (axis, number) in self.axes.iter().zip(numbers).rev() {
            *number = match &axis.source {
                Source::Values(values) => {
                    let length = values.len() as u64;
                    let value = values[(place % length) as usize];
                    place /= length;
                    value
                }
                Source::Spread(spread) => {
                    next -= 1;
                    spread.quantile(point[next])
                }
            };
        }
    }

    /// Returns the point of the unit cube that belongs to a sample.
    fn point<'p>(&self, sample: u64, few: &'p mut [f64; 2 * FEW], more: &'p mut Vec<f64>) -> &'p [f64] {
        let Some(points) = &self.points else { return &[] };
        let k = self.spreads;
        let dimensions = if self.sampling == Sampling::Saltelli { 2 * k } else { k };
        let point = if dimensions <= 2 * FEW {
            &mut few[..dimensions]
        } else {
            more.resize(dimensions, 0.0);
            &mut more[..]
        };
        if self.sampling != Sampling::Saltelli {
            points.write(sample, point);
            return point;
        }
        let (base, which) = (sample / (k as u64 + 2), (sample % (k as u64 + 2)) as usize);
        points.write(base, point);
        let (a, b) = point.split_at_mut(k);
        match which {
            0 => a,
            which if which <= k => {
                a[which - 1] = b[which - 1];
                a
            }
            _ => b,
        }
    }

    /// Returns parameter values as overrides of the scenario.
    pub(crate) fn overrides(&self, numbers: &[f64]) -> Vec<(String, String)> {
        self.axes.iter().zip(numbers).map(|(axis, number)| (axis.path.clone(), text(*number))).collect()
    }

    /// Returns all data on which the parameter values of a case depend.
    pub(crate) fn definition(&self) -> Value {
        let axis = |axis: &Axis| match &axis.source {
            Source::Values(values) => json!({ "path": axis.path, "values": values }),
            Source::Spread(spread) => json!({ "path": axis.path, "distribution": format!("{spread:?}") }),
        };
        let axes: Vec<Value> = self.axes.iter().map(axis).collect();
        let strata = (self.sampling == Sampling::LatinHypercube).then_some(self.samples);
        let seed = (self.spreads > 0).then_some(self.seed);
        json!({ "vary": axes, "sampling": format!("{:?}", self.sampling), "seed": seed, "strata": strata })
    }
}

/// Number of distributions up to which the values of a case need no heap allocation.
const FEW: usize = 16;

fn axis(file: &StudyFile, (parameter, variation): &(Parameter, Variation)) -> Result<Axis, ScenarioError> {
    let source = match variation {
        Variation::Values(values) => Source::Values(values.clone()),
        Variation::Uniform(bounds) => Source::Spread(Spread::Uniform(*bounds)),
        Variation::Normal([mean, deviation], bounds) => {
            Source::Spread(Spread::Normal { mean: *mean, deviation: *deviation, bounds: *bounds })
        }
        Variation::Lognormal([median, deviation]) => {
            Source::Spread(Spread::Lognormal { median: *median, deviation: *deviation })
        }
        Variation::Triangular([low, mode, high]) => {
            Source::Spread(Spread::Triangular { low: *low, mode: *mode, high: *high })
        }
    };
    if let Source::Spread(spread) = &source
        && let Some(fault) = spread.fault()
    {
        return Err(file.refusal("vary", Some(&parameter.path), &fault, None));
    }
    Ok(Axis { path: parameter.path.clone(), unit: parameter.unit, source })
}
