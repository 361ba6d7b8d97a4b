//! JSON Schema of the scenario file, generated from the types of the keys.

mod rule;

pub(crate) use rule::{
    above_zero, at_least_zero, cycles_or_dwell, duration_or_cycles, flyback_or_resonance, gaps_or_file,
    heights_or_file, inertia_where_free, law_or_file, names, no_default, no_ground, no_trace_column,
    period_or_dwell, period_or_frequency, points_or_file, radius_or_diameter, something_on_it,
    something_to_do, stroke_or_voltage,
};

#[cfg(not(target_family = "wasm"))]
use crate::form::Form;
use crate::resolved;
use crate::study::StudyForm;
use schemars::generate::SchemaSettings;
use schemars::transform::transform_subschemas;
use schemars::{JsonSchema, Schema};
use serde_json::{Map, Value, json};

/// Returns the JSON Schema (draft 2020-12) of the scenario file, version 1. The file `schema/scenario-1.json` is a copy.
pub fn schema() -> String {
    resolved::print(&tree())
}

/// Returns the JSON Schema (draft 2020-12) of study files, version 1. The file `schema/study-1.json` is a copy.
pub fn study_schema() -> String {
    resolved::print(&study_tree())
}

/// Returns the schema of scenario files as a value.
#[cfg(not(target_family = "wasm"))]
pub(crate) fn tree() -> Value {
    let mut schema = of::<Form>();
    schema.insert("defaultSnippets".to_owned(), json!([{ "label": "a drive", "body": snippet() }]));
    schema.to_value()
}

/// Returns the published schema, which is the same: reading it takes a tenth of the code that makes it.
#[cfg(target_family = "wasm")]
pub(crate) fn tree() -> Value {
    serde_json::from_str(include_str!("../../../schema/scenario-1.json")).unwrap_or_default()
}

/// Returns the schema of study files as a value.
pub(crate) fn study_tree() -> Value {
    of::<StudyForm>().to_value()
}

fn of<T: JsonSchema>() -> Schema {
    let mut schema = SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<T>();
    tidy(&mut schema);
    // Setting for JSON editors: comments are allowed.
    schema.insert("allowComments".to_owned(), json!(true));
    schema
}

/// Returns the snippet that an editor offers for an empty file.
#[cfg(not(target_family = "wasm"))]
fn snippet() -> Value {
    json!({
        "stickslip": 1,
        "title": "A ball between a foot and a slider",
        "materials": { "hardened steel": { "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 } },
        "waveforms": {
            "drive": { "sawtooth": { "stroke": "200 nm", "period": "10 ms", "flyback": "10 us" } }
        },
        "bodies": {
            "foot": { "x": { "follows": "drive" } },
            "slider": { "mass": "10 g", "x": "free" }
        },
        "contacts": {
            "ball": {
                "between": ["foot", "slider"],
                "materials": ["hardened steel", "hardened steel"],
                "profile": { "paraboloid": { "radius": "0.5 mm" } },
                "friction": 0.2,
                "normal": { "force": "0.3 N" }
            }
        },
        "run": { "duration": "100 ms" },
        "output": { "every": "10 us" },
        "plots": ["loop", "trajectory"]
    })
}

/// Simplifies a schema of schemars for JSON editors.
fn tidy(schema: &mut Schema) {
    // schemars writes `writeOnly` and number formats, which have no meaning for readers of the schema.
    schema.remove("writeOnly");
    schema.remove("format");
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = text.replace('\n', " ");
    }
    without_null(schema);
    if let Some(Value::Array(kinds)) = schema.remove("oneOf") {
        let kinds = kinds.into_iter().map(of_one_key).filter(|kind| *kind != json!({ "not": {} }));
        let kinds = words_together(kinds.collect());
        match <[Value; 1]>::try_from(kinds) {
            Ok([Value::Object(only)]) => fill(schema, only),
            Ok([only]) => {
                schema.insert("oneOf".to_owned(), json!([only]));
            }
            Err(kinds) => {
                schema.insert("oneOf".to_owned(), Value::Array(kinds));
            }
        }
    }
    transform_subschemas(&mut tidy, schema);
}

/// Allows null for the items of a list, such as an end of travel without a stop.
pub(crate) fn items_or_null(schema: &mut Schema) {
    if let Some(items) = schema.get_mut("items") {
        // A constant, because types that are null are removed.
        *items = json!({ "anyOf": [items.take(), { "const": null }] });
    }
}

/// Removes null. Optional keys are `Option`s in the types, for which schemars allows null; the reader of scenario files does not.
fn without_null(schema: &mut Schema) {
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|kind| kind != "null");
        if let [only] = types.as_slice() {
            let only = only.clone();
            schema.insert("type".to_owned(), only);
        }
    }
    if let Some(Value::Array(options)) = schema.get_mut("anyOf") {
        let before = options.len();
        options.retain(|option| option.get("type").is_none_or(|kind| kind != "null"));
        let only = match options.as_slice() {
            [Value::Object(only)] if before > 1 => Some(only.clone()),
            _ => None,
        };
        if let Some(only) = only {
            schema.remove("anyOf");
            fill(schema, only);
        }
    }
}

/// Adds missing keywords. Existing keywords stay: the description of a key takes precedence over the description of its type.
fn fill(schema: &mut Schema, more: Map<String, Value>) {
    for (key, value) in more {
        if schema.get(&key).is_none() {
            schema.insert(key, value);
        }
    }
}

/// Copies description and example of a variant such as `{"force": …}` to its only key.
fn of_one_key(mut kind: Value) -> Value {
    let described: Vec<_> = ["description", "examples"].map(|key| kind.get(key).cloned()).into();
    let Some(Value::Object(keys)) = kind.get_mut("properties") else { return kind };
    let mut keys = keys.iter_mut();
    let (Some((name, Value::Object(inner))), None) = (keys.next(), keys.next()) else { return kind };
    if let Some(description) = &described[0] {
        inner.insert("description".to_owned(), description.clone());
    }
    if let Some(Value::Array(examples)) = &described[1] {
        let inside: Vec<_> = examples.iter().filter_map(|example| example.get(name)).collect();
        inner.insert("examples".to_owned(), json!(inside));
    }
    kind
}

/// Joins variants that are single words into one `enum` with descriptions, because editors complete enums.
fn words_together(kinds: Vec<Value>) -> Vec<Value> {
    let (words, mut others): (Vec<_>, Vec<_>) =
        kinds.into_iter().partition(|kind| kind.get("const").is_some_and(Value::is_string));
    if !words.is_empty() {
        let each = |key| words.iter().filter_map(|word| word.get(key)).collect::<Vec<_>>();
        let list =
            json!({ "type": "string", "enum": each("const"), "enumDescriptions": each("description") });
        others.insert(0, list);
    }
    others
}
