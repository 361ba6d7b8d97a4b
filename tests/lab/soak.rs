//! `stickslip-lab soak`: scenes drawn from seeds.

use crate::program::{Table, code, lab, listing, run, stderr, stdout};
use tempfile::tempdir;

#[test]
fn seeds_are_judged_and_told_of() {
    let out = tempdir().unwrap();
    let output = lab()
        .args(["soak", "--from", "1011", "--seeds", "8", "--threads", "2", "--out"])
        .arg(out.path())
        .output()
        .unwrap();
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let said = stdout(&output);
    let all = said.lines().find(|line| line.trim_start().starts_with("all")).unwrap();
    assert_eq!(all.split_whitespace().nth(1), Some("8"), "{said}");
    assert!(said.lines().next().unwrap().contains("right") && said.contains("24 runs"), "{said}");
    assert_eq!(listing(out.path()), ["soak.csv"]);
    let table = Table::read(&out.path().join("soak.csv"));
    let seeds: Vec<u64> = table.column("seed").iter().map(|seed| seed.parse().unwrap()).collect();
    assert_eq!(seeds, (1011..1019).collect::<Vec<u64>>());
    assert!(table.column("error_1e-8").iter().all(|error| error.parse::<f64>().unwrap() < 1e-6));
}

/// A seed is a scenario: what was judged can be run, looked at and sent to somebody.
#[test]
fn a_seed_is_written_as_a_file_that_runs() {
    let out = tempdir().unwrap();
    let output = lab().args(["soak", "1012", "1014", "--write"]).arg(out.path()).output().unwrap();
    assert_eq!((code(&output), stdout(&output)), (0, String::new()), "{}", stderr(&output));
    assert_eq!(listing(out.path()), ["seed-1012.json", "seed-1014.json"]);
    let output = run(&out.path().join("seed-1014.json"), &out.path().join("results"), &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
}

#[test]
fn seeds_are_named_or_counted() {
    let output = lab().args(["soak", "3", "--seeds", "4"]).output().unwrap();
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("cannot be used with"), "{}", stderr(&output));
    assert_eq!(code(&lab().args(["soak", "--seeds", "0"]).output().unwrap()), 2);
}

#[test]
fn a_cell_of_the_matrix_is_judged_and_written_by_its_number() {
    let out = tempdir().unwrap();
    let hostile = |more: &[&str]| lab().args(["soak", "--hostile"]).args(more).output().unwrap();
    let output = hostile(&["1207"]);
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert!(stdout(&output).contains("right"), "{}", stdout(&output));
    assert_eq!(code(&hostile(&["1207", "--write", out.path().to_str().unwrap()])), 0);
    assert_eq!(listing(out.path()), ["cell-1207.json"]);
    let output = run(&out.path().join("cell-1207.json"), &out.path().join("results"), &[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let output = hostile(&["99999"]);
    assert_eq!((code(&output), stdout(&output)), (2, String::new()));
    assert!(stderr(&output).contains("there is no cell 99999"), "{}", stderr(&output));
    // A record of a part would be taken for one of the whole.
    assert_eq!(code(&hostile(&["1207", "--out", "a", "--page", "b"])), 2);
}
