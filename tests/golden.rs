//! Goldens of the examples, by the command that users have for theirs: they guard against change. What is right is shown by closed forms
//! elsewhere. `tests/golden/README.md` tells how they are made and renewed.

use crate::program::{code, listing, reseal, sha256, stderr, stdout, stickslip};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::Output;
use tempfile::{TempDir, tempdir};

/// Largest golden, bytes, and largest sum of all.
const MOST_BYTES: u64 = 100_000;
const MOST_BYTES_TOGETHER: u64 = 900_000;

fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn golden(arguments: &[&str], root: &Path) -> Output {
    let mut command = stickslip();
    let (first, rest) = arguments.split_first().unwrap();
    command.args(["golden", first]);
    if *first != "record" {
        command.arg(root);
    }
    command.args(rest).output().unwrap()
}

fn check(root: &Path) -> (i32, String) {
    let output = golden(&["check"], root);
    (code(&output), stdout(&output))
}

#[test]
fn every_example_agrees_with_its_golden_results() {
    let root = project().join("tests/golden");
    let (code, said) = check(&root);
    assert_eq!(code, 0, "{said}to keep the change:\n  stickslip golden accept tests/golden --reason \"…\"");
    let names: Vec<String> = said.lines().map(|line| line.split(':').next().unwrap().to_owned()).collect();
    let scenarios = listing(&project().join("scenarios"));
    let stems = scenarios.iter().filter_map(|name| name.strip_suffix(".json"));
    assert_eq!(
        names,
        stems.collect::<Vec<_>>(),
        "to record one: stickslip golden record FILE --out tests/golden"
    );
    let size = |name: &String| -> u64 {
        let folder = root.join(name);
        listing(&folder).iter().map(|file| std::fs::metadata(folder.join(file)).unwrap().len()).sum()
    };
    let sizes: Vec<u64> = names.iter().map(size).collect();
    assert!(sizes.iter().all(|size| *size <= MOST_BYTES), "{sizes:?}");
    assert!(sizes.iter().sum::<u64>() <= MOST_BYTES_TOGETHER, "{sizes:?}");
}

/// A folder of goldens of one scenario, with the scenario beside it.
struct Specimen {
    room: TempDir,
}

impl Specimen {
    /// The benchmark drive, made shorter or longer by what is set.
    fn of(set: &[&str]) -> Self {
        let room = tempdir().unwrap();
        std::fs::copy(project().join("scenarios/p1.json"), room.path().join("p1.json")).unwrap();
        let specimen = Self { room };
        let file = specimen.scenario();
        let out = specimen.root();
        let mut arguments = vec!["record", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
        set.iter().for_each(|set| arguments.extend(["--set", set]));
        let output = golden(&arguments, &out);
        assert_eq!((code(&output), stderr(&output)), (0, String::new()));
        specimen
    }

    fn root(&self) -> PathBuf {
        self.room.path().join("golden")
    }

    fn scenario(&self) -> PathBuf {
        self.room.path().join("p1.json")
    }

    fn file(&self, name: &str) -> PathBuf {
        self.root().join("p1").join(name)
    }

    /// Changes a file for one check; what that says.
    fn changed(&self, path: &Path, change: impl Fn(&str) -> String) -> (i32, String) {
        let text = std::fs::read_to_string(path).unwrap();
        let seals = std::fs::read_to_string(self.file("summary.json")).unwrap();
        std::fs::write(path, change(&text)).unwrap();
        if path.starts_with(self.root()) && path.extension().is_some_and(|end| end == "csv") {
            reseal(&self.root().join("p1"));
        }
        let found = check(&self.root());
        std::fs::write(self.file("summary.json"), seals).unwrap();
        std::fs::write(path, text).unwrap();
        found
    }

    /// The masses that the check is given instead of 20 g, as a program would be whose forces are off by as much.
    fn with_mass(&self, factor: f64) -> (i32, String) {
        let mass = format!("bodies.slider.mass={:?}", 0.02 * factor);
        let change = |text: &str| {
            let mut recipe: Value = serde_json::from_str(text).unwrap();
            recipe["set"] = json!([mass]);
            recipe.to_string()
        };
        let scenario = std::fs::read_to_string(self.file("scenario.json")).unwrap();
        // As if it had been recorded so: what is to be told is the change of results.
        let was: Value = serde_json::from_str(&scenario).unwrap();
        let mut is = was.clone();
        is["bodies"]["slider"]["mass"] = json!(0.02 * factor);
        std::fs::write(self.file("scenario.json"), is.to_string()).unwrap();
        let summary = std::fs::read_to_string(self.file("summary.json")).unwrap();
        let hash = |value: &str| sha256(value.as_bytes());
        let resealed = summary.replace(&hash(&scenario), &hash(&is.to_string()));
        assert_ne!(summary, resealed);
        std::fs::write(self.file("summary.json"), resealed).unwrap();
        let found = self.changed(&self.file("recipe.json"), change);
        std::fs::write(self.file("scenario.json"), scenario).unwrap();
        std::fs::write(self.file("summary.json"), summary).unwrap();
        found
    }
}

#[test]
fn a_golden_is_small_and_tells_one_in_1e9_from_rounding() {
    // 20 periods, and 1 s of a drive: 1 000.
    for cycles in [20, 1000] {
        let set = format!("run.cycles={cycles}");
        let specimen = Specimen::of(&[&set, "output.every=1 ms"][..if cycles == 20 { 1 } else { 2 }]);
        let folder = specimen.root().join("p1");
        let bytes: u64 =
            listing(&folder).iter().map(|name| std::fs::metadata(folder.join(name)).unwrap().len()).sum();
        assert!(bytes <= 40_000, "{cycles} cycles: {bytes} bytes");
        if cycles == 1000 {
            continue;
        }
        assert_eq!(check(&specimen.root()), (0, "p1: identical\n".to_owned()));
        let (code, said) = specimen.with_mass(1.0 + 1e-14);
        assert!(code == 0 && said.starts_with("p1: equal; largest difference: "), "{said}");
        let (code, said) = specimen.with_mass(1.0 + 1e-9);
        assert!(code == 1 && said.starts_with("p1: differs; first difference at t = "), "{said}");
        assert!(specimen.file("difference.png").exists());
        check(&specimen.root());
        assert!(!specimen.file("difference.png").exists(), "a green check takes the picture away");
    }
}

#[test]
fn a_golden_can_be_a_run_in_frames() {
    let specimen = Specimen::of(&[r#"run.stepper={"frames": {"length": "30 us"}}"#]);
    assert_eq!(check(&specimen.root()), (0, "p1: identical\n".to_owned()));
}

#[test]
fn a_falsified_golden_is_noticed() {
    let specimen = Specimen::of(&[]);
    let digit = |text: &str| {
        let rows: Vec<&str> = text.lines().collect();
        let cells: Vec<&str> = rows[20].split(',').collect();
        let x: f64 = cells[3].parse().unwrap();
        let row = rows[20].replacen(cells[3], &format!("{:?}", x * (1.0 + 1e-9)), 1);
        text.replacen(rows[20], &row, 1)
    };
    let event = |text: &str| {
        let line = text.lines().nth(60).unwrap();
        text.replacen(&format!("{line}\n"), "", 1)
    };
    let length = |text: &str| text.replacen("\"lengths_m\": [", "\"lengths_m\": [1.0,", 1);
    let name = |text: &str| text.replacen("\"peak_fx_N\"", "\"peak_f_N\"", 1);
    let noticed = |file: &str, change: &dyn Fn(&str) -> String, what: &str| {
        let (code, said) = specimen.changed(&specimen.file(file), change);
        assert!(code == 1 && said.contains(what), "{file}: {said}");
    };
    noticed("trace.csv", &digit, "slider.x_m");
    noticed("events.csv", &event, "is extra");
    noticed("summary.json", &length, "p1: differs; ");
    noticed("summary.json", &name, "p1: differs; ");
    noticed("recipe.json", &|text| text.replace("\"format\": 1", "\"format\": 2"), "this version reads 1");
    noticed("recipe.json", &|text| text[..20].to_owned(), "p1: damaged: ");
    noticed("summary.json", &|text| text[..200].to_owned(), "p1: damaged: ");
    noticed("trace.csv", &|text| text.replacen('0', "x", 1), "p1: damaged: ");
    noticed("scenario.json", &|text| text.replacen("0.02", "0.021", 1), "was changed after recording");
    std::fs::write(specimen.file("scenario.json"), "{}").unwrap();
    let accepted = golden(&["accept", "--reason", "what was damaged is made again"], &specimen.root());
    assert_eq!((code(&accepted), check(&specimen.root()).0), (0, 0), "{}", stderr(&accepted));
    std::fs::remove_file(specimen.file("recipe.json")).unwrap();
    let (code, said) = check(&specimen.root());
    assert!(code == 1 && said.starts_with("p1: damaged: "), "{said}");
}

#[test]
fn a_changed_scenario_is_named_before_what_it_changes() {
    let specimen = Specimen::of(&[]);
    let (code, said) = specimen.changed(&specimen.scenario(), |text| text.replace("\"20 g\"", "\"21 g\""));
    let named =
        "p1: differs; the scenario has changed: bodies.slider.mass was 0.02, is 0.021; first difference at ";
    assert!(code == 1 && said.starts_with(named), "{said}");
    // A change that shows in no row is one as well.
    let (code, said) =
        specimen.changed(&specimen.scenario(), |text| text.replace("\"cycles\": 20", "\"cycles\": 21"));
    assert!(code == 1 && said.contains("run.cycles was 20, is 21"), "{said}");
    std::fs::remove_file(specimen.scenario()).unwrap();
    let (code, said) = check(&specimen.root());
    assert!(
        code == 1 && said.starts_with("p1: gone: ") && said.ends_with("p1.json does not exist\n"),
        "{said}"
    );
}

#[test]
fn what_has_changed_is_accepted_for_a_reason_and_logged() {
    let specimen = Specimen::of(&["run.cycles=3"]);
    let root = specimen.root();
    let log = || std::fs::read_to_string(root.join("log.md")).unwrap();
    assert!(log().ends_with(" | 0.1.0 | p1 | first recorded |\n"));
    let text = std::fs::read_to_string(specimen.scenario()).unwrap();
    std::fs::write(specimen.scenario(), text.replace("\"20 g\"", "\"21 g\"")).unwrap();
    for reason in ["", "...", "1"] {
        let output = golden(&["accept", "--reason", reason], &root);
        assert_eq!((code(&output), check(&root).0), (2, 1), "{reason:?}");
        assert!(
            stderr(&output).contains("expected a reason of eight letters or more"),
            "{}",
            stderr(&output)
        );
    }
    let before = log();
    let output = golden(&["accept", "--reason", "a heavier slider | of brass"], &root);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let line = log().strip_prefix(&before).unwrap().to_owned();
    assert!(
        line.starts_with("| 20") && line.ends_with(" | 0.1.0 | p1 | a heavier slider / of brass |\n"),
        "{line}"
    );
    assert_eq!(check(&root), (0, "p1: identical\n".to_owned()));
    assert!(
        stdout(&golden(&["accept", "--reason", "another good reason"], &root)).contains("nothing to accept")
    );
    assert_eq!(log(), [before, line].concat());
}

#[test]
fn bad_input_is_refused_with_what_would_be_right() {
    let specimen = Specimen::of(&["run.cycles=3"]);
    let refused = |arguments: &[&str], root: &Path, what: &str| {
        let output = golden(arguments, root);
        assert!(code(&output) == 2 && stderr(&output).contains(what), "{}", stderr(&output));
    };
    let nowhere = specimen.room.path().join("nowhere");
    refused(
        &["check"],
        &nowhere,
        "there is no reference result\n   help: stickslip golden record FILE… --out ",
    );
    refused(&["check", "p2"], &specimen.root(), "there is no reference result \"p2\"");
    refused(&["accept"], &specimen.root(), "--reason");
    let (file, out) = (specimen.scenario(), specimen.root());
    let again = ["record", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
    refused(&again, &out, "exists already\n   help: stickslip golden accept ");
    assert_eq!(check(&out).0, 0);
}

#[test]
fn machines_read_what_was_found() {
    let specimen = Specimen::of(&["run.cycles=3"]);
    let file = specimen.room.path().join("golden.xml");
    let report = || {
        golden(&["check", "--junit", file.to_str().unwrap()], &specimen.root());
        std::fs::read_to_string(&file).unwrap()
    };
    assert!(report().contains("tests=\"1\" failures=\"0\""));
    let text = std::fs::read_to_string(specimen.scenario()).unwrap();
    std::fs::write(specimen.scenario(), text.replace("\"20 g\"", "\"21 g\"")).unwrap();
    let report = report();
    assert_eq!(report.matches("<failure message=\"differs; the scenario has changed").count(), 1, "{report}");
}

/// Steps upwards from a link led out of what it points to, and the next check found nothing.
#[test]
#[cfg(unix)]
fn goldens_behind_a_link_find_their_scenarios() {
    let room = tempdir().unwrap();
    let file = room.path().join("p1.json");
    std::fs::copy(project().join("scenarios/p1.json"), &file).unwrap();
    std::fs::create_dir_all(room.path().join("real/far/away")).unwrap();
    let link = room.path().join("link");
    std::os::unix::fs::symlink("real/far/away", &link).unwrap();
    let out = link.join("golden");
    let set = "run.cycles=2";
    let output =
        golden(&["record", file.to_str().unwrap(), "--set", set, "--out", out.to_str().unwrap()], &out);
    assert_eq!((code(&output), stderr(&output)), (0, String::new()));
    assert_eq!(check(&out), (0, "p1: identical\n".to_owned()));
}
