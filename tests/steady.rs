//! `stickslip steady`: what it says, what it writes, how it ends.

use crate::definitions::definitions;
use crate::program::{Table, code, listing, number, scenario, stderr, stdout, stickslip};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

/// A drive that never slips grossly: the search goes on for as long as it may.
const STUCK: &str = r#"waveforms.drive={"triangle":{"stroke":"20 nm","period":"1 ms"}}"#;

fn steady(name: &str, out: &Path, options: &[&str]) -> Output {
    stickslip().arg("steady").arg(scenario(name)).arg("--out").arg(out).args(options).output().unwrap()
}

/// The same of a branch.
fn branch(name: &str, out: &Path, options: &[&str]) -> Output {
    stickslip().arg("branch").arg(scenario(name)).arg("--out").arg(out).args(options).output().unwrap()
}

/// A column of numbers.
fn numbers(folder: &Path, table: &str, column: &str) -> Vec<f64> {
    let table = Table::read(&folder.join(table));
    table.column(column).iter().map(|word| word.parse().unwrap()).collect()
}

fn found(name: &str, out: &Path, options: &[&str]) -> Value {
    let output = steady(name, out, options);
    assert_eq!(code(&output), 0, "{name}: {}", stderr(&output));
    let said: Vec<String> = stderr(&output).lines().map(str::to_owned).collect();
    assert_eq!((said.len(), &said[0]), (2, &format!("{name}: searching for the periodic orbit")), "{said:?}");
    assert!(said[1].starts_with(&format!("{name}: found in ")), "{said:?}");
    serde_json::from_slice(&fs::read(out.join("steady.json")).unwrap()).unwrap()
}

/// Every step of the run that goes on is the one that was found, and not by the run's own tolerance alone: a plain run of P1 needs
/// five periods until a step is as good.
#[test]
fn a_run_goes_on_with_the_steady_motion() {
    for (name, within) in [("p1", 1e-11), ("impact_drive", 1e-7), ("piezo_stack", 1e-8)] {
        let out = tempdir().unwrap();
        let found = found(name, out.path(), &[]);
        assert_eq!(listing(out.path()), ["checkpoint", "steady.json", "steady.png"], "{name}");
        let resumed = stickslip().args(["run", "--resume"]).arg(out.path()).output().unwrap();
        assert_eq!((code(&resumed), stderr(&resumed).as_str()), (0, ""), "{name}");
        let (lengths, step) = (numbers(out.path(), "steps.csv", "length_m"), number(&found, "/step_m"));
        assert!(lengths.len() >= 10, "{name}");
        for length in lengths {
            assert!((length / step - 1.0).abs() < within, "{name}: {length:e} and {step:e}");
        }
        // What was given to bodies before the period began is none of this run's energy.
        let [books, input] =
            ["energy.error_J", "energy.input_J"].map(|column| numbers(out.path(), "trace.csv", column));
        let most = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        assert!(books[0].abs() < 1e-12 * most(&input) && input[0] == 0.0, "{name}: {:e}", books[0]);
        assert!(most(&books) < 1e-6 * most(&input), "{name}: {:e}", most(&books));
    }
}

#[test]
fn the_table_is_for_people_and_the_line_for_machines() {
    let out = tempdir().unwrap();
    let said = stdout(&steady("vertical_climber", out.path(), &["--periods", "100"]));
    for words in [
        "PERIODIC ORBIT",
        "284.8 nm ±",
        "a period, climber",
        "no: a run leaves this orbit",
        "not settled after 100 periods",
        "oscillates with a period of 7.52 drive periods and grows by 0.131 % per",
    ] {
        let lines = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(lines.contains(words), "{words} in\n{said}");
    }
    let line = stdout(&steady("vertical_climber", out.path(), &["--json", "--periods", "100"]));
    let file: Value = serde_json::from_slice(&fs::read(out.path().join("steady.json")).unwrap()).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&line).unwrap(), file);
    assert_eq!(
        (file["stable"].as_bool(), file["multipliers"][0]["kind"].as_str()),
        (Some(false), Some("grows"))
    );
    assert!(stdout(&steady("p1", out.path(), &["--quiet"])).is_empty());
}

/// Keys that hold values, as paths.
fn keys(value: &Value, here: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(entries) => entries.iter().for_each(|(key, inner)| {
            keys(inner, &if here.is_empty() { key.clone() } else { format!("{here}.{key}") }, found);
        }),
        Value::Array(entries) if entries.iter().any(Value::is_object) => {
            entries.iter().for_each(|inner| keys(inner, here, found));
        }
        _ => drop(found.insert(here.to_owned())),
    }
}

#[test]
fn every_key_is_defined_and_every_definition_met() {
    let out = tempdir().unwrap();
    let mut met = BTreeSet::new();
    keys(&found("impact_drive", out.path(), &[]), "", &mut met);
    keys(&found("vertical_climber", out.path(), &["--periods", "100"]), "", &mut met);
    let of_file = definitions().into_iter().filter(|definition| definition.file == "steady.json");
    let mut defined: BTreeSet<String> = of_file.map(|definition| definition.name.into_owned()).collect();
    // A search that has nothing to add says nothing.
    assert!(defined.remove("notes"));
    // So few periods do not tell what an unstable motion ends on.
    assert!(
        ["aftermath.repeats_periods", "aftermath.oscillation_periods"].iter().all(|key| defined.remove(*key))
    );
    assert_eq!(met, defined);
}

/// The waveform that never ends is refused where a caller commands it; a stepper without checkpoints leaves none.
#[test]
fn what_cannot_be_found_is_said_and_leaves_nothing() {
    let root = tempdir().unwrap();
    let out = root.path().join("steady");
    let cases: [(&str, &[&str], i32, &str); 5] = [
        ("bouncing_ball", &[], 2, "bouncing_ball: no waveform has a period"),
        ("commanded", &[], 2, "commanded: a calling program commands the waveform \"drive\""),
        ("fretting_sphere", &[], 2, "fretting_sphere: no coordinate is free"),
        ("impact_drive", &["--periods", "12"], 3, "impact_drive: no periodic orbit found in "),
        ("p1", &["--set", STUCK, "--periods", "60"], 3, "help: ball is never in gross slip"),
    ];
    for (name, options, expected, words) in cases {
        let output = steady(name, &out, options);
        assert_eq!(code(&output), expected, "{name}: {}", stderr(&output));
        assert!(stderr(&output).contains(words), "{name}: {}", stderr(&output));
        assert!(stdout(&output).is_empty() && !out.exists(), "{name}");
    }
    fs::write(&out, "a file").unwrap();
    let output = steady("p1", &out, &[]);
    assert_eq!((code(&output), stdout(&output)), (2, String::new()), "{}", stderr(&output));
    // Before anything is looked for.
    let said = stderr(&output);
    assert!(said.contains("this folder cannot be written: ") && !said.contains("looking"), "{said}");
    let refused = steady("p1", root.path(), &["--tolerance", "1e-3"]);
    assert_eq!(code(&refused), 2);
}

#[test]
fn a_stepper_without_checkpoints_leaves_none_and_says_so() {
    let out = tempdir().unwrap();
    let dopri5 = r#"run.stepper={"dopri5":{"tolerance":1e-9}}"#;
    let found = found("p1", out.path(), &["--set", dopri5]);
    assert_eq!(listing(out.path()), ["steady.json", "steady.png"]);
    let note = found["notes"][0].as_str().unwrap();
    assert!(note.ends_with("the stepper \"dopri5\" has no checkpoints"), "{note}");
}

#[cfg(unix)]
#[test]
fn an_interrupted_search_writes_nothing() {
    use std::process::{Command, Stdio};
    let root = tempdir().unwrap();
    let out = root.path().join("steady");
    let mut command = stickslip();
    command.arg("steady").arg(scenario("p1")).args(["--set", STUCK, "--periods", "1000000000"]);
    let child = command.arg("--out").arg(&out).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_secs(1));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 130, "{}", stderr(&output));
    assert!(stderr(&output).contains("p1: interrupted after "), "{}", stderr(&output));
    assert!(!out.exists());
}

/// What a command says of a scenario on one line.
fn line(command: &[&str], name: &str) -> Value {
    let output = stickslip().args(command).arg("--json").arg(scenario(name)).output().unwrap();
    assert_eq!(code(&output), 0, "{command:?} {name}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Beside runs as short as these it takes more than a fifth of their steps.
const ASKED: &str = "figures.steady_motion=true";

/// Against the search itself, at a thousandth of the tolerance: differences over 1e-5 of runs at 1e-9 leave 1e-4 of a multiplier. The impact drive and the climber have not settled in their own runs.
#[test]
#[ignore = "takes long: .ci/full"]
fn info_and_a_run_tell_the_steady_motion() {
    for name in ["p1", "impact_drive", "vertical_climber", "driven_stage"] {
        let out = tempdir().unwrap();
        let found = found(name, out.path(), &[]);
        let [before, beside] = [
            line(&["info"], name),
            line(&["run", "--quiet", "--set", ASKED, "--out", &out.path().display().to_string()], name),
        ];
        let [before, beside] = [&before["steady_motion"], &beside["steady_motion"]];
        assert_eq!(before, beside, "{name}");
        let off = (number(before, "/step_m") - number(&found, "/step_m")).abs();
        assert!(off <= number(before, "/step_error_m"), "{name}: {off:e}");
        let multiplier = |found| number(found, "/largest_multiplier");
        assert!((multiplier(before) - multiplier(&found)).abs() < 1e-4, "{name}");
        assert_eq!(before["stable"], found["stable"], "{name}");
    }
}

/// Fixed steps have something to be held against.
#[test]
fn the_steady_motion_beside_a_run_is_not_that_of_its_stepper() {
    let rough = r#"run.stepper={"rk4":{"step":"2 us"}}"#;
    let [rough, fine] = [line(&["info", "--set", rough], "p1"), line(&["info"], "p1")];
    assert_eq!(rough["steady_motion"], fine["steady_motion"]);
}

#[test]
fn what_takes_too_long_beside_a_run_is_said_and_what_is_not_asked_is_not_there() {
    let said = line(&["info"], "piezo_hysteresis");
    let fault = said["steady_motion"]["fault"].as_str().unwrap();
    assert!(fault.starts_with("no periodic orbit found within") && !fault.contains('\n'), "{fault}");
    let said = line(&["info"], "oblique_impact");
    assert!(said.get("steady_motion").is_none(), "{said}");
}

const STROKE: &str = "waveforms.drive.sawtooth.stroke";

/// What a branch tells of a stroke is what the command finds there by itself, and files of before are gone.
#[test]
fn a_branch_is_written_and_told() {
    let root = tempdir().unwrap();
    let out = root.path().join("branch");
    let range = format!("{STROKE}=30 nm..600 nm");
    let output = branch("p1", &out, &["--vary", &range, "--theme", "dark"]);
    assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
    let output = branch("p1", &out, &["--vary", &range]);
    assert_eq!(listing(&out), ["branch.csv", "branch.json", "branch.png"]);
    let said = stdout(&output);
    for words in [
        "36.04 nm",
        "gross slip of ball appears above (1 per period)",
        "end at 36.04 nm: no gross slip in ball beyond this value",
    ] {
        let lines = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(lines.contains(words), "{words} in\n{said}");
    }
    let (strokes, steps) =
        (numbers(&out, "branch.csv", &format!("{STROKE}_m")), numbers(&out, "branch.csv", "step_m"));
    assert!(strokes.is_sorted() && strokes.len() > 30);
    assert!((strokes[strokes.len() - 1] - 600e-9).abs() < 1e-18);
    let set = format!("{STROKE}={:e}", strokes[strokes.len() / 2]);
    let alone = found("p1", &root.path().join("alone"), &["--set", &set]);
    assert!((number(&alone, "/step_m") / steps[steps.len() / 2] - 1.0).abs() < 1e-10);
}

#[test]
fn a_branch_that_cannot_be_followed_is_told_and_leaves_nothing() {
    let root = tempdir().unwrap();
    let out = root.path().join("out");
    let refused = |name: &str, options: &[&str], expected: i32, words: &str| {
        let output = branch(name, &out, options);
        assert_eq!(code(&output), expected, "{options:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(words), "{options:?}: {}", stderr(&output));
        assert!(stdout(&output).is_empty() && !out.exists(), "{options:?}");
    };
    let range = |range: &str| format!("{STROKE}={range}");
    refused("p1", &["--vary", "1..2"], 2, "expected PATH=FROM..TO");
    refused("p1", &["--vary", &range("1 um")], 2, "expected FROM..TO, such as 0.1..0.6, got \"1 um\"");
    refused("p1", &["--vary", &range("1 um..2 N")], 2, "--vary  ");
    refused("p1", &["--vary", &range("1 um..0.1 um")], 2, "a range that rises");
    refused("p1", &["--vary", &range("1 um..2 um")], 2, "the branch starts at the value of the scenario");
    refused("p1", &["--vary", "contacts.ball.count=1..3"], 2, "this is a count");
    refused("p1", &["--vary", "contacts.bal.friction=0..1"], 2, "did you mean \"ball\"?");
    refused("p1", &["--accuracy", "1e-6"], 2, "--vary");
    refused("p1", &["--vary", &range("10 nm..1 um"), "--accuracy", "1"], 2, "expected 1e-12 to 1e-3");
    refused("bouncing_ball", &["--vary", "gravity.acceleration=5..15"], 2, "no waveform has a period");
    let stuck = ["--set", STUCK, "--periods", "60", "--vary", "contacts.ball.friction=0.1..0.2"];
    refused("p1", &stuck, 3, "help: ball is never in gross slip");
    fs::write(&out, "a file").unwrap();
    let output = branch("p1", &out, &["--vary", &range("30 nm..1 um")]);
    assert_eq!((code(&output), stdout(&output)), (2, String::new()), "{}", stderr(&output));
    assert!(stderr(&output).contains("this folder cannot be written: "), "{}", stderr(&output));
}
