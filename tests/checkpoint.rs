//! Runs that keep checkpoints, and runs that go on from them: no byte of a result knows of it.

use crate::program::{code, listing, number, run, scenario, stderr, stdout, stickslip, summary};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use tempfile::tempdir;

/// As many checkpoints as there can be.
pub(crate) const OFTEN: &str = "1 ns";
/// None but the first and the last.
pub(crate) const SELDOM: &str = "60 min";
const CHECKPOINT: [&str; 3] = ["journal", "scenario.json", "state"];

/// A call of `stickslip run` with checkpoints.
pub(crate) fn keeping(name: &str, out: &Path, every: &str, set: &[&str]) -> std::process::Command {
    let mut command = stickslip();
    command.arg("run").arg(scenario(name)).arg("--out").arg(out).args(["--checkpoint-every", every]);
    set.iter().for_each(|assignment| {
        command.args(["--set", assignment]);
    });
    command
}

/// Runs an example with checkpoints, which must end well; returns its folder.
pub(crate) fn kept(name: &str, out: &Path, every: &str, set: &[&str]) -> PathBuf {
    let output = keeping(name, out, every, set).output().unwrap();
    assert_eq!((code(&output), stderr(&output)), (0, String::new()), "{name}");
    let folder = out.join(name);
    assert_eq!(listing(&folder.join("checkpoint")), CHECKPOINT, "{name}");
    folder
}

pub(crate) fn resume(folder: &Path, options: &[&str]) -> Output {
    stickslip().args(["run", "--resume"]).arg(folder).args(options).output().unwrap()
}

/// Resumes, which must end well.
pub(crate) fn resumed(folder: &Path, options: &[&str]) {
    let output = resume(folder, options);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()), "{}", folder.display());
    assert_eq!(listing(&folder.join("checkpoint")), CHECKPOINT);
}

/// The summary's text without what differs from run to run.
fn timeless(folder: &Path) -> String {
    let mut summary: Value = summary(folder);
    assert!(summary["timing"].take()["wall_s"].is_number());
    summary.to_string()
}

/// The same files with the same bytes, but for timing; of checkpoints one may have none.
pub(crate) fn assert_same(first: &Path, second: &Path, what: &str) {
    let files = |folder: &Path| {
        let names = listing(folder).into_iter().filter(|name| name != "checkpoint");
        names.collect::<Vec<_>>()
    };
    assert_eq!(files(first), files(second), "{what}");
    for name in files(first) {
        let same = if name == "summary.json" {
            timeless(first) == timeless(second)
        } else {
            fs::read(first.join(&name)).unwrap() == fs::read(second.join(&name)).unwrap()
        };
        assert!(same, "{what}: {name} of {} and {}", first.display(), second.display());
    }
}

pub(crate) const INSIDES: [&str; 2] =
    [r#"output.springs={"every": "300 us", "count": 16}"#, r#"output.memory={"every": "300 us"}"#];
const FIELDS: &str = r#"output.fields={"every": "300 us", "radii": 9}"#;
pub(crate) const ROW: &str = r#"contacts.ball.engine={"springs": {"count": 64}}"#;
pub(crate) const VERLET: &str = r#"run.stepper={"verlet": {"step": "1 us"}}"#;
const RK4: &str = r#"run.stepper={"rk4": {"step": "2 us"}}"#;

#[test]
fn checkpoints_change_no_bit() {
    let cases: [(&str, &[&str]); 9] = [
        ("p1", &["run.cycles=40", INSIDES[0], INSIDES[1]]),
        ("quickstart", &["run.duration=100 ms", INSIDES[0], ROW, FIELDS]),
        ("quickstart", &["run.duration=30 ms", VERLET]),
        ("quickstart", &["run.duration=30 ms", RK4, INSIDES[1]]),
        ("three_ball_stage", &["output.springs={\"every\": \"1 ms\", \"count\": 8}"]),
        ("rocking_slider", &[FIELDS]),
        ("fretting_sphere", &[]),
        ("bouncing_ball", &[]),
        ("walking_drive", &["run.until_steady=1e-3"]),
    ];
    let mut saved = 0.0;
    for (i, (name, set)) in cases.iter().enumerate() {
        let (plain, with) = (tempdir().unwrap(), tempdir().unwrap());
        let output = run(&scenario(name), plain.path(), set);
        assert_eq!(code(&output), 0, "{name}: {}", stderr(&output));
        let folder = kept(name, with.path(), OFTEN, set);
        assert_same(&plain.path().join(name), &folder, &format!("{name}, case {i}"));
        saved += (number(&summary(&folder), "/counts/steps") / 1024.0).floor();
    }
    assert!(saved > 50.0, "{saved} checkpoints under way are too few to tell");
}

/// A number of the resolved scenario in a folder of results.
fn setting(folder: &Path, pointer: &str) -> Option<f64> {
    let scenario: Value = serde_json::from_slice(&fs::read(folder.join("scenario.json")).unwrap()).unwrap();
    scenario.pointer(pointer).and_then(Value::as_f64)
}

#[test]
fn half_a_run_and_its_other_half_are_one_run() {
    let examples = fs::read_dir(scenario("p1").parent().unwrap()).unwrap();
    let names = examples.filter_map(|entry| {
        let path = entry.unwrap().path();
        (path.extension()? == "json").then(|| path.file_stem().unwrap().to_str().unwrap().to_owned())
    });
    let mut names: Vec<String> = names.collect();
    names.sort();
    assert!(names.len() > 10);
    // A quarter of them in every run of the tests; all in .ci/full.
    let every = if std::env::var_os("STICKSLIP_FULL").is_some() { 1 } else { 4 };
    for name in names.into_iter().step_by(every) {
        let (whole, half) = (tempdir().unwrap(), tempdir().unwrap());
        // Its list of moments goes to the end of the run.
        let set: &[&str] = match name.as_str() {
            "oblique_loading" => &[r#"output.memory={"every": "1 s"}"#],
            "quickstart" | "rocking_slider" | "three_ball_stage" => &[FIELDS],
            _ => &[],
        };
        let output = run(&scenario(&name), whole.path(), set);
        assert_eq!(code(&output), 0, "{name}: {}", stderr(&output));
        let whole = whole.path().join(&name);
        let end = |key: &str| Some((format!("run.{key}"), setting(&whole, &format!("/run/{key}"))?));
        let (key, value) = end("cycles").or_else(|| end("duration")).unwrap();
        let first = kept(&name, half.path(), SELDOM, &[set, &[&format!("{key}={:e}", 0.5 * value)]].concat());
        assert!(number(&summary(&first), "/simulated_s") < number(&summary(&whole), "/simulated_s"));
        resumed(&first, &["--set", &format!("{key}={value:e}")]);
        assert_same(&whole, &first, &name);
        // What has come to its end comes to it again.
        resumed(&first, &[]);
        assert_same(&whole, &first, &name);
    }
}

#[test]
fn other_steppers_go_on_as_well() {
    for (i, set) in [[VERLET, ROW], [RK4, INSIDES[1]], [ROW, INSIDES[0]]].iter().enumerate() {
        let out = tempdir().unwrap();
        let end = |end: &'static str| [&set[..], &[end]].concat();
        let whole = kept("quickstart", &out.path().join("whole"), SELDOM, &end("run.duration=31 ms"));
        let parts = kept("quickstart", &out.path().join("parts"), OFTEN, &end("run.duration=7 ms"));
        for later in ["11.3 ms", "20 ms", "31 ms"] {
            resumed(&parts, &["--set", &format!("run.duration={later}")]);
        }
        assert_same(&whole, &parts, &format!("case {i}"));
    }
}

/// Periods that agreed before the run was ended count.
#[test]
fn a_run_that_goes_on_is_steady_when_it_would_have_been() {
    let out = tempdir().unwrap();
    let set = |cycles| ["run.until_steady=1e-4", "output.every=50 us", r#"plots=["events"]"#, cycles];
    let whole = kept("p1", &out.path().join("whole"), SELDOM, &set("run.cycles=1000"));
    assert_eq!(number(&summary(&whole), "/steady_after_periods"), 6.0);
    for cycles in ["run.cycles=3", "run.cycles=5.5"] {
        let parts = kept("p1", &out.path().join(cycles), SELDOM, &set(cycles));
        assert!(summary(&parts).get("steady_after_periods").is_none());
        resumed(&parts, &["--set", "run.cycles=1000"]);
        assert_same(&whole, &parts, cycles);
    }
}

#[test]
fn a_checkpoint_is_never_that_of_another_run() {
    let out = tempdir().unwrap();
    let folder = kept("p1", out.path(), SELDOM, &[]);
    // Drafts of a killed run, and what only looks like one.
    for name in [".trace.csv-Ab12cd", ".loop-dark.png-000000", ".mine.csv-Ab12cd", ".trace.csv-Ab12"] {
        fs::write(folder.join(name), "").unwrap();
    }
    fs::write(folder.join("checkpoint/.state-Ab12cd"), "").unwrap();
    fs::write(folder.join("checkpoint/notes"), "").unwrap();
    assert_eq!(code(&run(&scenario("p1"), out.path(), &[])), 0);
    let names = listing(&folder);
    assert_eq!(&names[..2], [".mine.csv-Ab12cd", ".trace.csv-Ab12"]);
    assert_eq!(listing(&folder.join("checkpoint")), ["notes"]);
    fs::remove_file(folder.join("checkpoint/notes")).unwrap();
    kept("p1", out.path(), SELDOM, &[]);
    assert_eq!(code(&run(&scenario("p1"), out.path(), &[])), 0);
    assert!(!folder.join("checkpoint").exists());
}

#[test]
fn several_runs_go_on_side_by_side() {
    let (out, whole) = (tempdir().unwrap(), tempdir().unwrap());
    let names = ["p1", "ruby_drive"];
    let folders = names.map(|name| kept(name, out.path(), SELDOM, &["run.cycles=2"]));
    let mut command = stickslip();
    command.args(["run", "--resume"]).args(&folders).args([
        "--set",
        "run.cycles=5",
        "--threads",
        "2",
        "--json",
    ]);
    let output = command.output().unwrap();
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    let lines: Vec<Value> = stdout(&output).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 2);
    for (name, folder) in names.iter().zip(&folders) {
        assert_eq!(code(&run(&scenario(name), whole.path(), &["run.cycles=5"])), 0);
        assert_same(&whole.path().join(name), folder, name);
    }
}
