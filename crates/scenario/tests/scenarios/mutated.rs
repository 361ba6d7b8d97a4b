//! Random mutations of the examples. For every file, the reader must return a scenario or an error with a position, within a second.
//!
//! The usual test run checks some cases; `STICKSLIP_CASES=100000 cargo test -p stickslip-scenario --test scenarios mutated` runs all.

use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::{TestCaseError, TestRunner};
use serde_json::Value;
use std::fs;
use std::time::{Duration, Instant};
use stickslip_drive::Model;
use stickslip_scenario::{Scenario, ScenarioError, schema};

/// Maximum time for a file, from its text to the state at t = 0.
const HANG: Duration = Duration::from_secs(1);

/// Texts inserted into files.
const PIECES: [&str; 34] = [
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "\"",
    "\\",
    "null",
    "true",
    "-1",
    "0",
    "1e999",
    "1e-400",
    "1e300",
    "-1e-300",
    "0.5",
    "\"5 N\"",
    "\"-3 um\"",
    "\"1e308 m\"",
    "\"0,5 mm\"",
    "\"free\"",
    "\"ground\"",
    "\"slider\"",
    "\"springs\"",
    "{\"follows\": \"drive\"}",
    "{\"springs\": {\"count\": 1000000}}",
    "{}",
    "[]",
    "\\ud800",
    "\u{feff}",
    "\u{202e}日本",
    "\n",
    "// ",
];

/// Mutation of a text.
#[derive(Debug, Clone)]
enum Edit {
    Remove(Index, usize),
    Insert(Index, String),
    Replace(Index, usize, String),
    Repeat(Index, usize),
    /// Replaces or removes a value or key of the tree.
    Swap(Index, Index),
    Drop(Index),
    Piece(Index, Index),
}

fn edit() -> impl Strategy<Value = Edit> {
    let place = any::<Index>;
    let piece = || {
        prop_oneof![
            any::<char>().prop_map(String::from),
            prop::sample::select(&PIECES[..]).prop_map(String::from)
        ]
    };
    prop_oneof![
        (place(), 1..24_usize).prop_map(|(at, length)| Edit::Remove(at, length)),
        (place(), piece()).prop_map(|(at, text)| Edit::Insert(at, text)),
        (place(), 1..24_usize, piece()).prop_map(|(at, length, text)| Edit::Replace(at, length, text)),
        (place(), 1..24_usize).prop_map(|(at, length)| Edit::Repeat(at, length)),
        (place(), place()).prop_map(|(at, other)| Edit::Swap(at, other)),
        place().prop_map(Edit::Drop),
        (place(), place()).prop_map(|(at, piece)| Edit::Piece(at, piece)),
    ]
}

/// Collects all values of a tree by JSON pointer.
fn pointers(value: &Value, here: &str, found: &mut Vec<String>) {
    let inner: Vec<(String, &Value)> = match value {
        Value::Object(entries) => {
            entries.iter().map(|(key, inner)| (key.replace('~', "~0").replace('/', "~1"), inner)).collect()
        }
        Value::Array(entries) => {
            entries.iter().enumerate().map(|(i, inner)| (i.to_string(), inner)).collect()
        }
        _ => Vec::new(),
    };
    for (step, inner) in inner {
        let pointer = format!("{here}/{step}");
        pointers(inner, &pointer, found);
        found.push(pointer);
    }
}

/// Applies a mutation to the tree, if the text is JSON.
fn in_tree(text: &str, edit: &Edit) -> Option<String> {
    let mut tree: Value = serde_json::from_str(text).ok()?;
    let mut places = Vec::new();
    pointers(&tree, "", &mut places);
    let pick = |index: &Index| (!places.is_empty()).then(|| places[index.index(places.len())].clone());
    match edit {
        Edit::Swap(at, other) => {
            let other = tree.pointer(&pick(other)?)?.clone();
            *tree.pointer_mut(&pick(at)?)? = other;
        }
        Edit::Piece(at, piece) => {
            let values: Vec<Value> =
                PIECES.iter().filter_map(|piece| serde_json::from_str(piece).ok()).collect();
            *tree.pointer_mut(&pick(at)?)? = values[piece.index(values.len())].clone();
        }
        Edit::Drop(at) => {
            let place = pick(at)?;
            let (parent, key) = place.rsplit_once('/')?;
            match tree.pointer_mut(parent)? {
                Value::Object(entries) => drop(entries.remove(key)),
                Value::Array(entries) => drop(entries.remove(key.parse().ok()?)),
                _ => return None,
            }
        }
        _ => return None,
    }
    serde_json::to_string_pretty(&tree).ok()
}

fn in_text(text: &str, edit: &Edit) -> String {
    let mut chars: Vec<char> = text.chars().collect();
    let at = |index: &Index, length: usize| {
        let start = index.index(chars.len().max(1));
        start..(start + length).min(chars.len())
    };
    match edit {
        Edit::Remove(index, length) => drop(chars.drain(at(index, *length))),
        Edit::Insert(index, piece) => drop(chars.splice(at(index, 0), piece.chars())),
        Edit::Replace(index, length, piece) => drop(chars.splice(at(index, *length), piece.chars())),
        Edit::Repeat(index, length) => {
            let range = at(index, *length);
            let copy = chars[range.clone()].to_vec();
            chars.splice(range.start..range.start, copy);
        }
        Edit::Swap(..) | Edit::Drop(_) | Edit::Piece(..) => {}
    }
    chars.into_iter().collect()
}

/// Executes all steps of the program before a run.
fn answer(text: &str) -> Result<Scenario, ScenarioError> {
    let scenario = Scenario::from_str(text, "mutated.json", "tests/good")?;
    Model::new(&scenario.scene)
        .and_then(|model| model.start(&scenario.plan))
        .map_err(|error| scenario.refusal(&error))?;
    Ok(scenario)
}

fn check(text: &str, validator: &jsonschema::Validator) -> Result<(), TestCaseError> {
    let mut begun = Instant::now();
    let mut answered = answer(text);
    if begun.elapsed() > HANG {
        // Repeats, because the machine may have been busy.
        begun = Instant::now();
        answered = answer(text);
        prop_assert!(begun.elapsed() < HANG, "took {:?}", begun.elapsed());
    }
    match answered {
        Ok(scenario) => {
            let again = Scenario::from_str(&scenario.resolved(), "again.json", "/nowhere");
            prop_assert!(again.is_ok(), "{}", again.unwrap_err());
            let resolved = scenario.resolved();
            // Blocks are equal only if identical, so their debug texts are compared.
            prop_assert_eq!(format!("{:?}", again.unwrap().scene), format!("{:?}", scenario.scene));
            let bare = text.trim_start_matches('\u{feff}');
            // A text with comments is not strict JSON.
            let value =
                serde_json::from_str(bare).unwrap_or_else(|_| serde_json::from_str(&resolved).unwrap());
            prop_assert!(
                bare.contains("//") || bare.contains("/*") || serde_json::from_str::<Value>(bare).is_ok()
            );
            let errors: Vec<_> = validator.iter_errors(&value).map(|error| error.to_string()).collect();
            prop_assert!(errors.is_empty(), "the schema refuses what the program takes: {errors:?}");
            for warning in &scenario.warnings {
                prop_assert!(
                    warning.excerpt.is_some() && warning.to_string().lines().count() <= 4,
                    "{}",
                    warning
                );
            }
        }
        Err(error) => {
            let excerpt = error.excerpt.clone().unwrap();
            prop_assert!(excerpt.line >= 1 && excerpt.line <= text.matches('\n').count() + 1);
            prop_assert!(excerpt.marker.start < excerpt.marker.end);
            prop_assert!(excerpt.marker.start <= excerpt.text.chars().count());
            for report in error.reports() {
                prop_assert!(
                    report.excerpt.is_some() && report.to_string().lines().count() <= 4,
                    "{}",
                    error
                );
            }
            prop_assert!(error.reports().count() <= 20, "{}", error);
        }
    }
    Ok(())
}

#[test]
fn a_mutated_file_is_answered_at_once() {
    let cases = std::env::var("STICKSLIP_CASES").map_or(4000, |cases| cases.parse().unwrap());
    let mut sources = vec![fs::read_to_string("tests/good/full.json").unwrap()];
    for entry in fs::read_dir("../../scenarios").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "json") {
            sources.push(fs::read_to_string(path).unwrap());
        }
    }
    assert!(sources.len() > 7);
    let schema: Value = serde_json::from_str(&schema()).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let config = ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() };
    let mutations = (any::<Index>(), prop::collection::vec(edit(), 1..6));
    let result = TestRunner::new(config).run(&mutations, |(source, edits)| {
        let text = sources[source.index(sources.len())].clone();
        let change = |text: String, edit: &Edit| in_tree(&text, edit).unwrap_or_else(|| in_text(&text, edit));
        check(&edits.iter().fold(text, change), &validator)
    });
    result.unwrap_or_else(|error| panic!("{error}"));
}
