//! Figures of fretting loops against closed forms, and against other rows.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;
use stickslip_results::cycles::CycleFigures;
use stickslip_results::{Job, Summary};

fn example(name: &str, set: &[(&str, &str)]) -> Job {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name).with_extension("json");
    prepare(&file, set)
}

fn prepare(file: &Path, set: &[(&str, &str)]) -> Job {
    let set: Vec<_> = set.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    Job::prepare(file, &set, Path::new("")).unwrap()
}

fn last_cycle(job: &Job, c: usize) -> CycleFigures {
    let outcome = job.run(&());
    assert!(outcome.error.is_none());
    outcome.cycles(c).last().unwrap().figures
}

fn near(got: f64, want: f64, within: f64, what: &str) {
    assert!(
        (got - want).abs() <= within * want.abs(),
        "{what}: {got:e}, not {want:e}: {:e}",
        got / want - 1.0
    );
}

/// A paraboloid under a constant load, F = μF_N(1 - (1 - u/u_c)^{3/2}) on first loading (Cattaneo 1938, Mindlin 1949); the
/// branches of its loop follow by Masing's rule.
#[test]
fn a_loop_of_a_paraboloid_has_its_closed_forms() {
    let profile = r#"{"paraboloid": {"radius": "10 mm"}}"#;
    let names = ["200 nm", "400 nm"];
    let set: Vec<(String, String)> =
        names.iter().map(|name| (format!("contacts.{name}.profile"), profile.to_owned())).collect();
    let set: Vec<(&str, &str)> = set.iter().map(|(k, v)| (k.as_str(), v.as_str())).collect();
    let job = example("fretting_sphere", &set);
    for (c, amplitude) in [(0, 200e-9), (1, 400e-9)] {
        check_paraboloid(&job, c, amplitude, &last_cycle(&job, c));
    }
}

/// The same of a table of points, whose cycles go from one reversal to the next of its kind: every one of them.
#[test]
fn the_loops_of_a_table_have_theirs() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/table_loop.json");
    let job = prepare(&file, &[]);
    let outcome = job.run(&());
    let found: Vec<CycleFigures> = outcome.cycles(0).iter().map(|cycle| cycle.figures).collect();
    let times: Vec<[f64; 2]> = found.iter().map(|cycle| cycle.time).collect();
    assert_eq!(times, [[1.0, 5.0], [5.0, 9.0]]);
    found.iter().for_each(|cycle| check_paraboloid(&job, 0, 300e-9, cycle));
}

/// A triangle from 0 to its stroke and back: the same loop about another middle. Its opening was taken at F_x = 0, and partial slip
/// called mixed.
#[test]
fn a_loop_about_another_middle_is_the_same_loop() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/table_loop.json");
    let triangle = r#"{"triangle": {"stroke": "600 nm", "period": "2 s"}}"#;
    let job = prepare(&file, &[("waveforms.t", triangle)]);
    check_paraboloid(&job, 0, 300e-9, &last_cycle(&job, 0));
    let summary = Summary::new(&job, &job.run(&()));
    let contact = &summary.contacts.0[0].1;
    assert_eq!(contact.fretting.as_ref().and_then(|fretting| fretting.regime), Some("partial"));
}

/// Nothing is free and nothing swings: 100 000 steps of a walk were called a crawl after 2 037 s.
#[test]
fn a_walk_of_many_periods_comes_to_its_end() {
    let job =
        example("fretting_sphere", &[("run.duration", "\"5000 s\""), ("output", "{}"), ("plots", "[]")]);
    let outcome = job.run(&());
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    assert_eq!(outcome.cycles(0).len(), 5000);
}

fn check_paraboloid(job: &Job, c: usize, amplitude: f64, found: &CycleFigures) {
    let CycleFigures { cycle, is_closed, secants, .. } = found;
    let (u_c, normal) = job.contact_scale(c);
    assert!(amplitude < u_c);
    let limit = f64::from(job.count(c)) * job.model.contacts().nth(c).unwrap().1.friction() * normal;
    let force = |u: f64| limit * (1.0 - (1.0 - u / u_c).powf(1.5));
    // The branch down: F = F(δ) - 2F((δ - u)/2). It vanishes where F(v) = F(δ)/2, v = u_c(1 - (1 - F/2μF_N)^{2/3}).
    let top = force(amplitude);
    let half = u_c * (1.0 - (1.0 - 0.5 * top / limit).powf(2.0 / 3.0));
    let opening = amplitude - 2.0 * half;
    // Area: from the mean of F over the way, ∫₀^δ F dv = μF_N(δ - ⅖u_c(1 - (1 - δ/u_c)^{5/2})).
    let under = limit * (amplitude - 0.4 * u_c * (1.0 - (1.0 - amplitude / u_c).powf(2.5)));
    let lost = 8.0 * under - 4.0 * amplitude * top;
    let window = 0.2 * amplitude;
    let secant = 2.0 * force(0.5 * window) / window;
    assert!(is_closed);
    near(cycle.displacement_amplitude, amplitude, 1e-12, "amplitude");
    near(cycle.force_amplitude, top, 1e-12, "force");
    // Both are small differences of forces: their rounding is that of the loop's height and width.
    near(cycle.dissipated, lost, 1e-11, "friction work");
    near(cycle.half_opening.unwrap(), opening, 1e-11, "opening");
    for found in [cycle.stiffness_after_maximum, cycle.stiffness_after_minimum] {
        near(found.unwrap(), 1.5 * limit / u_c, 1e-12, "tangent");
    }
    for found in secants {
        near(found.unwrap(), secant, 1e-10, "secant");
    }
}

/// E_d of the table is the difference of the friction work that a run with a row at either end of the cycle writes down.
#[test]
fn friction_work_of_a_cycle_is_the_difference_of_the_runs_own() {
    let job = example("fretting_sphere", &[("output.every", "\"1 s\"")]);
    let outcome = job.run(&());
    let channels = job.model.channels();
    let place = |name: &str| channels.iter().position(|channel| channel.name == name).unwrap();
    struct Rows(Vec<Vec<f64>>);
    impl stickslip_drive::Record for Rows {
        fn row(&mut self, values: &[f64]) {
            self.0.push(values.to_vec());
        }
        fn event(&mut self, _: &stickslip_drive::Event, _: &[f64]) {}
    }
    let mut rows = Rows(Vec::new());
    stickslip_drive::run(&job.model, &job.scenario.plan, &mut job.start.clone(), &mut rows).unwrap();
    for (c, (name, _)) in job.model.contacts().enumerate() {
        let at = |k: usize| rows.0[k][place(&format!("{name}.friction_J"))];
        let found = outcome.cycles(c);
        assert_eq!(found.len(), 3, "{name}");
        for (k, cycle) in found.iter().enumerate() {
            near(cycle.figures.cycle.dissipated, at(k + 1) - at(k), 1e-12, name);
        }
    }
}

/// Steps and loops, to the bit, under every stepper.
#[test]
fn figures_do_not_depend_on_the_rows() {
    let figures = |name: &str, stepper: &str, every: &str| {
        let job = example(name, &[("run.stepper", stepper), ("output.every", every), ("plots", "[]")]);
        let outcome = job.run(&());
        assert!(outcome.error.is_none(), "{name} {stepper}");
        let summary: serde_json::Value =
            serde_json::from_str(&Summary::new(&job, &outcome).pretty().unwrap()).unwrap();
        let loops = summary["contacts"].as_object().unwrap().values();
        let loops: Vec<_> = loops.map(|contact| contact["fretting"].clone()).collect();
        (summary["steps"].clone(), loops)
    };
    let steppers = [
        r#"{"event": {"tolerance": 1e-6}}"#,
        r#"{"verlet": {"step": "2 us"}}"#,
        r#"{"rk4": {"step": "2 us"}}"#,
        r#"{"dopri5": {"tolerance": 1e-6}}"#,
    ];
    for stepper in steppers {
        for name in ["quickstart", "three_ball_stage", "oblique_loading"] {
            let wanted = figures(name, stepper, "1e3");
            for every in ["\"31.3 us\"", "\"0.2 ms\""] {
                assert_eq!(figures(name, stepper, every), wanted, "{name}, {stepper}, {every}");
            }
        }
    }
    let sphere = |every| figures("fretting_sphere", r#"{"event": {"tolerance": 1e-8}}"#, every);
    assert_eq!(sphere("\"7 ms\""), sphere("1e3"));
}

/// The contact that holds the vibrated slider never moves: its amplitude, 8e-25 m of a u_c of 6e-8 m, was rounding, and how many
/// of its cycles came back hung on the tolerance.
#[test]
fn a_contact_at_rest_has_no_loop() {
    let told = |tolerance: &str| {
        let set = [("run.stepper.event.tolerance", tolerance), ("plots", "[]"), ("run.cycles", "8")];
        let job = example("vibrated_slider", &set);
        let summary = Summary::new(&job, &job.run(&()));
        serde_json::to_value(&summary).unwrap()["contacts"]["still"]["fretting"].clone()
    };
    let all = ["1e-5", "1e-6", "1e-8"].map(told);
    for fretting in &all {
        assert_eq!(fretting["regime"], "still", "{fretting}");
        assert_eq!(fretting["cycles"], all[0]["cycles"]);
        let ratios = ["energy_ratio", "slip_ratio", "half_opening_m", "stiffness_after_maximum_N_m"];
        assert!(ratios.iter().all(|ratio| fretting.get(ratio).is_none()), "{fretting}");
    }
}
