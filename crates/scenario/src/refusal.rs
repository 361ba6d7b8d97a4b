//! What serde says about a form that does not fit, in the words and with the place of a fault.

use crate::document::Document;
use crate::fault::Fault;
use crate::path::{KeyPath, Step};
use crate::quantity::HELP;
use crate::suggest;
use serde_path_to_error::Segment;

/// Gives a refusal its place and its words.
pub(crate) fn fault(document: &Document, error: &serde_path_to_error::Error<serde_json::Error>) -> Fault {
    let path = path(document, error.path());
    let message = error.inner().to_string();
    if let Some((name, known)) = quoted(&message, "unknown field `") {
        return unknown_key(document, path, name, &known);
    }
    if let Some((name, known)) = quoted(&message, "unknown variant `") {
        return unknown_variant(document, path, name, &known);
    }
    if let Some(name) = message.strip_prefix("missing field `").and_then(|rest| rest.strip_suffix('`')) {
        return Fault::new(path, format!("missing key \"{name}\"")).on_key();
    }
    for prefix in ["invalid type: ", "invalid value: ", "invalid length "] {
        if let Some((came, wanted)) = message.strip_prefix(prefix).and_then(|m| m.rsplit_once(", expected "))
        {
            return unexpected(document, path, came, wanted);
        }
    }
    let (text, help) = message.split_once(HELP).unwrap_or((&message, ""));
    let help = (!help.is_empty()).then(|| help.to_owned());
    let follow = follow_help(document, &path);
    Fault::new(path, text).maybe_help(help).maybe_help(follow)
}

/// The path as far as it stands in the file: serde also counts variants that are bare strings.
fn path(document: &Document, path: &serde_path_to_error::Path) -> KeyPath {
    let steps = path.iter().map_while(|segment| match segment {
        Segment::Seq { index } => Some(Step::Index(*index)),
        Segment::Map { key } | Segment::Enum { variant: key } => Some(Step::Key(key.clone())),
        Segment::Unknown => None,
    });
    let mut path = KeyPath(steps.collect());
    let (_, depth) = document.root.deepest(&path);
    path.0.truncate(depth);
    path
}

/// The name after a prefix, and the names listed as expected.
fn quoted<'a>(message: &'a str, prefix: &str) -> Option<(&'a str, Vec<&'a str>)> {
    let rest = message.strip_prefix(prefix)?;
    let (name, known) = match rest.rsplit_once("`, expected ") {
        Some((name, known)) => (name, known),
        None => (rest.rsplit_once("`, there are no ")?.0, ""),
    };
    Some((name, known.split('`').skip(1).step_by(2).collect()))
}

fn unknown_key(document: &Document, mut path: KeyPath, name: &str, known: &[&str]) -> Fault {
    if path.0.last() != Some(&Step::Key(name.to_owned())) {
        path.0.push(Step::Key(name.to_owned()));
    }
    let (_, depth) = document.root.deepest(&path);
    path.0.truncate(depth);
    Fault::new(path, "unknown key").on_key().maybe_help(suggest::help(name, known.iter().copied()))
}

fn unknown_variant(document: &Document, mut path: KeyPath, name: &str, known: &[&str]) -> Fault {
    let help = suggest::nearest(name, known.iter().copied()).map(|near| format!("did you mean \"{near}\"?"));
    let follow = follow_help(document, &path);
    let wanted = match known {
        [one] => format!("\"{one}\""),
        all => format!("one of {}", all.join(", ")),
    };
    let step = Step::Key(name.to_owned());
    let is_key = document.root.deepest(&path).0.step(&step).is_some();
    if is_key {
        path.0.push(step);
    }
    let shown = crate::document::shown(name);
    let fault =
        Fault::new(path, format!("expected {wanted}, got \"{shown}\"")).maybe_help(help).maybe_help(follow);
    if is_key { fault.on_key() } else { fault }
}

fn unexpected(document: &Document, path: KeyPath, came: &str, wanted: &str) -> Fault {
    if wanted.contains("map with a single key") || wanted == "fewer elements in map" {
        let names = keys(document, &path).join(", ");
        let message = format!("expected one key that says which kind, got {names}");
        return Fault::new(path, message).on_key().help("keep one of them");
    }
    if let ("unit", Some(Step::Key(name))) = (wanted, path.0.last()) {
        let message =
            format!("expected \"{}\" alone, without an object around it", crate::document::shown(name));
        return Fault::new(path, message).on_key();
    }
    let variant = value(document, &path).and_then(serde_json::Value::as_str).unwrap_or("name");
    let variant = format!("an object such as {{\"{}\": …}}", crate::document::shown(variant));
    let wanted = match wanted {
        "newtype variant" => &variant,
        "f64" => "a number",
        "a string" => "a string in double quotes",
        "a sequence" => "a list",
        "string or map" => "a name or an object with one key",
        "a map" | "map" | "struct variant" => "an object",
        "unit variant" => "a bare name",
        other if other.starts_with("struct ") => "an object",
        other => other,
    };
    let count = came.chars().all(|c| c.is_ascii_digit());
    let fault = Fault::new(path.clone(), format!("expected {wanted}"));
    let written = if count { Some(format!("{came} entries")) } else { came_as(document, &path) };
    let help = follow_help(document, &path).or_else(|| quotes_help(document, &path, wanted));
    match written {
        Some(written) => Fault { message: format!("{}, got {written}", fault.message), ..fault },
        None => fault,
    }
    .maybe_help(help)
}

/// A number in quotes where no unit is wanted.
fn quotes_help(document: &Document, path: &KeyPath, wanted: &str) -> Option<String> {
    let number = value(document, path)?.as_str()?.trim().parse::<f64>().ok()?;
    let plain = matches!(wanted, "a number" | "a whole number") && number.is_finite();
    plain.then(|| "write the number without quotes".to_owned())
}

/// What stands there, strings in quotes.
fn came_as(document: &Document, path: &KeyPath) -> Option<String> {
    let written = document.written(path)?;
    let is_string = document.root.deepest(path).0.value;
    let quotes = document.slice(is_string).starts_with('"') || value_is_string(document, path);
    Some(if quotes { format!("\"{written}\"") } else { written })
}

/// Overrides hold strings without quotes.
fn value_is_string(document: &Document, path: &KeyPath) -> bool {
    value(document, path).is_some_and(serde_json::Value::is_string)
}

fn value<'a>(document: &'a Document, path: &KeyPath) -> Option<&'a serde_json::Value> {
    path.0.iter().try_fold(&document.value, |value, step| match step {
        Step::Key(key) => value.get(key),
        Step::Index(index) => value.get(index),
    })
}

fn keys<'a>(document: &'a Document, path: &KeyPath) -> Vec<&'a str> {
    let entries = value(document, path).and_then(serde_json::Value::as_object);
    entries.map(|entries| entries.keys().map(String::as_str).collect()).unwrap_or_default()
}

/// A bare string is always a quantity: whoever wrote the name of a waveform is told how to follow it.
fn follow_help(document: &Document, path: &KeyPath) -> Option<String> {
    let text = value(document, path)?.as_str()?;
    document.value.get("waveforms")?.get(text)?;
    Some(format!("to follow the waveform write {{\"follows\": \"{text}\"}}"))
}
