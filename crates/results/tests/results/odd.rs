//! Odd scenes: `tests/odd/NAME.json` is run all the same and warned of with the words of `tests/odd/NAME.txt`.
//!
//! A new case: write the JSON, run `STICKSLIP_WRITE=1 cargo test -p stickslip-results --test results odd`, and read
//! what it wrote.

use std::fs;
use std::path::{Path, PathBuf};
use stickslip_results::{Job, Warning};

fn files(folder: &str) -> Vec<PathBuf> {
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    files.sort();
    files
}

fn job(path: &Path) -> Job {
    Job::prepare(path, &[], Path::new("")).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn odd_scenes_are_warned_of_word_for_word() {
    let (mut wrong, mut kinds) = (Vec::new(), Vec::new());
    let files = files("tests/odd");
    assert!(files.len() >= 20, "only {} scenes", files.len());
    for path in files {
        let warnings = job(&path).warnings();
        kinds.extend(warnings.iter().map(|warning| warning.kind));
        let told: Vec<String> = warnings.iter().map(|odd| format!("{}: {odd}", odd.kind)).collect();
        let told = told.join("\n");
        let beside = path.with_extension("txt");
        if std::env::var_os("STICKSLIP_WRITE").is_some() {
            fs::write(&beside, format!("{told}\n")).unwrap();
        }
        let expected = fs::read_to_string(&beside).unwrap_or_default();
        if expected.trim_end() != told || warnings.len() != 1 {
            wrong.push(format!("{}\nexpected\n{expected}\ngot\n{told}\n", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    kinds.sort_unstable();
    kinds.dedup();
    let all = [
        "damping",
        "driver_chatters",
        "endless",
        "frames_under_limits",
        "friction",
        "geometry",
        "load",
        "mass",
        "modulus",
        "pressure",
        "resonance",
        "step",
        "stiff_driver",
        "stroke",
        "tolerance",
    ];
    assert_eq!(kinds, all);
}

/// The example from which they are made, and all others, are as they are meant to be.
#[test]
fn the_examples_are_plausible() {
    for path in files("../../scenarios") {
        let job = job(&path);
        assert_eq!(job.warnings(), [], "{}", path.display());
        assert_eq!(Warning::of_scenario(&job), []);
    }
}

/// A scene of thousands of oddities is told of the first, in time.
#[test]
fn many_oddities_are_told_of_the_first() {
    let mut text = String::from(
        r#"{ "stickslip": 1, "run": { "duration": 1 }, "materials": { "brass": { "youngs_modulus": "100 GPa", "poisson_ratio": 0.3 } },
            "waveforms": { "w": { "triangle": { "stroke": "1 um", "period": 1 } } },
            "bodies": { "foot": { "x": { "follows": "w" } } }, "contacts": {"#,
    );
    for c in 0..5_000 {
        let comma = if c == 0 { "" } else { "," };
        text += &format!(
            r#"{comma} "c{c}": {{ "between": ["ground", "foot"], "materials": ["brass", "brass"], "friction": 0.2,
                "profile": {{ "paraboloid": {{ "radius": "1 mm" }} }}, "normal": {{ "force": "100 N" }} }}"#
        );
    }
    text += "} }";
    let scenario = stickslip_scenario::Scenario::from_str(&text, "odd.json", "").unwrap();
    let warnings = Job::new(scenario, "odd".to_owned(), "".into()).unwrap().warnings();
    assert_eq!(warnings.len(), 20);
    assert!(warnings[19].help.as_ref().unwrap().ends_with("; 4980 more warnings are not shown"));
}
