//! Results that were damaged, by accident or by somebody who wants a comparison to say "no difference".

use crate::compare::{Lines, Pair, place};
use crate::program::{code, listing, reseal, run_example, sha256, stderr, stdout, stickslip, summary};
use serde_json::{Value, json};
use std::path::Path;
use tempfile::tempdir;

/// How the summary of damaged results is left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Forgery {
    /// As the run wrote it.
    None,
    /// With the right hashes of the damaged tables.
    Hashes,
    /// With the counts as well.
    All,
}

/// What stays of two comparisons, with and without a tolerance of 0: their exit codes, and what was said.
fn judged(pair: &Pair) -> ([i32; 2], String) {
    let call =
        |flags: &[&str]| stickslip().arg("compare").args([&pair.a, &pair.b]).args(flags).output().unwrap();
    let (first, second) = (call(&[]), call(&["--tolerance", "0"]));
    ([code(&first), code(&second)], stderr(&first) + &stdout(&first))
}

/// Damages a table in each of three ways to go about the summary; returns what was found.
fn table_damaged(pair: &Pair, name: &str, what: &str, damage: &dyn Fn(&mut Lines)) {
    for forgery in [Forgery::None, Forgery::Hashes, Forgery::All] {
        pair.restore();
        pair.rewrite(name, damage);
        match forgery {
            Forgery::None => {}
            Forgery::Hashes => reseal(&pair.b),
            Forgery::All => {
                reseal(&pair.b);
                pair.recount();
            }
        }
        let (codes, said) = judged(pair);
        assert!(
            codes.iter().all(|code| [1, 2].contains(code)),
            "{what}, forged {forgery:?}: {codes:?}\n{said}"
        );
        if forgery == Forgery::None {
            assert_eq!(codes, [2, 2], "{what}: {said}");
            assert!(said.contains(&format!("b/{name}")), "{what}: {said}");
        }
        if codes[0] == 2 {
            assert!(
                said.contains("b/trace.csv")
                    || said.contains("b/events.csv")
                    || said.contains("b/summary.json"),
                "{said}"
            );
        }
    }
}

/// Puts another time into a line.
fn at(line: usize, time: &'static str) -> impl Fn(&mut Lines) {
    move |lines| time.clone_into(&mut lines[line][0])
}

/// Multiplies the times of some lines.
fn stretched(from: usize, factor: f64) -> impl Fn(&mut Lines) {
    move |lines| {
        for line in &mut lines[from..] {
            line[0] = format!("{:?}", line[0].parse::<f64>().unwrap() * factor);
        }
    }
}

/// A damage and its name.
type Damage<'a> = (&'a str, &'a dyn Fn(&mut Lines));

/// A run of 21 ms, and the lines of a table of another one.
fn pair_and_other(name: &str) -> (Pair, Lines) {
    let out = tempdir().unwrap();
    let set = ["run.duration=21 ms", "plots=[]", "waveforms.drive.sawtooth.stroke=190 nm"];
    let other = run_example("quickstart", out.path(), &set);
    let text = std::fs::read_to_string(other.join(name)).unwrap();
    (Pair::quickstart(), text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect())
}

/// A trace cut from 10 001 rows to one was "no difference" at exit code 0.
#[test]
fn damaged_traces_are_found_also_with_a_forged_summary() {
    let (pair, other) = pair_and_other("trace.csv");
    let trace: [Damage<'_>; 22] = [
        ("one row", &|lines| lines.truncate(2)),
        ("no row", &|lines| lines.truncate(1)),
        ("the first half", &|lines| lines.truncate(1051)),
        ("every second row", &|lines| {
            let mut row = 0;
            lines.retain(|_| {
                row += 1;
                row == 1 || row % 2 == 0
            });
        }),
        ("without the first row", &|lines| drop(lines.remove(1))),
        ("without the last row", &|lines| drop(lines.pop())),
        ("without a row", &|lines| drop(lines.remove(1000))),
        ("a row twice", &|lines| lines.insert(1000, lines[1000].clone())),
        ("the last row twice", &|lines| lines.extend(lines.last().cloned())),
        ("all rows twice", &|lines| {
            let rows = lines[1..].to_vec();
            lines.extend(rows);
        }),
        ("two rows changed places", &|lines| lines.swap(700, 701)),
        ("backwards", &|lines| lines[1..].reverse()),
        ("a time that is none", &at(900, "NaN")),
        ("a time without end", &at(900, "inf")),
        ("a falling time", &at(900, "0.001")),
        ("a time before the start", &at(1, "-0.00001")),
        ("a time after the end", &at(2101, "0.5")),
        ("times a little late", &stretched(900, 1.0 + 1e-6)),
        ("all times half", &stretched(1, 0.5)),
        ("rows of other moments", &|lines| {
            let times: Vec<String> = lines[1..].iter().map(|line| line[0].clone()).collect();
            lines[1..].rotate_left(500);
            lines[1..].iter_mut().zip(times).for_each(|(line, time)| line[0] = time);
        }),
        ("two columns changed places", &|lines| {
            let (x, y) = (place(lines, "ball.u_m"), place(lines, "ball.d_m"));
            lines[1..].iter_mut().for_each(|line| line.swap(x, y));
        }),
        ("of another run", &|lines| lines.clone_from(&other)),
    ];
    for (what, damage) in trace {
        table_damaged(&pair, "trace.csv", what, damage);
    }
    pair.restore();
    assert_eq!(judged(&pair).0, [0, 0]);
}

#[test]
fn damaged_lists_of_events_are_found_also_with_a_forged_summary() {
    let (pair, other) = pair_and_other("events.csv");
    let events: [Damage<'_>; 9] = [
        ("no events", &|lines| lines.truncate(1)),
        ("half of the events", &|lines| lines.truncate(lines.len() / 2)),
        ("without an event", &|lines| drop(lines.remove(100))),
        ("an event twice", &|lines| lines.insert(100, lines[100].clone())),
        ("two events changed places", &|lines| lines.swap(100, 110)),
        ("an event at no time", &at(100, "NaN")),
        ("an event after the end", &at(100, "7")),
        ("an event of another kind", &|lines| "touch".clone_into(&mut lines[100][2])),
        ("events of another run", &|lines| lines.clone_from(&other)),
    ];
    for (what, damage) in events {
        table_damaged(&pair, "events.csv", what, damage);
    }
}

#[test]
fn damaged_summaries_and_scenarios_are_found() {
    let pair = Pair::quickstart();
    let changed = |pointer: &str, value: Value, expected: i32, message: &str| {
        pair.restore();
        pair.edit_summary(pointer, |_| value);
        let (codes, said) = judged(&pair);
        assert_eq!(codes, [expected; 2], "{pointer}: {said}");
        assert!(said.contains(message), "{pointer}: {message} in {said}");
    };
    changed(
        "/simulated_s",
        json!(0.01),
        2,
        "trace.csv:1003  time_s: expected a time up to the end of the run in summary.json, 0.01",
    );
    changed(
        "/simulated_s",
        json!(0.03),
        2,
        "trace.csv:2102  time_s: the last row is at 0.021, but summary.json has the end",
    );
    changed("/simulated_s", json!(-1.0), 2, "simulated_s: expected a time of 0 or more");
    changed("/simulated_s", Value::Null, 2, "simulated_s is missing");
    changed("/counts/rows", json!(1), 2, "counts.rows is 1, and trace.csv has 2101 rows");
    changed("/counts/events", json!(1), 2, "counts.events is 1, and events.csv has ");
    changed(
        "/tables/trace.csv/rows",
        json!(7),
        2,
        "trace.csv:2102  expected 7 rows by summary.json, got 2101",
    );
    changed("/tables/trace.csv/sha256", json!("00"), 2, "trace.csv: is not the table of its run");
    changed("/tables/events.csv/sha256", json!("00"), 2, "events.csv: is not the table of its run");
    changed("/tables", json!({}), 2, "summary.json: has no checksum of trace.csv");
    changed("/scenario_sha256", json!("00"), 2, "scenario.json  is not the scenario of the run");
    changed("/status", json!("stopped"), 1, "status: done in A, stopped in B");
    changed("/energy/friction_J", json!(1e-9), 1, "energy.friction_J");
    // Who loosens what may differ would make anything agree.
    changed(
        "/stepper/tolerance",
        json!(1.0),
        2,
        "scenario.json  run.stepper differs from the stepper of summary.json",
    );
    changed(
        "/stepper",
        json!({ "name": "verlet", "step_s": 1.0 }),
        2,
        "run.stepper differs from the stepper",
    );
    changed("/contacts", json!({}), 2, "its contacts differ from those of summary.json");
}

/// A beginning that passes for the whole: its end, its counts and its hashes are those of the beginning.
#[test]
fn a_beginning_does_not_pass_for_the_whole() {
    for (name, set) in [("quickstart", "run.duration=21 ms"), ("p1", "run.cycles=3")] {
        let pair = Pair::new(name, &[set]);
        for (key, value, expected, message) in [
            ("status", json!("done"), 2, "b/scenario.json  the run ends at 0.0"),
            ("steady_after_periods", json!(1), 2, "has no run.until_steady"),
            ("cut", json!(true), 2, "cut: only a stopped run"),
            // A run that was interrupted there is one like any other, and said to be.
            ("status", json!("interrupted"), 0, "B: the run was interrupted at t = 0.001 s"),
        ] {
            pair.restore();
            for table in ["trace.csv", "events.csv"] {
                pair.edit(table, |lines| {
                    lines.retain(|line| {
                        line[0].parse::<f64>().is_ok_and(|t| t <= 1e-3) || line[0] == "time_s"
                    });
                });
            }
            pair.edit_summary("/simulated_s", |_| json!(1e-3));
            pair.edit_root(key, value);
            let (codes, said) = judged(&pair);
            assert!(codes == [expected; 2] && said.contains(message), "{name} {key}: {codes:?} {said}");
            assert!(
                expected != 0
                    || (said.contains("% of A's time") && said.contains("the end of the shorter run")),
                "{said}"
            );
        }
    }
}

/// Scales of the scene say what is at rest.
#[test]
fn scales_that_somebody_made_large_hide_nothing() {
    let pair = Pair::quickstart();
    pair.edit("trace.csv", |lines| {
        let k = place(lines, "slider.x_m");
        lines[1800][k] = format!("{:?}", lines[1800][k].parse::<f64>().unwrap() * 1.01);
    });
    pair.edit_summary(
        "/contacts/ball/scales",
        |_| json!({ "displacement_m": 1e9, "force_N": 1e9, "velocity_m_s": 1e9 }),
    );
    assert_eq!(judged(&pair).0, [1, 1]);
}

#[test]
fn a_scenario_of_another_run_is_found_also_with_its_hash_forged() {
    let pair = Pair::quickstart();
    for (from, to, message) in [
        (
            "\"duration\": 0.021",
            "\"duration\": 0.02",
            "the run ends at 0.02 s, but summary.json has the end at 0.021 s",
        ),
        (
            "\"every\": 0.00001",
            "\"every\": 0.00002",
            "trace.csv:3  time_s: expected a row at 2e-5 by output.every",
        ),
        ("\"ball\": {", "\"bell\": {", "its contacts differ from those of summary.json"),
    ] {
        pair.restore();
        let text = std::fs::read_to_string(pair.a.join("scenario.json")).unwrap();
        assert!(text.contains(from), "{from} in {text}");
        std::fs::write(pair.b.join("scenario.json"), text.replacen(from, to, 1)).unwrap();
        assert!(judged(&pair).1.contains("scenario.json  is not the scenario of the run"));
        let forged = sha256(&std::fs::read(pair.b.join("scenario.json")).unwrap());
        pair.edit_summary("/scenario_sha256", |_| json!(forged));
        let (codes, said) = judged(&pair);
        assert!(codes == [2, 2] && said.contains(message), "{message}: {said}");
    }
    pair.restore();
    std::fs::remove_file(pair.b.join("scenario.json")).unwrap();
    assert!(judged(&pair).1.contains("b/scenario.json: cannot be read: No such file"));
}

#[test]
fn an_excerpt_is_compared_with_and_not_judged() {
    let pair = Pair::quickstart();
    pair.rewrite("trace.csv", |lines| {
        let mut row = 0;
        lines.retain(|_| {
            row += 1;
            row < 3 || row % 50 == 0 || row == 2102
        });
    });
    pair.rewrite("events.csv", |lines| lines.iter_mut().for_each(|line| line.truncate(3)));
    reseal(&pair.b);
    pair.edit_root("excerpt", json!(true));
    let excerpt = |a: &Path, b: &Path| stickslip().arg("compare").args([a, b]).output().unwrap();
    let same = excerpt(&pair.b, &pair.a);
    assert_eq!(code(&same), 0, "{}{}", stdout(&same), stderr(&same));
    assert!(stdout(&same).contains("A: an excerpt with 44 of 2101 rows"), "{}", stdout(&same));
    let judged = excerpt(&pair.a, &pair.b);
    assert_eq!(code(&judged), 2);
    assert!(
        stderr(&judged).contains("b: is an excerpt of a run; give it as the reference A"),
        "{}",
        stderr(&judged)
    );
    // Every row of an excerpt must be met.
    let out = tempdir().unwrap();
    let set = ["run.duration=21 ms", "plots=[]", "output.every=30 us"];
    let coarse = run_example("quickstart", out.path(), &set);
    let missed = excerpt(&pair.b, &coarse);
    assert_eq!(code(&missed), 1);
    assert!(stdout(&missed).contains("of A are missing in B"), "{}", stdout(&missed));
}

/// The last half of a run was "no difference", without a word on how much was compared.
#[test]
fn how_much_was_compared_is_said() {
    let out = tempdir().unwrap();
    let run =
        |name: &str, set: &[&str]| run_example("p1", &out.path().join(name), &[&["plots=[]"], set].concat());
    let (fine, coarse) =
        (run("fine", &["run.cycles=2"]), run("coarse", &["run.cycles=2", "output.every=4 us"]));
    let short = run("short", &["run.cycles=1", "output.every=4 us"]);
    let said = |a: &Path, b: &Path| {
        let output = stickslip().arg("compare").args([a, b, Path::new("--json")]).output().unwrap();
        let found: Value = serde_json::from_str(&stdout(&output)).unwrap();
        let text = stdout(&stickslip().arg("compare").args([a, b]).output().unwrap());
        (code(&output), found["coverage"].clone(), text.lines().nth(3).unwrap().trim().to_owned())
    };
    let (code, coverage, text) = said(&fine, &coarse);
    assert_eq!((code, coverage["time"].as_f64()), (0, Some(1.0)));
    assert_eq!(coverage["rows"].as_f64(), Some(501.0 / 1001.0));
    assert!(text.starts_with("compared: all of A's time, ") && text.ends_with(" % of its rows"), "{text}");
    assert_eq!(said(&coarse, &fine).2, "compared: all of A's time, all of its rows");
    let (code, coverage, text) = said(&coarse, &short);
    assert!(code == 0 && (coverage["time"].as_f64().unwrap() - 0.5).abs() < 0.01, "{coverage}");
    assert!(text.contains("% of A's time"), "{text}");
}

#[test]
fn what_a_summary_says_of_its_tables_is_what_sha256sum_says() {
    let out = tempdir().unwrap();
    let set = ["run.duration=30 ms", "plots=[\"state\", \"memory\"]"];
    let folder = run_example("quickstart", out.path(), &set);
    let found = summary(&folder);
    let tables = found["tables"].as_object().unwrap();
    let names: Vec<&String> = tables.keys().collect();
    assert_eq!(names, ["trace.csv", "events.csv", "springs.csv", "memory.csv", "steps.csv"]);
    for (name, seal) in tables {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        assert_eq!(seal["sha256"], sha256(&bytes), "{name}");
        assert_eq!(seal["rows"], bytes.iter().filter(|byte| **byte == b'\n').count() - 1, "{name}");
    }
    assert_eq!(found["scenario_sha256"], sha256(&std::fs::read(folder.join("scenario.json")).unwrap()));
    // Tables that are not compared are held against their seals as well, and by those who draw them.
    for name in ["springs.csv", "memory.csv"] {
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        std::fs::write(folder.join(name), text.replacen(",0.0,", ",0.00,", 1)).unwrap();
        let refused =
            format!("{name}: is not the table of its run: its SHA-256 differs from that in summary.json");
        for arguments in [["compare", "--tolerance=0"], ["plot", "--plots=state,memory"]] {
            let folders = if arguments[0] == "compare" { vec![&folder, &folder] } else { vec![&folder] };
            let output = stickslip().args(arguments).args(folders).output().unwrap();
            assert!(code(&output) == 2 && stderr(&output).contains(&refused), "{}", stderr(&output));
        }
        std::fs::write(folder.join(name), text).unwrap();
    }
    assert!(!listing(&folder).iter().any(|name| name.starts_with('.')));
}
