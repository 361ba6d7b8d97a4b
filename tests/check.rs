//! `stickslip check` and `stickslip schema`.

use crate::program::{code, listing, run, scenario, stderr, stdout, stickslip};
use serde_json::Value;
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

fn check(folder: &Path, arguments: &[&str]) -> Output {
    stickslip().arg("check").args(arguments).current_dir(folder).output().unwrap()
}

/// The first example with one text replaced.
fn broken(folder: &Path, from: &str, to: &str) {
    let text = std::fs::read_to_string(scenario("quickstart")).unwrap();
    assert_eq!(text.matches(from).count(), 1, "{from}");
    std::fs::write(folder.join("mine.json"), text.replace(from, to)).unwrap();
}

#[test]
fn every_example_is_good_and_nothing_is_written() {
    let folder = tempdir().unwrap();
    let examples = scenario("p1");
    let names = listing(examples.parent().unwrap());
    let names: Vec<&str> = names.iter().filter_map(|name| name.strip_suffix(".json")).collect();
    let mut command = stickslip();
    command.arg("check").args(names.iter().map(|name| scenario(name))).current_dir(folder.path());
    let output = command.output().unwrap();
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    let said = stdout(&output);
    assert_eq!(said.lines().count(), names.len());
    assert!(
        said.lines().zip(names).all(|(line, name)| line.ends_with(&format!("{name}.json: ok"))),
        "{said}"
    );
    assert!(listing(folder.path()).is_empty());
}

#[test]
fn what_a_run_refuses_is_refused_in_the_same_words() {
    let faults = [
        ("0.2,", "-0.2,"),
        ("\"trajectory\"", "\"trajektory\""),
        ("\"every\": \"10 us\"", "\"every\": \"1 ns\""),
        ("{ \"every\": \"10 us\" }", "{ \"every\": \"10 us\", \"channels\": [\"slider.y_m\"] }"),
        ("\"event\": { \"tolerance\": 1e-8 }", "\"verlet\": { \"step\": \"0.1 ms\" }"),
        ("-0.02 N\" } ],\n  \"run\":    {", "-0.2 N\" } ],\n  \"run\":    { \"start\": \"equilibrium\","),
    ];
    for (from, to) in faults {
        let folder = tempdir().unwrap();
        broken(folder.path(), from, to);
        let file = folder.path().join("mine.json");
        let checked = check(folder.path(), &[file.to_str().unwrap()]);
        let ran = run(&file, &folder.path().join("out"), &[]);
        assert_eq!((code(&checked), code(&ran)), (2, 2), "{to}");
        assert_eq!(stderr(&checked), stderr(&ran));
        assert!(stderr(&checked).contains("mine.json:") && stdout(&checked).is_empty());
        assert_eq!(listing(folder.path()), ["mine.json"], "{to}");
    }
}

#[test]
fn a_step_that_is_unstable_points_into_the_file() {
    let folder = tempdir().unwrap();
    broken(folder.path(), "\"event\": { \"tolerance\": 1e-8 }", "\"verlet\": { \"step\": \"0.1 ms\" }");
    let said = stderr(&check(folder.path(), &["mine.json"]));
    assert!(said.starts_with("mine.json:22:70  run.stepper.verlet.step: expected less than "), "{said}");
    let limit: f64 = said.split(' ').skip_while(|word| *word != "than").nth(1).unwrap().parse().unwrap();
    // 2/ω of the contact resonance of three ruby balls of 0.5 mm under 0.3 N each and a slider of 10 g, 4.151 kHz.
    assert!((limit * std::f64::consts::PI * 4151.0 - 1.0).abs() < 3e-4, "{limit}");
}

#[test]
fn good_and_bad_files_are_told_apart_and_the_worst_counts() {
    let folder = tempdir().unwrap();
    broken(folder.path(), "0.2,", "-0.2,");
    let good = scenario("p1");
    let good = good.to_str().unwrap();
    let output = check(folder.path(), &["mine.json", good]);
    assert_eq!(code(&output), 2);
    assert_eq!(stdout(&output), format!("{good}: ok\n"));
    assert!(
        stderr(&output).starts_with("mine.json:18:19  contacts.ball.friction: expected"),
        "{}",
        stderr(&output)
    );
    let output = check(folder.path(), &["-q", good]);
    assert_eq!((code(&output), stdout(&output), stderr(&output)), (0, String::new(), String::new()));
}

#[test]
fn machines_get_a_line_of_json_per_file() {
    let folder = tempdir().unwrap();
    broken(folder.path(), "0.2,", "-0.2,");
    let good = scenario("p1");
    let output = check(folder.path(), &["--json", "mine.json", good.to_str().unwrap(), "nowhere.json"]);
    assert_eq!((code(&output), stderr(&output)), (2, String::new()));
    let lines: Vec<Value> = stdout(&output).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let error = &lines[0]["error"];
    assert_eq!((&lines[0]["file"], &lines[0]["ok"]), (&"mine.json".into(), &false.into()));
    assert_eq!((&error["line"], &error["column"], &error["width"]), (&18.into(), &19.into(), &4.into()));
    assert_eq!(error["path"], "contacts.ball.friction");
    assert_eq!(error["message"], "expected a number between 0 and 1000, got -0.2");
    assert!(error["help"].as_str().unwrap().contains("typical 0.05 to 0.6"));
    assert_eq!((&lines[1]["ok"], lines[1].get("error")), (&true.into(), None));
    assert!(lines[2]["error"]["message"].as_str().unwrap().starts_with("there is no such file"));
    let output =
        check(folder.path(), &["--json", good.to_str().unwrap(), "--set", "contacts.ball.friction=-1"]);
    let line: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(line["errors"], Value::Array(vec![line["error"].clone()]));
    assert_eq!(line.get("more"), None);
    assert!(line["error"]["override"].as_str().unwrap().contains("contacts.ball.friction=-1"), "{line}");
}

/// What follows from the scene, rows and lines are judged by themselves: one does not hide the other.
#[test]
fn limits_are_told_together_with_what_else_is_wrong() {
    let folder = tempdir().unwrap();
    broken(
        folder.path(),
        "-0.02 N\" } ],\n  \"run\":    {",
        "-0.2 N\" } ],\n  \"run\":    { \"start\": \"equilibrium\",",
    );
    let limits =
        ["--set", "output.every=1 ns", "--set", "output.fields={\"radii\": 10000, \"every\": \"1 ns\"}"];
    let output = check(folder.path(), &[&["--json", "mine.json"], &limits[..]].concat());
    let line: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let errors = line["errors"].as_array().unwrap();
    let told =
        |text: &str| errors.iter().filter(|error| error["message"].as_str().unwrap().contains(text)).count();
    assert_eq!(
        (errors.len(), told("rows of 20 channels"), told("lines, expected at most")),
        (3, 1, 1),
        "{line}"
    );
    assert_eq!(line["error"], errors[0]);
    let said = stderr(&check(folder.path(), &[&["mine.json"], &limits[..]].concat()));
    assert_eq!(said.matches("\n\n").count(), 2, "{said}");
}

#[test]
fn machines_are_told_what_was_not_judged() {
    let folder = tempdir().unwrap();
    let not_checked = |arguments: &[&str]| {
        let output = check(folder.path(), &[&["--json"], arguments].concat());
        let line: Value = serde_json::from_str(&stdout(&output)).unwrap();
        line.get("not_checked").cloned()
    };
    broken(folder.path(), "0.2,", "-0.2,");
    let all = serde_json::json!(["form", "meaning", "equilibrium", "limits"]);
    assert_eq!(not_checked(&["mine.json"]), Some(serde_json::json!(["limits"])));
    assert_eq!(not_checked(&["nowhere.json"]), Some(all.clone()));
    assert_eq!(not_checked(&["mine.json", "--set", "stickslip=2"]), Some(all.clone()));
    // Memory is estimated when nothing else is wrong.
    let good = ["mine.json", "--set", "contacts.ball.friction=0.2"];
    assert_eq!(not_checked(&good), None);
    assert_eq!(
        not_checked(&[&good[..], &["--set", "output.every=1 ns"]].concat()),
        Some(serde_json::json!(["limits"]))
    );
    assert_eq!(
        not_checked(&["mine.json", "--set", "run.start=equilibrium"]),
        Some(serde_json::json!(["equilibrium", "limits"]))
    );
    std::fs::write(folder.path().join("mine.json"), "{ \"stickslip\": 1, ").unwrap();
    assert_eq!(not_checked(&["mine.json"]), Some(all));
}

#[test]
fn what_is_odd_is_good_and_said() {
    let folder = tempdir().unwrap();
    broken(folder.path(), "\"bodies\": {", "\"bodies\": { \"wall\": {},");
    let odd = "mine.json:10:15  bodies.wall: no contact, spring, actuator or load names this body\n";
    let output = check(folder.path(), &["mine.json"]);
    assert_eq!((code(&output), stdout(&output)), (0, "mine.json: ok\n".to_owned()));
    assert!(stderr(&output).starts_with(&format!("warning: {odd}")), "{}", stderr(&output));
    assert_eq!(stderr(&check(folder.path(), &["-q", "mine.json"])), "");
    let output = check(folder.path(), &["--json", "mine.json"]);
    let line: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!((code(&output), &line["ok"], line.get("error")), (0, &true.into(), None));
    let warning = &line["warnings"][0];
    assert_eq!((&warning["line"], &warning["column"]), (&10.into(), &15.into()));
    assert_eq!((&warning["path"], warning.get("table")), (&"bodies.wall".into(), None));
}

#[test]
fn a_broken_table_is_named_to_machines() {
    let folder = tempdir().unwrap();
    broken(
        folder.path(),
        "{ \"sawtooth\": { \"stroke\": \"200 nm\", \"period\": \"10 ms\", \"flyback\": \"10 us\" } }",
        "{ \"table\": { \"file\": \"t.csv\", \"time\": \"t\", \"value\": \"x\" } }",
    );
    std::fs::write(folder.path().join("t.csv"), "t,x\n0,0\n1,far\n").unwrap();
    let output = check(folder.path(), &["--json", "mine.json"]);
    let line: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let error = &line["error"];
    assert_eq!((&line["file"], &error["table"]), (&"mine.json".into(), &"t.csv".into()));
    assert_eq!((&error["line"], &error["column"], &error["width"]), (&3.into(), &3.into(), &3.into()));
}

#[test]
fn the_schema_is_printed_as_it_lies_in_its_folder() {
    let output = stickslip().arg("schema").output().unwrap();
    let copy = scenario("p1").parent().unwrap().join("../schema/scenario-1.json");
    assert_eq!((code(&output), stdout(&output)), (0, std::fs::read_to_string(copy).unwrap()));
}
