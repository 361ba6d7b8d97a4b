//! Overrides `--set path=value`, applied to a parsed scenario before its keys are interpreted.

use crate::document::{Document, SourceKind};
use crate::fault::{Fault, Mend};
use crate::guide::Guide;
use crate::path::{KeyPath, Step};
use crate::place::{Inner, Place, Span};
use crate::suggest;
use crate::syntax::{self, Read};
use serde_json::{Map, Value};

/// Optional sections that an override may create.
const SECTIONS: [&str; 5] = ["run", "output", "figures", "gravity", "interface"];
/// Sections that are lists.
const LISTS: [&str; 2] = ["loads", "plots"];
/// Groups of keys that exclude each other.
const ALTERNATIVES: &[&[&str]] = &[
    &["duration", "cycles"],
    &["period", "frequency"],
    &["radius", "diameter"],
    &["every", "at"],
    &["heights", "self_affine"],
    &["window", "last"],
];
/// Sections that map names to parts.
const NAMED: [&str; 7] = ["materials", "waveforms", "bodies", "contacts", "springs", "actuators", "stops"];

/// Sets the value at a path. Returns the errors.
pub(crate) fn apply(document: &mut Document, path: &str, text: &str) -> Vec<Fault> {
    let source = document.sources.len();
    let argument = format!("{path}={text}");
    document.add(argument.clone(), argument, SourceKind::Override);
    let name = Span { source, start: 0, end: path.len() };
    let target = match KeyPath::parse(&numbered(&document.value, path)) {
        Some(target) if !target.0.is_empty() => target,
        _ => {
            let fault = Fault::new(KeyPath::default(), "expected a key path before the = sign").at_span(name);
            let fault = fault.help("such as contacts.ball.friction or loads[0].x").of_shape();
            // The path is invalid, so the error is independent of all others.
            return vec![fault.mend(Mend::Leave(None))];
        }
    };
    let put = value(text, &syntax::Origin { source, offset: path.len() + 1, path: target.clone() }).and_then(
        |read| {
            known(document, &target, name)?;
            for other in alternatives(&document.value, &target) {
                clear(&mut document.value, &other);
                document.root.clear(&other.0);
            }
            insert(&mut document.value, &target, read.value, name)?;
            Ok((Place { key: Some(name), ..read.place }, read.faults))
        },
    );
    match put {
        Ok((place, faults)) => {
            document.root.put(&target.0, place);
            faults
        }
        // The target keeps its old value.
        Err(fault) => vec![fault.of_shape().mend(Mend::Leave(Some(target)))],
    }
}

/// Replaces each `[+]` in a path by the index of the next entry of its list.
fn numbered(root: &Value, path: &str) -> String {
    let mut path = path.to_owned();
    while let Some(at) = path.find("[+]") {
        let list = KeyPath::parse(&path[..at]).and_then(|path| look(root, &path.0));
        let next = list.and_then(Value::as_array).map_or(0, Vec::len);
        path.replace_range(at..at + 3, &format!("[{next}]"));
    }
    path
}

fn look<'a>(root: &'a Value, path: &[Step]) -> Option<&'a Value> {
    path.iter().try_fold(root, |here, step| match step {
        Step::Key(key) => here.get(key),
        Step::Index(index) => here.get(index),
    })
}

/// Returns the paths of the values that an override replaces: alternatives of its key, and other variants of its value.
fn alternatives(root: &Value, target: &KeyPath) -> Vec<KeyPath> {
    let mut others = Vec::new();
    for depth in 1..=target.0.len() {
        let (parent, Step::Key(key)) = (&target.0[..depth - 1], &target.0[depth - 1]) else { continue };
        let parent = KeyPath(parent.to_vec());
        let here = look(root, &parent.0);
        // A change of an existing value replaces nothing else.
        let stays = match here {
            Some(Value::Object(entries)) => entries.is_empty() || entries.contains_key(key),
            Some(Value::String(_) | Value::Number(_)) => false,
            _ => true,
        };
        if stays {
            continue;
        }
        let kinds = Guide::get().choices(&parent);
        if !kinds.contains(key) {
            // The parent is a word such as "off", where an object with this key is allowed.
            if matches!(here, Some(Value::String(_)))
                && Guide::get().at(&KeyPath(target.0[..depth].to_vec())).is_some()
            {
                others.push(parent);
                continue;
            }
            let group = ALTERNATIVES.iter().filter(|group| group.contains(&key.as_str())).copied().flatten();
            let beside =
                group.filter(|other| *other != key && here.is_some_and(|here| here.get(other).is_some()));
            others.extend(
                beside.map(|other| KeyPath([&parent.0[..], &[Step::Key((*other).to_owned())]].concat())),
            );
            continue;
        }
        match here {
            // The parent is a word or a quantity, and becomes a variant with contents.
            Some(Value::String(_) | Value::Number(_)) => others.push(parent),
            Some(Value::Object(entries)) => {
                let rest = entries.keys().filter(|other| *other != key && kinds.contains(other));
                others
                    .extend(rest.map(|other| KeyPath([&parent.0[..], &[Step::Key(other.clone())]].concat())));
            }
            _ => {}
        }
    }
    others
}

/// Removes an entry from its object.
fn clear(root: &mut Value, path: &KeyPath) {
    let Some((Step::Key(key), parent)) = path.0.split_last() else { return };
    let parent = parent.iter().try_fold(root, |here, step| match step {
        Step::Key(key) => here.get_mut(key),
        Step::Index(index) => here.get_mut(index),
    });
    if let Some(Value::Object(entries)) = parent {
        entries.shift_remove(key);
    }
}

/// Parses a value: JSON if it is JSON, otherwise a string. Quantities therefore need no quotes on a command line.
fn value(text: &str, origin: &syntax::Origin) -> Result<Read, Fault> {
    let start = text.trim_start();
    let must_be_json = start.starts_with(['{', '[', '"']);
    if must_be_json || serde_json::from_str::<serde::de::IgnoredAny>(text).is_ok() {
        return syntax::read(text, origin);
    }
    let span = Span { source: origin.source, start: origin.offset, end: origin.offset + text.len() };
    let place = Place { key: None, value: span, inner: Inner::Leaf };
    Ok(Read { value: Value::String(text.to_owned()), place, faults: Vec::new() })
}

/// Checks that an override changes an existing value or adds a key to an existing part. Misspelt names of parts are refused.
fn known(document: &Document, target: &KeyPath, name: Span) -> Result<(), Fault> {
    let [Step::Key(part), rest @ ..] = target.0.as_slice() else { return Ok(()) };
    let unknown = |depth: usize, help: Option<String>| {
        let path = KeyPath(target.0[..depth].to_vec());
        Err(Fault::new(path, "the scenario has no value at this path").at_span(name).maybe_help(help))
    };
    let entries = document.value.get(part);
    match rest {
        [Step::Key(entry), _, ..] if NAMED.contains(&part.as_str()) => {
            let names = entries.and_then(Value::as_object).map(|m| m.keys().map(String::as_str));
            let names: Vec<&str> = names.into_iter().flatten().collect();
            if names.contains(&entry.as_str()) {
                return Ok(());
            }
            unknown(2, suggest::help(entry, names))
        }
        [_, ..]
            if entries.is_none() && ![&SECTIONS[..], &NAMED, &LISTS].concat().contains(&part.as_str()) =>
        {
            let parts = document.value.as_object().map(|m| m.keys().map(String::as_str));
            unknown(1, suggest::help(part, parts.into_iter().flatten().chain(SECTIONS)))
        }
        _ => Ok(()),
    }
}

/// Describes the indices of a list.
fn extent(length: usize) -> String {
    match length {
        0 => "is empty".to_owned(),
        1 => "has one entry, [0]".to_owned(),
        _ => format!("has {length} entries, [0] to [{}]", length - 1),
    }
}

/// Returns the empty container that the next step requires.
fn empty(step: Option<&Step>) -> Value {
    match step {
        Some(Step::Index(_)) => Value::Array(Vec::new()),
        _ => Value::Object(Map::new()),
    }
}

fn insert(root: &mut Value, target: &KeyPath, value: Value, name: Span) -> Result<(), Fault> {
    let mut here = root;
    for (depth, step) in target.0.iter().enumerate() {
        let fault = |message: String| Fault::new(KeyPath(target.0[..depth].to_vec()), message).at_span(name);
        here = match (step, here) {
            (Step::Key(key), Value::Object(entries)) => {
                entries.entry(key.clone()).or_insert_with(|| empty(target.0.get(depth + 1)))
            }
            (Step::Index(index), Value::Array(entries)) => {
                let length = entries.len();
                if *index == length {
                    entries.push(empty(target.0.get(depth + 1)));
                }
                entries.get_mut(*index).ok_or_else(|| fault(format!("the list {}", extent(length))))?
            }
            (Step::Key(_), _) => return Err(fault("this value has no keys".to_owned())),
            (Step::Index(_), _) => return Err(fault("this value is not a list".to_owned())),
        };
    }
    *here = value;
    Ok(())
}
