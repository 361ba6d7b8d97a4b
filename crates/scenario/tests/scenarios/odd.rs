//! Scenarios with warnings. The warnings of `tests/odd/NAME.json` must be the text of `tests/odd/NAME.txt`.
//!
//! For a new case, write the JSON file, run `STICKSLIP_WRITE=1 cargo test -p stickslip-scenario --test scenarios odd`, and read the text
//! that it writes.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use stickslip_scenario::Scenario;

fn files(folder: &str) -> Vec<PathBuf> {
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    files.sort();
    files
}

fn load(path: &Path) -> Scenario {
    Scenario::load(path).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn odd_scenarios_are_warned_of_word_for_word() {
    let mut count = 0;
    for path in files("tests/odd") {
        let scenario = load(&path);
        let warnings: Vec<String> = scenario.warnings.iter().map(ToString::to_string).collect();
        let beside = path.with_extension("txt");
        if std::env::var_os("STICKSLIP_WRITE").is_some() {
            fs::write(&beside, format!("{}\n", warnings.join("\n"))).unwrap();
        }
        assert_eq!(fs::read_to_string(&beside).unwrap().trim_end(), warnings.join("\n"));
        count += warnings.len();
    }
    assert!(count >= 16, "only {count} warnings");
}

#[test]
fn the_examples_are_not_odd() {
    for path in files("../../scenarios") {
        let scenario = load(&path);
        assert_eq!(scenario.warnings, [], "{}", path.display());
        // The resolved scenario contains all defaults and has no warnings about its wording.
        let again = Scenario::from_str(&scenario.resolved(), "resolved", "").unwrap();
        assert_eq!(again.warnings, [], "{}", path.display());
    }
}

#[test]
fn a_body_held_on_purpose_is_not_odd() {
    let with = |x: &str| Scenario::load_with("tests/odd/at_rest.json", &[("bodies.slider.x", x)]).unwrap();
    let masses =
        |scenario: &Scenario| scenario.warnings.iter().filter(|odd| odd.path.ends_with("mass")).count();
    assert_eq!(masses(&load(Path::new("tests/odd/at_rest.json"))), 1);
    assert_eq!(masses(&with("fixed")), 0);
}

/// Each warning contains its line, so the number of warnings is limited; otherwise a large file would take minutes.
#[test]
fn a_file_full_of_oddities_is_told_of_the_first() {
    let mut text = String::from("{ \"stickslip\": 1, \"run\": { \"duration\": 1 }, \"materials\": {\n");
    for i in 0..9_999 {
        writeln!(text, "\"m{i}\": {{ \"youngs_modulus\": 1, \"poisson_ratio\": 0.3 }},").unwrap();
    }
    text += "\"last\": { \"youngs_modulus\": 1e9, \"poisson_ratio\": 0.3 } } }";
    let warnings = Scenario::from_str(&text, "odd.json", "").unwrap().warnings;
    assert_eq!(warnings.len(), 20);
    assert!(warnings[19].help.as_ref().unwrap().ends_with("; 19980 more warnings are not shown"));
}
