//! `stickslip sensitivity`: which numbers matter. What it tells is tested beside the library; here is what is written and said.

use crate::program::{Table, code, listing, run, scenario, stderr, stdout, stickslip, summary};
use serde_json::Value;
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

fn sensitivity(name: &str, out: &Path, arguments: &[&str]) -> Output {
    stickslip().arg("sensitivity").arg(scenario(name)).args(arguments).arg("--out").arg(out).output().unwrap()
}

/// A step of one per cent, by runs of the program itself: elasticities say what comes of it.
#[test]
fn an_elasticity_is_what_a_per_cent_changes() {
    let root = tempdir().unwrap();
    let out = root.path().join("out");
    let asked = ["--of", "energy.friction_J", "--to", "contacts.ball.friction", "bodies.slider.mass"];
    let output = sensitivity("p1", &out, &asked);
    let said = "p1: derivatives, 8 runs\np1: 2 of 2 derivatives are known\n";
    assert_eq!((code(&output), stderr(&output).as_str()), (0, said));
    assert_eq!(listing(&out), ["sensitivity.csv", "sensitivity.json", "sensitivity.png"]);
    let table = Table::read(&out.join("sensitivity.csv"));
    let elasticities: Vec<f64> =
        table.column("elasticity").iter().map(|cell| cell.parse().unwrap()).collect();
    assert!(elasticities[0].abs() > elasticities[1].abs(), "{elasticities:?}");
    let friction = |set: &str| {
        let output = run(&scenario("p1"), root.path(), &[set]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        summary(&root.path().join("p1"))["energy"]["friction_J"].as_f64().unwrap()
    };
    for (path, found) in table.column("quantity").iter().zip(elasticities) {
        let own = if path.ends_with("mass") { 0.02 } else { 0.15 };
        let [less, more] = [0.999, 1.001].map(|share| friction(&format!("{path}={:e}", share * own)));
        let wanted = (more - less) / (more + less) * 1e3;
        assert!((found - wanted).abs() < 1e-3 * wanted.abs(), "{path}: {found} {wanted}");
    }
}

#[test]
fn the_same_bytes_for_any_number_of_threads_and_no_file_of_before() {
    let root = tempdir().unwrap();
    let written = |name: &str, more: &[&str]| {
        let out = root.path().join(name);
        let arguments = [&["--to", "contacts.ball.friction", "loads[0].x"], more].concat();
        let output = sensitivity("quickstart", &out, &arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let read = |name: &String| (name.clone(), std::fs::read(out.join(name)).unwrap());
        listing(&out).iter().map(read).collect::<Vec<_>>()
    };
    let one = written("one", &["--threads", "1", "--theme", "dark"]);
    assert!(one.iter().any(|(name, _)| name == "sensitivity-dark.png"));
    let [one, two] = [written("one", &["--threads", "1"]), written("two", &["--threads", "3"])];
    assert_eq!(one, two);
    assert_eq!(one.len(), 3);
}

#[test]
fn a_driver_at_its_window_is_told_from_both_sides() {
    let root = tempdir().unwrap();
    let asked =
        ["--of", "steps.last_m", "--to", "waveforms.drive.sawtooth.stroke", "contacts.balls.friction"];
    let set = ["--set", "run.cycles=2"];
    let output = sensitivity("driven_stage", &root.path().join("out"), &[&asked[..], &set].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let said = stdout(&output);
    assert!(
        said.contains("waveforms.drive.sawtooth.stroke, below") && said.contains("stroke, above"),
        "{said}"
    );
    assert!(said.contains("the events differ; above: stack voltage at upper end 0 → 2"), "{said}");
    let answer: Value =
        serde_json::from_slice(&std::fs::read(root.path().join("out/sensitivity.json")).unwrap()).unwrap();
    let rows = answer["figures"][0]["derivatives"].as_array().unwrap();
    let sides: Vec<&str> = rows.iter().filter_map(|row| row["side"].as_str()).collect();
    assert_eq!((sides, rows.len()), (vec!["below", "above"], 3));
}

#[test]
fn bad_input_is_told_and_writes_nothing() {
    let root = tempdir().unwrap();
    let out = root.path().join("out");
    let refused = |name: &str, arguments: &[&str], (verdict, words): (i32, &str)| {
        let output = sensitivity(name, &out, arguments);
        assert_eq!(code(&output), verdict, "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(words), "{arguments:?}: {}", stderr(&output));
        assert!(!out.exists(), "{arguments:?}");
    };
    refused("p1", &["--of", "steps.lst_m"], (2, "did you mean \"steps.last_m\"?"));
    refused("p1", &["--of", "drivers.stack.peak_current_A"], (2, "have no such result"));
    refused("p1", &["--of", "steps.periods"], (2, "is a count"));
    refused("p1", &["--to", "contacts.ball.count"], (2, "is a count"));
    refused("p1", &["--to", "contacts.bal.friction"], (2, "did you mean \"ball\"?"));
    refused("p1", &["--to", "run.cycles"], (2, "has no effect on the motion"));
    refused("p1", &["--set", "contacts.ball.friction=-1"], (2, "expected a number between"));
    refused("p1", &["--tolerance", "1"], (2, "'--tolerance <SHARE>': expected 1e-13 to 1e-6"));
    refused("p1", &["--set", "run.limits.steps=100"], (3, "the run of the scenario stopped early"));
    refused("bouncing_ball", &["--steady"], (2, "there is no periodic orbit"));
}

/// Finished derivatives are not lost to those that somebody ends, which stand beside them until the next are finished.
#[cfg(unix)]
#[test]
fn interrupted_derivatives_leave_finished_ones() {
    use std::io::{BufRead, BufReader, Read};
    use std::process::{Command, Stdio};
    let root = tempdir().unwrap();
    let out = root.path().join("out");
    let short = ["--of", "energy.friction_J", "--to", "contacts.front.friction"];
    assert_eq!(code(&sensitivity("three_ball_stage", &out, &short)), 0);
    let read = |name: &str| std::fs::read(out.join(name)).unwrap();
    let all = ["sensitivity.csv", "sensitivity.json", "sensitivity.png"];
    let finished = all.map(read);
    let mut command = stickslip();
    command.arg("sensitivity").arg(scenario("three_ball_stage")).arg("--out").arg(&out);
    command.args(["--tolerance", "1e-13", "--threads", "1", "--of", "contacts.front.peak_fx_N"]);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let mut said = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    said.read_line(&mut line).unwrap();
    assert!(line.starts_with("three_ball_stage: derivatives, "), "{line}");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    said.read_to_string(&mut line).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{line}");
    assert_eq!(all.map(read), finished);
    let partial: Value = serde_json::from_slice(&read("sensitivity-partial.json")).unwrap();
    assert_eq!(partial["status"], "interrupted");
    assert!(Table::read(&out.join("sensitivity-partial.csv")).column("note").contains(&"not run"));
    assert!(out.join("sensitivity-partial.png").exists());
    assert_eq!(code(&sensitivity("three_ball_stage", &out, &short)), 0);
    assert_eq!(listing(&out), all);
}
