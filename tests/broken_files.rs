//! Every bad scenario of crates/scenario, given to the program: its message, exit code 2, nothing left behind.

use crate::program::{code, listing, stderr, stdout, stickslip};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tempfile::tempdir;

/// Where the messages beside the files were written: their places are named from here.
fn home() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenario")
}

fn names(folder: &str) -> Vec<String> {
    let names = listing(&home().join(folder));
    names.iter().filter_map(|name| name.strip_suffix(".json")).map(str::to_owned).collect()
}

#[test]
fn each_broken_file_ends_with_its_message_and_leaves_nothing() {
    let out = tempdir().unwrap();
    let before = listing(&home().join("tests/bad"));
    let names = names("tests/bad");
    assert!(names.len() >= 190);
    let mut times = Vec::new();
    for name in names {
        let file = format!("tests/bad/{name}.json");
        let results = out.path().join("results");
        let begun = Instant::now();
        let output =
            stickslip().current_dir(home()).args(["run", &file, "--out"]).arg(&results).output().unwrap();
        times.push(begun.elapsed());
        let expected = std::fs::read_to_string(home().join(format!("tests/bad/{name}.txt"))).unwrap();
        assert_eq!(stderr(&output), expected, "{name}");
        assert_eq!((code(&output), stdout(&output)), (2, String::new()), "{name}");
        assert!(!results.exists(), "{name}");
    }
    assert_eq!(listing(&home().join("tests/bad")), before);
    // From a typo to the message, the start of the program included: the median, for machines with more to do.
    times.sort();
    let median = times[times.len() / 2];
    assert!(median < Duration::from_millis(50), "{median:?}");
}

#[test]
fn what_is_odd_is_said_and_run() {
    let out = tempdir().unwrap();
    for name in names("tests/odd") {
        let file = format!("tests/odd/{name}.json");
        let run = |more: &[&str]| {
            let mut command = stickslip();
            command.current_dir(home()).args(["run", &file, "--set", "plots=[]", "--out"]).arg(out.path());
            command.args(more).output().unwrap()
        };
        let odd = std::fs::read_to_string(home().join(format!("tests/odd/{name}.txt"))).unwrap();
        let output = run(&[]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let said = stderr(&output);
        let first: Vec<_> = odd.lines().filter(|line| line.starts_with("tests/odd/")).collect();
        assert!(!first.is_empty());
        // The pictures are not drawn here: nothing is odd about them.
        for line in first.into_iter().filter(|line| !line.contains("  plots[")) {
            assert!(said.contains(&format!("warning: {line}\n")), "{line}\n{said}");
        }
        assert_eq!(stderr(&run(&["--quiet"])), "");
    }
}
