//! Studies: every case equals a run of `stickslip run` with its parameters, and parts depend on the study only.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::fs;
use std::path::{Path, PathBuf};
use stickslip_run::{Job, Watcher};
use stickslip_study::sweep::{Shard, Study, StudyError};

fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios")
}

fn study(file: &Value) -> Study {
    let made = Study::from_str(&file.to_string(), ("study.json", "study"), &scenarios());
    made.unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the error message of a study.
fn refused(file: &Value) -> String {
    Study::from_str(&file.to_string(), ("study.json", "study"), &scenarios()).err().unwrap().to_string()
}

fn with(mut file: Value, key: &str, value: Value) -> Value {
    file[key] = value;
    file
}

/// P1 at a tolerance of 1e-6, cheap enough for thousands of runs.
fn p1(cases: u64, chunk: u64) -> Value {
    json!({
        "stickslip_study": 1, "scenario": "p1.json", "cases": cases, "chunk": chunk,
        "set": { "run.stepper.event.tolerance": 1e-6, "run.cycles": 5 },
        "vary": {
            "contacts.ball.friction": { "uniform": [0.1, 0.2] },
            "bodies.slider.mass": { "normal": ["20 g", "1 g"] },
        },
        "results": ["slider.x", "steps.last_m", "energy.friction_J"],
    })
}

fn run(study: &Study, out: &Path, threads: usize) {
    assert!(!study.run(out, (Shard::WHOLE, threads), &()).unwrap().interrupted);
}

/// Returns a digest of the names and contents of all files in a folder.
fn digest(folder: &Path) -> String {
    let mut files: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let mut digest = Sha256::new();
    for file in files {
        digest.update(file.file_name().unwrap().as_encoded_bytes());
        digest.update(fs::read(file).unwrap());
    }
    digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Returns header and rows of a study's table.
fn table(study: &Study, out: &Path) -> (Vec<String>, Vec<Vec<String>>) {
    let file = out.join("../table.csv");
    study.write_csv(out, &file).unwrap();
    let mut reader = csv::Reader::from_path(file).unwrap();
    let head = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let rows = reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect());
    (head, rows.collect())
}

/// Formats the value at a path in JSON as in a table.
fn told(summary: &Value, path: &str) -> String {
    match path.split('.').try_fold(summary, |here, key| here.get(key)) {
        Some(Value::Number(number)) => format!("{:?}", number.as_f64().unwrap()),
        Some(Value::String(word)) => word.clone(),
        Some(Value::Bool(is)) => is.to_string(),
        _ => String::new(),
    }
}

/// Scenario, path and values of the varied parameter, results.
type Example = (&'static str, &'static str, Value, &'static [&'static str]);

/// Scenarios of every kind; parameters with and without fast setting; results from the last row and the summary.
fn examples() -> [Example; 8] {
    [
        (
            "p1",
            "contacts.ball.friction",
            json!([0.1, 0.15, 0.2]),
            &["slider.x_m", "steps.last_m", "energy.friction_J"],
        ),
        (
            "p1",
            "waveforms.drive.sawtooth.stroke",
            json!(["0.3 um", "0.6 um"]),
            &["slider.x_m", "ball.state", "steps.last_m"],
        ),
        (
            "p1",
            "run.cycles",
            json!([3, 7.5]),
            &["slider.x_m", "steps.last_m", "counts.events", "steps.settling.state"],
        ),
        (
            "quickstart",
            "materials.ruby.youngs_modulus",
            json!(["300 GPa", "400 GPa"]),
            &["steps.steady.step_m", "steps.steady.error_m", "contacts.ball.peak_fx_N", "status"],
        ),
        (
            "impact_drive",
            "bodies.carrier.mass",
            json!(["25 g", "30 g"]),
            &["carrier.x_m", "steps.last_m", "carrier.vx"],
        ),
        (
            "three_ball_stage",
            "contacts.front.friction",
            json!([0.1, 0.2]),
            &["stage.x_m", "energy.error_J", "steps.last_m", "steps.settling.state"],
        ),
        (
            "fretting_sphere",
            "contacts.200 nm.friction",
            json!([0.4, 0.6]),
            &["contacts.200 nm.fretting.dissipated_J", "200 nm.fx_N"],
        ),
        (
            "driven_stage",
            "actuators.stack.driver.current",
            json!(["0.5 A", "2 A"]),
            &["stage.x_m", "steps.last_m", "steps.longest_m"],
        ),
    ]
}

/// Returns the results of a run with the parameters of a case, formatted as in a table.
fn by_hand(study: &Study, name: &str, case: usize, results: &[&str]) -> Vec<String> {
    let set = study.overrides(case as u64);
    let job = Job::prepare(&scenarios().join(format!("{name}.json")), &set, Path::new("")).unwrap();
    let outcome = job.run_with_table(&());
    let (summary, _) = stickslip_study::summary(&job, &outcome, &|| true);
    let summary = serde_json::to_value(summary).unwrap();
    let (channels, table) = (job.model.channels(), outcome.table.as_ref().unwrap());
    let of = |result: &&str| {
        let is = |name: &str| name == *result || stickslip_quantity::names::bare(name) == *result;
        let Some(channel) = channels.iter().find(|channel| is(&channel.name)) else {
            return told(&summary, result);
        };
        let last = *table.column(&channel.name).unwrap().last().unwrap();
        if channel.is_state { stickslip_drive::state_name(last).to_owned() } else { format!("{last:?}") }
    };
    results.iter().map(of).collect()
}

/// Each case is compared with a run by `stickslip run --set`.
#[test]
fn a_case_is_what_a_run_with_its_numbers_comes_to() {
    let folder = tempfile::tempdir().unwrap();
    for (place, (name, path, values, results)) in examples().into_iter().enumerate() {
        let values = json!({ "list": values });
        let file = json!({
            "stickslip_study": 1, "scenario": format!("{name}.json"), "vary": { path: values }, "results": results
        });
        let (study, out) = (study(&file), folder.path().join(place.to_string()));
        run(&study, &out, 2);
        let (_, rows) = table(&study, &out);
        for (case, row) in rows.iter().enumerate() {
            let (results, error) = (&row[2..row.len() - 1], &row[row.len() - 1]);
            assert_eq!(results, by_hand(&study, name, case, &results_of(&study)), "{name}: case {case}");
            assert_eq!(error, "", "{name}: case {case}");
        }
    }
}

fn results_of(study: &Study) -> Vec<&str> {
    study.results().collect()
}

/// Invalid values give failed cases with the message of `check`, and do not affect later cases.
#[test]
fn what_check_refuses_is_a_failed_case() {
    let masses = json!([0.02, -0.01, 0.0, 1e-45, 0.02, 1e35, 0.021]);
    let file = |results: Value| {
        let file = with(p1(1, 10), "results", results);
        let mut file = with(file, "vary", json!({ "bodies.slider.mass": { "list": masses } }));
        file.as_object_mut().unwrap().remove("cases");
        file
    };
    let folder = tempfile::tempdir().unwrap();
    let rows = |name: &str, results: Value| {
        let (study, out) = (study(&file(results)), folder.path().join(name));
        run(&study, &out, 1);
        table(&study, &out).1
    };
    let quick = rows("quick", json!(["slider.x_m"]));
    let whole = rows("whole", json!(["slider.x_m", "counts.steps"]));
    for (quick, whole) in quick.iter().zip(&whole) {
        assert_eq!((&quick[2], &quick[3]), (&whole[2], &whole[4]));
    }
    let failed: Vec<bool> = quick.iter().map(|row| !row[3].is_empty()).collect();
    assert_eq!(failed, [false, true, true, true, false, true, false]);
    assert!(
        quick[1][3].contains("bodies.slider.mass") && quick[1][3].contains("got -0.01"),
        "{}",
        quick[1][3]
    );
    assert_eq!(quick[0][2], quick[4][2]);
    assert!(quick.iter().all(|row| row[2].is_empty() != row[3].is_empty()));
}

/// The content is the same for one and two threads, for shards in any order, after an interruption, and for a larger study.
#[test]
fn parts_depend_on_the_study_alone() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    let whole = study(&p1(1000, 64));
    assert_eq!(whole.parts(), 16);
    run(&whole, &place("one"), 1);
    run(&whole, &place("two"), 2);
    let one = digest(&place("one"));
    assert_eq!(one, digest(&place("two")));
    for shard in (1..=7).rev() {
        let shard: Shard = format!("{shard}/7").parse().unwrap();
        whole.run(&place("shards"), (shard, 1), &()).unwrap();
    }
    assert_eq!(one, digest(&place("shards")));
    let stop = After(std::sync::atomic::AtomicUsize::new(0));
    assert!(whole.run(&place("stopped"), (Shard::WHOLE, 1), &stop).unwrap().interrupted);
    let status = whole.status(&place("stopped")).unwrap();
    assert!(status.parts > 0 && status.parts < 16, "{status:?}");
    assert_eq!(whole.run(&place("stopped"), (Shard::WHOLE, 1), &()).unwrap().there, status.parts);
    assert_eq!(one, digest(&place("stopped")));
    // A larger study reuses complete parts; the last part had 40 cases.
    run(&study(&p1(960, 64)), &place("grown"), 2);
    let grown = whole.run(&place("grown"), (Shard::WHOLE, 2), &()).unwrap();
    assert_eq!((grown.there, grown.computed), (15, 1));
    assert_eq!(one, digest(&place("grown")));
    let smaller = study(&p1(500, 64)).status(&place("grown")).unwrap_err().to_string();
    assert!(smaller.contains("\"cases\" was larger"), "{smaller}");
}

/// Watcher that interrupts after some blocks.
struct After(std::sync::atomic::AtomicUsize);

impl Watcher for After {
    fn reached(&self, _: f64) {
        self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    }
    fn goes_on(&self) -> bool {
        self.0.load(std::sync::atomic::Ordering::Relaxed) < 15
    }
}

#[test]
fn a_damaged_part_is_computed_again_and_a_foreign_one_is_not_touched() {
    let folder = tempfile::tempdir().unwrap();
    let own = study(&p1(200, 50));
    run(&own, folder.path(), 2);
    let before = digest(folder.path());
    let second = folder.path().join("part-000002.parquet");
    let bytes = fs::read(&second).unwrap();
    for left in [0, 1, 4, bytes.len() / 2, bytes.len() - 1] {
        fs::write(&second, &bytes[..left]).unwrap();
        let status = own.status(folder.path()).unwrap();
        assert_eq!((status.missing, status.damaged), (vec![2], vec![2]));
        let incomplete = own.statistics(folder.path()).unwrap_err();
        assert!(matches!(incomplete, StudyError::Incomplete { missing: 1, of: 4 }));
        run(&own, folder.path(), 1);
        assert_eq!(before, digest(folder.path()), "{left} bytes");
    }
    for (key, value) in [
        ("seed", json!(2)),
        ("chunk", json!(100)),
        ("results", json!(["slider.x_m"])),
        ("sampling", json!("random")),
        ("set", json!({ "run.stepper.event.tolerance": 1e-6, "run.cycles": 6 })),
        (
            "vary",
            json!({ "contacts.ball.friction": { "uniform": [0.1, 0.21] }, "bodies.slider.mass": { "normal": [0.02, 0.001] } }),
        ),
    ] {
        let other = study(&with(p1(200, 50), key, value));
        let refused = other.run(folder.path(), (Shard::WHOLE, 1), &()).unwrap_err();
        assert!(matches!(refused, StudyError::Foreign { .. }), "{key}: {refused}");
        assert!(other.remove(folder.path()).is_err());
        assert_eq!(before, digest(folder.path()), "{key}");
    }
    fs::write(folder.path().join("part-000001.parquet"), "PAR1 and nothing else PAR1").unwrap();
    assert_eq!(own.status(folder.path()).unwrap().damaged, [1]);
}

/// Grids, lists and samples: case i has sample ⌊i/G⌋ at point i mod G; the last axis of the file changes fastest.
#[test]
fn cases_are_samples_at_each_point_of_the_product() {
    let file = json!({
        "stickslip_study": 1, "scenario": "p1.json", "cases": 3,
        "vary": {
            "contacts.ball.normal.force": { "log": ["0.1 N", "10 N", 3] },
            "contacts.ball.friction": { "uniform": [0.1, 0.2] },
            "waveforms.drive.sawtooth.stroke": { "grid": ["0.4 um", "0.5 um", 2] },
        },
        "results": ["slider.x_m"],
    });
    let study = study(&file);
    assert_eq!(study.cases(), 18);
    let values: Vec<Vec<f64>> = (0..18).map(|case| study.values(case)).collect();
    for (case, own) in values.iter().enumerate() {
        assert!((own[0] / [0.1, 1.0, 10.0][case / 2 % 3] - 1.0).abs() < 1e-15);
        assert_eq!(own[1], values[case / 6 * 6][1]);
        assert_eq!(own[2], [0.4e-6, 0.5e-6][case % 2]);
    }
    // Each sampling fills the range, and cases can be requested in any order.
    for sampling in ["sobol", "random", "latin-hypercube"] {
        let study = self::study(&with(with(p1(512, 100), "sampling", json!(sampling)), "seed", json!(3)));
        let mut friction: Vec<f64> = (0..512).map(|case| study.values(case)[0]).collect();
        assert_eq!(study.values(17)[0], friction[17]);
        friction.sort_by(f64::total_cmp);
        let off = |(k, value): (usize, &f64)| (value - 0.1 - 0.1 * (k as f64 + 0.5) / 512.0).abs();
        let worst = friction.iter().enumerate().map(off).fold(0.0, f64::max);
        // Kolmogorov–Smirnov distance: random numbers exceed 1.95/sqrt(n) once in a thousand cases.
        assert!(
            worst < if sampling == "random" { 0.1 * 1.95 / 512f64.sqrt() } else { 0.1 / 512.0 },
            "{sampling}: {worst}"
        );
    }
}

/// The friction force at gross slip is μ (4/3) E* √R d^(3/2), a product with closed-form indices. For independent factors with means m_i,
/// variances v_i and q_i = v_i / m_i², the variance is Π m² (Π(1 + q) - 1). The first-order index is q_i, the total index q_i Π (1 + q_j)
/// over j other than i, both relative to Π(1 + q) - 1.
#[test]
fn indices_of_a_product_are_those_of_its_factors() {
    let file = json!({
        "stickslip_study": 1, "sampling": "saltelli", "cases": 8192, "chunk": 100_000,
        "scenario": {
            "stickslip": 1,
            "materials": { "steel": { "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 } },
            "waveforms": { "push": { "triangle": { "stroke": "40 um", "period": "4 s" } } },
            "bodies": { "foot": { "x": { "follows": "push" } } },
            "contacts": { "ball": {
                "between": ["foot", "ground"], "materials": ["steel", "steel"],
                "profile": { "paraboloid": { "radius": "1 mm" } }, "friction": 0.15, "normal": { "indentation": "1 um" }
            } },
            "run": { "duration": "1 s", "stepper": { "event": { "tolerance": 1e-6 } } }
        },
        "vary": {
            "contacts.ball.friction": { "uniform": [0.1, 0.2] },
            "materials.steel.youngs_modulus": { "uniform": ["100 GPa", "300 GPa"] },
            "contacts.ball.normal.indentation": { "uniform": ["0.5 um", "1.5 um"] },
        },
        "results": ["ball.fx_N"],
    });
    let folder = tempfile::tempdir().unwrap();
    let study = study(&file);
    assert_eq!(study.cases(), 8192 * 5);
    run(&study, folder.path(), 2);
    let found = study.indices(folder.path()).unwrap();
    // Mean of x^n over [a, b].
    let mean = |n: f64, a: f64, b: f64| (b.powf(n + 1.0) - a.powf(n + 1.0)) / ((n + 1.0) * (b - a));
    let q = [(1.0, 0.1, 0.2), (1.0, 1.0, 3.0), (1.5, 0.5, 1.5)]
        .map(|(n, a, b)| mean(2.0 * n, a, b) / mean(n, a, b).powi(2) - 1.0);
    let all = q.iter().map(|q| 1.0 + q).product::<f64>();
    for ((path, index), q) in found.indices.0[0].1.0.iter().zip(q) {
        let (first, total) = (q / (all - 1.0), q * all / (1.0 + q) / (all - 1.0));
        assert!((index.first.0 - first).abs() < 1e-3, "{path}: {} {first}", index.first.0);
        assert!((index.total.0 - total).abs() < 1e-3, "{path}: {} {total}", index.total.0);
    }
}

#[test]
fn what_is_wrong_with_a_study_is_said_with_its_place() {
    let wrong = |key: &str, value: Value| refused(&with(p1(10, 10), key, value));
    let vary = |path: &str, how: Value| wrong("vary", json!({ path: how }));
    let uniform = json!({ "uniform": [0.1, 0.2] });
    for (said, expected) in [
        (vary("contacts.bal.friction", uniform.clone()), "did you mean \"ball\"?"),
        (vary("contacts.ball.materials[0]", uniform.clone()), "got a text"),
        (vary("contacts.ball.friction", json!({ "uniform": [0.2, 0.1] })), "below"),
        (vary("contacts.ball.friction", json!({ "uniform": [0.1] })), "uniform"),
        (
            vary("contacts.ball.friction", json!({ "grid": [0.2, 0.1, 5] })),
            "the first value must be below the last",
        ),
        (
            vary("contacts.ball.friction", json!({ "grid": [0.1, 0.2, 0] })),
            "expected a number of values from 1",
        ),
        (vary("contacts.ball.friction", json!({ "list": [] })), "expected at least one value"),
        (vary("contacts.ball.friction", json!({ "log": [0.0, 0.2, 5] })), "above 0"),
        (vary("contacts.ball.friction", json!({ "normal": [0.1, 0.0] })), "above 0"),
        (vary("contacts.ball.friction", json!({ "normal": [0.1, 0.1, 0.2] })), "got 3 entries"),
        (vary("contacts.ball.friction", json!({ "gauss": [0.1, 0.2] })), "\"gauss\""),
        (
            vary("contacts.ball.friction", json!({ "uniform": ["1 N", "2 N"] })),
            "expected a number, got \"1 N\"",
        ),
        (vary("bodies.slider.mass", json!({ "uniform": ["1 N", "2 N"] })), "N is a unit of a force"),
        (vary("contacts.ball.count", uniform.clone()), "is a count"),
        (
            vary("contacts.ball.friction", json!({ "uniform": [0.1, 0.2, 0.3] })),
            "expected 2 entries, got 3 entries",
        ),
        (vary("run.cycles", json!({ "list": [3] })), "run.cycles varies"),
        (wrong("vary", json!({})), "no number varies"),
        (wrong("results", json!([])), "at least one result"),
        (wrong("results", json!(["slider.x", "slider.x"])), "named twice"),
        (wrong("results", json!(["steps.stedy"])), "did you mean \"steps.steady\"?"),
        (wrong("results", json!(["timing.wall_s"])), "differs from run to run"),
        (wrong("results", json!(["title"])), "a text"),
        (wrong("results", json!(["steps"])), "several results"),
        (wrong("chunk", json!(0)), "chunk"),
        (wrong("cases", json!(4_000_000_000_u64)), "increase \"chunk\""),
        (wrong("cases", json!(0)), "at least 1 sample"),
        (wrong("scenario", json!("p2.json")), "there is no file"),
        (wrong("scenario", json!(3)), "path of a scenario file"),
        (wrong("sampling", json!("product")), "no distributions"),
        (wrong("stickslip_study", json!(2)), "expected 1"),
        (wrong("colour", json!(2)), "unknown key"),
        (wrong("set", json!({ "contacts.bal.friction": 1 })), "did you mean \"ball\"?"),
    ] {
        assert!(said.contains(expected), "{said}\n{expected}");
        assert!(said.contains("study.json:") || said.contains("--set"), "{said}");
    }
    let mut without = p1(10, 10);
    without.as_object_mut().unwrap().remove("cases");
    assert!(refused(&without).contains("distributions need \"cases\""));
    let grid = with(p1(10, 10), "vary", json!({ "contacts.ball.friction": { "list": [0.1] } }));
    assert!(refused(&grid).contains("leave this key out"));
}
