//! Golden results of the examples: they guard against change. What is right is shown by closed forms elsewhere.
//!
//! `tests/golden/README.md` tells how they are made and renewed.

use crate::program::{Table, code, listing, reseal, run, stderr, stdout, stickslip, summary};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::SystemTime;
use tempfile::tempdir;

/// Says why the goldens that differ are to be renewed.
const VARIABLE: &str = "STICKSLIP_GOLDEN";
const COMMAND: &str =
    "STICKSLIP_GOLDEN=\"why the results change\" cargo test -p stickslip --test program golden";
/// Rows of a golden trace, besides the first and the last.
const ROWS: usize = 40;
/// Largest golden, bytes.
const MOST_BYTES: u64 = 100_000;
/// Largest sum of all, bytes.
const MOST_BYTES_TOGETHER: u64 = 800_000;

/// Scenarios and their golden results.
struct Goldens {
    scenarios: PathBuf,
    root: PathBuf,
}

impl Goldens {
    fn of_the_project() -> Self {
        let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        Self { scenarios: project.join("scenarios"), root: project.join("tests/golden") }
    }

    /// Names of all scenarios.
    fn names(&self) -> Vec<String> {
        let files = listing(&self.scenarios);
        files.iter().filter_map(|name| name.strip_suffix(".json")).map(str::to_owned).collect()
    }

    /// Arguments for `run --set` or for `compare`, recorded beside the golden.
    fn recipe(&self, name: &str, part: &str) -> Vec<String> {
        let Ok(text) = std::fs::read(self.root.join(name).join("recipe.json")) else { return Vec::new() };
        let recipe: Value = serde_json::from_slice(&text).unwrap();
        let words = recipe[part].as_array().unwrap().iter();
        words.map(|word| word.as_str().unwrap().to_owned()).collect()
    }

    /// Runs a scenario as its recipe says, without pictures.
    fn run(&self, name: &str, out: &Path) -> PathBuf {
        let set = self.recipe(name, "set");
        let set: Vec<&str> = ["plots=[]"].into_iter().chain(set.iter().map(String::as_str)).collect();
        let output = run(&self.scenarios.join(format!("{name}.json")), out, &set);
        assert_eq!(code(&output), 0, "{name}: {}", stderr(&output));
        out.join(name)
    }

    /// Compares results with the golden; an error says how they differ.
    fn check(&self, name: &str, results: &Path) -> Result<(), String> {
        let golden = self.root.join(name);
        if !golden.join("summary.json").exists() {
            return Err(format!("{name} has no golden results; to make them:\n  {COMMAND}"));
        }
        let mut command = stickslip();
        command.arg("compare").args([&golden, results]).args(self.recipe(name, "compare"));
        let output = command.output().unwrap();
        match code(&output) {
            0 => Ok(()),
            1 => Err(format!("{name} has changed:\n{}to keep the change:\n  {COMMAND}", stdout(&output))),
            _ => Err(format!("{name}: {}", stderr(&output))),
        }
    }

    /// Writes the golden of results: some rows, all events without their columns, the figures.
    fn write(&self, name: &str, results: &Path) {
        let golden = self.root.join(name);
        std::fs::create_dir_all(&golden).unwrap();
        if !golden.join("recipe.json").exists() {
            std::fs::write(golden.join("recipe.json"), "{\n  \"set\": [],\n  \"compare\": []\n}\n").unwrap();
        }
        let trace = Table::read(&results.join("trace.csv"));
        let rows = spread(trace.rows.len()).into_iter().map(|row| trace.rows[row].join(","));
        write_lines(&golden.join("trace.csv"), std::iter::once(trace.head.join(",")).chain(rows));
        let events = std::fs::read_to_string(results.join("events.csv")).unwrap();
        let short = |line: &str| line.split(',').take(3).collect::<Vec<_>>().join(",");
        write_lines(&golden.join("events.csv"), events.lines().map(short));
        let mut figures = figures(&summary(results));
        let steps = results.join("steps.csv");
        if steps.exists() {
            let lengths = Table::read(&steps);
            let lengths = lengths.column("length_m").into_iter().map(|cell| cell.parse::<f64>().unwrap());
            figures["steps"]["lengths_m"] = lengths.collect();
        }
        let figures = serde_json::to_string_pretty(&figures).unwrap();
        std::fs::write(golden.join("summary.json"), figures + "\n").unwrap();
        reseal(&golden);
        let sealed = serde_json::to_string_pretty(&summary(&golden)).unwrap();
        std::fs::write(golden.join("summary.json"), sealed + "\n").unwrap();
    }

    /// Compares all scenarios; with a reason renews the goldens that differ and logs it.
    fn check_all(&self, reason: Option<&str>) -> Result<(), String> {
        let reason = reason.map(str::trim);
        if reason.is_some_and(|reason| reason.chars().filter(|c| c.is_alphabetic()).count() < 8) {
            return Err(format!("{VARIABLE} must say why the results change"));
        }
        let (mut faults, mut renewed) = (Vec::new(), Vec::new());
        let out = tempdir().unwrap();
        for name in self.names() {
            let results = self.run(&name, out.path());
            match (self.check(&name, &results), reason) {
                (Ok(()), _) => {}
                (Err(fault), None) => faults.push(fault),
                (Err(_), Some(_)) => {
                    self.write(&name, &results);
                    // A golden that does not even agree with its own run would be noticed tomorrow.
                    faults.extend(self.check(&name, &results).err());
                    renewed.push(name);
                }
            }
        }
        if let Some(reason) = reason.filter(|_| !renewed.is_empty()) {
            self.log(reason, &renewed);
        }
        faults.extend(self.sizes());
        if faults.is_empty() { Ok(()) } else { Err(faults.join("\n\n")) }
    }

    fn log(&self, reason: &str, names: &[String]) {
        let now = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
        let reason = reason.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "/");
        let line =
            format!("| {} | {} | {} | {reason} |\n", &now[..10], env!("CARGO_PKG_VERSION"), names.join(", "));
        let path = self.root.join("LOG.md");
        let head = "# Why golden results changed\n\n| date | version | scenarios | reason |\n| --- | --- | --- | --- |\n";
        let text = std::fs::read_to_string(&path).unwrap_or_else(|_| head.to_owned());
        std::fs::write(path, text + &line).unwrap();
    }

    /// What is too large, and goldens of scenarios that are gone.
    fn sizes(&self) -> Vec<String> {
        let (names, mut faults, mut together) = (self.names(), Vec::new(), 0);
        let folders = listing(&self.root).into_iter().filter(|name| self.root.join(name).is_dir());
        for name in folders {
            if !names.contains(&name) {
                faults.push(format!("tests/golden/{name} has no scenario: remove it"));
            }
            let folder = self.root.join(&name);
            let size = |file: &String| std::fs::metadata(folder.join(file)).unwrap().len();
            let bytes: u64 = listing(&folder).iter().map(size).sum();
            if bytes > MOST_BYTES {
                faults.push(format!("tests/golden/{name} has {bytes} bytes: shorten its run in recipe.json"));
            }
            together += bytes;
        }
        if together > MOST_BYTES_TOGETHER {
            faults.push(format!("tests/golden has {together} bytes: shorten some runs in their recipe.json"));
        }
        faults
    }
}

/// The first row, the last, and some between, spread by the golden ratio: no period of a drive is met at one phase only.
fn spread(rows: usize) -> Vec<usize> {
    let ratio = (5_f64.sqrt() - 1.0) / 2.0;
    let between = (1..=ROWS as u32).map(|k| ((f64::from(k) * ratio).fract() * rows as f64) as usize);
    let mut places: Vec<usize> = between.chain([0, rows - 1]).collect();
    places.sort_unstable();
    places.dedup();
    places
}

/// The part of a summary that is compared.
fn figures(summary: &Value) -> Value {
    let mut figures = json!({
        "excerpt": true,
        "program": { "version": summary["program"]["version"] },
        "counts": { "rows": summary["counts"]["rows"] },
    });
    for key in ["stepper", "status", "simulated_s", "contacts", "steps", "energy"] {
        if let Some(value) = summary.get(key) {
            figures[key] = value.clone();
        }
    }
    figures
}

fn write_lines(path: &Path, lines: impl Iterator<Item = String>) {
    let text: String = lines.map(|line| line + "\n").collect();
    std::fs::write(path, text).unwrap();
}

#[test]
fn every_example_agrees_with_its_golden_results() {
    let reason = std::env::var(VARIABLE).ok();
    if let Err(faults) = Goldens::of_the_project().check_all(reason.as_deref()) {
        panic!("{faults}");
    }
}

/// Goldens of one scenario in a folder of their own.
struct Specimen {
    goldens: Goldens,
    results: PathBuf,
    _root: tempfile::TempDir,
}

impl Specimen {
    fn new() -> Self {
        let root = tempdir().unwrap();
        let goldens = Goldens { scenarios: root.path().join("scenarios"), root: root.path().join("golden") };
        std::fs::create_dir(&goldens.scenarios).unwrap();
        std::fs::create_dir(&goldens.root).unwrap();
        let project = Goldens::of_the_project();
        std::fs::copy(project.scenarios.join("p1.json"), goldens.scenarios.join("p1.json")).unwrap();
        let results = goldens.run("p1", root.path());
        Self { goldens, results, _root: root }
    }

    fn golden(&self, name: &str) -> PathBuf {
        self.goldens.root.join("p1").join(name)
    }
}

#[test]
fn a_scenario_without_golden_results_fails_with_the_command() {
    let specimen = Specimen::new();
    let fault = specimen.goldens.check_all(None).unwrap_err();
    assert_eq!(fault, format!("p1 has no golden results; to make them:\n  {COMMAND}"));
}

#[test]
fn goldens_are_renewed_for_a_reason_only_and_it_is_logged() {
    let specimen = Specimen::new();
    let goldens = &specimen.goldens;
    for reason in ["", "  ", "...", "1"] {
        assert!(goldens.check_all(Some(reason)).unwrap_err().contains("must say why"), "{reason:?}");
    }
    assert!(listing(&goldens.root).is_empty());
    goldens.check_all(Some("the first of its kind | a trial")).unwrap();
    let log = std::fs::read_to_string(goldens.root.join("LOG.md")).unwrap();
    assert!(log.starts_with("# Why golden results changed\n"));
    let line = format!(" | {} | p1 | the first of its kind / a trial |\n", env!("CARGO_PKG_VERSION"));
    assert!(log.ends_with(&line), "{log}");
    // What has not changed is not renewed.
    goldens.check_all(Some("another good reason")).unwrap();
    assert_eq!(std::fs::read_to_string(goldens.root.join("LOG.md")).unwrap(), log);
    assert_eq!(goldens.check_all(None), Ok(()));
}

#[test]
fn a_falsified_golden_is_noticed() {
    let specimen = Specimen::new();
    let (goldens, results) = (&specimen.goldens, &specimen.results);
    goldens.write("p1", results);
    assert_eq!(goldens.check("p1", results), Ok(()));
    let falsify = |name: &str, change: &dyn Fn(&str) -> String, message: &str| {
        let path = specimen.golden(name);
        let text = std::fs::read_to_string(&path).unwrap();
        let seals = std::fs::read_to_string(specimen.golden("summary.json")).unwrap();
        std::fs::write(&path, change(&text)).unwrap();
        reseal(&specimen.goldens.root.join("p1"));
        let fault = goldens.check("p1", results).unwrap_err();
        assert!(fault.contains(message) && fault.ends_with(COMMAND), "{fault}");
        std::fs::write(specimen.golden("summary.json"), seals).unwrap();
        std::fs::write(&path, text).unwrap();
    };
    let digit = |text: &str| {
        let rows: Vec<&str> = text.lines().collect();
        let cells: Vec<&str> = rows[20].split(',').collect();
        let x: f64 = cells[3].parse().unwrap();
        let row = rows[20].replacen(cells[3], &format!("{:?}", x * (1.0 + 1e-9)), 1);
        text.replacen(rows[20], &row, 1)
    };
    falsify("trace.csv", &digit, ": slider.x_m\n");
    let event = |text: &str| {
        let line = text.lines().nth(60).unwrap();
        text.replacen(&format!("{line}\n"), "", 1)
    };
    falsify("events.csv", &event, "extra in B: ");
    let length = |text: &str| {
        let (before, lengths) = text.split_once("\"lengths_m\"").unwrap();
        format!("{before}\"lengths_m\"{}", lengths.replacen("5.02996042", "5.02996043", 1))
    };
    falsify("summary.json", &length, "steps.lengths_m[");
    falsify(
        "summary.json",
        &|text| text.replacen("\"peak_fx_N\"", "\"peak_f_N\"", 1),
        "missing in B: contacts.ball.peak_f_N",
    );
}

#[test]
fn goldens_of_scenarios_that_are_gone_are_noticed() {
    let specimen = Specimen::new();
    specimen.goldens.write("p1", &specimen.results);
    std::fs::create_dir(specimen.goldens.root.join("p2")).unwrap();
    assert_eq!(
        specimen.goldens.check_all(None),
        Err("tests/golden/p2 has no scenario: remove it".to_owned())
    );
}
