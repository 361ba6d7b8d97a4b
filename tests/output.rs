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
        // Pictures carry the limit that was changed: theirs are those of the tables, which are the same.
        assert_readable(&other);
        for name in ["trace.csv", "events.csv", "steps.csv"] {
            let [one, two] = [&folder, &other].map(|folder| std::fs::read(folder.join(name)).unwrap());
            assert!(one == two, "{option}: {name}");
        }
        assert_eq!(summary(&folder)["counts"], summary(&other)["counts"], "{option}");
    }
}

/// A million periods make a table of 105 MB.
#[test]
fn steps_that_are_not_written_are_counted_all_the_same() {
    let out = tempdir().unwrap();
    let folders = ["all", "off"].map(|steps| {
        let steps_of_all = format!("output.steps={steps}");
        run_example("p1", &out.path().join(steps), &["run.cycles=40", &steps_of_all])
    });
    let has_table = folders.each_ref().map(|folder| folder.join("steps.csv").exists());
    assert_eq!(has_table, [true, false]);
    let [all, off] = folders.each_ref().map(|folder| summary(folder));
    assert!(all["steps"]["periods"] == 40 && all["steps"] == off["steps"], "{}", off["steps"]);
    assert_eq!(off["tables"].get("steps.csv"), None);
    assert_readable(&folders[1]);
    let compared = stickslip().arg("compare").args(&folders).output().unwrap();
    assert_eq!(code(&compared), 0, "{}", stderr(&compared));
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
    // Pictures of them say until when they go.
    let plots = ["plot", "--plots", "loop,events", "--format", "svg"];
    for (folder, is_cut) in [(&folder, true), (&whole, false)] {
        assert_eq!(code(&stickslip().args(plots).arg(folder).output().unwrap()), 0);
        for name in ["loop.svg", "events.svg"] {
            let picture = std::fs::read_to_string(folder.join(name)).unwrap();
            assert_eq!(picture.contains("(events are thinned)"), is_cut, "{name}");
        }
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

/// The cycles before and after the stop are one table.
#[test]
fn cycles_go_on_to_the_byte() {
    let (whole, part) = (tempdir().unwrap(), tempdir().unwrap());
    let set = ["run.duration=40 s", "output.every=1 s", "plots=[]"];
    let folder = run_example("fretting_sphere", whole.path(), &set);
    let stopped = [&set[..], &["run.limits.steps=300"]].concat();
    let output = keeping("fretting_sphere", part.path(), SELDOM, &stopped).output().unwrap();
    assert_eq!(code(&output), 3, "{}", stderr(&output));
    let other = part.path().join("fretting_sphere");
    let before = Table::read(&other.join("cycles.csv")).rows.len();
    resumed(&other, &["--set", "run.limits.steps=1000000"]);
    let after = Table::read(&other.join("cycles.csv")).rows.len();
    assert!(0 < before && before < after, "{before} of {after}");
    for name in ["trace.csv", "events.csv", "cycles.csv"] {
        let [one, two] = [&folder, &other].map(|folder| std::fs::read(folder.join(name)).unwrap());
        assert!(one == two, "{name}");
    }
}

/// What two runs both write of their events is compared, in whatever words it was asked for.
#[test]
fn events_are_compared_where_both_runs_write_them() {
    let out = tempdir().unwrap();
    let plain = ["run.cycles=20", "output.every=20 us", "plots=[]"];
    let run =
        |name: &str, more: &[&str]| run_example("p1", &out.path().join(name), &[&plain[..], more].concat());
    let whole = run("whole", &[]);
    let all = run("all", &["output.events=all"]);
    let many = run("many", &[r#"output.events={"most": 200000}"#]);
    let few = run("few", &[r#"output.events={"kinds": ["gross slip"]}"#]);
    let last = run("last", &["output.last=5"]);
    let longer = run("longer", &["output.last=5", "run.cycles=23"]);
    let compare = |a: &Path, b: &Path| {
        let output = stickslip().arg("compare").arg("--json").args([a, b]).output().unwrap();
        let found: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
        let [missing, extra, moved] =
            ["missing", "extra", "moved"].map(|key| found["events"][key].as_array().unwrap().len());
        assert_eq!([missing, extra, moved], [0; 3], "{found}");
        (number(&found, "/events/a"), found["notes"].to_string())
    };
    let count = number(&summary(&whole), "/counts/events");
    for other in [&all, &many] {
        assert_eq!(compare(&whole, other).0, count);
    }
    let (none, notes) = compare(&whole, &few);
    assert!(none == 0.0 && notes.contains("not compared"), "{notes}");
    // Five periods of twenty, and two that both have.
    for (a, b, share) in [(&whole, &last, 5.0 / 20.0), (&last, &longer, 2.0 / 20.0)] {
        let (some, notes) = compare(a, b);
        assert!((some - share * count).abs() < 0.05 * count, "{some} of {count}");
        assert!(notes.contains("which both windows contain"), "{notes}");
    }
}

/// Rows outside of a window once warned of open books, and nothing did in their place.
#[test]
fn open_books_are_warned_of_whatever_the_window() {
    let out = tempdir().unwrap();
    let stepper = r#"run.stepper={"verlet": {"step": "20 us"}}"#;
    let set = [stepper, "output.every=20 us", "plots=[]"];
    let warned = |name: &str, more: &[&str]| {
        let folder = run_example("p1", &out.path().join(name), &[&set[..], more].concat());
        summary(&folder)["warnings"].to_string().contains("energy_balance")
    };
    assert!(warned("whole", &[]));
    assert!(warned("window", &[r#"output.window={"to": "40 us"}"#, "output.events=off"]));
}

/// Of a row of springs gross slip is told that no event located: results say how many events there are, and are equal to themselves.
#[test]
fn events_of_rows_are_counted_as_written() {
    let out = tempdir().unwrap();
    let set = [r#"contacts.ball.engine={"springs": {"count": 64}}"#, "output.events=\"all\"", "plots=[]"];
    let folder = run_example("quickstart", out.path(), &set);
    let found = summary(&folder);
    let rows = Table::read(&folder.join("events.csv")).rows.len() as f64;
    assert_eq!(number(&found, "/counts/events_written"), rows);
    assert!(rows > number(&found, "/counts/events"));
    let output = stickslip().arg("compare").args([&folder, &folder]).output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
}

/// A file without `output`, `plots` and `figures` is shown all the same: rows, pictures, and what it would take to report steps.
#[test]
fn a_file_that_asks_for_nothing_shows_something() {
    let root = tempdir().unwrap();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/cases/two_sliders.json");
    let output = run(&file, root.path(), &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let note = "no step reported: name a body in figures, one of \"light\", \"heavy\"";
    assert!(stdout(&output).contains(note), "{}", stdout(&output));
    let folder = root.path().join("two_sliders");
    let rows = Table::read(&folder.join("trace.csv")).column("time_s").len();
    assert!((100..=20_001).contains(&rows), "{rows}");
    for picture in ["loop.png", "trajectory.png"] {
        assert!(folder.join(picture).is_file(), "{picture}");
    }
    // What is written out in full runs to the same bits.
    let again = run(&folder.join("scenario.json"), &root.path().join("again"), &[]);
    assert_eq!(code(&again), 0, "{}", stderr(&again));
    let traces = [folder.join("trace.csv"), root.path().join("again/scenario/trace.csv")];
    let [first, second] = traces.map(|path| std::fs::read(path).unwrap());
    assert!(first == second);
    // Nothing is what was asked for where the keys say so.
    let output = run(&file, &root.path().join("bare"), &["output={}", "plots=[]", "figures.body=light"]);
    assert!(!stdout(&output).contains("no step reported"), "{}", stdout(&output));
    let bare = root.path().join("bare/two_sliders");
    assert_eq!(Table::read(&bare.join("trace.csv")).column("time_s").len(), 2);
    assert!(!bare.join("loop.png").exists());
    let again = run(&bare.join("scenario.json"), &root.path().join("barer"), &[]);
    assert_eq!(code(&again), 0, "{}", stderr(&again));
    assert_eq!(Table::read(&root.path().join("barer/scenario/trace.csv")).column("time_s").len(), 2);
}

/// From a third of a period to 400 the default rows are between a hundred and twenty thousand.
#[test]
fn default_rows_are_neither_few_nor_too_many() {
    let root = tempdir().unwrap();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/cases/two_sliders.json");
    for cycles in ["0.3", "1", "7", "60", "400"] {
        let output = run(&file, root.path(), &[&format!("run.cycles={cycles}"), "plots=[]"]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let rows = Table::read(&root.path().join("two_sliders/trace.csv")).column("time_s").len();
        assert!((100..=20_001).contains(&rows), "{cycles}: {rows}");
    }
}
