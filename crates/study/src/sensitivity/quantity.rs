//! Parameters of a scenario with respect to which derivatives are computed.

use super::SensitivityError;
use serde_json::Value;
use std::collections::HashSet;
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

/// Longest list whose numbers are parameters. Longer lists are data, such as the points of a waveform.
const LIST: usize = 4;
/// Sections of the scenario whose entries have an effect only if another part refers to them by name.
const LISTS: [&str; 2] = ["materials", "waveforms"];
/// Keys that only limit the duration of a waveform.
const LENGTHS: [&str; 1] = ["cycles"];

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
        let mut tree: Value = serde_json::from_str(&job.resolved).unwrap_or_default();
        let mut named = HashSet::new();
        strings(&tree, &mut named);
        for list in LISTS {
            if let Some(entries) = tree.get_mut(list).and_then(Value::as_object_mut) {
                entries.retain(|name, _| named.contains(name));
            }
        }
        let mut paths = Vec::new();
        leaves(String::new(), &tree, &mut paths);
        let known = paths.iter().filter_map(|path| Self::of(job, path).ok());
        known.filter(|quantity| quantity.value != 0.0).collect()
    }
}

/// Collects all strings in the values of a JSON tree.
fn strings(here: &Value, found: &mut HashSet<String>) {
    match here {
        Value::Object(entries) => entries.values().for_each(|inner| strings(inner, found)),
        Value::Array(entries) => entries.iter().for_each(|inner| strings(inner, found)),
        Value::String(text) => found.extend([text.clone()]),
        _ => {}
    }
}

/// Collects the key paths of all numbers.
fn leaves(path: String, here: &Value, found: &mut Vec<String>) {
    match here {
        Value::Object(entries) => {
            for (key, inner) in entries.iter().filter(|(key, _)| !LENGTHS.contains(&key.as_str())) {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                leaves(path, inner, found);
            }
        }
        // Lists of objects contain parts of the scenario, such as loads.
        Value::Array(entries) if entries.len() <= LIST || entries.iter().all(Value::is_object) => {
            entries.iter().enumerate().for_each(|(i, inner)| leaves(format!("{path}[{i}]"), inner, found));
        }
        Value::Number(_) => found.push(path),
        _ => {}
    }
}
