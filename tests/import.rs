//! `stickslip import`: what a table is taken for, and the recipe that says so.

use crate::program::{code, stderr, stdout, stickslip};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../record/tests/data").join(name)
}

fn run(command: &str, file: &Path, arguments: &[&str]) -> Output {
    stickslip().arg(command).arg(file).args(arguments).output().unwrap()
}

/// A recipe that was written gives the cycles that the options gave; one of another file is refused.
#[test]
fn a_recipe_is_shown_written_and_measured_by() {
    let root = tempfile::tempdir().unwrap();
    let at = |name: &str| root.path().join(name).to_str().unwrap().to_owned();
    let file = data("01_no_head_mm_kN.csv");
    let columns = ["--displacement", "1:mm", "--force", "2:kN"];
    let shown = run("import", &file, &[&columns[..], &["--out", &at("recipe.json")]].concat());
    assert_eq!(code(&shown), 0, "{}", stderr(&shown));
    for said in ["displacement in mm", "force in kN", "0.000785", "rows: 241", "recipe: "] {
        assert!(stdout(&shown).contains(said), "{said}: {}", stdout(&shown));
    }
    assert_eq!(code(&run("measure", &file, &[&columns[..], &["--out", &at("named"), "-q"]].concat())), 0);
    let by_recipe = run("measure", &file, &["--recipe", &at("recipe.json"), "--out", &at("recipe"), "-q"]);
    assert_eq!((code(&by_recipe), stderr(&by_recipe).as_str()), (0, ""));
    let cycles = |name: &str| fs::read_to_string(root.path().join(name).join("cycles.csv")).unwrap();
    assert_eq!(cycles("named"), cycles("recipe"));
    let other = data("25_profile_two_columns.asc");
    let refused = run("measure", &other, &["--recipe", &at("recipe.json"), "--out", &at("none")]);
    assert_eq!(code(&refused), 2, "{}", stdout(&refused));
    assert!(!root.path().join("none").exists());
    let line = run("import", &data("logger_latin1.csv"), &["--json"]);
    let recipe: serde_json::Value = serde_json::from_slice(&line.stdout).unwrap();
    assert_eq!((&recipe["encoding"], &recipe["columns"]["normal"]["column"]), (&"latin-1".into(), &4.into()));
}
