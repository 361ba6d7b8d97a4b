//! What goes on inside the contacts: `springs.csv` and `memory.csv`.

use crate::program::{Table, code, listing, number, run, run_example, scenario, stderr, summary};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use tempfile::tempdir;

/// A steel ball as a paraboloid under a constant load, rubbed by a sine, and what its closed form needs.
struct Rig {
    /// Indentation, m.
    d: f64,
    /// κ = μE\*/G\*.
    slope: f64,
    amplitude: f64,
}

const RADIUS: f64 = 5e-3;
const FRICTION: f64 = 0.6;
const LOAD: f64 = 10.0;

impl Rig {
    fn new(amplitude: f64) -> Self {
        let (modulus, nu) = (210e9_f64, 0.3_f64);
        let normal = modulus / (2.0 * (1.0 - nu * nu));
        let tangential = modulus / ((2.0 - nu) * (1.0 + nu));
        let d = (0.75 * LOAD / (normal * RADIUS.sqrt())).powf(2.0 / 3.0);
        Self { d, slope: FRICTION * normal / tangential, amplitude }
    }

    /// Half the width of the contact, a = √(Rd), m.
    fn radius(&self) -> f64 {
        (RADIUS * self.d).sqrt()
    }

    fn scenario(&self, output: &Value) -> Value {
        json!({
            "stickslip": 1,
            "materials": { "steel": { "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 } },
            "waveforms": { "rub": { "sine": { "amplitude": self.amplitude, "period": 1 } } },
            "bodies": { "rig": { "x": { "follows": "rub" } } },
            "contacts": { "ball": {
                "between": ["rig", "ground"], "materials": ["steel", "steel"], "friction": FRICTION,
                "profile": { "paraboloid": { "radius": RADIUS } }, "normal": { "force": LOAD }
            } },
            "run": { "duration": 2 },
            "output": output
        })
    }

    /// Where springs at these places, each as wide as its share of the contact, carry the load: E\*Δx Σ(d-h) = F_N, by halves.
    fn depth_of_row(&self, places: &[f64]) -> f64 {
        let normal = 210e9 / (2.0 * (1.0 - 0.09));
        let width = 2.0 * self.radius() / places.len() as f64;
        let force =
            |d: f64| normal * width * places.iter().map(|x| (d - x * x / RADIUS).max(0.0)).sum::<f64>();
        let (mut low, mut high) = (0.0, 2.0 * self.d);
        for _ in 0..100 {
            let d = 0.5 * (low + high);
            if force(d) < LOAD { low = d } else { high = d }
        }
        low
    }

    fn u(&self, t: f64) -> f64 {
        self.amplitude * (TAU * t).sin()
    }

    /// Stretch (m) and state of a spring at x, taken from turning point to turning point: s + Δu, clamped to ±κ(d-h), h = x²/R (4.22).
    fn spring(&self, x: f64, t: f64) -> (f64, &'static str) {
        let limit = self.slope * (self.d - x * x / RADIUS);
        let turns = (0..).map(|k| 0.25 + 0.5 * f64::from(k)).take_while(|turn| *turn < t);
        let (mut s, mut at, mut state) = (0.0, 0.0, "stick");
        for stop in turns.chain([t]) {
            let trial = s + self.u(stop) - at;
            (s, at) = (trial.clamp(-limit, limit), self.u(stop));
            state = if trial >= limit {
                "slip+"
            } else if trial <= -limit {
                "slip-"
            } else {
                "stick"
            };
        }
        (s, state)
    }
}

fn write(folder: &Path, scenario: &Value) -> PathBuf {
    let file = folder.join("rig.json");
    std::fs::write(&file, scenario.to_string()).unwrap();
    file
}

/// Runs a scenario written out; returns its folder.
fn results(out: &Path, scenario: &Value, set: &[&str]) -> PathBuf {
    let output = run(&write(out, scenario), &out.join("results"), set);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    out.join("results/rig")
}

fn numbers(table: &Table, column: &str) -> Vec<f64> {
    table.column(column).into_iter().map(|text| text.parse().unwrap()).collect()
}

#[test]
fn springs_do_what_the_clamped_sum_says() {
    let rig = Rig::new(500e-9);
    let u_c = rig.slope * rig.d;
    assert!(rig.amplitude < u_c);
    let out = tempdir().unwrap();
    let folder =
        results(out.path(), &rig.scenario(&json!({ "springs": { "count": 40, "every": "73 ms" } })), &[]);
    assert!(summary(&folder)["files"].as_array().unwrap().contains(&json!("springs.csv")));
    let table = Table::read(&folder.join("springs.csv"));
    assert_eq!(table.head.join(","), "time_s,contact,x_m,stretch_m,state,g_m,fx_N,fz_N,limit_N");
    // 0, 73 ms, … 1.971 s: none lies at a turning point.
    assert_eq!(table.rows.len(), 28 * 40);
    let (time, x, stretch) =
        (numbers(&table, "time_s"), numbers(&table, "x_m"), numbers(&table, "stretch_m"));
    let mut seen = std::collections::BTreeMap::new();
    for (i, state) in table.column("state").into_iter().enumerate() {
        assert_eq!(time[i], 0.073 * (i / 40) as f64);
        let place = (2.0 * (i % 40) as f64 - 39.0) / 40.0 * rig.radius();
        assert!((x[i] - place).abs() < 1e-12 * rig.radius(), "{} {place}", x[i]);
        let (s, known) = rig.spring(x[i], time[i]);
        assert!((stretch[i] - s).abs() < 1e-12 * u_c, "{i}: {} {s}", stretch[i]);
        assert_eq!(state, known, "{i}");
        // (4.22), (4.23): F_x over its limit is the stretch over κ(d-g), and the limit is μ times the normal force.
        let [g, fx, fz, limit] = ["g_m", "fx_N", "fz_N", "limit_N"].map(|name| numbers(&table, name)[i]);
        let most = rig.slope * (rig.d - g);
        assert!((fx * most - limit * s).abs() < 1e-12 * limit * u_c, "{i}: {fx} {limit}");
        assert!((fz * FRICTION - limit).abs() < 1e-12 * limit, "{i}: {fz} {limit}");
        *seen.entry(known).or_insert(0) += 1;
    }
    assert!(seen.len() == 3 && seen.values().all(|count| *count > 100), "{seen:?}");
    assert!(table.column("contact").iter().all(|name| *name == "ball"));
}

#[test]
fn a_row_of_springs_shows_its_own() {
    let mut rig = Rig::new(500e-9);
    let output = json!({ "springs": { "count": 7, "every": "73 ms" } });
    let out = tempdir().unwrap();
    let row = r#"contacts.ball.engine={"springs": {"count": 40}}"#;
    let table = Table::read(&results(out.path(), &rig.scenario(&output), &[row]).join("springs.csv"));
    assert_eq!(table.rows.len(), 28 * 40);
    let (time, x, stretch) =
        (numbers(&table, "time_s"), numbers(&table, "x_m"), numbers(&table, "stretch_m"));
    rig.d = rig.depth_of_row(&x[..40]);
    for (i, state) in table.column("state").into_iter().enumerate() {
        let (s, known) = rig.spring(x[i], time[i]);
        assert!((stretch[i] - s).abs() < 1e-12 * rig.slope * rig.d, "{i}: {} {s}", stretch[i]);
        assert_eq!(state, known, "{i}");
    }
}

#[test]
fn the_memory_is_the_curve_of_the_turning_points() {
    // At 0.1 s the edge u-κ(d-h) meets p = 0 at h = d-u/κ. At 0.4 s the edge u+κ(d-h) meets that of the turning point at
    // d-h = (A-u)/2κ. From 0.75 s on the two turning points ±A meet at d-h = A/κ, p = 0.
    let rig = Rig::new(500e-9);
    let (d, slope, a) = (rig.d, rig.slope, rig.amplitude);
    let out = tempdir().unwrap();
    let output = json!({ "memory": { "at": [0, "100 ms", "400 ms", "900 ms"] } });
    let folder = results(out.path(), &rig.scenario(&output), &[]);
    assert!(summary(&folder)["files"].as_array().unwrap().contains(&json!("memory.csv")));
    let table = Table::read(&folder.join("memory.csv"));
    assert_eq!(table.head.join(","), "time_s,contact,d_m,u_m,h_m,p_m");
    let half = |u: f64| (d - (a - u) / (2.0 * slope), 0.5 * (a + u));
    let [u1, u2, u3] = [0.1, 0.4, 0.9].map(|t| rig.u(t));
    let known = [
        (0.0, 0.0, vec![(0.0, 0.0), (d, 0.0)]),
        (0.1, u1, vec![(0.0, 0.0), (d - u1 / slope, 0.0), (d, u1)]),
        (0.4, u2, vec![(0.0, 0.0), (d - a / slope, 0.0), half(u2), (d, u2)]),
        (0.9, u3, {
            let (h, p) = half(-u3);
            vec![(0.0, 0.0), (d - a / slope, 0.0), (h, -p), (d, u3)]
        }),
    ];
    let mut lines = table.rows.iter();
    for (t, u, corners) in known {
        for (h, p) in corners {
            let line = lines.next().unwrap();
            assert_eq!(line[1], "ball");
            let numbers: Vec<f64> = [0, 2, 3, 4, 5].iter().map(|&i| line[i].parse().unwrap()).collect();
            for (got, want) in numbers.iter().zip([t, d, u, h, p]) {
                assert!((got - want).abs() <= 1e-13 * want.abs().max(d), "{line:?}: {want:e}");
            }
        }
    }
    assert!(lines.next().is_none());
}

#[test]
fn an_open_contact_has_open_springs_and_no_memory() {
    let rig = Rig::new(500e-9);
    let output = json!({ "springs": { "count": 5, "every": "250 ms" }, "memory": { "every": "250 ms" } });
    let out = tempdir().unwrap();
    let sine = r#"{"follows": {"sine": {"amplitude": "1 um", "offset": "0.5 um", "period": "1 s"}}}"#;
    let set = format!("contacts.ball.normal={{\"indentation\": {sine}}}");
    let folder = results(out.path(), &rig.scenario(&output), &[&set]);
    // The load is the deepest at 0.25 s, and lifted at 0.75 s.
    let springs = Table::read(&folder.join("springs.csv"));
    let open = springs.rows.iter().filter(|row| row[4] == "open");
    let mut open: Vec<&str> = open.map(|row| row[0].as_str()).collect();
    assert_eq!(open.iter().filter(|t| **t == "0.75").count(), 5);
    assert_eq!(open.iter().filter(|t| **t == "0.25").count(), 0);
    let curves = Table::read(&folder.join("memory.csv"));
    let mut times = curves.column("time_s");
    times.dedup();
    assert_eq!(times, ["0.0", "0.25", "0.5", "1.0", "1.25", "1.5", "2.0"]);
    open.clear();
    // A contact that is never pressed has neither.
    let never =
        results(out.path(), &rig.scenario(&output), &[r#"contacts.ball.normal={"indentation": "-1 nm"}"#]);
    for name in ["springs.csv", "memory.csv"] {
        assert_eq!(Table::read(&never.join(name)).rows.len(), 0, "{name}");
    }
}

#[test]
fn looking_inside_changes_nothing_else() {
    let out = tempdir().unwrap();
    let steppers = [
        r#"{"event": {}}"#,
        r#"{"verlet": {"step": "1 us"}}"#,
        r#"{"rk4": {"step": "1 us"}}"#,
        r#"{"dopri5": {}}"#,
    ];
    for (i, stepper) in steppers.into_iter().enumerate() {
        let stepper = format!("run.stepper={stepper}");
        let set = ["run.duration=20 ms", stepper.as_str(), "plots=[]"];
        let plain = run_example("quickstart", &out.path().join(format!("{i}")), &set);
        let inside = [
            "output.springs={\"every\": \"13 us\"}",
            "output.memory={\"every\": \"17 us\"}",
            "output.fields={\"every\": \"1 ms\", \"radii\": 7}",
        ];
        let looked =
            run_example("quickstart", &out.path().join(format!("{i} looked")), &[&set[..], &inside].concat());
        for name in ["trace.csv", "events.csv"] {
            let bytes = |folder: &Path| std::fs::read(folder.join(name)).unwrap();
            assert!(bytes(&plain) == bytes(&looked), "{stepper}: {name}");
        }
        assert_eq!(summary(&plain)["counts"], summary(&looked)["counts"], "{stepper}");
        // 20 ms / 13 us and one for t = 0, 101 springs.
        assert_eq!(Table::read(&looked.join("springs.csv")).rows.len(), 1539 * 101);
    }
}

#[test]
fn a_plot_asks_for_its_table_and_old_tables_go() {
    let out = tempdir().unwrap();
    let tables = |plots: &str| {
        let set = ["output={\"every\": \"10 ms\"}", &format!("plots={plots}")];
        let folder = run_example("oblique_loading", out.path(), &set);
        let names = listing(&folder).into_iter().filter(|name| name.ends_with(".csv"));
        (names.collect::<Vec<_>>().join(" "), folder)
    };
    assert_eq!(tables(r#"["state"]"#).0, "events.csv springs.csv trace.csv");
    let (names, folder) = tables(r#"["memory"]"#);
    assert_eq!(names, "events.csv memory.csv trace.csv");
    let mut times = numbers(&Table::read(&folder.join("memory.csv")), "time_s");
    times.dedup();
    assert_eq!(times.len(), 6);
    assert_eq!(times.last(), Some(&7.0));
    assert_eq!(tables("[]").0, "events.csv trace.csv");
}

#[test]
fn a_run_that_stops_leaves_its_looks() {
    let out = tempdir().unwrap();
    let set = [
        "run.limits.steps=200",
        "run.duration=25 ms",
        "output.springs={\"count\": 3}",
        "output.memory={\"every\": \"10 us\"}",
    ];
    let output = run(&scenario("quickstart"), out.path(), &set);
    assert_eq!(code(&output), 3, "{}", stderr(&output));
    let folder = out.path().join("quickstart");
    let trace = numbers(&Table::read(&folder.join("trace.csv")), "time_s");
    let mut springs = numbers(&Table::read(&folder.join("springs.csv")), "time_s");
    let mut curves = numbers(&Table::read(&folder.join("memory.csv")), "time_s");
    springs.dedup();
    curves.dedup();
    // The last row is that of the stop.
    assert!(trace.len() > 10);
    assert_eq!(springs, trace[..trace.len() - 1]);
    assert_eq!(curves, springs);
}

#[test]
fn info_says_how_much_there_will_be() {
    let out = tempdir().unwrap();
    let springs = r#"output.springs={"count": 21, "every": "0.3 ms"}"#;
    let set = ["run.duration=30 ms", springs, r#"output.memory={"every": "7 ms"}"#];
    let folder = run_example("quickstart", out.path(), &set);
    let arguments: Vec<&str> = set.iter().flat_map(|set| ["--set", *set]).collect();
    let info = crate::info::info(&scenario("quickstart"), &arguments);
    let lines = Table::read(&folder.join("springs.csv")).rows.len() as f64;
    assert_eq!(number(&info, "/expected/spring_lines"), lines);
    let size = std::fs::metadata(folder.join("springs.csv")).unwrap().len() as f64;
    let ratio = number(&info, "/expected/springs_B") / size;
    assert!((0.9..=1.1).contains(&ratio), "{ratio} of {size} B");
    let table = Table::read(&folder.join("memory.csv"));
    let mut curves = table.column("time_s");
    curves.dedup();
    assert_eq!(number(&info, "/expected/memory_curves"), curves.len() as f64);
    let plain = crate::info::info(&scenario("quickstart"), &[]);
    assert!(
        plain["expected"].get("spring_lines").is_none() && plain["expected"].get("memory_curves").is_none()
    );
}
