//! Results that somebody else has sent: nothing in them hangs the program, fills the memory or commands the terminal.

use crate::compare::{Pair, place};
use crate::program::{code, listing, reseal, run_example, scenario, stderr, stdout, stickslip};
use serde_json::json;
use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::tempdir;

/// What a call says that must come to its end in seconds.
fn answer(arguments: &[&Path]) -> Output {
    let mut child =
        stickslip().args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let begun = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if begun.elapsed() > Duration::from_secs(20) {
            child.kill().unwrap();
            panic!("{arguments:?} hangs");
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    child.wait_with_output().unwrap()
}

/// `plot` hung on a pipe, and a link to an endless device took all memory.
#[cfg(unix)]
#[test]
fn pipes_and_devices_are_refused() {
    let out = tempdir().unwrap();
    let good = run_example(
        "p1",
        &out.path().join("good"),
        &["run.cycles=1", "plots=[\"loop\", \"state\"]", "output.memory={}"],
    );
    let bad = out.path().join("bad");
    for name in ["trace.csv", "events.csv", "summary.json", "scenario.json", "springs.csv", "memory.csv"] {
        for device in ["pipe", "/dev/zero", "folder"] {
            let _ = fs::remove_dir_all(&bad);
            fs::create_dir(&bad).unwrap();
            for file in listing(&good) {
                fs::copy(good.join(&file), bad.join(&file)).unwrap();
            }
            fs::remove_file(bad.join(name)).unwrap();
            match device {
                "pipe" => assert!(
                    std::process::Command::new("mkfifo").arg(bad.join(name)).status().unwrap().success()
                ),
                "folder" => fs::create_dir(bad.join(name)).unwrap(),
                _ => std::os::unix::fs::symlink(device, bad.join(name)).unwrap(),
            }
            for arguments in
                [&["plot".as_ref(), bad.as_path()][..], &["compare".as_ref(), good.as_path(), bad.as_path()]]
            {
                let output = answer(arguments);
                let said = stderr(&output);
                assert_eq!(code(&output), 2, "{name} {device}: {said}");
                assert!(said.contains(name) && said.len() < 1000, "{name} {device}: {said}");
            }
        }
    }
}

/// A word of 50 MB once took 100 s.
#[test]
fn words_and_numbers_without_end_are_refused_at_once() {
    let pair = Pair::new("p1", &["run.cycles=1"]);
    let refused = |name: &str, text: &str, message: &str| {
        pair.restore();
        fs::write(pair.b.join(name), text).unwrap();
        if name != "summary.json" {
            reseal(&pair.b);
        }
        for arguments in [
            &["plot".as_ref(), pair.b.as_path()][..],
            &["compare".as_ref(), pair.a.as_path(), pair.b.as_path()],
        ] {
            let begun = Instant::now();
            let output = answer(arguments);
            assert!(
                code(&output) == 2 && stderr(&output).contains(message),
                "{message}: {:.300}",
                stderr(&output)
            );
            assert!(begun.elapsed() < Duration::from_secs(5), "{message}: {:?}", begun.elapsed());
        }
    };
    let events = fs::read_to_string(pair.a.join("events.csv")).unwrap();
    let long = "x".repeat(10_000_000);
    refused(
        "events.csv",
        &events.replacen("drive", &long, 1),
        "a cell has 10000000 bytes, expected at most 1024",
    );
    refused(
        "events.csv",
        &events.replacen("drive", &long.repeat(2), 1),
        "the line has more than 16777216 bytes",
    );
    refused("trace.csv", &"a,".repeat(300_000), "expected at most 200000 cells, got 300001");
    refused("summary.json", &"[".repeat(100_000), "recursion limit");
    refused(
        "summary.json",
        &format!("[{}0]", "0,".repeat(3_000_000)),
        "the file has more than 2500000 values",
    );
    refused("summary.json", &format!("\"{}\"", long.repeat(7)), "the file has more than 67108864 bytes");
    refused(
        "summary.json",
        &format!("{{\"status\": \"{long}\"}}"),
        "has a name or word of 10000000 bytes, expected at most 1024",
    );
    // Names within names, of very many values.
    let name = "x".repeat(1000);
    let deep =
        format!("{}[{}0]{}", format!("{{\"{name}\":").repeat(100), "0,".repeat(100_000), "}".repeat(100));
    refused("summary.json", &deep, "the full names of its results have more than 134217728 bytes");
}

/// What was printed, in which there is nothing that a terminal would obey.
fn clean(output: &Output) -> String {
    let said = stdout(output) + &stderr(output);
    let obeyed = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
    assert!(!said.contains(obeyed), "{said:?}");
    said
}

/// Colours, titles and whatever else a terminal obeys.
#[test]
fn nothing_that_a_terminal_obeys_is_printed() {
    let pair = Pair::new("p1", &["run.cycles=1", "plots=[\"loop\"]"]);
    let (escape, bell) = ("\u{1b}]0;owned\u{7}\u{1b}[2J", "\u{9b}2J\u{202e}");
    let calls: [&[&Path]; 3] = [
        &["plot".as_ref(), &pair.b],
        &["compare".as_ref(), &pair.a, &pair.b],
        &["compare".as_ref(), &pair.a, &pair.b, "--json".as_ref()],
    ];
    // In summaries.
    for evil in [escape, bell] {
        for pointer in ["/program/version", "/program/name", "/status", "/stepper/name"] {
            pair.restore();
            pair.edit_summary(pointer, |_| json!(evil));
            for call in calls {
                let output = answer(call);
                assert_eq!(code(&output), 2);
                assert!(clean(&output).contains("summary.json: has control characters in names or words"));
            }
        }
    }
    // In tables: names, words, what should be numbers.
    for evil in [escape, bell] {
        for (table, from) in [("trace.csv", "slider.x_m"), ("events.csv", "drive"), ("trace.csv", "\n0.0,")] {
            pair.restore();
            let text = fs::read_to_string(pair.b.join(table)).unwrap();
            assert!(text.contains(from));
            let to = if from.starts_with('\n') { format!("\n{evil},") } else { evil.to_owned() };
            fs::write(pair.b.join(table), text.replacen(from, &to, 1)).unwrap();
            reseal(&pair.b);
            calls.iter().for_each(|call| drop(clean(&answer(call))));
        }
    }
}

/// Who computed a picture, and what a file is called.
#[test]
fn nothing_that_a_terminal_obeys_is_printed_of_pictures_and_names() {
    let (escape, bell) = ("\u{1b}]0;owned\u{7}\u{1b}[2J", "\u{9b}2J\u{202e}");
    let folder = tempdir().unwrap();
    let out = run_example("p1", folder.path(), &["run.cycles=1", "plots=[\"loop\"]"]);
    let mut carried = stickslip_plot::read_text(&fs::read(out.join("loop.png")).unwrap()).unwrap();
    for (key, text) in &mut carried {
        if key == "Software" {
            *text = format!("stickslip {escape}{bell}");
        }
    }
    let figure = stickslip_plot::Figure {
        title: stickslip_plot::Label::plain("x"),
        panels: vec![stickslip_plot::Panel::default()],
        provenance: carried,
        ..stickslip_plot::Figure::default()
    };
    let picture = folder.path().join("evil.png");
    fs::write(&picture, stickslip_plot::draw_png(&figure).unwrap()).unwrap();
    let said = clean(&answer(&["repro".as_ref(), &picture]));
    assert!(said.contains("note: computed by stickslip \\u{1b}]0;owned"), "{said}");
    let evil = folder.path().join("a\u{1b}[31mb.json");
    fs::copy(scenario("p1"), &evil).unwrap();
    let mut run = stickslip();
    run.arg("run").arg(&evil).arg("--out").arg(folder.path()).args([
        "--set",
        "run.cycles=1",
        "--set",
        "plots=[]",
    ]);
    assert!(clean(&run.output().unwrap()).contains("a\\u{1b}[31mb: 1.000 ms simulated"));
}

/// JSON has no numbers that are not finite, and once strings stood in their place.
#[test]
fn what_is_not_finite_is_null_in_json() {
    let pair = Pair::quickstart();
    pair.edit("trace.csv", |lines| {
        let k = place(lines, "slider.x_m");
        "NaN".clone_into(&mut lines[700][k]);
    });
    let output = stickslip().arg("compare").args([&pair.a, &pair.b]).arg("--json").output().unwrap();
    assert_eq!(code(&output), 1);
    let said = stdout(&output);
    assert!(!said.contains("\"inf\"") && !said.contains("\"NaN\""), "{said}");
    let found: serde_json::Value = serde_json::from_str(&said).unwrap();
    let channel =
        found["channels"].as_array().unwrap().iter().find(|channel| channel["name"] == "slider.x_m").unwrap();
    assert!(channel["worst"].is_null() && channel["rows"] == 1, "{channel}");
    let text = stdout(&stickslip().arg("compare").args([&pair.a, &pair.b]).output().unwrap());
    assert!(text.contains("inf m"), "{text}");
}
