//! `--set path=value`: values put into a read scenario before it is given its meaning.

use crate::document::{Document, SourceKind};
use crate::fault::{Fault, Mend};
use crate::path::{KeyPath, Step};
use crate::place::{Inner, Place, Span};
use crate::suggest;
use crate::syntax::{self, Read};
use serde_json::{Map, Value};

/// Parts that may be left out of a scenario as a whole: an override makes them.
const SECTIONS: [&str; 4] = ["run", "output", "figures", "gravity"];
/// Parts that are maps from names the user gave.
const NAMED: [&str; 6] = ["materials", "waveforms", "bodies", "contacts", "springs", "actuators"];

/// Puts one value under a path; says what is wrong with it.
pub(crate) fn apply(document: &mut Document, path: &str, text: &str) -> Vec<Fault> {
    let source = document.sources.len();
    let argument = format!("{path}={text}");
    document.add(argument.clone(), argument, SourceKind::Override);
    let name = Span { source, start: 0, end: path.len() };
    let target = match KeyPath::parse(path) {
        Some(target) if !target.0.is_empty() => target,
        _ => {
            let fault = Fault::new(KeyPath::default(), "expected a key path before the = sign").at_span(name);
            return vec![fault.help("such as contacts.ball.friction or loads[0].x").mend(Mend::Leave)];
        }
    };
    let put = value(text, &syntax::Origin { source, offset: path.len() + 1, path: target.clone() }).and_then(
        |read| {
            known(document, &target, name)?;
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
        Err(fault) => vec![fault.mend(Mend::Leave)],
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
            if entries.is_none() && !SECTIONS.contains(&part.as_str()) && !NAMED.contains(&part.as_str()) =>
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

fn insert(root: &mut Value, target: &KeyPath, value: Value, name: Span) -> Result<(), Fault> {
    let mut here = root;
    for (depth, step) in target.0.iter().enumerate() {
        let fault = |message: String| Fault::new(KeyPath(target.0[..depth].to_vec()), message).at_span(name);
        here = match (step, here) {
            (Step::Key(key), Value::Object(entries)) => {
                entries.entry(key.clone()).or_insert_with(|| Value::Object(Map::new()))
            }
            (Step::Index(index), Value::Array(entries)) => {
                let length = entries.len();
                entries.get_mut(*index).ok_or_else(|| fault(format!("the list {}", extent(length))))?
            }
            (Step::Key(_), _) => return Err(fault("this value has no keys".to_owned())),
            (Step::Index(_), _) => return Err(fault("this value is not a list".to_owned())),
        };
    }
    *here = value;
    Ok(())
}
