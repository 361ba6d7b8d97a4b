//! `stickslip study optimise`: the optimum of a result, killed and resumed.

use crate::program::{code, listing, scenario, stderr, stdout, stickslip};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// The largest way of P1 over two numbers, in a folder.
fn file(folder: &Path, evaluations: u64) -> PathBuf {
    let study = json!({
        "stickslip_study": 1, "scenario": scenario("p1"), "maximise": "slider.x_m",
        "set": { "run.stepper.event.tolerance": 1e-6, "run.cycles": 5 },
        "over": { "contacts.ball.friction": [0.1, 0.2], "waveforms.drive.sawtooth.flyback": ["20 us", "0.5 ms"] },
        "starts": 3, "evaluations": evaluations,
    });
    let path = folder.join("fastest.json");
    fs::write(&path, study.to_string()).unwrap();
    path
}

fn optimise(file: &Path, out: &Path, more: &[&str]) -> Command {
    let mut optimise = stickslip();
    optimise.args(["study", "optimise"]).arg(file).arg("--out").arg(out).args(more);
    optimise
}

fn output(file: &Path, out: &Path, more: &[&str]) -> Output {
    optimise(file, out, more).output().unwrap()
}

fn bytes(folder: &Path) -> Vec<(String, Vec<u8>)> {
    listing(folder).into_iter().map(|name| (name.clone(), fs::read(folder.join(name)).unwrap())).collect()
}

#[test]
fn an_optimum_is_found_told_and_written() {
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (file(folder.path(), 40), folder.path().join("out"));
    let told = output(&file, &out, &[]);
    assert_eq!(code(&told), 0, "{}", stderr(&told));
    let text = stdout(&told);
    for said in [
        "maximum of slider.x_m",
        "within 1 %",
        "contacts.ball.friction",
        "limit: ",
        "options for `stickslip steady` and `run`: --set ",
    ] {
        assert!(text.contains(said), "{said}\n{text}");
    }
    assert_eq!(listing(&out), ["evaluations.txt", "optimum.json", "optimum.png"]);
    let found: Value = serde_json::from_slice(&fs::read(out.join("optimum.json")).unwrap()).unwrap();
    assert_eq!(found["starts"].as_array().unwrap().len(), 3);
    // The optimum is what a run with its options gives: at the period itself.
    let set: Vec<&str> =
        found["best"]["set"].as_array().unwrap().iter().map(|set| set.as_str().unwrap()).collect();
    let all: Vec<&str> =
        ["run.stepper.event.tolerance=1e-6", "run.cycles=5"].into_iter().chain(set).collect();
    let by_hand = crate::program::run_example("p1", folder.path(), &all);
    let trace = crate::program::Table::read(&by_hand.join("trace.csv"));
    let x: f64 = trace.column("slider.x_m").last().unwrap().parse().unwrap();
    assert_eq!(found["periods"][1], json!({ "factor": 1.0, "value": x }));
    // All is in the journal: the same command has nothing to compute.
    let before = bytes(&out);
    let again = output(&file, &out, &["--json", "--threads", "1"]);
    assert_eq!(serde_json::from_str::<Value>(&stdout(&again)).unwrap(), found);
    assert_eq!(bytes(&out), before);
}

#[test]
fn a_waveform_is_written_for_a_generator() {
    let folder = tempfile::tempdir().unwrap();
    let (path, out) = (folder.path().join("s.json"), folder.path().join("out"));
    let study = json!({
        "stickslip_study": 1, "scenario": scenario("driven_stage"), "maximise": "stage.x_m", "worst_of_period": false,
        "set": { "run.cycles": 3 }, "starts": 1, "evaluations": 1,
        "waveform": { "path": "waveforms.drive", "corners": 8 },
    });
    fs::write(&path, study.to_string()).unwrap();
    let told = output(&path, &out, &["--rate", "1 MHz", "--gain", "20", "--quiet"]);
    assert_eq!(code(&told), 0, "{}", stderr(&told));
    assert_eq!(
        listing(&out),
        ["evaluations.txt", "optimum.json", "optimum.png", "waveform.csv", "waveform.json"]
    );
    let samples = fs::read_to_string(out.join("waveform.csv")).unwrap();
    let found: Value = serde_json::from_slice(&fs::read(out.join("optimum.json")).unwrap()).unwrap();
    let period = found["waveform"]["period_s"].as_f64().unwrap();
    assert_eq!(samples.lines().next(), Some("time [s],value [V],generator [V]"));
    assert_eq!(samples.lines().count(), 1 + (period * 1e6).round() as usize);
    for row in samples.lines().skip(1) {
        let row: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert!((row[1] - 20.0 * row[2]).abs() < 1e-12 * row[1].abs().max(1.0), "{row:?}");
    }
    // Pasted into the scenario it is the optimum.
    let waveform = fs::read_to_string(out.join("waveform.json")).unwrap();
    let set = format!("waveforms.drive={}", waveform.replace('\n', " "));
    let by_hand = crate::program::run_example("driven_stage", folder.path(), &["run.cycles=3", &set]);
    let trace = crate::program::Table::read(&by_hand.join("trace.csv"));
    let x: f64 = trace.column("stage.x_m").last().unwrap().parse().unwrap();
    assert_eq!(found["best"]["value"], json!(x));
}

/// Killed at any moment a search loses the evaluations under way and no more.
#[cfg(unix)]
#[test]
fn a_killed_search_goes_on_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let (file, whole, parts) =
        (file(folder.path(), 1500), folder.path().join("whole"), folder.path().join("parts"));
    let begun = Instant::now();
    assert_eq!(code(&output(&file, &whole, &["--quiet", "--threads", "1"])), 0);
    let wall = begun.elapsed().as_secs_f64();
    for share in [0.2, 0.5, 0.3] {
        let mut child = optimise(&file, &parts, &["--quiet"]).stdout(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_secs_f64(wall * share));
        child.kill().unwrap();
        child.wait().unwrap();
        // A line that was being written.
        let journal = parts.join("evaluations.txt");
        let mut text = fs::read_to_string(&journal).unwrap_or_default();
        text.push_str("3fe0000000000000 3fe00");
        fs::write(&journal, text).unwrap();
    }
    assert_eq!(code(&output(&file, &parts, &["--quiet"])), 0);
    assert_eq!(bytes(&parts), bytes(&whole));
    assert_eq!(code(&output(&file, &parts, &["--quiet", "--fresh"])), 0);
    assert_eq!(bytes(&parts), bytes(&whole));
}

#[test]
fn bad_input_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (file(folder.path(), 20), folder.path().join("out"));
    let refused = |file: &Path, more: &[&str], message: &str| {
        let told = output(file, &out, more);
        assert_eq!(code(&told), 2, "{}", stderr(&told));
        assert!(stderr(&told).contains(message), "{message}\n{}", stderr(&told));
        assert!(!out.exists());
    };
    refused(&file, &["--gain", "0"], "--gain 0");
    refused(&file, &["--rate", "-3 Hz"], "--rate -3 Hz");
    refused(&file, &["--rate", "3 V"], "--rate 3 V");
    let other = folder.path().join("other.json");
    let text = fs::read_to_string(&file).unwrap();
    for (from, to, message) in [
        ("slider.x_m", "steady_motion.sped_m_s", "did you mean \"steady_motion.speed_m_s\"?"),
        ("[0.1,0.2]", "[0.2,0.1]", "must be below"),
        ("contacts.ball.friction", "contacts.bal.friction", "did you mean \"ball\"?"),
        ("\"maximise\"", "\"maximize\"", "maximise"),
    ] {
        fs::write(&other, text.replace(from, to)).unwrap();
        refused(&other, &[], message);
    }
    for command in ["check", "run", "plan"] {
        let told = stickslip().args(["study", command]).arg(&file).output().unwrap();
        assert_eq!(code(&told), 2);
        assert!(stderr(&told).contains("run it with `stickslip study optimise`"), "{}", stderr(&told));
    }
    // All cases fail, and nothing but the journal is written.
    fs::write(&other, text.replace("[0.1,0.2]", "[-0.2,-0.1]")).unwrap();
    let failed = output(&other, &out, &[]);
    assert_eq!(code(&failed), 3);
    assert!(stderr(&failed).contains("all cases failed: contacts.ball.friction"), "{}", stderr(&failed));
    assert_eq!(listing(&out), ["evaluations.txt"]);
    // Another search does not mix with it.
    let foreign = output(&file, &out, &[]);
    assert!(
        code(&foreign) == 2 && stderr(&foreign).contains("has parts of another study"),
        "{}",
        stderr(&foreign)
    );
}
