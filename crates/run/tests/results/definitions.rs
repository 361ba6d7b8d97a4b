//! Every written value has a definition.

use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use stickslip_drive::Model;
use stickslip_run::definitions;
use stickslip_scenario::Scenario;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn defined(file: &str, name: &str) -> bool {
    definitions().iter().any(|definition| definition.defines(file, name))
}

#[test]
fn every_channel_of_every_example_is_defined() {
    let mut lacking = BTreeSet::new();
    for entry in fs::read_dir(root().join("scenarios")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "json") {
            continue;
        }
        let scenario = Scenario::load(&path).unwrap();
        let channels = Model::new(&scenario.scene).unwrap().channels();
        assert!(channels.len() > 5);
        lacking.extend(channels.into_iter().map(|c| c.name).filter(|name| !defined("trace.csv", name)));
    }
    assert!(lacking.is_empty(), "{lacking:?}");
}

/// Collects the paths of all keys with values. Names of parts are kept.
fn keys(value: &Value, here: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(entries) => {
            for (key, inner) in entries {
                // The dot in a file name does not separate keys.
                let key = key.replace('.', " ");
                keys(inner, &if here.is_empty() { key } else { format!("{here}.{key}") }, found);
            }
        }
        Value::Array(entries) if entries.iter().any(Value::is_object) => {
            entries.iter().for_each(|inner| keys(inner, here, found));
        }
        _ => drop(found.insert(here.to_owned())),
    }
}

#[test]
fn every_key_of_every_golden_summary_is_defined() {
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(root().join("tests/golden")).unwrap() {
        if let Ok(text) = fs::read_to_string(entry.unwrap().path().join("summary.json")) {
            keys(&serde_json::from_str(&text).unwrap(), "", &mut found);
        }
    }
    assert!(found.len() > 100, "{}", found.len());
    // Golden results omit and add some keys, such as the steps without their table.
    let is_theirs = |name: &str| name.starts_with("excerpt") || name == "steps.lengths_m";
    let lacking: Vec<_> =
        found.iter().filter(|name| !is_theirs(name) && !defined("summary.json", name)).collect();
    assert!(lacking.is_empty(), "{lacking:?}");
}
