//! What two scenarios must have in common to be ends of one run.

use serde_json::Value;
use sha2::{Digest, Sha256};
use stickslip_scenario::Scenario;

/// Keys of a scenario that change nothing of what moves up to a time that both reach.
const BESIDE: [&str; 6] = ["title", "figures", "output", "plots", LIMITS, "run.until_steady"];
/// Keys that give a run its end. Whichever of them the file has may be changed from one part of a run to the next.
const END: [&str; 2] = ["run.duration", "run.cycles"];
/// Guards that may be changed as well: a run that one of them has stopped could not go on otherwise.
const LIMITS: &str = "run.limits";

/// SHA-256 of what moves: of the resolved scenario without title, end, limits, figures, output and pictures. States of runs
/// with one key are states of one motion.
pub fn model_key(scenario: &Scenario) -> [u8; 32] {
    key(scenario, BESIDE.into_iter().chain(END))
}

/// SHA-256 of the resolved scenario without its end and its limits: what all parts of a run share, their results included.
pub(super) fn run_key(scenario: &Scenario) -> [u8; 32] {
    key(scenario, END.into_iter().chain([LIMITS]))
}

/// Whether a path is that of a limit, or of all of them.
pub(super) fn is_limit(path: &str) -> bool {
    path.strip_prefix(LIMITS).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// Whether a path is one that can give a run its end.
pub(super) fn is_end(path: &str) -> bool {
    END.contains(&path)
}

/// Which key gives a scenario its end.
pub(super) fn end_of(scenario: &Scenario) -> &'static str {
    let value: Value = serde_json::from_str(&scenario.resolved()).unwrap_or_default();
    if value.pointer("/run/cycles").is_some() { END[1] } else { END[0] }
}

fn key(scenario: &Scenario, without: impl Iterator<Item = &'static str>) -> [u8; 32] {
    // What a scenario prints reads back; were it not so, all keys would be one and the states themselves still told apart.
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
