//! Plain words: `docs/words.txt` lists what the project does not write, and nothing that people read has any of it.

use crate::program::{listing, scenario, stderr, stdout, stickslip, summary};
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;
use tempfile::tempdir;

/// An expression, and what may stand around it.
struct Rule {
    avoided: regex::Regex,
    unless: Option<regex::Regex>,
}

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn rules() -> Vec<Rule> {
    let read = |text: &str| regex::RegexBuilder::new(text).case_insensitive(true).build().unwrap();
    let text = std::fs::read_to_string(root().join("docs/words.txt")).unwrap();
    let lines = text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    let rule = |line: &str| match line.split_once(" unless ") {
        Some((avoided, unless)) => Rule { avoided: read(avoided), unless: Some(read(unless)) },
        None => Rule { avoided: read(line), unless: None },
    };
    lines.map(rule).collect()
}

/// A text without its code and addresses.
fn prose(text: &str) -> String {
    let code = regex::Regex::new(r"(?s)```.*?```|`[^`]*`|\]\([^)]*\)").unwrap();
    code.replace_all(text, " ").into_owned()
}

/// What is avoided and stands in a text all the same, with what is around it.
fn found(rules: &[Rule], name: &str, text: &str) -> String {
    let mut all = String::new();
    for rule in rules {
        for hit in rule.avoided.find_iter(text) {
            let near = |chars: usize| {
                let from = text[..hit.start()]
                    .char_indices()
                    .rev()
                    .take(chars)
                    .last()
                    .map_or(hit.start(), |(i, _)| i);
                let to =
                    text[hit.end()..].char_indices().nth(chars).map_or(text.len(), |(i, _)| hit.end() + i);
                &text[from..to]
            };
            if !rule.unless.as_ref().is_some_and(|unless| unless.is_match(near(12))) {
                let _ = writeln!(all, "{name}: … {} …", near(30).replace('\n', " "));
            }
        }
    }
    all
}

#[test]
fn rules_find_what_they_name() {
    let rules = rules();
    assert!(rules.len() > 20);
    for text in ["the books are told", "it goes on", "back and\nforth it hangs on", "the longest step"] {
        assert!(!found(&rules, "", text).is_empty(), "{text}");
    }
    for text in ["back and forth", "comes to rest", "household goods"] {
        assert_eq!(found(&rules, "", text), "");
    }
    assert_eq!(prose("a `goes on` b [c](goes on)").split_whitespace().collect::<Vec<_>>(), ["a", "b", "[c"]);
}

#[test]
fn readme_and_changelog_are_short_and_plain() {
    for (name, most) in [("README.md", 120), ("CHANGELOG.md", 80)] {
        let text = std::fs::read_to_string(root().join(name)).unwrap();
        assert!(text.lines().count() <= most, "{name}");
        assert_eq!(found(&rules(), name, &prose(&text)), "");
    }
}

#[test]
fn help_and_definitions_are_plain() {
    let first = stdout(&stickslip().arg("--help").output().unwrap());
    let mut all = found(&rules(), "--help", &first);
    let commands =
        first.lines().filter_map(|line| line.strip_prefix("  ")).filter(|line| !line.starts_with(' '));
    let names: Vec<&str> = commands.filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.len() > 18, "{names:?}");
    for name in names {
        let help = stdout(&stickslip().args([name, "--help"]).output().unwrap());
        all += &found(&rules(), name, &prose(&help));
    }
    // All definitions.
    all += &found(&rules(), "explain", &prose(&stdout(&stickslip().arg("explain").output().unwrap())));
    assert_eq!(all, "");
}

#[test]
fn descriptions_of_keys_are_plain() {
    fn descriptions(value: &Value, all: &mut String) {
        match value {
            Value::Object(entries) => entries.iter().for_each(|(key, inner)| match inner {
                Value::String(text) if key == "description" => *all += &format!("{}\n", prose(text)),
                _ => descriptions(inner, all),
            }),
            Value::Array(entries) => entries.iter().for_each(|inner| descriptions(inner, all)),
            _ => {}
        }
    }
    let schema: Value = serde_json::from_str(&stdout(&stickslip().arg("schema").output().unwrap())).unwrap();
    let mut all = String::new();
    descriptions(&schema, &mut all);
    assert!(all.lines().count() > 300);
    assert_eq!(found(&rules(), "schema", &all), "");
}

/// What runs and `info` of all examples print, and the sentences of their summaries.
#[test]
fn output_of_all_examples_is_plain() {
    let (rules, out) = (rules(), tempdir().unwrap());
    let examples = scenario("p1").parent().unwrap().to_owned();
    let mut all = String::new();
    for name in listing(&examples).iter().filter_map(|name| name.strip_suffix(".json")) {
        let run = stickslip().arg("run").arg(scenario(name)).arg("--out").arg(out.path()).output().unwrap();
        let info = stickslip().arg("info").arg(scenario(name)).output().unwrap();
        let told = summary(&out.path().join(name));
        let mut sentences = String::new();
        for list in [&told["steps"]["why"], &told["notes"], &told["warnings"]] {
            for one in list.as_array().into_iter().flatten() {
                let _ = writeln!(
                    sentences,
                    "{} {}",
                    one["message"].as_str().or(one.as_str()).unwrap_or_default(),
                    one["help"]
                );
            }
        }
        for text in [stdout(&run), stderr(&run), stdout(&info), sentences] {
            all += &found(&rules, name, &text);
        }
    }
    assert_eq!(all, "");
}
