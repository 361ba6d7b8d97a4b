//! `stickslip-lab bench`: what accuracy costs.

use crate::program::{Table, code, lab, listing, scenario, stderr, stdout};
use std::path::Path;
use tempfile::tempdir;

/// x(20 ms) of P1 by two unrelated methods in 50 digits, as in `crates/drive/tests/data/drive_p1.json`.
fn known() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../drive/tests/data/drive_p1.json");
    let data: serde_json::Value = serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    format!("p1:slider.x_m={}", data["slider_x_m_at_20_ms"])
}

/// Runs of one method on one engine: tolerance or step, error of the trajectory, seconds, error against what is known.
struct Runs(Vec<[f64; 4]>);

impl Runs {
    fn read(table: &Table, method: &str, engine: &str, springs: &str) -> Self {
        let place = |name: &str| table.head.iter().position(|head| head == name).unwrap();
        let keys = [("method", method), ("engine", engine), ("springs", springs)];
        let own = table.rows.iter().filter(|row| keys.iter().all(|(key, value)| row[place(key)] == *value));
        let runs = own.filter(|row| !row[place("end_error")].is_empty()).map(|row| {
            let value = if row[place("step_s")].is_empty() { "tolerance" } else { "step_s" };
            [value, "trajectory_error", "wall_s_per_s", "known_error"]
                .map(|name| row[place(name)].parse().unwrap_or(f64::NAN))
        });
        Self(runs.collect())
    }

    /// Order of the error in the tolerance or step: least squares in the logarithms.
    fn order(&self, runs: std::ops::Range<usize>) -> f64 {
        let points: Vec<(f64, f64)> = self.0[runs].iter().map(|run| (run[0].ln(), run[1].ln())).collect();
        let n = points.len() as f64;
        let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
        let (sxy, sxx) = points.iter().fold((0.0, 0.0), |(sxy, sxx), point| {
            (sxy + (point.0 - x) * (point.1 - y), sxx + (point.0 - x).powi(2))
        });
        sxy / sxx
    }
}

#[test]
fn p1_is_measured_by_every_stepper_and_engine() {
    let out = tempdir().unwrap();
    let mut command = lab();
    command.arg("bench").arg(scenario("p1")).args(["--budget", "8 s", "--known", &known()]);
    command.arg("--page").arg(out.path().join("page.md"));
    let output = command.arg("--out").arg(out.path()).output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_page(&std::fs::read_to_string(out.path().join("page.md")).unwrap(), out.path());
    let files = ["bench.csv", "work-precision-dark.png", "work-precision.png", "work-precision.svg"];
    assert_eq!(listing(&out.path().join("p1")), files);
    assert!(stdout(&output).contains("bench.csv"));
    let table = Table::read(&out.path().join("p1/bench.csv"));
    let event = Runs::read(&table, "event", "curve", "");
    assert_eq!(event.0.len(), 12);
    for [tolerance, error, _, known] in &event.0 {
        assert!(*error < 10.0 * tolerance + 1e-12, "{tolerance:e}: {error:e}");
        // The program's own reference is the published solution.
        assert!(*known < 10.0 * tolerance + 1e-12, "{tolerance:e}: {known:e}");
    }
    // Errors fall with the tolerance, up to the luck of one order.
    assert!(event.0.windows(2).all(|pair| pair[1][1] < 2.0 * pair[0][1]));
    let verlet = Runs::read(&table, "verlet", "curve", "");
    let order = verlet.order(1..verlet.0.len().min(8));
    assert!(verlet.0.len() >= 6 && (order - 2.0).abs() < 0.3, "{order}");
    for springs in ["64", "256", "1024"] {
        for method in ["event", "dopri5", "rk4", "verlet"] {
            assert!(!Runs::read(&table, method, "springs", springs).0.is_empty(), "{method} {springs}");
        }
        // The loop shares no code with the program's rows and stepper, and makes the same steps.
        let own = Runs::read(&table, "verlet", "springs", springs);
        let others = Runs::read(&table, "loop", "springs", springs);
        let pairs: Vec<_> = own.0.iter().zip(&others.0).collect();
        assert!(pairs.len() > 3);
        assert!(pairs.iter().all(|(a, b)| (a[1] - b[1]).abs() < 1e-6 && a[0] == b[0]), "{pairs:?}");
    }
    for (method, springs) in [("loop-rk4", "64"), ("exact-verlet", ""), ("exact-rk4", "")] {
        let engine = if springs.is_empty() { "curve" } else { "springs" };
        assert!(Runs::read(&table, method, engine, springs).0.len() > 3, "{method}");
    }
    // So many nodes, and neither tolerance nor step.
    for (method, most) in [("floor-4", 1e-4), ("floor-10", 1e-8), ("floor-16", 1e-9)] {
        let runs = Runs::read(&table, method, "curve", "");
        assert!(runs.0.len() == 1 && runs.0[0][1] < most && runs.0[0][0].is_nan(), "{method}: {:?}", runs.0);
    }
    let outside = Runs::read(&table, "ode_solvers", "curve", "");
    let last = outside.0[outside.0.len() - 1];
    assert!(last[0] < 1e-8 && last[3] < 1e-6, "{last:?}");
    // What has no result says why.
    let (errors, notes) = (table.column("end_error"), table.column("note"));
    assert!(errors.iter().zip(&notes).all(|(error, note)| error.is_empty() != note.is_empty()));
}

/// The page names its command, its links lead somewhere, and its tables are whole.
fn assert_page(page: &str, folder: &Path) {
    assert!(page.contains("stickslip-lab bench ") && page.contains("--known p1:slider.x_m=1.00842862803207"));
    // What is faster comes before all tables, and nothing is told that was not measured.
    let [faster, first] =
        ["**Where another method is faster**", "| ---"].map(|words| page.find(words).unwrap());
    assert!(faster < first && !page.contains('≈'));
    assert!(page.contains(concat!("by stickslip ", env!("CARGO_PKG_VERSION"))));
    let links = page.split("](").skip(1).map(|rest| rest.split_once(')').unwrap().0);
    let sources = page.split("src=\"").skip(1).map(|rest| rest.split_once('"').unwrap().0);
    let places: Vec<&str> = links.chain(sources).collect();
    // A table, an SVG, a picture.
    assert_eq!(places.len(), 3);
    assert!(places.iter().all(|place| folder.join(place).exists()), "{places:?}");
    let tables: Vec<&str> = page.lines().filter(|line| line.starts_with('|')).collect();
    let ratios = tables.iter().filter(|line| line.starts_with("| `p1` | 1e-"));
    assert_eq!(ratios.map(|line| line.matches('|').count()).collect::<Vec<_>>(), [11, 11, 11, 10, 10, 10]);
    assert_eq!(tables.iter().filter(|line| line.starts_with("| 1e-")).count(), 12);
}

#[test]
fn growth_is_measured_where_nothing_else_changes() {
    let out = tempdir().unwrap();
    let mut command = lab();
    command
        .args(["bench", "--growth", "--out"])
        .arg(out.path())
        .arg("--page")
        .arg(out.path().join("page.md"));
    let output = command.output().unwrap();
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(listing(out.path()), ["growth-dark.png", "growth.csv", "growth.png", "growth.svg", "page.md"]);
    let page = std::fs::read_to_string(out.path().join("page.md")).unwrap();
    assert!(page.contains("## Scaling") && page.contains("src=\"growth.png\""), "{page}");
    let table = Table::read(&out.path().join("growth.csv"));
    let column = |name: &str| table.head.iter().position(|head| head == name).unwrap();
    let numbers = |what: &str, name: &str| -> Vec<f64> {
        let rows = table.rows.iter().filter(|row| row[0] == what);
        rows.map(|row| row[column(name)].parse().unwrap()).collect()
    };
    // Rows are written between steps, and springs are visited in every step: neither changes the steps.
    for what in ["rows_per_period", "springs"] {
        let steps = numbers(what, "steps");
        assert!(steps.len() > 3 && steps.iter().all(|count| *count == steps[0]), "{what}: {steps:?}");
    }
    // The same work in every period, but for the first ones.
    let work: Vec<f64> = numbers("simulated_s", "evaluations")
        .iter()
        .zip(numbers("simulated_s", "size"))
        .map(|(evaluations, time)| evaluations / time)
        .collect();
    assert!(work.windows(2).skip(1).all(|pair| (pair[1] / pair[0] - 1.0).abs() < 0.02), "{work:?}");
    // Every swing leaves a corner, and the small one inside does not mind them.
    let (depth, steps) = (numbers("knots", "size"), numbers("knots", "steps"));
    assert!(depth.windows(2).all(|pair| pair[1] > pair[0]) && depth[depth.len() - 1] > 200.0, "{depth:?}");
    let last = steps[steps.len() - 1];
    assert!(steps.iter().all(|count| (count / last - 1.0).abs() < 0.1), "{steps:?}");
}

#[test]
fn the_loop_knows_loads_that_vary_and_bodies_that_turn() {
    let out = tempdir().unwrap();
    let mut command = lab();
    command.arg("bench").args([scenario("sine_drive"), scenario("oblique_impact")]);
    let output = command.args(["--budget", "4 s", "--quiet", "--out"]).arg(out.path()).output().unwrap();
    assert_eq!((code(&output), stdout(&output), stderr(&output)), (0, String::new(), String::new()));
    for name in ["sine_drive", "oblique_impact"] {
        let table = Table::read(&out.path().join(name).join("bench.csv"));
        // Independent of the program's engines and steppers, and it comes to the same motion at second order.
        let runs = Runs::read(&table, "loop", "springs", "256");
        let order = runs.order(2..7);
        assert!((order - 2.0).abs() < 0.35 && runs.0[6][1] < 1e-3, "{name}: {order}, {:?}", runs.0);
        assert!(Runs::read(&table, "exact-rk4", "curve", "").0.is_empty());
        assert!(Runs::read(&table, "ode_solvers", "curve", "").0.is_empty());
    }
}

/// What valgrind is to count runs once and leaves nothing behind; how it counts is no matter of a test.
#[test]
fn what_is_counted_runs_alone() {
    for what in ["1e-3", "floor:4", "floor:16"] {
        let output =
            lab().args(["bench", "--quiet", "--counted", what]).arg(scenario("p1")).output().unwrap();
        assert!(
            output.status.success() && output.stdout.is_empty() && output.stderr.is_empty(),
            "{output:?}"
        );
    }
    let output = lab().args(["bench", "--counted", "floor"]).arg(scenario("p1")).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let out = tempdir().unwrap();
    let bench = |name: &str, more: &[&str]| {
        let mut command = lab();
        command.arg("bench").arg(scenario(name)).args(more).arg("--out").arg(out.path().join("out"));
        let output = command.output().unwrap();
        (code(&output), stderr(&output))
    };
    let (code, said) = bench("fretting_sphere", &[]);
    assert!(code == 2 && said.contains("fretting_sphere: no coordinate is free"), "{code} {said}");
    let (code, said) = bench("p1", &["--known", "p1:foot.x_m=1"]);
    assert!(code == 2 && said.contains("expected a free coordinate, one of slider.x_m"), "{code} {said}");
    let (code, said) = bench("p1", &["--known", "p2:slider.x_m=1"]);
    assert!(
        code == 2 && said.contains("--known p2: expected the name of a scenario of the command"),
        "{code} {said}"
    );
    let (code, said) = bench("p1", &["--budget", "0 s"]);
    assert!(code == 2 && said.contains("expected a time above 0"), "{code} {said}");
    assert!(!out.path().join("out").exists());
}
