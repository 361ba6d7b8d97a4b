//! Invalid scenarios. The error of `tests/bad/NAME.json` must be the text of `tests/bad/NAME.txt`.
//!
//! For a new case, write the JSON file, run `STICKSLIP_WRITE=1 cargo test -p stickslip-scenario --test scenarios bad::`, and read the
//! text that it writes.

use std::fs;
use std::path::{Path, PathBuf};
use stickslip_drive::Model;
use stickslip_scenario::{Scenario, ScenarioError};
use unicode_width::UnicodeWidthChar;

fn cases() -> Vec<PathBuf> {
    let folder = fs::read_dir("tests/bad").unwrap();
    let mut cases: Vec<_> = folder.map(|entry| entry.unwrap().path()).collect();
    cases.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    cases.sort();
    cases
}

/// Returns the error of a file before its run starts, including errors that only the model detects.
fn refusal(path: &Path) -> Option<ScenarioError> {
    let scenario = match Scenario::load(path) {
        Ok(scenario) => scenario,
        Err(error) => return Some(error),
    };
    let started = Model::new(&scenario.scene).and_then(|model| model.start(&scenario.plan));
    started.err().map(|error| scenario.refusal(&error))
}

#[test]
fn every_bad_scenario_is_refused_word_for_word() {
    let cases = cases();
    assert!(cases.len() >= 190, "only {} cases", cases.len());
    let mut wrong = Vec::new();
    for path in cases {
        let message = refusal(&path).map_or("accepted".to_owned(), |error| error.to_string());
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

/// Returns the characters in a range of cells of a line, as a terminal shows them.
fn in_cells(line: &str, from: usize, to: usize) -> String {
    let mut cell = 0;
    let cells = line.chars().map(|c| {
        let start = cell;
        cell += c.width().unwrap();
        (start, c)
    });
    cells.filter(|(start, _)| (from..to).contains(start)).map(|(_, c)| c).collect()
}

#[test]
fn the_marker_stands_under_what_is_to_blame() {
    for path in cases() {
        let error = refusal(&path).unwrap();
        let excerpt = error.excerpt.as_ref().unwrap_or_else(|| panic!("{} has no place", path.display()));
        let bytes = fs::read(&error.file).unwrap();
        if !bytes.starts_with(&[0xff, 0xfe]) {
            let text = String::from_utf8_lossy(&bytes);
            assert_eq!(text.lines().nth(excerpt.line - 1).unwrap_or(""), excerpt.text, "{}", path.display());
        }
        assert_eq!(excerpt.marker.start + 1, excerpt.column, "{}", path.display());
        let shown = error.to_string();
        let lines: Vec<_> = shown.lines().collect();
        assert!(lines[0].starts_with(&format!("{}:{}:{}  ", error.file, excerpt.line, excerpt.column)));
        let (start, end) = (lines[2].find('^').unwrap(), lines[2].len());
        assert!(lines[2].trim_start().bytes().all(|byte| byte == b'^'), "{shown}");
        let blamed: String =
            excerpt.text.chars().skip(excerpt.marker.start).take(excerpt.marker.len()).collect();
        let under = in_cells(lines[1], start, end);
        // Long lines are cut; tabs and similar characters are replaced.
        let same = blamed.starts_with(&under) && (under == blamed || lines[1].ends_with('…'));
        assert!(same || under == " " || under == "\u{fffd}", "{blamed:?} {under:?}\n{shown}");
    }
}
