//! Commands that are killed: the same command continues where it was and comes to the same bytes.
#![cfg(unix)]

use crate::program::{bytes, code, listing, scenario, stderr, stickslip};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Kills a command that writes into a folder again and again, up to twice as late as it would take to its end, and tells `each` after every
/// kill; the last time it goes on to its end. Compares the folder with that of a command that was left alone.
pub(crate) fn killed(command: impl Fn(&Path) -> Command, (kills, mut each): (u32, impl FnMut(&Path))) {
    let root = tempfile::tempdir().unwrap();
    let [whole, parts] = ["whole", "parts"].map(|name| root.path().join(name));
    let done = |out: &Path| {
        let output = command(out).output().unwrap();
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    };
    let begun = Instant::now();
    done(&whole);
    let wall = begun.elapsed().as_secs_f64();
    let kills = std::env::var("STICKSLIP_KILLS").map_or(kills, |kills| kills.parse().unwrap());
    for k in 0..kills {
        let share = (0.618_033_988_749_894_9 * f64::from(k + 1)).fract() / f64::from(kills.min(12));
        let mut child = command(&parts).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_secs_f64(2.0 * wall * share));
        child.kill().unwrap();
        child.wait().unwrap();
        each(&parts);
    }
    done(&parts);
    assert_eq!(listing(&parts), listing(&whole));
    assert_eq!(bytes(&parts), bytes(&whole));
}

/// A command on a scenario; its journal never gets shorter and nothing else is left by a kill.
fn resumed(name: &'static str, journal: &str, arguments: &[&str]) {
    let command = |out: &Path| {
        let mut command = stickslip();
        command
            .arg(arguments[0])
            .arg(scenario(name))
            .args(&arguments[1..])
            .arg("--quiet")
            .arg("--out")
            .arg(out);
        command
    };
    let mut before = 0;
    killed(
        command,
        (8, |out: &Path| {
            let lines = std::fs::read(out.join(journal)).unwrap_or_default();
            let lines = lines.iter().filter(|byte| **byte == b'\n').count();
            // The command may have come to its end.
            assert!(lines >= before || !out.join(journal).exists(), "{lines} {before}");
            before = lines;
        }),
    );
}

#[test]
fn a_killed_curve_goes_on() {
    let curve = ["curve", "--curve", "step-amplitude", "--points", "9", "--threads", "2"];
    resumed("three_ball_stage", "curve.journal", &curve);
}

#[test]
fn a_killed_sensitivity_goes_on() {
    let sensitivity =
        ["sensitivity", "--to", "contacts.front.friction", "bodies.stage.mass", "--threads", "2"];
    resumed("three_ball_stage", "sensitivity.journal", &sensitivity);
}

#[test]
fn a_killed_branch_goes_on() {
    let friction = "contacts.a.friction";
    let [set, range] = [format!("{friction}=0.21"), format!("{friction}=0.209..0.212")];
    resumed("walking_drive", "branch.journal", &["branch", "--set", &set, "--vary", &range]);
}

#[test]
fn a_killed_map_of_regimes_goes_on() {
    let map = [
        "map",
        "--x",
        "contacts.ball.friction=0.1..0.3",
        "--y",
        "waveforms.drive.sawtooth.stroke=10nm..600nm",
        "--of",
        "contacts.ball.regime",
    ];
    resumed("p1", "map.journal", &map);
}

/// Points of a journal count: one that is another is what the curve has then. `--fresh` computes all of them, as does another scenario.
#[test]
fn a_journal_is_of_its_scenario_and_can_be_left_out() {
    let root = tempfile::tempdir().unwrap();
    let curve = |out: &Path, more: &[&str]| {
        let mut command = stickslip();
        command.args([
            "curve",
            "--vary",
            "contacts.ball.friction=0.1..0.3",
            "--points",
            "4",
            "--quiet",
            "--out",
        ]);
        let output = command.arg(out).args(more).arg(scenario("p1")).output().unwrap();
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        std::fs::read_to_string(out.join("curve.csv")).unwrap()
    };
    let out = root.path().join("out");
    let own = curve(&out, &[]);
    let mut cut = stickslip();
    cut.args(["curve", "--vary", "contacts.ball.friction=0.1..0.3", "--points", "2000", "--quiet", "--out"]);
    let mut child = cut.arg(&out).arg(scenario("p1")).stdout(Stdio::null()).spawn().unwrap();
    let journal = out.join("curve.journal");
    while !std::fs::read_to_string(&journal)
        .is_ok_and(|text| text.lines().count() > 3 && text.contains("\"1e-1\""))
    {
        std::thread::sleep(Duration::from_millis(5));
        assert!(child.try_wait().unwrap().is_none(), "it has come to its end");
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let text = std::fs::read_to_string(&journal).unwrap();
    let head = text.lines().next().unwrap();
    let first = text.lines().find(|line| line.contains("\"contacts.ball.friction\",\"1e-1\"")).unwrap();
    let (key, value) = first.split_once('\t').unwrap();
    let step = serde_json::from_str::<serde_json::Value>(value).unwrap()["Ok"]["step"].to_string();
    let forged = format!("{head}\n{key}\t{}\n\"torn", value.replace(&step, "1.25e-7"));
    let forge = || std::fs::write(&journal, &forged).unwrap();
    forge();
    assert!(curve(&out, &[]).contains("1.25e-7") && !journal.exists());
    forge();
    assert_eq!(curve(&out, &["--fresh"]), own);
    forge();
    assert!(!curve(&out, &["--set", "bodies.slider.mass=21 g"]).contains("1.25e-7"));
    assert_eq!(listing(&out), ["curve.csv", "curve.json", "curve.png"]);
}
