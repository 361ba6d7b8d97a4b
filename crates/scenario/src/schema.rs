//! The JSON Schema of the scenario file, generated from the form's types.

use crate::form::Form;
use crate::resolved;
use schemars::Schema;
use schemars::generate::SchemaSettings;
use schemars::transform::transform_subschemas;
use serde_json::Value;

/// The JSON Schema (draft 2020-12) of the scenario file, version 1; a copy lies in `schema/scenario-1.json`.
pub fn schema() -> String {
    let generator = SchemaSettings::draft2020_12().into_generator();
    let mut schema = generator.into_root_schema_for::<Form>();
    without_null(&mut schema);
    resolved::print(schema.as_value())
}

/// A key that may be left out is an option in the form's types, and schemars lets options be null. The loader does not.
fn without_null(schema: &mut Schema) {
    // schemars marks what serde never writes; to a reader of the schema that says nothing.
    schema.remove("writeOnly");
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
            for (key, value) in only {
                // The key's own description says more than that of its type.
                if schema.get(&key).is_none() {
                    schema.insert(key, value);
                }
            }
        }
    }
    transform_subschemas(&mut without_null, schema);
}
