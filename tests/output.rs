//! What is written of rows and events: which, when and how.

use crate::checkpoint::{SELDOM, assert_same, keeping, resume, resumed};
use crate::program::{Table, code, number, run, run_example, scenario, stderr, stdout, stickslip, summary};
use std::path::Path;
use tempfile::tempdir;

/// Ways to ask for output.
const OPTIONS: [&str; 8] = [
    "output.events=off",
    "output.events=all",
    r#"output.events={"most": 100}"#,
    r#"output.events={"kinds": ["gross slip", "gross slip ends"], "contacts": ["ball"]}"#,
    r#"output.window={"from": "11 ms", "to": "26 ms"}"#,
    "output.last=3",
    "output.float=6",
    "output.states=numbers",
];

/// Pictures drawn again from the tables of a run are those of the run, and it reproduces itself.
fn assert_readable(folder: &Path) {
    let again = tempdir().unwrap();
    let output = stickslip().arg("plot").arg(folder).arg("--out").arg(again.path()).output().unwrap();
    assert_eq!((code(&output), stderr(&output)), (0, String::new()), "{}", folder.display());
    for picture in ["loop.png", "trajectory.png", "events.png"] {
        let drawn = std::fs::read(again.path().join(folder.file_name().unwrap()).join(picture)).unwrap();
        assert!(drawn == std::fs::read(folder.join(picture)).unwrap(), "{}: {picture}", folder.display());
    }
    let repro = stickslip().arg("repro").arg(folder.join("loop.png")).output().unwrap();
    assert_eq!((code(&repro), stdout(&repro).contains(": identical: ")), (0, true), "{}", stderr(&repro));
    let compared = stickslip().arg("compare").args([folder, folder]).output().unwrap();
    assert_eq!(code(&compared), 0, "{}", stderr(&compared));
}

#[test]
fn whatever_is_asked_for_reads_back_and_goes_on_to_the_byte() {
    for option in OPTIONS {
        let (whole, part) = (tempdir().unwrap(), tempdir().unwrap());
        let set = ["run.cycles=40", "output.every=20 us", option];
        let folder = run_example("p1", whole.path(), &set);
        assert_readable(&folder);
        // About half of it.
        let stopped = [&set[..], &["run.limits.steps=150"]].concat();
        let output = keeping("p1", part.path(), SELDOM, &stopped).output().unwrap();
        assert_eq!(code(&output), 3, "{option}: {}", stderr(&output));
        let other = part.path().join("p1");
        resumed(&other, &["--set", "run.limits.steps=1000000"]);
        for name in ["trace.csv", "events.csv", "steps.csv", "loop.png", "events.png"] {
            let [one, two] = [&folder, &other].map(|folder| std::fs::read(folder.join(name)).unwrap());
            // Pictures carry the limit that was changed.
            assert!(one == two || name.ends_with(".png"), "{option}: {name}");
        }
        assert_eq!(summary(&folder)["counts"], summary(&other)["counts"], "{option}");
    }
}

#[test]
fn events_without_end_are_thinned_and_it_is_said() {
    let out = tempdir().unwrap();
    let most = r#"output.events={"most": 100}"#;
    let output = run(&scenario("p1"), out.path(), &["run.cycles=200", "output.every=100 us", most]);
    let folder = out.path().join("p1");
    let found = summary(&folder);
    let note = found["notes"][0].as_str().unwrap();
    assert!(note.starts_with("events.csv has ") && stdout(&output).contains(note), "{note}");
    let (written, all) = (number(&found, "/counts/events_written"), number(&found, "/counts/events"));
    assert_eq!(written, Table::read(&folder.join("events.csv")).rows.len() as f64);
    assert!(written < 400.0 && all > 1500.0, "{written} of {all}");
    // Until then none is missing.
    let until = number(&found, "/counts/events_whole_until_s");
    let times = |folder: &Path| {
        let events = Table::read(&folder.join("events.csv"));
        let times: Vec<String> = events.column("time_s").iter().map(|cell| (*cell).to_owned()).collect();
        times.into_iter().filter(|time| time.parse::<f64>().unwrap() <= until).collect::<Vec<_>>()
    };
    let other = tempdir().unwrap();
    let whole = run_example("p1", other.path(), &["run.cycles=200", "output.every=100 us", "plots=[]"]);
    // A hundred, and the block of one that comes next.
    assert_eq!((times(&folder).len(), times(&folder)), (101, times(&whole)));
    // Figures are taken from all of them.
    for key in ["steps", "contacts", "energy"] {
        assert_eq!(found[key], summary(&whole)[key], "{key}");
    }
}

#[test]
fn a_window_has_the_rows_and_events_of_the_whole() {
    let (some, all) = (tempdir().unwrap(), tempdir().unwrap());
    let whole = run_example("p1", all.path(), &["plots=[]"]);
    for (option, from, to) in [
        (r#"output.window={"from": "5 ms", "to": "6 ms"}"#, 5e-3, 6e-3),
        (r#"output.window={"to": "1 ms"}"#, 0.0, 1e-3),
        ("output.last=2", 18e-3, 20e-3),
    ] {
        let part = run_example("p1", some.path(), &["plots=[]", option]);
        let rows = |folder: &Path, name: &str| {
            let table = Table::read(&folder.join(name));
            let inside = |time: &str| (from - 1e-12..=to + 1e-12).contains(&time.parse::<f64>().unwrap());
            table.rows.into_iter().filter(|row| inside(&row[0])).collect::<Vec<_>>()
        };
        let near = |a: &str, b: &str| (a.parse::<f64>().unwrap() - b.parse::<f64>().unwrap()).abs() < 1e-12;
        for name in ["trace.csv", "events.csv"] {
            let (found, wanted) = (rows(&part, name), rows(&whole, name));
            assert_eq!(found.len(), wanted.len(), "{option} {name}");
            assert!(found.iter().zip(&wanted).all(|(a, b)| near(&a[0], &b[0])), "{option} {name}");
            // Besides these, the first and the last row of the run.
            let more = Table::read(&part.join(name)).rows.len() - found.len();
            assert!(more <= if name == "trace.csv" { 2 } else { 0 }, "{option} {name}: {more}");
        }
        assert_eq!(summary(&part)["steps"], summary(&whole)["steps"]);
    }
}

/// The same bits, whatever stands for them; and fewer of them where that is asked for.
#[test]
fn states_and_digits_are_read_as_they_were_written() {
    let out = tempdir().unwrap();
    let set = ["run.cycles=3", "plots=[]"];
    let words = run_example("p1", &out.path().join("words"), &set);
    let numbers = run_example("p1", &out.path().join("numbers"), &[set[0], set[1], "output.states=numbers"]);
    let states = Table::read(&numbers.join("trace.csv"));
    assert!(states.column("ball.state").iter().all(|cell| ["0", "1", "2", "3"].contains(cell)));
    assert_eq!(summary(&numbers)["states"]["3"], "slip");
    let compared = stickslip().arg("compare").args([&words, &numbers]).output().unwrap();
    assert_eq!(code(&compared), 0, "{}", stdout(&compared));
    let rounded = run_example("p1", &out.path().join("rounded"), &[set[0], set[1], "output.float=4"]);
    let (few, all) = (Table::read(&rounded.join("trace.csv")), Table::read(&words.join("trace.csv")));
    assert_eq!(few.column("time_s"), all.column("time_s"));
    for (few, all) in few.column("slider.x_m").iter().zip(all.column("slider.x_m")) {
        let (few, all): (f64, f64) = (few.parse().unwrap(), all.parse().unwrap());
        assert!(
            (few - all).abs() <= 0.5e-3 * all.abs() && few == format!("{all:.3e}").parse::<f64>().unwrap()
        );
    }
}

#[test]
fn last_periods_go_by_the_end_that_was_known() {
    let out = tempdir().unwrap();
    let output = keeping("p1", out.path(), SELDOM, &["output.last=2", "plots=[]"]).output().unwrap();
    assert_eq!(code(&output), 0);
    let folder = out.path().join("p1");
    let refused = resume(&folder, &["--set", "run.cycles=30"]);
    assert!(code(&refused) == 2 && stderr(&refused).contains("output.last"), "{}", stderr(&refused));
    // Within a window nothing changes.
    let [long, short] = ["long", "short"].map(|name| out.path().join(name));
    let window = r#"output.window={"from": "15 ms"}"#;
    let whole = run_example("p1", &long, &["run.cycles=30", window, "plots=[]"]);
    let output = keeping("p1", &short, SELDOM, &[window, "plots=[]"]).output().unwrap();
    assert_eq!(code(&output), 0);
    resumed(&short.join("p1"), &["--set", "run.cycles=30"]);
    assert_same(&whole, &short.join("p1"), "window");
}
