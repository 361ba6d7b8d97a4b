//! Runs that do not come to their end.

use crate::program::{Table, code, listing, number, run, scenario, stderr, stdout, summary};
use tempfile::tempdir;

#[test]
fn a_run_that_stops_itself_leaves_what_it_computed() {
    let out = tempdir().unwrap();
    let output = run(&scenario("quickstart"), out.path(), &["run.limits.steps=1500"]);
    assert_eq!(code(&output), 3);
    assert_eq!(stdout(&output), "");
    let said = stderr(&output);
    assert!(said.starts_with("quickstart: stopped: the limit of 1500 steps was reached at t = "), "{said}");
    assert!(said.contains("help: raise run.limits.steps"), "{said}");
    let folder = out.path().join("quickstart");
    assert_eq!(listing(&folder).len(), 6);
    let summary = summary(&folder);
    assert_eq!(summary["status"], "stopped");
    assert!(summary["error"]["message"].as_str().unwrap().starts_with("the limit of 1500 steps"));
    let reached = number(&summary, "/simulated_s");
    assert!(reached > 0.0 && reached < 0.1);
    let trace = Table::read(&folder.join("trace.csv"));
    assert_eq!(trace.column("time_s").last().unwrap().parse::<f64>().unwrap(), reached);
}

#[test]
fn a_stop_within_the_first_period_has_no_steps_and_says_so() {
    let out = tempdir().unwrap();
    let output = run(&scenario("quickstart"), out.path(), &["run.limits.steps=50"]);
    assert_eq!(code(&output), 3);
    let summary = summary(&out.path().join("quickstart"));
    assert!(summary.get("steps").is_none());
    assert!(summary["notes"][0].as_str().unwrap().starts_with("no steps: "), "{}", summary["notes"]);
    assert!(!summary.to_string().contains("null"));
}

#[test]
fn events_and_the_clock_stop_a_run_too() {
    let out = tempdir().unwrap();
    for (limit, words) in [("run.limits.events=20", "20 events"), ("run.limits.wall=1 ns", "wall time")] {
        let output = run(&scenario("p1"), out.path(), &["run.cycles=2000", "output={}", limit]);
        assert_eq!(code(&output), 3, "{limit}");
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_what_it_computed() {
    use crate::program::stickslip;
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};
    let out = tempdir().unwrap();
    let mut command = stickslip();
    command.arg("run").args(["p1", "quickstart"].map(scenario)).arg("--out").arg(out.path());
    // Both would take hours.
    command.args(["--set", "run.limits.steps=1e15", "--set", "output={}"]);
    command.args(["--set", "waveforms.drive.sawtooth.cycles=1e9", "--set", "plots=[]"]);
    command.args(["--set", "run.stepper={\"verlet\":{\"step\":\"1 ns\"}}"]);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let folder = out.path().join("p1");
    let begun = Instant::now();
    // The tables are open once the run is under way.
    while !(folder.exists() && listing(&folder).len() == 2) {
        assert!(begun.elapsed() < Duration::from_secs(20), "the run does not start");
        std::thread::sleep(Duration::from_millis(5));
    }
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 130, "{}", stderr(&output));
    assert_eq!(listing(&folder), ["events.csv", "scenario.json", "summary.json", "trace.csv"]);
    assert_eq!(summary(&folder)["status"], "interrupted");
    assert!(stderr(&output).starts_with("p1: interrupted at t = "), "{}", stderr(&output));
    assert!(stderr(&output).contains("quickstart: not run") && !out.path().join("quickstart").exists());
}
