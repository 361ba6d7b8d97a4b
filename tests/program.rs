//! The program under test and what it leaves behind.

use serde_json::{Value, json};
use sha2::Digest;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const LAB: Option<&str> = option_env!("CARGO_BIN_EXE_stickslip-lab");

/// A call of the program; among the tests of the lab of the one that is built beside it.
pub(crate) fn stickslip() -> Command {
    let beside =
        || Path::new(LAB.unwrap()).with_file_name(format!("stickslip{}", std::env::consts::EXE_SUFFIX));
    Command::new(option_env!("CARGO_BIN_EXE_stickslip").map_or_else(beside, PathBuf::from))
}

/// A call of the program that measures and checks.
#[allow(dead_code, reason = "only the lab's tests call it")]
pub(crate) fn lab() -> Command {
    Command::new(LAB.unwrap())
}

/// Path of an example.
pub(crate) fn scenario(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(format!("{name}.json"))
}

/// Runs a scenario file with overrides into a folder.
pub(crate) fn run(file: &Path, out: &Path, set: &[&str]) -> Output {
    let mut command = stickslip();
    command.arg("run").arg(file).arg("--out").arg(out);
    for assignment in set {
        command.args(["--set", assignment]);
    }
    command.output().unwrap()
}

/// Runs an example, which must end well; returns its folder.
pub(crate) fn run_example(name: &str, out: &Path, set: &[&str]) -> PathBuf {
    let output = run(&scenario(name), out, set);
    assert_eq!(code(&output), 0, "{name}: {}", stderr(&output));
    out.join(name)
}

pub(crate) fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// The summary in a folder of results.
pub(crate) fn summary(folder: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(folder.join("summary.json")).unwrap()).unwrap()
}

/// A number in a summary by JSON pointer.
pub(crate) fn number(summary: &Value, pointer: &str) -> f64 {
    summary.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer} in {summary}"))
}

/// Names in a folder, sorted; hidden ones, too.
pub(crate) fn listing(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Makes the summary in a folder say of its tables what they hold now, as one does who changes them and knows of seals.
pub(crate) fn reseal(folder: &Path) {
    let mut summary = summary(folder);
    for name in ["trace.csv", "events.csv", "steps.csv", "springs.csv", "memory.csv"] {
        let Ok(bytes) = std::fs::read(folder.join(name)) else { continue };
        let rows = bytes.iter().filter(|byte| **byte == b'\n').count().saturating_sub(1);
        summary["tables"][name] = json!({ "rows": rows, "sha256": sha256(&bytes) });
    }
    std::fs::write(folder.join("summary.json"), summary.to_string()).unwrap();
}

/// SHA-256 in hexadecimal digits.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    sha2::Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A table as text.
pub(crate) struct Table {
    pub(crate) head: Vec<String>,
    pub(crate) rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn read(path: &Path) -> Self {
        let mut reader = csv::Reader::from_path(path).unwrap();
        let words = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
        let head = words(reader.headers().unwrap());
        let rows = reader.records().map(|record| words(&record.unwrap())).collect();
        Self { head, rows }
    }

    pub(crate) fn column(&self, name: &str) -> Vec<&str> {
        let place = self.head.iter().position(|head| head == name).unwrap();
        self.rows.iter().map(|row| row[place].as_str()).collect()
    }
}

/// Hashes of all files of a folder, in the order of their names.
pub(crate) fn bytes(folder: &Path) -> String {
    let files = listing(folder).into_iter().map(|name| sha256(&std::fs::read(folder.join(name)).unwrap()));
    files.collect::<Vec<_>>().join(" ")
}
