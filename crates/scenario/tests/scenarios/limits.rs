//! Untrusted files: too large ones are refused before they cost time or memory.
//!
//! The program itself limits rows, springs, curves, steps, events and wall time of a run.

use std::fmt::Write;
use std::path::Path;
use std::time::{Duration, Instant};
use stickslip_scenario::{Scenario, ScenarioError};

/// Loads a scenario of a free body and the given parts.
fn load(rest: &str, base: &Path) -> Result<(), ScenarioError> {
    let text = format!(
        r#"{{ "stickslip": 1, "materials": {{ "m": {{ "youngs_modulus": 1e9, "poisson_ratio": 0.3 }} }},
            "run": {{ "duration": 1 }}, {rest} }}"#
    );
    let begun = Instant::now();
    let result = Scenario::from_str(&text, "s.json", base).map(drop);
    // A slow machine needs seconds; without the limits these cases would take minutes, hours, or all memory.
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
    result
}

fn refused(rest: &str, path: &str, message: &str) {
    let error = load(rest, Path::new("")).unwrap_err();
    assert_eq!((error.path.as_str(), error.message.as_str()), (path, message));
    assert!(error.excerpt.is_some());
}

/// Repeats `part` and replaces `#` by numbers.
fn many(count: usize, part: &str) -> String {
    let mut text = String::new();
    for i in 0..count {
        let comma = if i > 0 { "," } else { "" };
        write!(text, "{comma}{}", part.replace('#', &i.to_string())).unwrap();
    }
    text
}

const BODY: &str = r#""b#": { "mass": 1, "x": "free" }"#;
const CONTACT: &str = r#""c#": { "between": ["ground", "b0"], "materials": ["m", "m"], "friction": 0.1,
    "profile": { "flat": { "radius": 1 } }, "normal": { "force": 1 } }"#;

#[test]
fn parts_of_one_kind_are_counted() {
    let bodies = |count: usize| format!(r#""bodies": {{ {} }}"#, many(count, BODY));
    let message = "expected at most 10000 of them, got 10001";
    refused(&bodies(10_001), "bodies", message);
    let contacts = |count: usize| format!(r#"{}, "contacts": {{ {} }}"#, bodies(1), many(count, CONTACT));
    refused(&contacts(10_001), "contacts", message);
    let loads =
        |count: usize| format!(r#"{}, "loads": [{}]"#, bodies(1), many(count, r#"{ "on": "b0", "x": 1 }"#));
    refused(&loads(10_001), "loads", message);
    let waves = many(10_001, r#""w#": { "sine": { "amplitude": 1, "period": 1 } }"#);
    refused(&format!(r#""waveforms": {{ {waves} }}"#), "waveforms", message);
    let loads = many(10_000, r#"{ "on": "b9999", "x": 1 }"#);
    let rest = format!(r#"{}, "loads": [{loads}], "gravity": {{ "incline": 1 }}"#, bodies(10_000));
    assert!(load(&rest, Path::new("")).is_ok(), "as many as may be");
}

#[test]
fn a_sum_of_sines_has_an_end() {
    let terms = many(1001, r#"{ "amplitude": 1, "order": 1 }"#);
    let rest = format!(r#""waveforms": {{ "w": {{ "harmonics": {{ "period": 1, "terms": [{terms}] }} }} }}"#);
    refused(&rest, "waveforms.w.harmonics.terms", "expected at most 1000 terms in all waveforms, got 1001");
}

#[test]
fn identical_contacts_and_springs_of_a_row_are_counted() {
    let contact = |more: &str| {
        let contact =
            CONTACT.replace('#', "0").replace("\"force\": 1 }", &format!("\"force\": 1 }}, {more}"));
        format!(r#""bodies": {{ {} }}, "contacts": {{ {contact} }}"#, many(1, BODY))
    };
    let message = "expected a whole number between 1 and 1000000, got 1000001";
    refused(&contact("\"count\": 1000001"), "contacts.c0.count", message);
    let row = "\"engine\": { \"springs\": { \"count\": 1000001 } }";
    refused(&contact(row), "contacts.c0.engine.springs.count", message);
}

#[test]
fn a_scenario_can_be_run_again_from_its_results() {
    let points = many(300_000, "[#,0]");
    let rest = format!(r#""waveforms": {{ "w": {{ "table": {{ "points": [{points}] }} }} }}"#);
    refused(&rest, "", "written out in full the scenario would have more than 4194304 bytes");
}

#[test]
fn tables_have_an_end_each_and_together() {
    let folder = tempfile::tempdir().unwrap();
    let line = |i: usize| format!("{i},0,{}\n", "z".repeat(1000));
    let table = |lines: usize| (0..lines).fold("t,x,z\n".to_owned(), |text, i| text + &line(i));
    std::fs::write(folder.path().join("long.csv"), table(4_200)).unwrap();
    std::fs::write(folder.path().join("good.csv"), table(4_000)).unwrap();
    let waves = |count: usize, file: &str| {
        let table = format!(r##""w#": {{ "table": {{ "file": "{file}", "time": "t", "value": "x" }} }}"##);
        load(&format!(r#""waveforms": {{ {} }}"#, many(count, &table)), folder.path())
    };
    let error = waves(1, "long.csv").unwrap_err();
    assert_eq!(error.message, "a table has at most 4194304 bytes");
    assert!(waves(16, "good.csv").is_ok());
    let error = waves(10_000, "good.csv").unwrap_err();
    assert_eq!(error.message, "the files of all tables have more than 67108864 bytes together");
    // 67 108 864 bytes are 16 such files and a part of another.
    assert_eq!(error.path, "waveforms.w16.table.file");
}

#[test]
fn endless_names_are_not_compared() {
    let (long, longer) = ("a".repeat(1_000_000), "b".repeat(1_000_000));
    let body = format!(r#""bodies": {{ "slider": {{}} }}, "figures": {{ "body": "{long}" }}"#);
    let error = load(&body, Path::new("")).unwrap_err();
    assert_eq!(error.help.as_deref(), Some("known here: slider"));
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("t.csv"), format!("t,{long}\n0,0\n")).unwrap();
    let table = format!(r#"{{ "table": {{ "file": "t.csv", "time": "t", "value": "{longer}" }} }}"#);
    let error = load(&format!(r#""waveforms": {{ "w": {table} }}"#), folder.path()).unwrap_err();
    assert!(error.to_string().len() < 1000 && error.message.starts_with("the file has no column \"bbbb"));
}

/// Many unknown material names must not be compared with many described ones at every reading.
#[test]
fn many_materials_that_nobody_describes_are_not_compared() {
    let mut root: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string("tests/good/several.json").unwrap()).unwrap();
    let ball = root["contacts"]["ball"].clone();
    let steel = root["materials"]["steel"].clone();
    for i in 0..9_000 {
        root["materials"][format!("described material number {i:05}")] = steel.clone();
        let mut contact = ball.clone();
        let pair = [2 * i, 2 * i + 1].map(|i| format!("another substance of mine {i:05}"));
        contact["materials"] = pair.to_vec().into();
        root["contacts"][format!("c{i}")] = contact;
    }
    let begun = Instant::now();
    let error = Scenario::from_str(&root.to_string(), "a.json", "").unwrap_err();
    assert!(error.to_string().contains("there is no material \"another substance of mine 00000\""));
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
}
