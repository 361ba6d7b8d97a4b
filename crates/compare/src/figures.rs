//! Figures of two summaries: energies, steps, contacts.

use super::allowance::Allowance;
use super::channels::distance;
use super::results::Results;
use serde::Serialize;
use serde_json::Value;
use std::collections::HashMap;
use stickslip_quantity::names::unit;
use stickslip_run::Real;

/// Parts of a summary that say what a run came to.
const PARTS: [&str; 3] = ["contacts", "steps", "energy"];

/// How the figures differ.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct FigureDifferences {
    /// Number of figures that were compared.
    pub compared: usize,
    /// Those that differ by more than is allowed.
    pub differ: Vec<FigureDifference>,
    /// Figures of A that B has not.
    pub missing: Vec<String>,
    /// Figures of B that A has not.
    pub extra: Vec<String>,
}

/// A figure that differs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FigureDifference {
    /// Name of the figure, such as `steps.lengths_m[3]`.
    pub name: String,
    /// Its SI unit; empty where it has none.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub unit: &'static str,
    /// What A has.
    pub a: Value,
    /// What B has.
    pub b: Value,
    /// None for words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub allowed: Option<Real>,
}

/// Compares the figures that both runs must have in common: over one span of time, with the same rows where they hang
/// on these.
pub(super) fn compare(a: &Results, b: &Results, allowance: &Allowance) -> FigureDifferences {
    let (figures_a, figures_b) = (figures(a), figures(b));
    let known_b: HashMap<&str, &Value> =
        figures_b.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let has_same_span = a.end == b.end;
    let rows = |results: &Results| results.summary.pointer("/counts/rows").cloned();
    // As many rows may be others: those of another window, or of another interval.
    let has_same_rows = rows(a) == rows(b) && a.asked.has_same_rows(&b.asked);
    // Whoever has sent one of them may have left out the table of the steps.
    let lists = |results: &Results| results.summary.pointer("/steps/lengths_m").is_some();
    let both_list = lists(a) && lists(b);
    // Rounding alone may lengthen the stretch in which steps count as steady.
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
            // The shorter run made fewer steps.
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

/// Figures that are taken from the rows that were written, and differ where other rows are.
fn hangs_on_rows(name: &str) -> bool {
    const ENDS: [&str; 3] = ["peak_fx_N", "peak_fn_N", "throughput_J"];
    name.contains(".largest_error_") || ENDS.iter().any(|end| name.ends_with(end))
}

/// Figures that tell how sure others are: by other rounding they are others, by steps of another kind even whether a motion has settled.
fn is_judgement(name: &str, is_same_run: bool) -> bool {
    const OF_STEADY: [&str; 4] = ["from_period", "periods", "error_m", "repeatability_m"];
    (name.starts_with("steps.settling.") && !(is_same_run && name == "steps.settling.state"))
        || name.strip_prefix("steps.steady.").is_some_and(|rest| OF_STEADY.contains(&rest))
}

/// Sentences, which say in words what other figures are.
fn is_sentence(name: &str) -> bool {
    name.starts_with("steps.why[")
}

/// Figures of the start, which are there however long the run is.
fn is_of_start(name: &str) -> bool {
    let parts: Vec<&str> = name.split('.').collect();
    matches!(parts.as_slice(), ["contacts", _, "count" | "gross_slip_displacement_m"])
        || matches!(parts.as_slice(), ["contacts", _, "one" | "all", _])
}

/// Names of all figures of a summary, such as `steps.lengths_m[3]`.
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
    // What others are measured by comes of what is compared anyway.
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
