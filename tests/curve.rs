//! `stickslip curve`: curves of a machine. What they tell is tested beside the library; here is what is written and said.

use crate::program::{Table, code, listing, run, scenario, stderr, stdout, stickslip, summary};
use serde_json::Value;
use std::path::Path;
use std::process::Output;
use tempfile::tempdir;

fn curve(name: &str, out: &Path, arguments: &[&str]) -> Output {
    stickslip().arg("curve").arg(scenario(name)).args(arguments).arg("--out").arg(out).output().unwrap()
}

/// `run` waits for its steps by itself: what it calls steady is the point of the curve, to the tolerance that both have.
#[test]
fn a_point_is_what_a_run_of_it_comes_to() {
    let root = tempdir().unwrap();
    let out = root.path().join("curve");
    let arguments = ["--vary", "waveforms.drive.sawtooth.stroke=60 nm..300 nm", "--points", "3"];
    let output = curve("ruby_drive", &out, &arguments);
    // Nobody sees a bar here.
    let said = "ruby_drive: vary, 3 points\nruby_drive: vary, 3 of 3 points done\n";
    assert_eq!((code(&output), stderr(&output).as_str()), (0, said));
    assert_eq!(listing(&out), ["curve.csv", "curve.json", "curve.png"]);
    let table = Table::read(&out.join("curve.csv"));
    let steps: Vec<f64> = table.column("step_m").iter().map(|step| step.parse().unwrap()).collect();
    let strokes = table.column("waveforms.drive.sawtooth.stroke_m");
    assert_eq!((strokes.len(), strokes[0], strokes[2]), (3, "6e-8", "3e-7"));
    for (stroke, step) in strokes.iter().zip(steps) {
        let set = format!("waveforms.drive.sawtooth.stroke={stroke}");
        let output = run(&scenario("ruby_drive"), root.path(), &[&set, "run.cycles=30"]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let waited = summary(&root.path().join("ruby_drive"))["steps"]["steady"]["step_m"].as_f64().unwrap();
        // u_c is 40 nm.
        assert!((step - waited).abs() < 1e-6 * 40e-9, "{stroke}: {step:e} {waited:e}");
    }
}

#[test]
fn the_same_bytes_for_any_number_of_threads_and_no_file_of_before() {
    let root = tempdir().unwrap();
    let written = |name: &str, more: &[&str]| {
        let out = root.path().join(name);
        let arguments = [&["--curve", "force-speed", "--points", "5"], more].concat();
        let output = curve("quickstart", &out, &arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let read = |name: &String| (name.clone(), std::fs::read(out.join(name)).unwrap());
        listing(&out).iter().map(read).collect::<Vec<_>>()
    };
    let one = written("one", &["--threads", "1", "--theme", "dark"]);
    assert!(one.iter().any(|(name, _)| name == "curve-dark.png"));
    let [one, two] = [written("one", &["--threads", "1"]), written("two", &["--threads", "3"])];
    assert_eq!(one, two);
    let both = ["1", "3"].map(|threads| written("both", &["--both", "--threads", threads]));
    assert_eq!(both[0], both[1]);
    assert_eq!(
        one.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(),
        ["curve.csv", "curve.json", "curve.png"]
    );
}

/// μF_N of the balls and the weight along the slide: written, said and drawn for loads both ways.
#[test]
fn what_is_held_at_rest_is_written_for_both_ways() {
    let root = tempdir().unwrap();
    let out = root.path().join("held");
    let incline = r#"gravity={"acceleration": 9.81, "incline": "20 deg"}"#;
    let asked = ["--curve", "holding-force", "--set", "loads=[]", "--set", incline, "--points", "4"];
    let output = curve("quickstart", &out, &[&asked[..], &["--range", "0.1..1.3"]].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stderr(&output).contains("quickstart: holding-force, 4 of 4 points done\n"));
    assert!(
        stderr(&output).contains(
            "2 of 8 holding forces were not found; at 100.0 mN: without a load, slider slides away"
        )
    );
    assert!(stdout(&output).contains("holding force of slider"), "{}", stdout(&output));
    assert_eq!(listing(&out), ["curve.csv", "curve.json", "curve.png"]);
    let table = Table::read(&out.join("curve.csv"));
    let weight = 10e-3 * 9.81 * 20_f64.to_radians().sin();
    for (column, sign) in [("along_x_N", 1.0), ("against_x_N", -1.0)] {
        let held = table.column(column);
        assert_eq!(held[0], "");
        for (place, value) in [(1, 0.5), (2, 0.9), (3, 1.3)] {
            let wanted: f64 = 0.2 * value + sign * weight;
            let held: f64 = held[place].parse().unwrap();
            assert!((held / wanted - 1.0).abs() < 1e-4, "{column} {value}: {held} {wanted}");
        }
    }
    assert_eq!(table.column("against_x_gives_way")[3], "slider slides away");
}

/// Both senses in one table, file and picture; S₀ of the symmetric drive is the same in both.
#[test]
fn both_senses_are_written_together() {
    let root = tempdir().unwrap();
    let out = root.path().join("both");
    let asked = [
        "--curve",
        "step-amplitude",
        "--range",
        "20 nm..100 nm",
        "--points",
        "3",
        "--tolerance",
        "1e-3",
        "--both",
    ];
    let output = curve("ruby_drive", &out, &asked);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let said = "ruby_drive: step-amplitude, 6 points\nruby_drive: step-amplitude, 6 of 6 points done\n";
    assert_eq!(stderr(&output), said);
    let told = stdout(&output);
    assert!(told.starts_with("forward\n") && told.contains("\nbackward\n"), "{told}");
    assert_eq!(listing(&out), ["curve.csv", "curve.json", "curve.png"]);
    let table = Table::read(&out.join("curve.csv"));
    assert_eq!(
        table.column("direction"),
        ["forward", "forward", "forward", "backward", "backward", "backward"]
    );
    let steps: Vec<f64> = table.column("step_m").iter().map(|step| step.parse().unwrap()).collect();
    assert!(steps[2] > 0.0 && (steps[2] + steps[5]).abs() < 1e-6 * steps[2], "{steps:?}");
    let told: Value = serde_json::from_slice(&std::fs::read(out.join("curve.json")).unwrap()).unwrap();
    let landmark = |place: usize| {
        (told["landmarks"][place]["direction"].clone(), told["landmarks"][place]["at"].as_f64())
    };
    let ((forth, there), (back, then)) = (landmark(0), landmark(1));
    assert_eq!((forth, back), ("forward".into(), "backward".into()));
    assert!((there.unwrap() / then.unwrap() - 1.0).abs() < 2e-3, "{there:?} {then:?}");
}

#[test]
fn what_a_value_does_not_allow_is_said_beside_the_others() {
    let root = tempdir().unwrap();
    let arguments = ["--vary", "contacts.ball.friction=-0.2..0.2", "--points", "3"];
    let output = curve("quickstart", &root.path().join("some"), &arguments);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let said = stderr(&output);
    // The one without friction is dragged away by the load.
    assert!(said.contains("2 of 3 points have no result; at -0.2000: "), "{said}");
    assert!(stdout(&output).contains("slides away"), "{}", stdout(&output));
    assert!(said.contains("expected a number between 0 and 1000, got -2e-1"), "{said}");
    assert!(stdout(&output).contains("refused"), "{}", stdout(&output));
    let none = ["--vary", "contacts.ball.friction=-0.3..-0.2", "--points", "2", "--json"];
    let output = curve("quickstart", &root.path().join("none"), &none);
    assert_eq!(code(&output), 3);
    let answer: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(answer["points"].as_array().unwrap().len(), 2);
}

#[test]
fn bad_input_is_told_and_writes_nothing() {
    let root = tempdir().unwrap();
    let out = root.path().join("out");
    let refused = |name: &str, arguments: &[&str], words: &str| {
        let output = curve(name, &out, arguments);
        assert_eq!(code(&output), 2, "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(words), "{arguments:?}: {}", stderr(&output));
        assert!(!out.exists(), "{arguments:?}");
    };
    refused("quickstart", &[], "--curve");
    refused("quickstart", &["--curve", "speed"], "possible values: step-amplitude");
    refused(
        "quickstart",
        &["--curve", "force-speed", "--range", "1"],
        "expected FROM..TO, such as 0.1..0.6, got \"1\"",
    );
    refused("quickstart", &["--curve", "force-speed", "--range", "1 N..2 nm"], "--range  ");
    let both = "--vary  expected a unit at both ends or at none, which is kg, got \"1 g..2\"";
    refused("quickstart", &["--vary", "bodies.slider.mass=1 g..2"], both);
    refused(
        "quickstart",
        &["--curve", "force-speed", "--range", "2 mN..1 mN"],
        "--range  expected a range that rises from one finite value to another, got 2.000 mN to 1.000 mN",
    );
    refused(
        "quickstart",
        &["--curve", "force-speed", "--range", "0..1 N", "--log"],
        "--log  expected a range above 0",
    );
    refused(
        "quickstart",
        &["--curve", "force-speed", "--points", "1"],
        "--points  expected 2 to 10000 points, got 1",
    );
    refused("quickstart", &["--curve", "preload", "--points", "1"], "expected 2 to 10000 points, got 1");
    let path = "contacts.ball.friction=0.1..0.2";
    refused("quickstart", &["--curve", "force-speed", "--vary", path], "only holding-force takes both");
    refused("three_ball_stage", &["--curve", "holding-force"], "name a parameter, such as --vary");
    refused("worn_ball", &["--curve", "holding-force"], "no body is free along x");
    refused("quickstart", &["--curve", "holding-force", "--both"], "--both  cannot be used with");
    let jumps = ["--curve", "step-load", "--both", "--set", "waveforms.drive.sawtooth.flyback=0"];
    refused("quickstart", &jumps, "a waveform that jumps cannot be reversed");
    let smooth = ["--curve", "holding-force", "--set", "contacts.ball.friction=0"];
    refused("quickstart", &smooth, "no contact of \"slider\" has friction");
    refused("quickstart", &["--curve", "holding-force", "--range", "2 N..1 N"], "a range that rises");
    refused("quickstart", &["--curve", "holding-force", "--range", "1 m..2 m"], "--range  ");
    refused("quickstart", &["--vary", "contacts.ball.friction"], "PATH=FROM..TO");
    refused("quickstart", &["--vary", "contacts.bal.friction=0..1"], "did you mean \"ball\"?");
    refused("quickstart", &["--vary", "contacts.ball.count=1..3"], "is a count");
    refused("bouncing_ball", &["--curve", "step-amplitude"], "no waveform has a period");
    refused("walking_drive", &["--curve", "preload"], "has a constant normal force");
}

#[test]
fn a_place_that_cannot_be_written_into_is_told_before_the_first_point() {
    let root = tempdir().unwrap();
    let out = root.path().join("file");
    std::fs::write(&out, "somebody's").unwrap();
    let output = curve("quickstart", &out, &["--curve", "force-speed"]);
    let said = stderr(&output);
    assert_eq!(code(&output), 2, "{said}");
    assert!(said.contains("this folder cannot be written: ") && !said.contains("points"), "{said}");
    assert_eq!(std::fs::read(&out).unwrap(), b"somebody's");
}

/// A finished curve is not lost to one that somebody ends; what that has done is beside it until the next is finished.
#[cfg(unix)]
#[test]
fn an_interrupted_curve_leaves_a_finished_one() {
    use std::io::{BufRead, BufReader, Read};
    use std::process::{Command, Stdio};
    let root = tempdir().unwrap();
    let out = root.path().join("curve");
    let short = ["--vary", "contacts.ball.friction=0.1..0.3", "--points", "3", "--theme", "light,dark"];
    assert_eq!(code(&curve("ruby_drive", &out, &short)), 0);
    let read = |name: &str| std::fs::read(out.join(name)).unwrap();
    let finished = [read("curve.csv"), read("curve.json"), read("curve.png")];
    let mut command = stickslip();
    command.arg("curve").arg(scenario("ruby_drive"));
    command.args(["--vary", "contacts.ball.friction=0.1..0.3", "--points", "10000", "--threads", "1"]);
    let mut child =
        command.arg("--out").arg(&out).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let mut said = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    said.read_line(&mut line).unwrap();
    assert_eq!(line, "ruby_drive: vary, 10000 points\n");
    std::thread::sleep(std::time::Duration::from_secs(1));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    said.read_to_string(&mut line).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{line}");
    assert!(line.contains(" of 10000 points done"), "{line}");
    assert_eq!([read("curve.csv"), read("curve.json"), read("curve.png")], finished);
    // As many rows as points, those that were not run say so.
    let table = Table::read(&out.join("curve-partial.csv"));
    assert!(table.column("fault").contains(&"not run"));
    let partial: Value = serde_json::from_slice(&read("curve-partial.json")).unwrap();
    assert_eq!(
        (&partial["status"], &partial["landmarks"][0]["fault"]),
        (&"interrupted".into(), &"not run".into())
    );
    assert!(out.join("curve-partial.png").exists());
    // The next that comes to its end clears up.
    assert_eq!(code(&curve("ruby_drive", &out, &short)), 0);
    assert_eq!(listing(&out), ["curve-dark.png", "curve.csv", "curve.json", "curve.png"]);
}

/// What `check --json` warns of in an example with overrides: kinds.
fn checked(name: &str, set: &[&str]) -> Vec<String> {
    let mut command = stickslip();
    command.arg("check").arg(scenario(name)).arg("--json");
    set.iter().for_each(|pair| {
        command.args(["--set", pair]);
    });
    let told: Value = serde_json::from_str(&stdout(&command.output().unwrap())).unwrap();
    strings(&told["warnings"], "kind")
}

/// A key of all entries of a list, which is left out where it is empty.
fn strings(list: &Value, key: &str) -> Vec<String> {
    list.as_array().into_iter().flatten().map(|it| it[key].as_str().unwrap().to_owned()).collect()
}

/// A drive behind a driver steps from a small voltage on, which no point of the range has; a range by default ends at the window and the
/// nominal voltage, 120 V, and of 41 points the landmarks are printed alone.
#[test]
fn a_range_ends_at_the_data_sheet_and_zero_steps_lie_below_it() {
    let root = tempdir().unwrap();
    let asked = ["--curve", "step-amplitude", "--tolerance", "1e-3"];
    let output = curve("driven_stage", &root.path().join("curve"), &asked);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let told: Value =
        serde_json::from_slice(&std::fs::read(root.path().join("curve/curve.json")).unwrap()).unwrap();
    let points = told["points"].as_array().unwrap();
    assert_eq!((points.len(), points[40]["value"].as_f64()), (41, Some(120.0)));
    assert!(points.iter().all(|point| point["warnings"] == serde_json::json!([])));
    let landmarks = told["landmarks"].as_array().unwrap();
    assert_eq!((landmarks.len(), &landmarks[0]["name"]), (1, &Value::from("zero_step")));
    let [at, below] = ["at", "below"].map(|key| landmarks[0][key].as_f64().unwrap());
    assert!(at > 0.0 && at < below && below == points[0]["value"].as_f64().unwrap(), "{at} {below}");
    let said = stdout(&output);
    assert!(
        said.contains("41 points in curve.csv, --rows prints them") && !said.contains("mean speed"),
        "{said}"
    );
    // The drive steps above it and not below.
    for (share, steps) in [(0.98, false), (1.02, true)] {
        let set = format!("waveforms.drive.sawtooth.stroke={}", share * at);
        run(&scenario("driven_stage"), root.path(), &[&set, "run.cycles=40", "plots=[]"]);
        let step = summary(&root.path().join("driven_stage"))["steps"]["last_m"].as_f64().unwrap();
        assert_eq!(step > 1e-10, steps, "{share}: {step:e}");
    }
}

/// A curve may cross zero twice: beyond the window, or where the current no longer discharges the stack. Points carry what `check` says.
#[test]
fn where_steps_cease_the_window_or_the_current_is_named() {
    let root = tempdir().unwrap();
    let wide = r#"actuators.stack.driver.window=["0 V", "500 V"]"#;
    for (by, range, set) in [("window", "110 V..160 V", "run.cycles=12"), ("current", "110 V..350 V", wide)] {
        let out = root.path().join(by);
        let asked =
            ["--curve", "step-amplitude", "--range", range, "--points", "4", "--tolerance", "1e-2", "--rows"];
        let output = curve("driven_stage", &out, &[&asked[..], &["--set", set]].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert!(stdout(&output).contains("mean speed"));
        let told: Value = serde_json::from_slice(&std::fs::read(out.join("curve.json")).unwrap()).unwrap();
        let landmarks = told["landmarks"].as_array().unwrap();
        assert_eq!(strings(&told["landmarks"], "name"), ["zero_step", "zero_step"]);
        assert_eq!(
            (&landmarks[0]["beyond_by"], &landmarks[1]["beyond_by"]),
            (&Value::Null, &Value::from(by))
        );
        let points = told["points"].as_array().unwrap();
        let step = |k: usize| points[k]["step_m"].as_f64().unwrap();
        let at = landmarks[1]["at"].as_f64().unwrap();
        let last = (0..4).filter(|k| step(*k) > 1e-9).max().unwrap();
        let value = |k: usize| points[k]["value"].as_f64().unwrap();
        assert!(last < 3 && (value(last)..=value(last + 1)).contains(&at), "{by}: {at} V");
        for point in points {
            let own = point["set"][0].as_str().unwrap();
            assert_eq!(strings(&point["warnings"], "kind"), checked("driven_stage", &[set, own]), "{own}");
            assert!(strings(&point["warnings"], "message").iter().all(|message| !message.is_empty()));
        }
    }
}
