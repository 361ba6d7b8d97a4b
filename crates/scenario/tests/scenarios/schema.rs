//! The schema is generated from the types of the keys. It must equal the copy in `schema/` and accept all valid scenarios.
//!
//! After a change of the keys, run `STICKSLIP_WRITE=1 cargo test -p stickslip-scenario --test scenarios schema`, and read the difference.

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;
use stickslip_scenario::{Scenario, schema, study_schema};

const COPY: &str = "../../schema/scenario-1.json";
const STUDIES: &str = "../../schema/study-1.json";
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
    if std::env::var_os("STICKSLIP_WRITE").is_some() {
        fs::write(STUDIES, study_schema()).unwrap();
    }
    assert_eq!(fs::read_to_string(STUDIES).unwrap(), study_schema());
}

/// Study file of the documentation, and one with every kind of variation.
#[test]
fn good_studies_are_valid() {
    let schema: Value = serde_json::from_str(&study_schema()).unwrap();
    jsonschema::draft202012::meta::validate(&schema).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let own: Value =
        serde_json::from_str(&fs::read_to_string("../../docs/studies/friction.json").unwrap()).unwrap();
    let vary = json!({
        "a": { "grid": ["1 um", 2e-6, 3] }, "b": { "log": [1, "2 N", 3] }, "c": { "list": [1, "2 N"] },
        "d": { "uniform": [1, 2] }, "e": { "normal": [1, 2] }, "f": { "normal": [1, 2, 0, 3] },
        "g": { "lognormal": ["1 N", 1.2] }, "h": { "triangular": [1, 2, 3] },
    });
    let mut all = own.clone();
    all["vary"] = vary;
    for good in [&own, &all] {
        let errors: Vec<_> = validator.iter_errors(good).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{errors:?}");
    }
    for (key, bad) in [
        ("vary", json!({ "a": { "uniform": [1] } })),
        ("vary", json!({ "a": { "normal": [1, 2, 3] } })),
        ("vary", json!({ "a": { "gauss": [1, 2] } })),
        ("chunk", json!(0)),
        ("results", json!([])),
        ("sampling", json!("grid")),
        ("other", json!(1)),
    ] {
        let mut study = own.clone();
        study[key] = bad;
        assert!(!validator.is_valid(&study), "{key}");
    }
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
        ("/bodies/slider", json!({ "inertia": "10 g", "pitch": "free" })),
        ("/bodies/slider", json!({ "pitch": { "follows": "drive", "free": {} } })),
        ("/bodies/slider", json!({ "start": { "pitch": "1 um" } })),
        ("/contacts/ball/normal", json!({ "coupled": {} })),
        ("/loads/0", json!({ "on": "slider", "pitch": "1 N" })),
        ("/loads/0", json!({ "on": "slider", "z": "1 N", "at": { "y": 1 } })),
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
    scenario["contacts"]["ball"]["at"] = json!({ "slider": [0, 1] });
    assert!(!validator.is_valid(&scenario));
    let mut scenario = good.clone();
    scenario["contacts"]["ball"]["fricton"] = json!(1);
    assert!(!validator.is_valid(&scenario));
    let mut scenario = good;
    scenario["actuators"]["stack"] =
        json!({ "between": ["ground", "slider"], "stiffness": 1, "stroke": 1, "voltage": 1 });
    assert!(!validator.is_valid(&scenario), "keys of later versions are marked in an editor");
}

/// Key of the schema: its name, its schema, and whether it is required.
struct Key<'a> {
    name: &'a str,
    schema: &'a Value,
    is_required: bool,
}

/// Collects all keys that the schema describes, without conditions.
fn keys<'a>(schema: &'a Value, found: &mut Vec<Key<'a>>) {
    let Value::Object(entries) = schema else { return };
    let required = entries.get("required").and_then(Value::as_array);
    for (name, inner) in entries.get("properties").and_then(Value::as_object).into_iter().flatten() {
        let is_required = required.is_some_and(|required| required.iter().any(|key| key == name));
        found.push(Key { name, schema: inner, is_required });
    }
    for group in ["properties", "$defs"] {
        entries.get(group).and_then(Value::as_object).into_iter().flatten().for_each(|(_, s)| keys(s, found));
    }
    let kinds = entries.get("oneOf").and_then(Value::as_array).into_iter().flatten();
    kinds.filter(|kind| kind.get("type").is_some()).for_each(|kind| keys(kind, found));
}

/// Returns the unit in the description of a quantity.
fn unit<'a>(root: &'a Value, schema: &Value) -> Option<&'a str> {
    let named = root.pointer(schema["$ref"].as_str()?.strip_prefix('#')?)?;
    let described = named["description"].as_str().unwrap_or("");
    if described.ends_with("constant or following a waveform.") {
        return unit(root, &named["anyOf"][0]);
    }
    Some(described.split_once(": a number in ")?.1.split_once(',')?.0)
}

#[test]
fn every_key_is_described_with_unit_default_and_examples() {
    let root: Value = serde_json::from_str(&schema()).unwrap();
    let mut found = Vec::new();
    keys(&root, &mut found);
    assert!(found.len() > 100, "{}", found.len());
    let mut units = 0;
    for Key { name, schema, is_required } in found {
        let text = schema["description"].as_str().unwrap_or_else(|| panic!("{name} is not described"));
        assert!(text.len() > 10 && text.ends_with('.') && !text.contains('\n'), "{name}: {text}");
        if let Some(unit) = unit(&root, schema) {
            let words: Vec<&str> = text.split([',', ';', ':', '.', '(']).map(str::trim).collect();
            let of_another = unit == "SI" && words.contains(&"in the unit of the driven quantity");
            let said = words.iter().any(|word| *word == unit || *word == format!("a number in {unit}"));
            assert!(said || of_another, "{name}: no word of {unit} in {text}");
            units += 1;
        }
        let says = |words: &[&str]| words.iter().any(|word| text.contains(word));
        let optional = says(&["default", "needed", "required", "this or", "Only \"fixed\""]);
        assert!(is_required || schema.get("default").is_some() || optional, "{name}: no default in {text}");
        let mut alone = schema.clone();
        alone["$defs"] = root["$defs"].clone();
        let validator = jsonschema::validator_for(&alone).unwrap();
        let examples = schema["examples"].as_array().unwrap_or_else(|| panic!("{name} has no example"));
        for example in examples.iter().chain(schema.get("default")) {
            let errors: Vec<_> = validator.iter_errors(example).map(|error| error.to_string()).collect();
            assert!(errors.is_empty(), "{name} = {example}: {errors:?}");
        }
    }
    assert!(units > 40, "{units}");
}

#[test]
fn what_an_editor_offers_for_an_empty_file_runs() {
    let schema: Value = serde_json::from_str(&schema()).unwrap();
    let body = schema["defaultSnippets"][0]["body"].to_string();
    let scenario = Scenario::from_str(&body, "snippet", "").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scenario.warnings, []);
    assert!(validator().is_valid(&serde_json::from_str(&body).unwrap()));
}

/// Reasons why a schema cannot detect an error: names of other parts, relations between values, largest and smallest numbers, other
/// files, the model, duplicate keys.
const REASONS: [&str; 6] = ["name", "relation", "number", "file", "model", "duplicate"];

const MISSES: &str = "tests/schema_misses.txt";

/// The schema refuses every invalid scenario except those in `tests/schema_misses.txt`, each listed with the reason.
#[test]
fn the_schema_catches_what_a_schema_can() {
    let validator = validator();
    let listed = fs::read_to_string(MISSES).unwrap();
    let listed: BTreeMap<&str, &str> =
        listed.lines().skip(1).filter_map(|line| line.split_once(": ")).collect();
    let (mut files, mut syntax, mut caught, mut missed) = (0, 0, 0, BTreeMap::new());
    for entry in fs::read_dir("tests/bad").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "json") {
            continue;
        }
        files += 1;
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let text = fs::read(&path).unwrap();
        match serde_json::from_slice::<Value>(&text) {
            Err(_) => syntax += 1,
            Ok(value) if !validator.is_valid(&value) => caught += 1,
            Ok(_) => {
                let reason = listed.get(name.as_str()).copied().unwrap_or("no reason given").to_owned();
                missed.insert(name, reason);
            }
        }
    }
    let count = format!(
        "{files} bad scenarios: {syntax} are no JSON, {caught} are caught by the schema, {} are not:",
        missed.len()
    );
    let lines: Vec<String> = missed.iter().map(|(name, reason)| format!("{name}: {reason}")).collect();
    if std::env::var_os("STICKSLIP_WRITE").is_some() {
        fs::write(MISSES, format!("{count}\n{}\n", lines.join("\n"))).unwrap();
    }
    for (name, reason) in &missed {
        assert!(REASONS.contains(&reason.as_str()), "{name}: {reason}");
        let told = fs::read_to_string(format!("tests/bad/{name}.txt")).unwrap();
        assert_eq!(told.contains("occurs twice"), reason == "duplicate", "{name}");
    }
    let written = fs::read_to_string(MISSES).unwrap();
    assert_eq!(written, format!("{count}\n{}\n", lines.join("\n")));
    assert!(missed.values().filter(|reason| *reason != "duplicate").count() >= 25);
}
