//! `--set path=value`: values put into a read scenario before it is given its meaning.

use crate::document::{Document, SourceKind};
use crate::fault::{Fault, Mend};
use crate::guide::Guide;
use crate::path::{KeyPath, Step};
use crate::place::{Inner, Place, Span};
use crate::suggest;
use crate::syntax::{self, Read};
use serde_json::{Map, Value};

/// Parts that may be left out of a scenario as a whole: an override makes them.
const SECTIONS: [&str; 4] = ["run", "output", "figures", "gravity"];
/// Parts that are lists.
const LISTS: [&str; 2] = ["loads", "plots"];
/// Keys of which one is given.
const ALTERNATIVES: &[&[&str]] = &[
    &["duration", "cycles"],
    &["period", "frequency"],
    &["radius", "diameter"],
    &["every", "at"],
    &["heights", "self_affine"],
    &["window", "last"],
];
/// Parts that are maps from names the user gave.
const NAMED: [&str; 6] = ["materials", "waveforms", "bodies", "contacts", "springs", "actuators"];

/// Puts one value under a path; says what is wrong with it.
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
            // Nobody knows what it speaks of: it stands for itself.
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
        // What it was to be stays what it was.
        Err(fault) => vec![fault.of_shape().mend(Mend::Leave(Some(target)))],
    }
}

/// The path with the number of the next entry where `[+]` adds one.
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

/// What an override puts out of force: the other key of two that exclude each other, the other kind where one is chosen.
fn alternatives(root: &Value, target: &KeyPath) -> Vec<KeyPath> {
    let mut others = Vec::new();
    for depth in 1..=target.0.len() {
        let (parent, Step::Key(key)) = (&target.0[..depth - 1], &target.0[depth - 1]) else { continue };
        let parent = KeyPath(parent.to_vec());
        let here = look(root, &parent.0);
        // What stands there already is changed and puts nothing else out of force; the schema is written for no less.
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
            // A word such as "off", where an object could stand that has this key.
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
            // A word or a quantity where now a kind with an inside stands.
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

/// Takes an entry out of its object, or makes an empty one of a plain value.
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

/// The value is JSON if it reads as JSON, and a string otherwise; so quantities need no quotes on a command line.
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

/// An override changes what is there or adds a key to it; it does not invent named parts by a slip of the pen.
fn known(document: &Document, target: &KeyPath, name: Span) -> Result<(), Fault> {
    let [Step::Key(part), rest @ ..] = target.0.as_slice() else { return Ok(()) };
    let unknown = |depth: usize, help: Option<String>| {
        let path = KeyPath(target.0[..depth].to_vec());
        Err(Fault::new(path, "there is nothing under this path").at_span(name).maybe_help(help))
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

/// Which entries a list has.
fn extent(length: usize) -> String {
    match length {
        0 => "is empty".to_owned(),
        1 => "has one entry, [0]".to_owned(),
        _ => format!("has {length} entries, [0] to [{}]", length - 1),
    }
}

/// What a step leads into.
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
