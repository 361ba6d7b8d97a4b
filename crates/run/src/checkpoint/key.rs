//! Hash keys that identify scenarios with compatible checkpoints.

use serde_json::Value;
use sha2::{Digest, Sha256};
use stickslip_scenario::Scenario;

/// Keys of a scenario that do not affect the motion.
const BESIDE: [&str; 7] = ["title", "figures", "output", "plots", "interface", LIMITS, "run.until_steady"];
/// Keys that determine the end of a run. A resumed run can change the one of these keys that its scenario contains.
const END: [&str; 2] = ["run.duration", "run.cycles"];
/// Key of the limits of a run. A resumed run can change them, because a run stopped by a limit could not continue otherwise.
const LIMITS: &str = "run.limits";

/// Returns the SHA-256 of the resolved scenario without its end, limits, results, output, plots and title.
///
/// States of runs with equal keys are compatible.
pub fn model_key(scenario: &Scenario) -> [u8; 32] {
    key(scenario, BESIDE.into_iter().chain(END))
}

/// Returns the SHA-256 of the resolved scenario without its end and limits. An interrupted run and its continuations have the same hash.
pub(super) fn run_key(scenario: &Scenario) -> [u8; 32] {
    key(scenario, END.into_iter().chain([LIMITS]))
}

/// Returns whether a key is `run.limits` or one of its keys.
pub(super) fn is_limit(path: &str) -> bool {
    path.strip_prefix(LIMITS).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// Returns whether a key determines the end of a run.
pub(super) fn is_end(path: &str) -> bool {
    END.contains(&path)
}

/// Returns the key that determines the end of the scenario.
pub(super) fn end_of(scenario: &Scenario) -> &'static str {
    let value: Value = serde_json::from_str(&scenario.resolved()).unwrap_or_default();
    if value.pointer("/run/cycles").is_some() { END[1] } else { END[0] }
}

fn key(scenario: &Scenario, without: impl Iterator<Item = &'static str>) -> [u8; 32] {
    // A resolved scenario is valid JSON, so parsing succeeds.
    let mut value: Value = serde_json::from_str(&scenario.resolved()).unwrap_or_default();
    for path in without {
        remove(&mut value, path);
    }
    Sha256::digest(value.to_string().as_bytes()).into()
}

fn remove(value: &mut Value, path: &str) {
    let (parent, key) = match path.split_once('.') {
        Some((parent, key)) => (value.get_mut(parent), key),
        None => (Some(value), path),
    };
    if let Some(Value::Object(entries)) = parent {
        entries.shift_remove(key);
    }
}
