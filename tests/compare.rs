//! Two runs told apart: every sort of difference is made by hand, and must be found as what it is.

use crate::program::{code, listing, reseal, run, run_example, scenario, stderr, stdout, stickslip, summary};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use tempfile::{TempDir, tempdir};

/// Lines of a table as words; the first has the names.
pub(crate) type Lines = Vec<Vec<String>>;

/// A run, and a copy of it to be changed.
pub(crate) struct Pair {
    pub(crate) a: PathBuf,
    pub(crate) b: PathBuf,
    _root: TempDir,
}

impl Pair {
    pub(crate) fn new(name: &str, set: &[&str]) -> Self {
        let root = tempdir().unwrap();
        let a = run_example(name, &root.path().join("a"), &[&["plots=[]"], set].concat());
        let b = root.path().join("b");
        std::fs::create_dir(&b).unwrap();
        for name in ["trace.csv", "events.csv", "summary.json", "scenario.json"] {
            std::fs::copy(a.join(name), b.join(name)).unwrap();
        }
        Self { a, b, _root: root }
    }

    pub(crate) fn quickstart() -> Self {
        Self::new("quickstart", &["run.duration=21 ms"])
    }

    /// Makes B what A is.
    pub(crate) fn restore(&self) {
        for name in ["trace.csv", "events.csv", "summary.json", "scenario.json"] {
            std::fs::copy(self.a.join(name), self.b.join(name)).unwrap();
        }
    }

    /// Replaces a table of B by a changed copy of A's, and makes the summary fit.
    pub(crate) fn edit<T>(&self, name: &str, change: impl FnOnce(&mut Lines) -> T) -> T {
        let result = self.rewrite(name, change);
        reseal(&self.b);
        self.recount();
        result
    }

    /// Replaces a table of B by a changed copy of A's, and nothing else.
    pub(crate) fn rewrite<T>(&self, name: &str, change: impl FnOnce(&mut Lines) -> T) -> T {
        let text = std::fs::read_to_string(self.a.join(name)).unwrap();
        let mut lines: Lines =
            text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
        let result = change(&mut lines);
        let text: Vec<String> = lines.iter().map(|line| line.join(",") + "\n").collect();
        std::fs::write(self.b.join(name), text.concat()).unwrap();
        result
    }

    /// Makes the summary of B count what its tables have.
    pub(crate) fn recount(&self) {
        for (count, table) in [("rows", "trace.csv"), ("events", "events.csv")] {
            let rows = summary(&self.b)["tables"][table]["rows"].clone();
            self.edit_summary(&format!("/counts/{count}"), |_| rows);
        }
    }

    /// Changes a value in the summary of B.
    pub(crate) fn edit_summary(&self, pointer: &str, change: impl FnOnce(&Value) -> Value) {
        let mut summary = summary(&self.b);
        let value = summary.pointer_mut(pointer).unwrap();
        *value = change(value);
        std::fs::write(self.b.join("summary.json"), summary.to_string()).unwrap();
    }

    /// Puts a value under a key of the summary of B.
    pub(crate) fn edit_root(&self, key: &str, value: Value) {
        let mut summary = summary(&self.b);
        summary[key] = value;
        std::fs::write(self.b.join("summary.json"), summary.to_string()).unwrap();
    }

    fn compare(&self, flags: &[&str]) -> (i32, Value) {
        compare(&self.a, &self.b, flags)
    }

    fn text(&self, flags: &[&str]) -> String {
        stdout(&call(&self.a, &self.b, flags))
    }
}

fn call(a: &Path, b: &Path, flags: &[&str]) -> std::process::Output {
    stickslip().arg("compare").args([a, b]).args(flags).output().unwrap()
}

/// Exit code and what was found.
fn compare(a: &Path, b: &Path, flags: &[&str]) -> (i32, Value) {
    let output = call(a, b, &[&["--json"], flags].concat());
    assert_eq!(stderr(&output), "");
    (code(&output), serde_json::from_str(&stdout(&output)).unwrap())
}

/// Names of the channels that differ.
fn differing(found: &Value) -> Vec<&str> {
    let channels = found["channels"].as_array().unwrap().iter().filter(|channel| channel["rows"] != 0);
    channels.map(|channel| channel["name"].as_str().unwrap()).collect()
}

/// Numbers of missing, extra and moved events.
fn events(found: &Value) -> [usize; 3] {
    ["missing", "extra", "moved"].map(|sort| found["events"][sort].as_array().unwrap().len())
}

/// Multiplies a number by 1 + 10⁻⁹.
fn nudge(cell: &mut String) {
    *cell = format!("{:?}", cell.parse::<f64>().unwrap() * (1.0 + 1e-9));
}

pub(crate) fn place(lines: &Lines, name: &str) -> usize {
    lines[0].iter().position(|head| head == name).unwrap()
}

#[test]
fn the_same_run_is_the_same_to_the_bit() {
    let pair = Pair::quickstart();
    let again = tempdir().unwrap();
    let b = run_example("quickstart", again.path(), &["plots=[]", "run.duration=21 ms"]);
    let (code, found) = compare(&pair.a, &b, &["--tolerance", "0", "--time-tolerance", "0"]);
    assert_eq!((code, &found["verdict"], &found["notes"]), (0, &json!("identical"), &json!([])));
    assert_eq!(found["rows"], json!({ "a": 2101, "b": 2101, "common": 2101 }));
    assert_eq!(found["coverage"], json!({ "time": 1.0, "rows": 1.0 }));
    assert_eq!(found["channels"].as_array().unwrap().len(), 19);
    assert!(found["figures"]["compared"].as_u64().unwrap() > 25);
    let text = pair.text(&[]);
    assert!(text.contains("  ball.fx_N ") && text.ends_with("\nidentical\n"), "{text}");
    assert_eq!(pair.text(&["-q"]), "");
}

#[test]
fn a_change_of_1e_9_is_found_in_every_channel() {
    let pair = Pair::quickstart();
    let channels = pair.edit("trace.csv", |lines| lines[0].clone());
    for name in channels.iter().filter(|name| !["time_s", "ball.state"].contains(&name.as_str())) {
        // The largest value of the channel.
        let time = pair.edit("trace.csv", |lines| {
            let k = place(lines, name);
            let size = |line: &[String]| line[k].parse::<f64>().unwrap().abs();
            let row = (1..lines.len()).max_by(|&i, &j| size(&lines[i]).total_cmp(&size(&lines[j]))).unwrap();
            nudge(&mut lines[row][k]);
            lines[row][0].parse::<f64>().unwrap()
        });
        let (code, found) = pair.compare(&[]);
        if name == "energy.damping_J" || name == "energy.error_J" {
            // Nothing is damped, and the error of the books, rounding itself, is measured by what went through them.
            assert_eq!((code, differing(&found).len()), (0, 0), "{name}");
            continue;
        }
        assert_eq!((code, differing(&found)), (1, vec![name.as_str()]));
        assert_eq!(found["first"], json!({ "time_s": time, "what": name }));
        assert!(pair.text(&[]).ends_with(&format!(" s: {name}\ndiffers\n")));
    }
}

/// The benchmark drive with a mass that is 1e-13 heavier differed in one state, at a corner of its waveform, and in how many steps count as
/// steady.
#[test]
fn rounding_is_equal_and_not_identical() {
    let pair = Pair::new("p1", &[]);
    let other = |mass: f64| {
        let out = tempdir().unwrap();
        let b = run_example("p1", out.path(), &["plots=[]", &format!("bodies.slider.mass={mass:?}")]);
        (b, out)
    };
    let (b, _out) = other(0.02 * (1.0 + 1e-13));
    let (code, found) = compare(&pair.a, &b, &[]);
    assert_eq!((code, &found["verdict"]), (0, &json!("equal")));
    let text = stdout(&call(&pair.a, &b, &[]));
    assert!(text.contains("\n  largest difference: ") && text.ends_with(" s\nequal\n"), "{text}");
    let (code, found) = compare(&pair.a, &b, &["--exact"]);
    assert_eq!((code, &found["verdict"]), (1, &json!("differs")));
    let (b, _out) = other(0.02 * (1.0 + 1e-9));
    assert_eq!(compare(&pair.a, &b, &[]).0, 1);
    // Another time taken is no other bit.
    let (b, _out) = other(0.02);
    assert_eq!(compare(&pair.a, &b, &["--exact"]).0, 0);
}

/// The scenario has the length of a frame, the summary has the time step: a whole fraction of the frame that depends on the model.
#[test]
fn runs_in_frames_can_be_compared() {
    let pair = Pair::new("p1", &[r#"run.stepper={"frames": {"length": "30 us"}}"#, "run.cycles=2"]);
    let (code, found) = pair.compare(&[]);
    assert_eq!((code, &found["verdict"]), (0, &json!("identical")));
    pair.edit_summary("/stepper/step_s", |step| json!(0.7 * step.as_f64().unwrap()));
    let output = call(&pair.a, &pair.b, &[]);
    assert!(
        stderr(&output).contains("run.stepper differs from the stepper of summary.json"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_state_on_an_event_may_be_that_before_it_or_after_it() {
    let pair = Pair::new("p1", &[]);
    // At 15 ms the waveform has a corner, and gross slip ends.
    for (time, code) in [(0.015, 0), (0.0151, 1)] {
        let was = pair.edit("trace.csv", |lines| {
            let (state, row) = (
                place(lines, "ball.state"),
                lines.iter().skip(1).position(|line| line[0].parse::<f64>().unwrap() >= time).unwrap() + 1,
            );
            std::mem::replace(&mut lines[row][state], "stick".to_owned())
        });
        assert!(was != "stick");
        assert_eq!(pair.compare(&[]).0, code, "{time}");
    }
}

#[test]
fn another_word_and_what_is_no_number_are_found() {
    let pair = Pair::quickstart();
    for (name, value) in [("ball.state", "open"), ("slider.x_m", "NaN"), ("ball.fx_N", "inf")] {
        pair.edit("trace.csv", |lines| {
            let k = place(lines, name);
            value.clone_into(&mut lines[700][k]);
        });
        let (code, found) = pair.compare(&[]);
        assert_eq!((code, differing(&found)), (1, vec![name]));
        assert!((found["first"]["time_s"].as_f64().unwrap() - 6.99e-3).abs() < 1e-9);
    }
}

#[test]
fn an_event_moved_by_a_nanosecond_is_that_event_alone() {
    for (name, set) in [("quickstart", "run.duration=21 ms"), ("fretting_sphere", "run.duration=3 s")] {
        let pair = Pair::new(name, &[set]);
        let event = pair.edit("events.csv", |lines| {
            let middle = lines.len() / 2;
            let event = lines[middle].clone();
            lines[middle][0] = format!("{:?}", event[0].parse::<f64>().unwrap() + 1e-9);
            event
        });
        let (code, found) = pair.compare(&[]);
        assert_eq!((code, events(&found)), (1, [0, 0, 1]), "{name}");
        let moved = &found["events"]["moved"][0];
        assert_eq!((moved["source"].as_str(), moved["kind"].as_str()), (Some(&*event[1]), Some(&*event[2])));
        assert!((moved["by_s"].as_f64().unwrap() - 1e-9).abs() < 1e-15);
        let line = format!("moved in B: {}, \"{}\" at t = {} s, by +1.0e-9 s", event[1], event[2], event[0]);
        assert!(pair.text(&[]).contains(&line), "{line}\n{}", pair.text(&[]));
        assert_eq!(pair.compare(&["--time-tolerance", "2 ns"]).0, 0, "{name}");
    }
}

#[test]
fn a_missing_event_is_one_event_and_shifts_no_other() {
    let pair = Pair::quickstart();
    let event = pair.edit("events.csv", |lines| lines.remove(100));
    let (code, found) = pair.compare(&[]);
    assert_eq!((code, events(&found)), (1, [1, 0, 0]));
    let missing = json!({ "source": event[1], "kind": event[2], "time_s": event[0].parse::<f64>().unwrap() });
    assert_eq!(found["events"]["missing"][0], missing);
    assert!(pair.text(&[]).contains(&format!("missing in B: {}, \"{}\" at t = ", event[1], event[2])));
    let (code, found) = compare(&pair.b, &pair.a, &[]);
    assert_eq!((code, events(&found)), (1, [0, 1, 0]));
    // Even where no other event stays where it was.
    pair.edit("events.csv", |lines| {
        lines.remove(100);
        for line in &mut lines[1..] {
            line[0] = format!("{:?}", line[0].parse::<f64>().unwrap() + 1e-10);
        }
    });
    let (_, found) = pair.compare(&[]);
    assert_eq!((events(&found)[..2].to_vec(), &found["events"]["missing"][0]), (vec![1, 0], &missing));
    assert_eq!(found["events"]["moved"][0]["by_s"].as_f64().unwrap().signum(), 1.0);
}

#[test]
fn an_event_of_another_kind_is_one_missing_and_one_extra() {
    let pair = Pair::quickstart();
    pair.edit("events.csv", |lines| "touch".clone_into(&mut lines[50][2]));
    assert_eq!(events(&pair.compare(&[]).1), [1, 1, 0]);
}

#[test]
fn figures_are_compared_each_by_its_name() {
    let pair = Pair::quickstart();
    for (pointer, name) in [
        ("/steps/last_m", "steps.last_m"),
        ("/energy/friction_J", "energy.friction_J"),
        ("/contacts/ball/peak_fx_N", "contacts.ball.peak_fx_N"),
    ] {
        let original = summary(&pair.a).pointer(pointer).unwrap().clone();
        pair.edit_summary(pointer, |value| json!(value.as_f64().unwrap() * (1.0 + 1e-9)));
        let (code, found) = pair.compare(&[]);
        assert_eq!((code, found["figures"]["differ"].as_array().unwrap().len()), (1, 1), "{name}");
        assert_eq!(found["figures"]["differ"][0]["name"], name);
        assert!(
            pair.text(&[]).contains(&format!("\n  summary value {name}: "))
                && pair.text(&[]).ends_with("differs\n")
        );
        pair.edit_summary(pointer, |_| original);
    }
    // Sentences say in words what figures are, to four digits.
    pair.edit_summary("/steps/why/0", |_| json!("the drive went forth and back"));
    assert_eq!(pair.compare(&[]).0, 0);
    pair.edit("steps.csv", |lines| {
        let length: f64 = lines[2][3].parse().unwrap();
        lines[2][3] = format!("{:?}", length * (1.0 + 1e-9));
    });
    let (code, found) = pair.compare(&[]);
    assert_eq!((code, &found["figures"]["differ"][0]["name"]), (1, &json!("steps.lengths_m[1]")));
    // Whoever sends results may leave the steps out.
    std::fs::remove_file(pair.b.join("steps.csv")).unwrap();
    let (code, found) = pair.compare(&[]);
    assert_eq!((code, &found["notes"]), (0, &json!(["B: missing, not compared: steps.csv"])));
    pair.edit_summary("/steps", |_| json!({}));
    let (code, found) = pair.compare(&[]);
    assert_eq!((code, &found["figures"]["missing"][0]), (1, &json!("steps.body")));
}

#[test]
fn rows_on_other_grids_are_compared_where_they_meet() {
    let pair = Pair::new("p1", &["run.cycles=3"]);
    let out = tempdir().unwrap();
    // A corner lies on a row of both grids at 0.9 ms: 450 · 2 µs and 9 · 100 µs, which are rounded apart.
    let grids =
        [("3 us", 1001, 501, 0), ("1 us", 3001, 1501, 0), ("7 us", 430, 216, 0), ("100 us", 31, 29, 2)];
    for (every, rows, common, at_events) in grids {
        let b =
            run_example("p1", out.path(), &["run.cycles=3", &format!("output.every={every}"), "plots=[]"]);
        let (code, found) = compare(&pair.a, &b, &[]);
        assert_eq!(
            (code, &found["rows"]),
            (0, &json!({ "a": 1501, "b": rows, "common": common })),
            "{every}"
        );
        let note = found["notes"].as_array().unwrap().last().unwrap().as_str().unwrap();
        let left_out =
            if at_events > 0 { format!(" ({at_events} more are at events)") } else { String::new() };
        let numbers =
            format!("rows: 1501 in A and {rows} in B, compared at {common} common times{left_out}; ");
        assert_eq!(note, numbers + "nothing is interpolated");
    }
}

#[test]
fn channels_that_one_run_lacks_are_named() {
    let pair = Pair::quickstart();
    let out = tempdir().unwrap();
    let set = ["run.duration=21 ms", "plots=[]", r#"output.channels=["slider.x_m", "ball.state"]"#];
    let few = run_example("quickstart", out.path(), &set);
    let (code, found) = compare(&pair.a, &few, &[]);
    assert_eq!((code, found["channels_missing"].as_array().unwrap().len()), (1, 17));
    assert!(stdout(&call(&pair.a, &few, &[])).contains("  ball.u_m "));
    // What B has besides is said, and is no difference.
    let (code, found) = compare(&few, &pair.a, &[]);
    assert_eq!((code, found["channels_extra"].as_array().unwrap().len()), (0, 17));
    assert!(found["notes"].to_string().contains("only in B: foot.x_m, "));
}

#[test]
fn runs_of_different_length_are_compared_until_the_shorter_ends() {
    let pair = Pair::new("p1", &["run.cycles=4"]);
    let out = tempdir().unwrap();
    let short = run_example(
        "p1",
        out.path(),
        &[r#"run={"duration":"2.5 ms","stepper":{"event":{"tolerance":1e-12}}}"#, "plots=[]"],
    );
    for (a, b) in [(&pair.a, &short), (&short, &pair.a)] {
        let (code, found) = compare(a, b, &[]);
        assert_eq!((code, &found["until_s"], &found["rows"]["common"]), (0, &json!(2.5e-3), &json!(1251)));
        assert!(
            found["notes"].to_string().contains("compared until t = 0.0025 s, the end of the shorter run")
        );
        assert!(found["figures"]["compared"].as_u64().unwrap() >= 2, "two whole steps");
    }
    // A corner at the very end of a run starts nothing there, and something in the longer run.
    let corner = run_example("p1", &out.path().join("corner"), &["run.cycles=2", "plots=[]"]);
    let (code, found) = compare(&pair.a, &corner, &[]);
    assert_eq!((code, &found["rows"]["common"]), (0, &json!(1000)));
    // An interrupted run says so; one that stopped itself is not the same as one that did not.
    for (status, expected) in [("interrupted", 0), ("stopped", 1)] {
        let text = std::fs::read_to_string(short.join("summary.json")).unwrap();
        std::fs::write(short.join("summary.json"), text.replace("\"done\"", &format!("\"{status}\"")))
            .unwrap();
        let (code, found) = compare(&pair.a, &short, &[]);
        assert_eq!(code, expected, "{status}");
        assert!(found["notes"].to_string().contains(&format!("B: the run was {status} at t = 0.0025 s")));
        std::fs::write(short.join("summary.json"), text).unwrap();
    }
}

#[test]
fn a_run_that_stopped_itself_agrees_as_far_as_it_came() {
    let pair = Pair::new("quickstart", &[]);
    let out = tempdir().unwrap();
    let output = run(&scenario("quickstart"), out.path(), &["run.limits.steps=400", "plots=[]"]);
    assert_eq!(code(&output), 3);
    let (code, found) = compare(&pair.a, &out.path().join("quickstart"), &[]);
    assert_eq!((code, differing(&found).len(), events(&found)), (1, 0, [0, 0, 0]));
    assert!(pair.text(&[]).ends_with("\nidentical\n"));
}

#[test]
fn runs_at_different_tolerances_agree_within_what_they_promise() {
    let tight = tempdir().unwrap();
    // A power without a closed form: a paraboloid would swing, all but equal at all tolerances.
    let power = r#"contacts.ball.profile={"power":{"exponent":2.5,"coefficient":1e4}}"#;
    let set = ["run.duration=21 ms", "plots=[]", power];
    let b =
        run_example("quickstart", tight.path(), &[&set[..], &["run.stepper.event.tolerance=1e-12"]].concat());
    let pair = Pair::new("quickstart", &set);
    let (code, found) = compare(&pair.a, &b, &[]);
    assert_eq!((code, &found["tolerance"]["relative"]), (0, &json!(1e-6)));
    let (code, found) = compare(&pair.a, &b, &["--tolerance", "1e-13"]);
    assert_eq!(code, 1);
    assert!(differing(&found).contains(&"slider.x_m"));
}

#[test]
fn tolerances_are_taken_as_they_are_given() {
    let pair = Pair::quickstart();
    pair.edit("trace.csv", |lines| {
        let k = place(lines, "slider.x_m");
        // Some 0.3 µm, moved by 3e-16 m.
        nudge(&mut lines[2000][k]);
    });
    for (flags, expected) in [
        (&["--tolerance", "1e-8"][..], 0),
        (&["--tolerance", "1e-12"], 1),
        (&["--absolute", "slider.x_m=1e-6 nm"], 0),
        (&["--absolute", "slider.x_m=1e-20"], 1),
        (&["--absolute", "foot.x_m=1 nm"], 1),
        (&["--ignore", "slider.x_m"], 0),
        (&["--ignore", "slider"], 0),
        (&["--ignore", "ball"], 1),
    ] {
        assert_eq!(pair.compare(flags).0, expected, "{flags:?}");
    }
}

#[test]
fn the_channels_that_differ_are_drawn_where_that_is_asked() {
    let pair = Pair::quickstart();
    pair.edit("trace.csv", |lines| {
        for (name, row) in [("ball.fx_N", 900), ("slider.x_m", 1200)] {
            let k = place(lines, name);
            let value: f64 = lines[row][k].parse().unwrap();
            lines[row][k] = format!("{:?}", value * 1.01);
        }
    });
    let out = tempdir().unwrap();
    for end in ["png", "svg"] {
        let file = out.path().join(format!("difference.{end}"));
        let flags = ["--plot", file.to_str().unwrap()];
        let text = pair.text(&flags);
        let drawn = format!("  drawn in {}: slider.x_m, ball.fx_N\n", file.display());
        assert!(text.contains(&drawn), "{text}");
        let bytes = std::fs::read(&file).unwrap();
        if end == "png" {
            let texts = stickslip_plot::read_text(&bytes).unwrap();
            let title = texts.iter().find(|(key, _)| key == "Title").map(|(_, text)| text.as_str());
            assert_eq!(title, Some("first difference at t = 0.00899 s: ball.fx_N"));
        } else {
            assert!(String::from_utf8(bytes).unwrap().contains("ball.fx_N"));
        }
    }
    assert_eq!(listing(out.path()), ["difference.png", "difference.svg"]);
    for (file, message) in [
        ("x.jpg", "ends in .png or .svg"),
        ("no/x.png", "no/x.png  cannot be written: No such file or directory\n"),
    ] {
        let output = call(&pair.a, &pair.b, &["--plot", file]);
        assert!(code(&output) == 2 && stderr(&output).contains(message), "{}", stderr(&output));
    }
}

/// The rest would press together what is compared, to a sixth of the width.
#[test]
fn the_picture_ends_with_the_shorter_run() {
    let out = tempdir().unwrap();
    let run = |name: &str, cycles: u32| {
        let set = [&format!("run.cycles={cycles}"), "output.every=50 us", "plots=[]"];
        run_example("p1", &out.path().join(name), &set)
    };
    let (long, short) = (run("long", 6), run("short", 1));
    let file = out.path().join("difference.svg");
    // Names and ticks, without what names the runs and says how far they agree.
    let texts = |a: &Path, b: &Path| -> Vec<String> {
        assert!(code(&call(a, b, &["--plot", file.to_str().unwrap()])) < 2);
        let svg = std::fs::read_to_string(&file).unwrap();
        let texts = svg.lines().filter(|line| !line.starts_with('<') && !line.contains("/p1"));
        let said = ["SHA-256", "the files differ", "byte-identical"];
        texts.filter(|line| !said.iter().any(|said| line.contains(said))).map(str::to_owned).collect()
    };
    let one = texts(&short, &short);
    assert!(one.contains(&"time t (ms)".to_owned()), "{one:?}");
    assert_eq!((texts(&long, &short), texts(&short, &long)), (one.clone(), one.clone()));
    assert_ne!(texts(&long, &long), one);
}

#[test]
fn bad_input_is_said_and_is_no_difference() {
    let pair = Pair::quickstart();
    let refused = |a: &Path, b: &Path, flags: &[&str], message: &str| {
        let output = call(a, b, flags);
        assert_eq!((code(&output), stdout(&output)), (2, String::new()), "{message}");
        assert!(stderr(&output).contains(message), "expected {message:?} in {}", stderr(&output));
    };
    let (a, b) = (pair.a.as_path(), pair.b.as_path());
    refused(a, Path::new("nowhere"), &[], "nowhere: expected a folder of results");
    refused(a, &a.join("trace.csv"), &[], "expected a folder of results");
    refused(a, b, &["--absolute", "slidr.x_m=1 nm"], "did you mean \"slider.x_m\"?");
    refused(a, b, &["--absolute", "slider.x_m=1 N"], "N is a unit of a force");
    refused(a, b, &["--absolute", "slider.x_m=-1 nm"], "expected a value of 0 or more");
    refused(a, b, &["--ignore", "bell"], "did you mean \"ball\"?");
    refused(a, b, &["--tolerance=-1"], "expected a value of 0 or more");
    refused(a, b, &["--tolerance", "-1"], "expected a value of 0 or more");
    refused(a, b, &["--time-tolerance", "1 nm"], "nm is a unit of a length");
    pair.edit("trace.csv", |lines| lines.truncate(1));
    refused(a, b, &[], "trace.csv  has no rows");
    pair.edit("trace.csv", |lines| "x".clone_into(&mut lines[3][1]));
    refused(a, b, &[], "trace.csv:4  foot.x_m: expected a number, got \"x\"");
    pair.edit("trace.csv", |lines| "t".clone_into(&mut lines[0][0]));
    refused(a, b, &[], "trace.csv: there is no column \"time_s\"");
    std::fs::write(b.join("summary.json"), "{}").unwrap();
    refused(a, b, &[], "summary.json: is not the summary of a run: simulated_s is missing");
    std::fs::write(b.join("summary.json"), "{").unwrap();
    refused(a, b, &[], "summary.json: cannot be read: ");
    std::fs::remove_file(b.join("summary.json")).unwrap();
    refused(
        a,
        b,
        &[],
        "b: incomplete: the run was killed while it published its results\n   help: run the scenario again\n",
    );
    for name in ["trace.csv", "events.csv", "scenario.json"] {
        std::fs::remove_file(b.join(name)).unwrap();
    }
    refused(a, b, &[], "expected a folder of results");
}

/// P1: u_c = μE*d/G*, and ω² = 2G*a/m of the slider on the stuck contact.
#[test]
fn the_natural_scales_are_those_of_the_closed_form() {
    let pair = Pair::new("p1", &["run.cycles=1"]);
    let (modulus, nu, radius, load, friction, mass) = (210e9_f64, 0.3_f64, 1e-3_f64, 1.0_f64, 0.15, 0.02);
    let normal = modulus / (2.0 * (1.0 - nu * nu));
    let tangential = modulus / ((2.0 - nu) * (1.0 + nu));
    let contact = (0.75 * load * radius / normal).cbrt();
    let u_c = friction * normal / tangential * contact * contact / radius;
    let frequency = (2.0 * tangential * contact / mass).sqrt();
    let scales = &summary(&pair.a)["contacts"]["ball"]["scales"];
    for (name, want) in [("displacement_m", u_c), ("force_N", 0.15), ("velocity_m_s", u_c * frequency)] {
        let got = scales[name].as_f64().unwrap();
        assert!((got / want - 1.0).abs() < 1e-12, "{name}: {got:e} for {want:e}");
    }
}
