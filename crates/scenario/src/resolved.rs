//! Canonical JSON of a scenario: numbers in SI, defaults written out, tables inlined.

use serde_json::Value;
use std::fmt::Write;

/// Formats a value as JSON: objects on several lines, lists of plain values on one.
pub(crate) fn print(value: &Value) -> String {
    let mut text = String::new();
    write(&mut text, value, 0);
    text.push('\n');
    text
}

fn write(text: &mut String, value: &Value, depth: usize) {
    match value {
        Value::Object(entries) if !entries.is_empty() => {
            text.push('{');
            for (i, (key, entry)) in entries.iter().enumerate() {
                separate(text, i, depth + 1);
                // Writing to a string cannot fail.
                let _ = write!(text, "{}: ", Value::String(key.clone()));
                write(text, entry, depth + 1);
            }
            end(text, '}', depth);
        }
        Value::Array(entries) if !entries.iter().all(is_plain) => {
            text.push('[');
            for (i, entry) in entries.iter().enumerate() {
                separate(text, i, depth + 1);
                write(text, entry, depth + 1);
            }
            end(text, ']', depth);
        }
        other => {
            let _ = write!(text, "{other}");
        }
    }
}

/// Returns whether a value is written on one line: a plain value, or a list of plain values.
fn is_plain(value: &Value) -> bool {
    match value {
        Value::Object(_) => false,
        Value::Array(entries) => entries.iter().all(|entry| !entry.is_object() && !entry.is_array()),
        _ => true,
    }
}

fn separate(text: &mut String, index: usize, depth: usize) {
    if index > 0 {
        text.push(',');
    }
    text.push('\n');
    text.extend(std::iter::repeat_n("  ", depth));
}

fn end(text: &mut String, bracket: char, depth: usize) {
    text.push('\n');
    text.extend(std::iter::repeat_n("  ", depth));
    text.push(bracket);
}
