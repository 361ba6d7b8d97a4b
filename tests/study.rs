//! `stickslip study`: many runs of one scenario, killed and resumed.

use crate::program::{bytes, code, listing, scenario, stderr, stdout, stickslip};
#[cfg(unix)]
use crate::resumed::killed;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A study of P1 in a folder.
fn file(folder: &Path, cases: u64, chunk: u64) -> PathBuf {
    let study = json!({
        "stickslip_study": 1, "scenario": scenario("p1"), "cases": cases, "chunk": chunk,
        "set": { "run.stepper.event.tolerance": 1e-6, "run.cycles": 5 },
        "vary": { "contacts.ball.friction": { "normal": [0.15, 0.01] }, "bodies.slider.mass": { "list": ["20 g", "-1 g"] } },
        "results": ["slider.x_m", "steps.last_m", "ball.state"],
    });
    let path = folder.join("friction.json");
    fs::write(&path, study.to_string()).unwrap();
    path
}

fn study(command: &str, file: &Path, out: &Path, more: &[&str]) -> Command {
    let mut study = stickslip();
    study.args(["study", command]).arg(file).arg("--out").arg(out).args(more);
    study
}

fn output(command: &str, file: &Path, out: &Path, more: &[&str]) -> Output {
    study(command, file, out, more).output().unwrap()
}

fn json_of(output: &Output) -> Value {
    assert_eq!(code(output), 0, "{}", stderr(output));
    serde_json::from_str(&stdout(output)).unwrap()
}

#[test]
fn a_study_is_planned_run_told_and_merged() {
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (file(folder.path(), 40, 30), folder.path().join("out"));
    assert!(stdout(&output("check", &file, &out, &[])).contains("ok, 80 cases in 3 parts"));
    let plan = json_of(&output("plan", &file, &out, &["--json", "--threads", "1"]));
    assert_eq!((&plan["cases"], &plan["chunks"]), (&json!(80), &json!(3)));
    assert!(plan["expected_s"].as_f64().unwrap() > 0.0 && plan["bytes"].as_u64().unwrap() > 0);
    assert!(!out.exists());
    assert_eq!(json_of(&output("status", &file, &out, &["--json"]))["missing"], json!([0, 1, 2]));
    let told = output("run", &file, &out, &[]);
    assert_eq!(code(&told), 0, "{}", stderr(&told));
    let text = stdout(&told);
    for said in [
        "slider.x_m",
        "ball.state: slip 40, without a value 40",
        "40 of 80 cases failed:",
        "bodies.slider.mass",
        "--set contacts.ball.friction=0.1",
    ] {
        assert!(text.contains(said), "{said}\n{text}");
    }
    assert_eq!(listing(&out), ["part-000000.parquet", "part-000001.parquet", "part-000002.parquet"]);
    assert_eq!(
        json_of(&output("status", &file, &out, &["--json"])),
        json!({ "parts": 3, "of": 3, "missing": [], "damaged": [] })
    );
    let table = folder.path().join("all.csv");
    assert_eq!(code(&output("merge", &file, &out, &["--csv", table.to_str().unwrap()])), 0);
    let rows = fs::read_to_string(&table).unwrap();
    let head = "case,contacts.ball.friction,bodies.slider.mass,slider.x_m,steps.last_m,ball.state,error";
    assert!(rows.starts_with(head) && rows.lines().count() == 81, "{rows}");
    // A case that is told can be run by hand.
    let mut cells = rows.lines().nth(1).unwrap().split(',');
    let (friction, x) = (cells.nth(1).unwrap(), cells.nth(1).unwrap());
    let set = format!("contacts.ball.friction={friction}");
    let by_hand = crate::program::run_example(
        "p1",
        folder.path(),
        &["run.stepper.event.tolerance=1e-6", "run.cycles=5", &set],
    );
    let trace = crate::program::Table::read(&by_hand.join("trace.csv"));
    assert_eq!(trace.column("slider.x_m").last().unwrap().parse::<f64>().unwrap(), x.parse::<f64>().unwrap());
}

/// Killed at any moment a study loses the parts under way and no more; nothing but whole parts is left at the end.
#[cfg(unix)]
#[test]
fn a_killed_study_goes_on_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let file = file(folder.path(), 6000, 100);
    let mut before = 0;
    let each = |parts: &Path| {
        let there = json_of(&output("status", &file, parts, &["--json"]));
        assert_eq!(there["damaged"], json!([]));
        assert!(there["parts"].as_u64().unwrap() >= before);
        before = there["parts"].as_u64().unwrap();
    };
    killed(|out| study("run", &file, out, &["--quiet"]), (8, each));
}

#[test]
fn bad_input_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (file(folder.path(), 40, 30), folder.path().join("out"));
    assert_eq!(code(&output("run", &file, &out, &["--shard", "4/3"])), 2);
    let alone =
        study("run", &file, &out, &["--shard", "auto"]).env_remove("SLURM_ARRAY_TASK_ID").output().unwrap();
    assert!(code(&alone) == 2 && stderr(&alone).contains("not an array job"), "{}", stderr(&alone));
    assert!(!out.exists());
    let array = |id: &str| {
        let mut shard = study("run", &file, &out, &["--shard", "auto", "--json"]);
        shard.envs([
            ("SLURM_ARRAY_TASK_ID", id),
            ("SLURM_ARRAY_TASK_MIN", "1"),
            ("SLURM_ARRAY_TASK_COUNT", "2"),
        ]);
        json_of(&shard.output().unwrap())
    };
    assert_eq!(array("1"), json!({ "computed": 2, "parts": 2, "of": 3 }));
    assert_eq!(array("2")["cases"], json!(80));
    let incomplete = output("merge", &file, &folder.path().join("none"), &["--csv", "x.csv"]);
    assert!(code(&incomplete) == 2 && stderr(&incomplete).contains("3 of 3 parts are missing"));
    let before = bytes(&out);
    let text = fs::read_to_string(&file).unwrap().replace("0.15,0.01", "0.15,0.02");
    fs::write(&file, text).unwrap();
    for command in [&["run"][..], &["run", "--fresh"], &["status"], &["indices"]] {
        let refused = output(command[0], &file, &out, &command[1..]);
        assert_eq!(code(&refused), 2, "{command:?}");
        assert!(stderr(&refused).contains("has parts of another study"), "{}", stderr(&refused));
    }
    assert_eq!(bytes(&out), before);
    let text = fs::read_to_string(&file).unwrap().replace("[\"20 g\",\"-1 g\"]", "[\"-2 g\",\"-1 g\"]");
    fs::write(&file, text).unwrap();
    let failed = output("run", &file, &folder.path().join("failed"), &[]);
    assert_eq!(code(&failed), 3);
    assert!(stderr(&failed).contains("all cases failed"), "{}", stderr(&failed));
}

#[test]
fn indices_are_told_by_result_and_path() {
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (folder.path().join("s.json"), folder.path().join("out"));
    let study = json!({
        "stickslip_study": 1, "scenario": scenario("p1"), "cases": 64,
        "set": { "run.stepper.event.tolerance": 1e-6, "run.cycles": 5 },
        "vary": { "contacts.ball.friction": { "uniform": [0.1, 0.2] }, "bodies.slider.mass": { "normal": ["20 g", "1 g"] } },
        "results": ["steps.last_m"],
    });
    fs::write(&file, study.to_string()).unwrap();
    let found = json_of(&output("indices", &file, &out, &["--json", "--quiet"]));
    let friction = &found["indices"]["steps.last_m"]["contacts.ball.friction"];
    assert!(friction["total"].as_f64().unwrap() > 0.5, "{found}");
    assert_eq!(listing(folder.path()), ["out-indices", "s.json"]);
}
