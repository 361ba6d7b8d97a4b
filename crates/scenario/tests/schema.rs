//! The schema: generated from the form's types, equal to the copy in `schema/`, and true of good scenarios.
//!
//! After a change of the form: run with `STICKSLIP_WRITE=1`, and read the difference.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails like the test")]

use serde_json::{Value, json};
use std::fs;
use stickslip_scenario::{Scenario, schema};

const COPY: &str = "../../schema/scenario-1.json";
const SCENARIOS: &str = "../../scenarios";

fn validator() -> jsonschema::Validator {
    let schema: Value = serde_json::from_str(&schema()).unwrap();
    jsonschema::draft202012::meta::validate(&schema).unwrap();
    jsonschema::validator_for(&schema).unwrap()
}

#[test]
fn the_copy_is_the_schema_of_the_types() {
    if std::env::var_os("STICKSLIP_WRITE").is_some() {
        fs::write(COPY, schema()).unwrap();
    }
    assert_eq!(fs::read_to_string(COPY).unwrap(), schema());
}

#[test]
fn examples_and_what_they_resolve_to_are_valid() {
    let validator = validator();
    let mut count = 0;
    for entry in fs::read_dir(SCENARIOS).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "json") {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        let resolved = Scenario::load(&path).unwrap_or_else(|error| panic!("{error}")).resolved();
        for text in [text, resolved] {
            let value = serde_json::from_str(&text).unwrap();
            let errors: Vec<_> = validator.iter_errors(&value).map(|error| error.to_string()).collect();
            assert!(errors.is_empty(), "{}: {errors:?}", path.display());
        }
        count += 1;
    }
    assert!(count > 0);
}

#[test]
fn what_the_loader_refuses_by_form_the_schema_refuses() {
    let validator = validator();
    let good: Value =
        serde_json::from_str(&fs::read_to_string("../../scenarios/quickstart.json").unwrap()).unwrap();
    assert!(validator.is_valid(&good));
    let bad = [
        ("/contacts/ball/friction", json!(-0.2)),
        ("/contacts/ball/friction", json!("0.2")),
        ("/contacts/ball/count", json!(2.5)),
        ("/contacts/ball/count", Value::Null),
        ("/contacts/ball/normal", json!({ "force": "5 mm" })),
        ("/contacts/ball/normal", json!({ "force": 1, "radius": 1 })),
        ("/contacts/ball/profile", json!({ "table": {} })),
        ("/contacts/ball/between", json!(["foot"])),
        ("/bodies/slider/mass", json!("10")),
        ("/waveforms/drive/sawtooth/stroke", json!("10 parsec")),
        ("/stickslip", json!(2)),
        ("/plots/0", json!("lop")),
    ];
    for (pointer, value) in bad {
        let mut scenario = good.clone();
        *scenario.pointer_mut(pointer).unwrap() = value.clone();
        assert!(!validator.is_valid(&scenario), "{pointer} = {value}");
    }
    let mut scenario = good.clone();
    scenario["contacts"]["ball"]["fricton"] = json!(1);
    assert!(!validator.is_valid(&scenario));
    let mut scenario = good;
    scenario["bodies"]["slider"]["inertia"] = json!(1);
    assert!(!validator.is_valid(&scenario), "keys of later versions are marked in an editor");
}
