//! Runs that do not come to their end.

use crate::program::{Table, code, listing, number, run, scenario, stderr, stdout, stickslip, summary};
use tempfile::tempdir;

#[test]
fn a_run_that_stops_itself_leaves_what_it_computed() {
    let out = tempdir().unwrap();
    let output = run(&scenario("quickstart"), out.path(), &["run.limits.steps=400"]);
    assert_eq!(code(&output), 3);
    assert_eq!(stdout(&output), "");
    let said = stderr(&output);
    assert!(said.starts_with("quickstart: stopped: the limit of 400 steps was reached at t = "), "{said}");
    assert!(said.contains("help: increase run.limits.steps"), "{said}");
    let folder = out.path().join("quickstart");
    assert_eq!(listing(&folder).len(), 7);
    let summary = summary(&folder);
    assert_eq!(summary["status"], "stopped");
    assert!(summary["error"]["message"].as_str().unwrap().starts_with("the limit of 400 steps"));
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

/// Two runs that would take hours, interrupted in the first; what the program said.
#[cfg(unix)]
fn interrupted(out: &std::path::Path) -> std::process::Output {
    use crate::program::stickslip;
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};
    let mut command = stickslip();
    command.arg("run").args(["p1", "quickstart"].map(scenario)).arg("--out").arg(out);
    command.args(["--set", "run.limits.steps=1e15", "--set", "output={}"]);
    command.args(["--set", "waveforms.drive.sawtooth.cycles=1e9", "--set", "plots=[]"]);
    command.args(["--set", "run.stepper={\"verlet\":{\"step\":\"1 ns\"}}"]);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let folder = out.join("p1");
    let begun = Instant::now();
    // The tables are open once the run is under way.
    while !(folder.exists() && listing(&folder).iter().filter(|name| name.starts_with('.')).count() == 4) {
        assert!(begun.elapsed() < Duration::from_secs(20), "the run does not start");
        std::thread::sleep(Duration::from_millis(5));
    }
    let told = |signal: &str| Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    let killed = told("-INT");
    // As a timer that tells the process and its group: the same wish once more.
    told("-TERM");
    assert!(killed.success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 130, "{}", stderr(&output));
    assert!(stderr(&output).starts_with("p1: interrupted at t = "), "{}", stderr(&output));
    output
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_what_it_computed() {
    let out = tempdir().unwrap();
    let output = interrupted(out.path());
    let folder = out.path().join("p1");
    assert_eq!(listing(&folder), ["events.csv", "scenario.json", "summary.json", "trace.csv"]);
    assert_eq!(summary(&folder)["status"], "interrupted");
    assert!(stderr(&output).contains("quickstart: not run") && !out.path().join("quickstart").exists());
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_complete_results_of_before() {
    let out = tempdir().unwrap();
    assert_eq!(code(&run(&scenario("p1"), out.path(), &["plots=[]"])), 0);
    let folder = out.path().join("p1");
    let before = std::fs::read(folder.join("summary.json")).unwrap();
    let files = listing(&folder);
    for _ in 0..2 {
        let output = interrupted(out.path());
        assert!(
            stderr(&output).contains("p1.interrupted; the complete results of an earlier run in "),
            "{}",
            stderr(&output)
        );
        assert_eq!(
            (std::fs::read(folder.join("summary.json")).unwrap(), listing(&folder)),
            (before.clone(), files.clone())
        );
        assert_eq!(summary(&out.path().join("p1.interrupted"))["status"], "interrupted");
    }
}

/// P1 steps 545.195, 485.170, 502.988, 502.9961, 502.99604 nm (`drive_p1.json`), and no more changes by 1e-4 from then on:
/// the changes of the fourth, the fifth and the sixth step are small.
#[test]
fn a_run_asked_to_ends_well_as_soon_as_its_steps_are_constant() {
    let out = tempdir().unwrap();
    let set = ["run.cycles=100000", "run.until_steady=1e-4", "output.every=50 us"];
    let output = run(&scenario("p1"), out.path(), &set);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    let said = stdout(&output);
    assert!(said.starts_with("p1: 6.000 ms simulated in "), "{said}");
    assert!(said.lines().next().unwrap().ends_with(", steps constant after 6 periods"), "{said}");
    let folder = out.path().join("p1");
    let found = summary(&folder);
    assert_eq!((&found["status"], &found["steady_after_periods"]), (&"done".into(), &6.into()));
    assert_eq!((number(&found, "/simulated_s"), number(&found, "/counts/rows")), (6e-3, 121.0));
    let steps = Table::read(&folder.join("steps.csv"));
    let lengths: Vec<f64> = steps.column("length_m").iter().map(|cell| cell.parse().unwrap()).collect();
    assert_eq!((lengths.len(), &found["steps"]["periods"]), (6, &6.into()));
    for (length, known) in lengths.iter().zip([545.194936404, 485.170376494, 502.988183807, 502.996111248]) {
        assert!((1e9 * length / known - 1.0).abs() < 1e-9);
    }
    for table in ["trace.csv", "events.csv"] {
        let times = Table::read(&folder.join(table));
        let last: f64 = times.column("time_s").last().unwrap().parse().unwrap();
        assert!(last <= 6e-3 && last > 5.8e-3, "{table}: {last}");
    }
    // The last period has its memory curves, whichever it is.
    let memory = Table::read(&folder.join("memory.csv"));
    let mut moments = memory.column("time_s");
    moments.dedup();
    assert_eq!(moments.len(), 6 * 6);
    // A run that does not settle says nothing of it.
    let output = run(&scenario("p1"), out.path(), &["run.until_steady=1e-4", "run.cycles=5"]);
    assert_eq!(code(&output), 0);
    assert!(!stdout(&output).contains("constant"));
    assert!(summary(&folder).get("steady_after_periods").is_none());
}

/// Half an answer in a file on a full disk is not whole; a reader that has seen enough is served.
#[cfg(target_os = "linux")]
#[test]
fn an_answer_that_is_lost_is_told_and_a_closed_pipe_is_not() {
    use std::process::Stdio;
    let file = scenario("p1");
    let p1 = file.to_str().unwrap();
    for arguments in
        [&["schema"][..], &["info", p1], &["check", p1], &["check", p1, "--json"], &["new", "--list"]]
    {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = stickslip().args(arguments).stdout(full).output().unwrap();
        let told = "the output cannot be written: No space left on device\n";
        assert_eq!((code(&output), stderr(&output).as_str()), (3, told), "{arguments:?}");
        let mut reader =
            stickslip().args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(reader.stdout.take());
        let output = reader.wait_with_output().unwrap();
        assert_eq!((code(&output), stderr(&output)), (0, String::new()), "{arguments:?}");
    }
}

/// Places without mass past μF_N = 6 N: sin 2πt = 6/7.2, told with what pulls and what holds, and all until then is there.
#[test]
fn a_load_past_the_limit_of_friction_ends_a_run_and_leaves_what_it_computed() {
    let out = tempdir().unwrap();
    let output = run(&scenario("fretting_force"), out.path(), &["waveforms.pull.sine.amplitude=7.2 N"]);
    assert_eq!((code(&output), stdout(&output)), (3, String::new()));
    let said = stderr(&output);
    assert!(
        said.contains("a load of 7.200 N on holder exceeds the friction limit of its contacts, 6.000 N"),
        "{said}"
    );
    // Holder and far holder carry the same load on the same contact: either gives way first.
    let stopped = said.lines().find(|line| line.starts_with("fretting_force: stopped: ")).unwrap_or_default();
    assert!(stopped.contains(": no force balances 6.000e0 N along x of `"), "{said}");
    assert!(stopped.contains("`holder`") || stopped.contains("`far holder`"), "{said}");
    assert!(stopped.ends_with(" on: this is the friction limit of its contacts"), "{said}");
    assert!(said.contains("help: reduce the load or increase the normal force"), "{said}");
    let folder = out.path().join("fretting_force");
    let summary = summary(&folder);
    assert_eq!(summary["status"], "stopped");
    let wanted = (6.0_f64 / 7.2).asin() / std::f64::consts::TAU;
    let reached = number(&summary, "/simulated_s");
    assert!((reached / wanted - 1.0).abs() < 1e-10, "{reached} {wanted}");
    let trace = Table::read(&folder.join("trace.csv"));
    let times = trace.column("time_s");
    // Rows every 5 ms, and the last one where it stopped.
    assert_eq!(times.len(), (wanted / 5e-3).floor() as usize + 2);
    assert_eq!(times.last().unwrap().parse::<f64>().unwrap(), reached);
    let events = Table::read(&folder.join("events.csv"));
    assert!(!events.rows.is_empty());
}

/// A normal law by points that a contact leaves in the run: how deep a body that hangs back will be pressed into is not known
/// before. It rests under 15 mN, of 20 mN at 50 nm, and the anvil rises by 80 nm before it can move.
#[test]
fn a_contact_beyond_the_last_point_of_its_law_ends_a_run_and_leaves_what_it_computed() {
    let out = tempdir().unwrap();
    let file = out.path().join("anvil.json");
    let scene = r#"{
      "stickslip": 1,
      "materials": { "steel": { "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 } },
      "waveforms": { "rise": { "table": { "points": [["0 s", "0 nm"], ["1 ms", "0 nm"], ["1.1 ms", "80 nm"]] } } },
      "bodies": {
        "ball": { "mass": "1 kg", "z": "free" },
        "anvil": { "z": { "follows": "rise" } }
      },
      "contacts": { "tip": {
        "between": ["anvil", "ball"], "materials": ["steel", "steel"], "friction": 0.3,
        "profile": { "normal_law": { "points": [[0, 0], ["50 nm", "20 mN"], ["100 nm", "60 mN"]] } },
        "normal": "coupled" } },
      "loads": [{ "on": "ball", "z": "-15 mN" }],
      "run": { "duration": "2 ms", "start": "equilibrium" },
      "output": { "every": "0.1 ms" }
    }"#;
    std::fs::write(&file, scene).unwrap();
    let output = run(&file, out.path(), &[]);
    assert_eq!((code(&output), stdout(&output)), (3, String::new()), "{}", stderr(&output));
    let said = stderr(&output);
    assert!(said.starts_with("anvil: stopped: ") && said.contains("tip"), "{said}");
    assert!(said.contains("exceeds the range of the profile, 1e-7 m"), "{said}");
    assert!(said.contains("help: extend the profile to larger radii, or reduce the normal load"), "{said}");
    let folder = out.path().join("anvil");
    let summary = summary(&folder);
    assert_eq!(summary["status"], "stopped");
    let reached = number(&summary, "/simulated_s");
    assert!(reached > 1e-3 && reached < 1.1e-3, "{reached}");
    let trace = Table::read(&folder.join("trace.csv"));
    // The last row is where the step that left the law has ended.
    let depths: Vec<f64> = trace.column("tip.d_m").iter().map(|d| d.parse().unwrap()).collect();
    let (last, before) = depths.split_last().unwrap();
    assert_eq!(before.len(), 11);
    assert!(before.iter().all(|d| *d <= 1e-7) && *last > 1e-7, "{depths:?}");
}
