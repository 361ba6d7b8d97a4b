//! Rules of the schema that types do not express: ranges of quantities, keys that require or exclude each other, names.

use schemars::Schema;
use serde_json::{Map, Value, json};

/// Restricts a number or quantity to values above zero.
pub(crate) fn above_zero(schema: &mut Schema) {
    bound(schema, &json!({ "exclusiveMinimum": 0, "pattern": r"^\s*0*\.?0*[1-9]" }));
}

/// Restricts a number or quantity to values of at least zero. The pattern allows -0.
pub(crate) fn at_least_zero(schema: &mut Schema) {
    bound(schema, &json!({ "minimum": 0, "pattern": r"^\s*([^-\s]|-[0.]*([^0-9.]|$))" }));
}

/// Adds rules to a schema: number rules apply to numbers, patterns to strings. For a variant such as `{"force": …}` the rules apply to
/// its value, for a list to its entries.
fn bound(schema: &mut Schema, rules: &Value) {
    let Some(rules) = rules.as_object() else { return };
    let apply = |inner: &mut Map<String, Value>| inner.extend(rules.clone());
    if let Some(Value::Object(keys)) = schema.get_mut("properties") {
        keys.values_mut().filter_map(Value::as_object_mut).for_each(apply);
    } else if let Some(Value::Object(items)) = schema.get_mut("items") {
        apply(items);
    } else if let Some(Value::Array(items)) = schema.get_mut("prefixItems") {
        items.iter_mut().filter_map(Value::as_object_mut).for_each(apply);
    } else {
        for (key, value) in rules {
            schema.insert(key.clone(), value.clone());
        }
    }
}

/// Characters that names must not contain: control characters, ASCII symbols except `+`, `-` and `_`, and blocks of Unicode symbols.
/// Classes such as `\p{L}` are not used, because some JSON Schema validators do not know them. The check of the scenario also refuses the
/// symbols that pass this pattern, such as emoji.
const SIGNS: &str = concat!(
    r"!-*,./:-@\[-\^`{-\u00a9\u00ab-\u00b1\u00b4\u00b6-\u00b8\u00bb\u00bf\u00d7\u00f7\u0300-\u036f",
    r"\u2000-\u206f\u20a0-\u20ff\u2190-\u245f\u2500-\u2bff\u3000-\u3004\u3008-\u3020\ue000-\uf8ff"
);

/// Returns the rule for names of parts, which occur in key paths and column headers.
pub(crate) fn names() -> Value {
    let (end, inner) = (format!(r"[^\u0000- {SIGNS}]"), format!(r"[^\u0000-\u001f{SIGNS}]"));
    json!({ "pattern": format!("^{end}({inner}*{end})?$"), "maxLength": 64 })
}

/// Removes the default, because an omitted value depends on other keys.
pub(crate) fn no_default(schema: &mut Schema) {
    schema.remove("default");
}

/// Forbids the name `ground`, which is the fixed ground.
pub(crate) fn no_ground(schema: &mut Schema) {
    not_named(schema, &["ground"]);
}

/// Forbids names of columns of the trace, because names of contacts begin column names.
pub(crate) fn no_trace_column(schema: &mut Schema) {
    not_named(schema, &["ground", "energy", "time_s"]);
}

fn not_named(schema: &mut Schema, taken: &[&str]) {
    if let Some(Value::Object(names)) = schema.get_mut("propertyNames") {
        names.insert("not".to_owned(), json!({ "enum": taken }));
    }
}

/// A periodic waveform has either a period or a frequency, and at most one of burst and sequence.
pub(crate) fn period_or_frequency(schema: &mut Schema) {
    either(schema, "period", "frequency");
    schema.insert("not".to_owned(), json!({ "required": ["burst", "sequence"] }));
}

/// A burst has either a period or a dwell.
pub(crate) fn period_or_dwell(schema: &mut Schema) {
    either(schema, "period", "dwell");
}

/// An entry of a sequence has either cycles (run) or a dwell (rest).
pub(crate) fn cycles_or_dwell(schema: &mut Schema) {
    let run = json!({ "required": ["cycles"], "properties": { "dwell": false } });
    let rest =
        json!({ "required": ["dwell"], "properties": { "cycles": false, "reversed": { "const": false } } });
    schema.insert("oneOf".to_owned(), json!([run, rest]));
}

/// A sawtooth has a flyback, a resonance or a maximum rate, but not both flyback and resonance.
pub(crate) fn flyback_or_resonance(schema: &mut Schema) {
    let keys = ["flyback", "resonance", "rate"].map(|key| json!({ "required": [key] }));
    schema.insert("anyOf".to_owned(), json!(keys));
    schema.insert("allOf".to_owned(), json!([{ "not": { "required": ["flyback", "resonance"] } }]));
}

/// A run has either a duration or a number of cycles.
pub(crate) fn duration_or_cycles(schema: &mut Schema) {
    either(schema, "duration", "cycles");
}

/// A round face or a ball has either a radius or a diameter.
pub(crate) fn radius_or_diameter(schema: &mut Schema) {
    either(schema, "radius", "diameter");
}

fn either(schema: &mut Schema, one: &str, other: &str) {
    schema.insert("oneOf".to_owned(), json!([{ "required": [one] }, { "required": [other] }]));
}

/// A table has either points or a file.
pub(crate) fn points_or_file(schema: &mut Schema) {
    here_or_in_file(schema, ["points"], &["time", "value"]);
}

/// A profile by points has either points or a file.
pub(crate) fn gaps_or_file(schema: &mut Schema) {
    here_or_in_file(schema, ["points"], &["radius", "gap"]);
}

/// A normal law has either points or a file.
pub(crate) fn law_or_file(schema: &mut Schema) {
    here_or_in_file(schema, ["points"], &["indentation", "force"]);
}

/// A rough line has either heights, or a file, or is generated as a self-affine line.
pub(crate) fn heights_or_file(schema: &mut Schema) {
    let without =
        |keys: &[&str]| keys.iter().map(|key| ((*key).to_owned(), json!(false))).collect::<Map<_, _>>();
    let here = json!({ "required": ["heights", "spacing"], "properties": without(&["file", "recipe", "height", "self_affine"]) });
    let there = json!({ "required": ["file"], "anyOf": [{ "required": ["height"] }, { "required": ["recipe"] }], "properties": without(&["heights", "self_affine"]) });
    let made = json!({ "required": ["self_affine"], "properties": without(&["heights", "file", "recipe", "height", "spacing", "level", "within"]) });
    schema.insert("oneOf".to_owned(), json!([here, there, made]));
}

/// Requires either a list in the scenario, or columns of a file.
fn here_or_in_file(schema: &mut Schema, list: [&str; 1], columns: &[&str]) {
    let there: Vec<&str> = ["file", "recipe"].iter().chain(columns).copied().collect();
    let without =
        |keys: &[&str]| keys.iter().map(|key| ((*key).to_owned(), json!(false))).collect::<Map<_, _>>();
    let here = json!({ "required": list, "properties": without(&there) });
    let named: Vec<&str> = ["file"].iter().chain(columns).copied().collect();
    let there = json!({ "anyOf": [{ "required": named }, { "required": ["file", "recipe"] }], "properties": without(&list) });
    schema.insert("oneOf".to_owned(), json!([here, there]));
}

/// A free x or z requires a mass, a free pitch a moment of inertia.
pub(crate) fn inertia_where_free(schema: &mut Schema) {
    let where_free = |axis: &str, needed: &str| {
        let free = json!({ "properties": { axis: { "const": "free" } }, "required": [axis] });
        json!({ "if": free, "then": { "required": [needed] } })
    };
    let rules =
        [("x", "mass"), ("z", "mass"), ("pitch", "inertia")].map(|(axis, needed)| where_free(axis, needed));
    schema.insert("allOf".to_owned(), json!(rules));
}

/// A spring has a stiffness, a damping or a preload.
pub(crate) fn something_to_do(schema: &mut Schema) {
    let keys = ["stiffness", "damping", "preload"].map(|key| json!({ "required": [key] }));
    schema.insert("anyOf".to_owned(), json!(keys));
}

/// A piezo stack has either a stroke or a voltage, and a stiffness or a data sheet.
pub(crate) fn stroke_or_voltage(schema: &mut Schema) {
    either(schema, "stroke", "voltage");
    let keys = ["stiffness", "data_sheet"].map(|key| json!({ "required": [key] }));
    schema.insert("anyOf".to_owned(), json!(keys));
}

/// A load has a component x, z or pitch.
pub(crate) fn something_on_it(schema: &mut Schema) {
    let keys = ["x", "z", "pitch"].map(|key| json!({ "required": [key] }));
    schema.insert("anyOf".to_owned(), json!(keys));
}
