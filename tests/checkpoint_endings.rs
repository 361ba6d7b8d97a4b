//! Runs that go on after they were killed, interrupted, or had stopped themselves.

use crate::checkpoint::{INSIDES, OFTEN, ROW, SELDOM, VERLET, assert_same, keeping, kept, resume, resumed};
use crate::program::{code, listing, number, run, scenario, stderr, stickslip, summary};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;
use tempfile::tempdir;

/// Runs of a second or so, longer than the others: on the curve in fixed steps, on a row from event to event.
const LONG: [[&str; 5]; 2] = [
    [
        "run.duration=1 s",
        "output.every=20 us",
        r#"run.stepper={"verlet": {"step": "0.5 us"}}"#,
        r#"output.memory={"every": "3 ms"}"#,
        r#"output.springs={"every": "1 ms", "count": 20}"#,
    ],
    ["run.duration=1 s", "output.every=20 us", ROW, "plots=[\"loop\", \"events\"]", INSIDES[0]],
];

/// Kills a run by a signal that nobody hears of after a while, s; whether it had come to its end before.
fn killed(mut command: std::process::Command, after: f64) -> bool {
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    std::thread::sleep(Duration::from_secs_f64(after));
    child.kill().unwrap();
    child.wait().unwrap().success()
}

/// How often runs are killed here; `STICKSLIP_KILLS=100` takes its time.
fn kills() -> usize {
    std::env::var("STICKSLIP_KILLS").map_or(4, |count| count.parse().unwrap())
}

/// An undisturbed run, in its folder, and how long it takes, s.
fn undisturbed(out: &Path, set: &[&str]) -> (PathBuf, f64) {
    let begun = std::time::Instant::now();
    let folder = kept("quickstart", out, "20 ms", set);
    (folder, begun.elapsed().as_secs_f64())
}

#[test]
#[allow(clippy::print_stdout, reason = "the numbers of a longer test")]
fn a_killed_run_goes_on_as_if_nothing_had_happened() {
    let out = tempdir().unwrap();
    let whole = [0, 1].map(|i| undisturbed(&out.path().join(format!("whole {i}")), &LONG[i]));
    let mut seed = 7_u64;
    let mut draw = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    // Runs that were killed before their first checkpoint, and that had come to their end.
    let (mut early, mut late) = (0, 0);
    for k in 0..kills() {
        let (set, (whole, wall)) = (&LONG[k % 2], &whole[k % 2]);
        let parts = out.path().join(format!("parts {k}"));
        let folder = parts.join("quickstart");
        // Every other pair of runs is to become longer only when it goes on.
        let set = [&set[..], if k % 4 < 2 { &[] } else { &["run.duration=600 ms"] }].concat();
        let end: &[&str] = if k % 4 < 2 { &[] } else { &["--set", set[0]] };
        late += usize::from(killed(keeping("quickstart", &parts, "20 ms", &set), wall * draw()));
        if !folder.join("checkpoint/state").exists() {
            let output = resume(&folder, &[]);
            assert!(
                code(&output) == 2 && stderr(&output).contains("has no checkpoint"),
                "{}",
                stderr(&output)
            );
            killed(keeping("quickstart", &parts, "20 ms", &set), 0.5 * wall);
            early += 1;
        }
        // Killed once more on the way.
        let mut again = stickslip();
        again.args(["run", "--resume"]).arg(&folder).args(end);
        late += usize::from(killed(again, wall * draw()));
        resumed(&folder, end);
        assert_same(whole, &folder, &format!("kill {k}"));
        assert!(!listing(&folder).iter().any(|name| name.starts_with('.')), "{:?}", listing(&folder));
        fs::remove_dir_all(&parts).unwrap();
    }
    println!(
        "of {} runs {early} were killed before their first checkpoint; {late} signals of {} came too late",
        kills(),
        2 * kills()
    );
    assert!(late < 2 * kills(), "no run was killed under way");
}

/// Between its start and its first checkpoint a run has nothing but its start to go on from, rows and looks at t = 0 included.
#[test]
fn a_run_that_was_killed_before_its_first_checkpoint_begins_anew() {
    let out = tempdir().unwrap();
    for (i, set) in LONG.iter().enumerate() {
        let (whole, _) = undisturbed(&out.path().join(format!("whole {i}")), set);
        let parts = out.path().join(format!("parts {i}"));
        let mut command = keeping("quickstart", &parts, SELDOM, set);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        while !parts.join("quickstart/checkpoint/state").exists() {
            std::thread::sleep(Duration::from_millis(1));
        }
        std::thread::sleep(Duration::from_millis(50));
        child.kill().unwrap();
        assert!(!child.wait().unwrap().success());
        resumed(&parts.join("quickstart"), &[]);
        assert_same(&whole, &parts.join("quickstart"), &format!("case {i}"));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_goes_on_from_where_it_was() {
    let out = tempdir().unwrap();
    let whole = kept("quickstart", &out.path().join("whole"), SELDOM, &LONG[0]);
    let child = keeping("quickstart", out.path(), SELDOM, &LONG[0])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let folder = out.path().join("quickstart");
    let journal = folder.join("checkpoint/journal");
    while !fs::metadata(&journal).is_ok_and(|found| found.len() > 0) {
        std::thread::sleep(Duration::from_millis(2));
    }
    // Well under way, and far from its end.
    std::thread::sleep(Duration::from_millis(100));
    let told = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(told.success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 130, "{}", stderr(&output));
    let reached = number(&summary(&folder), "/simulated_s");
    assert!(
        stderr(&output).contains(&format!("stickslip run --resume {}", folder.display())),
        "{}",
        stderr(&output)
    );
    // There and nowhere before: an end at which it already was is refused.
    let output = resume(&folder, &["--set", "run.duration=3 ms"]);
    assert_eq!(code(&output), 2);
    let said = stderr(&output);
    assert!(
        said.contains(&format!("the run has reached t = {reached:e} s and cannot end at 3e-3 s")),
        "{said}"
    );
    resumed(&folder, &[]);
    assert_same(&whole, &folder, "interrupted");
}

#[test]
fn a_run_that_stopped_itself_stops_again_where_it_did() {
    let out = tempdir().unwrap();
    let set = ["run.limits.steps=20000", VERLET, "output.every=1 ms"];
    assert_eq!(code(&run(&scenario("quickstart"), &out.path().join("plain"), &set)), 3);
    let output = keeping("quickstart", out.path(), OFTEN, &set).output().unwrap();
    assert_eq!(code(&output), 3, "{}", stderr(&output));
    let (plain, folder) = (out.path().join("plain/quickstart"), out.path().join("quickstart"));
    assert_same(&plain, &folder, "stopped");
    let again = resume(&folder, &[]);
    assert_eq!(code(&again), 3);
    assert_eq!(stderr(&again), stderr(&output));
    assert_same(&plain, &folder, "stopped again");
}

/// Raised, the limit is one that the run had from the start; nothing of it is computed twice.
#[test]
fn a_run_that_a_limit_has_stopped_goes_on_with_another() {
    let out = tempdir().unwrap();
    let of = |limit: &'static str| [limit, "run.duration=20 ms", VERLET, "output.every=1 ms"];
    let whole = kept("quickstart", &out.path().join("whole"), SELDOM, &of("run.limits.steps=200000"));
    let output = keeping("quickstart", out.path(), SELDOM, &of("run.limits.steps=7000")).output().unwrap();
    let folder = out.path().join("quickstart");
    let hint = format!(
        "`stickslip run --resume {} --set run.limits.steps=…` resumes the run from the last checkpoint",
        folder.display()
    );
    assert_eq!(code(&output), 3);
    assert!(stderr(&output).contains(&hint), "{}", stderr(&output));
    resumed(&folder, &["--set", "run.limits.steps=200000"]);
    assert_same(&whole, &folder, "another limit");
}
