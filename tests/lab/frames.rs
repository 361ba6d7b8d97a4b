//! `stickslip-lab bench --realtime`: frames of drives, how long they take and what they lose.

use crate::program::{Table, code, lab, listing, scenario, stderr, stdout};
use std::path::{Path, PathBuf};
use tempfile::tempdir;

/// P1 on three unlike contacts, fed from outside.
fn fed() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/realtime/contacts_3.json")
}

/// Numbers of a column.
fn numbers(table: &Table, name: &str) -> Vec<f64> {
    table.column(name).iter().map(|text| text.parse().unwrap_or(f64::NAN)).collect()
}

/// Measures both scenes quickly into a folder.
fn measure(out: &Path) {
    let mut command = lab();
    command.args(["bench", "--realtime"]).arg(scenario("p1")).arg(fed());
    command.args(["--period", "20 us,50 us", "--frames", "3e3", "--paced", "10 ms"]);
    command.arg("--page").arg(out.join("page.md")).arg("--out").arg(out.join("made"));
    let output = command.output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stdout(&output).contains("frames.csv"), "{}", stdout(&output));
}

/// Frames are counted, their work is the same whenever they are computed, and their errors are small. Times are as they come.
#[test]
fn frames_are_measured_by_both_steppers_at_every_period() {
    let (out, again) = (tempdir().unwrap(), tempdir().unwrap());
    measure(out.path());
    measure(again.path());
    let files =
        ["accuracy.csv", "frames-dark.png", "frames.csv", "frames.png", "frames.svg", "histograms.csv"];
    assert_eq!(listing(&out.path().join("made")), [&files[..], &["worst_frames.csv"]].concat());
    let table = Table::read(&out.path().join("made/frames.csv"));
    // Two scenes, two periods, two steppers; and the empty loop at each period.
    assert_eq!(table.rows.len(), 10);
    assert_eq!(table.column("stepper")[..4], ["frames", "event", "frames", "event"]);
    assert!(numbers(&table, "frames").iter().all(|frames| *frames == 3e3));
    assert_eq!(numbers(&table, "paced_frames")[..4], [500.0, 500.0, 200.0, 200.0]);
    let [median, most, worst] =
        ["median", "p99_99", "worst"].map(|name| numbers(&table, &format!("execution_{name}_us")));
    assert!((0..10).all(|k| median[k] <= most[k] && most[k] <= worst[k]), "{median:?} {most:?} {worst:?}");
    let (frames, event) = ([0, 2, 4, 6], [1, 3, 5, 7]);
    let strokes = numbers(&table, "error_strokes");
    assert!(frames.iter().all(|k| strokes[*k] > 0.0 && strokes[*k] < 1e-3), "{strokes:?}");
    assert!(event.iter().all(|k| strokes[*k] < 1e-8), "{strokes:?}");
    let other = Table::read(&again.path().join("made/frames.csv"));
    let counted =
        ["median_work_steps", "worst_work_evaluations", "worst_work_knots", "worst_work_frame", "error_u_c"];
    for name in counted {
        assert_eq!(table.column(name), other.column(name), "{name}");
    }
    let steps = numbers(&table, "worst_work_steps");
    // What bounds a frame: eight times its own steps, and one for each corner.
    let own = numbers(&table, "steps_per_frame");
    assert!(frames.iter().all(|k| steps[*k] >= own[*k] && steps[*k] <= 8.0 * own[*k] + 2.0), "{steps:?}");
    let worst = Table::read(&out.path().join("made/worst_frames.csv"));
    let kinds = ["merge", "event", "turning point or growth", "corner or cut step", "plain"];
    assert!(worst.column("kind").iter().all(|kind| kinds.contains(kind)));
    // Twenty of each of eight loops by execution time, and twenty of each paced one by latency.
    assert_eq!(worst.rows.len(), 2 * 20 * 8);
    assert_histograms(&Table::read(&out.path().join("made/histograms.csv")));
    assert_accuracy(&Table::read(&out.path().join("made/accuracy.csv")));
    assert_page(&std::fs::read_to_string(out.path().join("page.md")).unwrap(), out.path());
}

/// Every frame stands in one bin.
fn assert_histograms(table: &Table) {
    let counts = numbers(table, "frames");
    for (scene, stepper, what, total) in [
        ("p1", "event", "execution", 3e3),
        ("p1", "frames", "paced_latency", 500.0),
        ("contacts_3", "frames", "execution", 3e3),
        ("", "empty", "paced_execution", 500.0),
    ] {
        let own = |row: &Vec<String>| row[..4] == [scene, "2e-5", stepper, what];
        let sum: f64 = table.rows.iter().zip(&counts).filter(|(row, _)| own(row)).map(|(_, n)| n).sum();
        assert_eq!(sum, total, "{scene} {stepper} {what}");
    }
}

/// Shorter frames lose less, as stated.
fn assert_accuracy(table: &Table) {
    assert_eq!(table.rows.len(), 20);
    let (off, orders) = (numbers(table, "frames_error_strokes"), numbers(table, "frames_order"));
    for scene in [0, 10] {
        // 1 us and 20 us.
        assert!(off[scene] < 0.05 * off[scene + 4] && off[scene + 4] < 1e-3, "{off:?}");
        assert!(orders[scene] > 1.5 && orders[scene] < 5.0, "{orders:?}");
    }
    assert!(numbers(table, "event_error_strokes").iter().all(|off| *off < 1e-8));
}

/// The page names its command, and its links lead somewhere.
fn assert_page(page: &str, folder: &Path) {
    assert!(page.contains("--period \"20 us,50 us\" --frames 3000 --paced \"0.01 s\""), "{page}");
    let links = page.split("](").skip(1).map(|rest| rest.split_once(')').unwrap().0);
    let sources = page.split("src=\"").skip(1).map(|rest| rest.split_once('"').unwrap().0);
    let places: Vec<&str> = links.chain(sources).collect();
    // Four tables, an SVG, a picture.
    assert_eq!(places.len(), 6);
    assert!(places.iter().all(|place| folder.join(place).exists()), "{places:?}");
    assert_eq!(page.lines().filter(|line| line.starts_with("| `contacts_3` |")).count(), 4 + 4 + 2);
}

#[test]
fn without_a_clock_nothing_is_told_of_waking() {
    let out = tempdir().unwrap();
    let mut command = lab();
    command.args(["bench", "--realtime"]).arg(scenario("commanded"));
    command.args(["--frames", "500", "--paced", "0", "--quiet", "--out"]).arg(out.path());
    let output = command.output().unwrap();
    assert_eq!((code(&output), stdout(&output), stderr(&output)), (0, String::new(), String::new()));
    let table = Table::read(&out.path().join("frames.csv"));
    assert_eq!(table.rows.len(), 3);
    for name in ["paced_frames", "overruns", "paced_latency_worst_us"] {
        assert!(table.column(name).iter().all(|text| text.is_empty()), "{name}");
    }
}

#[test]
fn what_frames_cannot_be_measured_of_is_refused() {
    let out = tempdir().unwrap();
    let bench = |file: &Path, more: &[&str]| {
        let mut command = lab();
        command.args(["bench", "--realtime"]).arg(file).args(more).arg("--out").arg(out.path().join("out"));
        let output = command.output().unwrap();
        (code(&output), stderr(&output))
    };
    for (more, words) in [
        (["--period", "0 s"], "expected a time above 0"),
        (["--period", "20 us,-1 us"], "expected a time above 0"),
        (["--period", "20"], "--period"),
        (["--frames", "0"], "expected a whole number from 1 to 1e12"),
        (["--frames", "1.5"], "expected a whole number from 1 to 1e12"),
        (["--frames", "many"], "expected a number, got \"many\""),
        (["--paced", "-1 s"], "expected a time, 0 or above"),
        (["--budget", "1 s"], "--budget"),
    ] {
        let (code, said) = bench(&scenario("p1"), &more);
        assert!(code == 2 && said.contains(words), "{more:?}: {code} {said}");
    }
    let (code, said) = bench(Path::new("nowhere.json"), &[]);
    assert!(code == 2 && said.contains("nowhere.json"), "{code} {said}");
    let (code, said) = bench(&scenario("fretting_sphere"), &[]);
    assert!(code == 2 && said.contains("fretting_sphere: no coordinate is free"), "{code} {said}");
    assert!(!out.path().join("out").exists());
}
