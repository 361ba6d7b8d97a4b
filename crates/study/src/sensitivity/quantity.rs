//! Numbers of a scenario that derivatives are taken with respect to.

use super::SensitivityError;
use serde_json::Value;
use std::collections::HashSet;
use stickslip_run::Job;
use stickslip_scenario::Parameter;

/// A number of the scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Its key path.
    pub path: String,
    /// Its SI unit; empty for a plain number.
    pub unit: &'static str,
    /// What it is, SI.
    pub value: f64,
}

/// Longer lists are data, such as the points of a waveform.
const LIST: usize = 4;
/// Parts that do something only where another one names them.
const LISTS: [&str; 2] = ["materials", "waveforms"];
/// How long something goes on, and no more.
const LENGTHS: [&str; 1] = ["cycles"];

impl Quantity {
    /// The number under a key path.
    ///
    /// # Errors
    /// None that can change by any amount, or one that the scenario leaves out.
    pub(super) fn of(job: &Job, path: &str) -> Result<Self, SensitivityError> {
        let Parameter { path, value, unit, .. } = job.scenario.parameter(path)?;
        match value {
            Some(value) => Ok(Self { path, unit, value }),
            None => Err(SensitivityError::LeftOut { file: job.name.clone(), path }),
        }
    }

    /// All numbers of the scenario that say what there is and what drives it, but those that are 0 and those of materials and waveforms
    /// that nothing names.
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

/// All texts, but keys.
fn strings(here: &Value, found: &mut HashSet<String>) {
    match here {
        Value::Object(entries) => entries.values().for_each(|inner| strings(inner, found)),
        Value::Array(entries) => entries.iter().for_each(|inner| strings(inner, found)),
        Value::String(text) => found.extend([text.clone()]),
        _ => {}
    }
}

/// Key paths of the numbers under one.
fn leaves(path: String, here: &Value, found: &mut Vec<String>) {
    match here {
        Value::Object(entries) => {
            for (key, inner) in entries.iter().filter(|(key, _)| !LENGTHS.contains(&key.as_str())) {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                leaves(path, inner, found);
            }
        }
        // Parts of a scene come in lists as well.
        Value::Array(entries) if entries.len() <= LIST || entries.iter().all(Value::is_object) => {
            entries.iter().enumerate().for_each(|(i, inner)| leaves(format!("{path}[{i}]"), inner, found));
        }
        Value::Number(_) => found.push(path),
        _ => {}
    }
}
