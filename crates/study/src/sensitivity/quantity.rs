//! Parameters of a scenario with respect to which derivatives are computed.

use super::SensitivityError;
use stickslip_run::Job;
use stickslip_scenario::Parameter;

/// A parameter of the scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Key path.
    pub path: String,
    /// SI unit; empty for a plain number.
    pub unit: &'static str,
    /// Value, SI.
    pub value: f64,
}

impl Quantity {
    /// Returns the parameter at a key path.
    ///
    /// # Errors
    /// Fails if the path does not name a real number, or the scenario omits it.
    pub(super) fn of(job: &Job, path: &str) -> Result<Self, SensitivityError> {
        let Parameter { path, value, unit, .. } = job.scenario.parameter(path)?;
        match value {
            Some(value) => Ok(Self { path, unit, value }),
            None => Err(SensitivityError::LeftOut { file: job.name.clone(), path }),
        }
    }

    /// Returns all parameters of the model, except parameters with the value 0 and those of unused materials and waveforms.
    pub(super) fn all(job: &Job) -> Vec<Self> {
        let known =
            job.scenario.parameters().into_iter().filter_map(|Parameter { path, value, unit, .. }| {
                value.filter(|value| *value != 0.0).map(|value| Self { path, unit, value })
            });
        known.collect()
    }
}
