//! Fields and friction maps of runs: their integrals equal the forces and the friction work of the run.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::path::Path;
use stickslip_run::folder::Folder;
use stickslip_run::{Job, Recorder};

/// Rows of a table by column name.
type Rows = Vec<BTreeMap<String, String>>;

/// Runs an example with overrides and returns its tables by name.
fn tables(name: &str, set: &[(&str, &str)]) -> BTreeMap<&'static str, Rows> {
    let root = tempfile::tempdir().unwrap();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name);
    let set: Vec<_> = set.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let job = Job::prepare(&file.with_extension("json"), &set, root.path()).unwrap();
    let folder = Folder::make(&job.folder).unwrap();
    let recorder = Recorder::new(&job, &()).with_tables(&folder).unwrap();
    let (outcome, drafts) = job.run_recorded(recorder).unwrap();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    let table = |path: &Path| {
        let text = std::fs::read_to_string(path).unwrap();
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let head = lines.next().unwrap();
        lines.map(|cells| head.iter().cloned().zip(cells).collect()).collect()
    };
    drafts.iter().map(|draft| (draft.name, table(draft.file.path()))).collect()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap()
}

/// Returns 2π ∫ f r dr at the last time of a contact, by the trapezoidal rule with equal radii.
fn over_area(rows: &Rows, contact: &str, column: &str) -> f64 {
    let last = number(rows.last().unwrap(), "time_s");
    let rows = rows.iter().filter(|row| row["contact"] == contact && number(row, "time_s") == last);
    let points: Vec<(f64, f64)> = rows.map(|row| (number(row, "r_m"), number(row, column))).collect();
    let ring = |pair: &[(f64, f64)]| {
        let [(r, f), (s, g)] = pair else { unreachable!() };
        PI * (r * f + s * g) * (s - r)
    };
    points.windows(2).map(ring).sum()
}

/// An example, its contact, the number of identical contacts, and overrides.
type Case = (&'static str, &'static str, f64, &'static [(&'static str, &'static str)]);

/// Examples with a ball: quasi-static and dynamic, memory curve and spring row, constant and varying load, long displacements.
const CASES: [Case; 6] = [
    ("fretting_sphere", "800 nm", 1.0, &[]),
    ("quickstart", "ball", 3.0, &[("run.duration", "30 ms")]),
    (
        "quickstart",
        "ball",
        3.0,
        &[("run.duration", "12 ms"), ("run.stepper", r#"{"verlet":{"step":"1 us"}}"#)],
    ),
    (
        "quickstart",
        "ball",
        3.0,
        &[("run.duration", "12 ms"), ("contacts.ball.engine", r#"{"springs":{"count":4000}}"#)],
    ),
    ("oblique_impact", "foot", 1.0, &[]),
    ("p1", "ball", 1.0, &[("run.cycles", "30")]),
];

#[test]
fn stresses_and_the_map_of_friction_add_up_to_forces_and_friction() {
    for (name, contact, count, set) in CASES {
        let fields = ("output.fields", r#"{"radii": 1201}"#);
        let set = [&[fields, ("plots", "[]")], set].concat();
        let tables = tables(name, &set);
        let end = tables["trace.csv"].last().unwrap();
        let of = |column: &str| number(end, &format!("{contact}.{column}")) / count;
        let normal = over_area(&tables["fields.csv"], contact, "p_Pa");
        let shear = over_area(&tables["fields.csv"], contact, "tau_Pa");
        let work = over_area(&tables["friction.csv"], contact, "work_J_m2");
        let limit = of("fn_N").max(1e-30);
        assert!((normal - of("fn_N")).abs() < 1e-3 * limit, "{name}: F_N {normal}");
        assert!((shear - of("fx_N")).abs() < 1e-3 * limit, "{name}: F_x {shear}");
        assert!((work / of("friction_J") - 1.0).abs() < 1e-3, "{name}: friction {work}");
    }
}

#[test]
fn who_asks_for_fields_gets_the_same_run() {
    for (name, _, _, set) in CASES {
        let without = tables(name, &[&[("plots", "[]")], set].concat());
        let with = tables(name, &[&[("plots", "[]"), ("output.fields", r#"{"radii": 5}"#)], set].concat());
        assert_eq!(with["trace.csv"], without["trace.csv"], "{name}");
        assert_eq!(with["events.csv"], without["events.csv"], "{name}");
        assert!(!without.contains_key("fields.csv"));
    }
}

#[test]
fn an_open_contact_answers_with_nothing_and_its_friction_stays() {
    let fields = ("output.fields", r#"{"radii": 31, "at": ["1 us", "12 us"], "extent": "40 um"}"#);
    let tables = tables("oblique_impact", &[fields, ("plots", "[]")]);
    let end = number(tables["trace.csv"].last().unwrap(), "time_s");
    assert!(end > 12e-6, "{end}");
    let rows = &tables["fields.csv"];
    assert_eq!(rows.len(), 62);
    let pressed = rows.iter().filter(|row| row["state"] != "open").count();
    assert!(pressed > 3, "{pressed}");
    for row in rows.iter().filter(|row| row["state"] == "open") {
        assert_eq!((number(row, "p_Pa"), number(row, "tau_Pa")), (0.0, 0.0));
    }
    let work = |k: usize| number(&tables["friction.csv"][k], "work_J_m2");
    assert!((0..31).all(|k| work(31 + k) >= work(k)));
}
