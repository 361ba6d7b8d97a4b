//! Comparison of the values of two summaries: energies, steps, contacts.

use super::allowance::Allowance;
use super::channels::distance;
use super::results::Results;
use serde::Serialize;
use serde_json::Value;
use std::collections::HashMap;
use stickslip_quantity::names::unit;
use stickslip_run::Real;

/// Parts of the summary that contain results.
const PARTS: [&str; 3] = ["contacts", "steps", "energy"];

/// Differences of the summary values.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct FigureDifferences {
    /// Number of compared values.
    pub compared: usize,
    /// Summary values that differ by more than allowed.
    pub differ: Vec<FigureDifference>,
    /// Names of summary values of run A that run B lacks.
    pub missing: Vec<String>,
    /// Names of summary values of run B that run A lacks.
    pub extra: Vec<String>,
}

/// A summary value that differs between two runs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FigureDifference {
    /// Name of the value, such as `steps.lengths_m[3]`.
    pub name: String,
    /// SI unit; empty if the value has no unit.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub unit: &'static str,
    /// Value in A.
    pub a: Value,
    /// Value in B.
    pub b: Value,
    /// Allowed difference, in the unit of the value. `None` for words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allowed: Option<Real>,
}

/// Compares the values that both runs must share.
///
/// Most values are compared only for runs of equal length. Values computed from the written rows are compared only for equal rows.
pub(super) fn compare(a: &Results, b: &Results, allowance: &Allowance) -> FigureDifferences {
    let (figures_a, figures_b) = (figures(a), figures(b));
    let known_b: HashMap<&str, &Value> =
        figures_b.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let has_same_span = a.end == b.end;
    let rows = |results: &Results| results.summary.pointer("/counts/rows").cloned();
    // Equal numbers of rows do not suffice, because the window or the interval may differ.
    let has_same_rows = rows(a) == rows(b) && a.asked.has_same_rows(&b.asked);
    // The table of the steps may be missing in one of the folders.
    let lists = |results: &Results| results.summary.pointer("/steps/lengths_m").is_some();
    let both_list = lists(a) && lists(b);
    // Different rounding can change the number of steps that count as steady.
    let is_identical = a.has_tables_of(b);
    let is_comparable = |name: &str| {
        let is_length = name.starts_with("steps.lengths_m[");
        let is_of_part = is_length || is_of_start(name);
        let is_told = is_identical || !is_judgement(name, allowance.is_same_run);
        let is_written = has_same_rows || !hangs_on_rows(name);
        !allowance.ignores(name)
            && !is_sentence(name)
            && (has_same_span || is_of_part)
            && is_written
            && is_told
            && (both_list || !is_length)
    };
    let mut differences = FigureDifferences::default();
    for &(ref name, first) in figures_a.iter().filter(|(name, _)| is_comparable(name)) {
        match known_b.get(name.as_str()) {
            Some(second) => {
                differences.compared += 1;
                differences.differ.extend(difference(name, first, second, allowance));
            }
            None if has_same_span => differences.missing.push(name.clone()),
            // The shorter run has fewer step lengths.
            None => {}
        }
    }
    if has_same_span {
        let known_a: HashMap<&str, &Value> =
            figures_a.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let extra = figures_b.iter().map(|(name, _)| name).filter(|name| is_comparable(name));
        differences.extra = extra.filter(|name| !known_a.contains_key(name.as_str())).cloned().collect();
    }
    differences
}

fn difference(name: &str, a: &Value, b: &Value, allowance: &Allowance) -> Option<FigureDifference> {
    let allowed = match (a.as_f64(), b.as_f64()) {
        (Some(x), Some(y)) => {
            let allowed = allowance.of(name, x.abs().max(y.abs()));
            if distance(x, y) <= allowed {
                return None;
            }
            Some(Real(allowed))
        }
        _ if a == b => return None,
        _ => None,
    };
    Some(FigureDifference { name: name.to_owned(), unit: unit(name), a: a.clone(), b: b.clone(), allowed })
}

/// Returns whether a value is computed from the written rows, and so depends on the row times.
fn hangs_on_rows(name: &str) -> bool {
    const ENDS: [&str; 3] = ["peak_fx_N", "peak_fn_N", "throughput_J"];
    name.contains(".largest_error_") || ENDS.iter().any(|end| name.ends_with(end))
}

/// Returns whether a value assesses other values, such as their error or the settling state.
///
/// Values that assess others change with rounding, except for the settling state, which changes only with the integrator or its tolerance.
fn is_judgement(name: &str, is_same_run: bool) -> bool {
    const OF_STEADY: [&str; 4] = ["from_period", "periods", "error_m", "repeatability_m"];
    (name.starts_with("steps.settling.") && !(is_same_run && name == "steps.settling.state"))
        || name.strip_prefix("steps.steady.").is_some_and(|rest| OF_STEADY.contains(&rest))
}

/// Returns whether a value is a sentence about other values.
fn is_sentence(name: &str) -> bool {
    name.starts_with("steps.why[")
}

/// Returns whether a value depends only on the initial state, so that it does not depend on the length of the run.
fn is_of_start(name: &str) -> bool {
    let parts: Vec<&str> = name.split('.').collect();
    matches!(parts.as_slice(), ["contacts", _, "count" | "gross_slip_displacement_m"])
        || matches!(parts.as_slice(), ["contacts", _, "one" | "all", _])
}

/// Returns the names of all values of a summary, such as `steps.lengths_m[3]`.
pub(super) fn names(results: &Results) -> impl Iterator<Item = String> {
    figures(results).into_iter().map(|(name, _)| name)
}

fn figures(results: &Results) -> Vec<(String, &Value)> {
    let mut leaves = Vec::new();
    for part in PARTS {
        if let Some(value) = results.summary.get(part) {
            collect(part.to_owned(), value, &mut leaves);
        }
    }
    // Scales are not compared, because they follow from values that are compared.
    leaves.retain(|(name, _)| !name.contains(".scales."));
    leaves
}

fn collect<'a>(name: String, value: &'a Value, leaves: &mut Vec<(String, &'a Value)>) {
    match value {
        Value::Object(entries) => {
            entries.iter().for_each(|(key, value)| collect(format!("{name}.{key}"), value, leaves));
        }
        Value::Array(entries) => {
            entries.iter().enumerate().for_each(|(i, value)| collect(format!("{name}[{i}]"), value, leaves));
        }
        _ => leaves.push((name, value)),
    }
}
