//! Bad scenarios: `tests/bad/NAME.json` gives the message of `tests/bad/NAME.txt`, word for word.
//!
//! A new case: write the JSON, run with `STICKSLIP_WRITE=1`, and read what it wrote.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails like the test")]

use std::fs;
use std::path::PathBuf;
use stickslip_scenario::Scenario;

fn cases() -> Vec<PathBuf> {
    let folder = fs::read_dir("tests/bad").unwrap();
    let mut cases: Vec<_> = folder.map(|entry| entry.unwrap().path()).collect();
    cases.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    cases.sort();
    cases
}

#[test]
fn every_bad_scenario_is_refused_word_for_word() {
    let cases = cases();
    assert!(cases.len() >= 25, "only {} cases", cases.len());
    let mut wrong = Vec::new();
    for path in cases {
        let message = match Scenario::load(&path) {
            Ok(_) => "accepted".to_owned(),
            Err(error) => error.to_string(),
        };
        let beside = path.with_extension("txt");
        if std::env::var_os("STICKSLIP_WRITE").is_some() {
            fs::write(&beside, format!("{message}\n")).unwrap();
        }
        let expected = fs::read_to_string(&beside).unwrap_or_default();
        if expected.trim_end() != message {
            wrong.push(format!("{}\nexpected\n{expected}\ngot\n{message}\n", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_marker_stands_under_what_is_to_blame() {
    for path in cases() {
        let Err(error) = Scenario::load(&path) else { continue };
        let excerpt = error.excerpt.as_ref().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(text.lines().nth(excerpt.line - 1).unwrap_or(""), excerpt.text, "{}", path.display());
        assert_eq!(excerpt.marker.start + 1, excerpt.column, "{}", path.display());
        assert!(!excerpt.marker.is_empty());
        let shown = error.to_string();
        let lines: Vec<_> = shown.lines().collect();
        let carets = lines[2].chars().position(|c| c == '^').unwrap();
        let under: Vec<char> = lines[1].chars().skip(carets).take(1).collect();
        let blamed: Vec<char> = excerpt.text.chars().skip(excerpt.marker.start).take(1).collect();
        // Control characters are shown as blanks.
        let blamed: Vec<char> = blamed.into_iter().map(|c| if c.is_control() { ' ' } else { c }).collect();
        assert_eq!(under, blamed, "{}", path.display());
    }
}
