//! A stage that rests on its foot far from its initial position, with one flyback per period.
//!
//! Three silicon nitride balls on a foot of 500 mg with a stack of 50 N/µm, and a sawtooth of a few Hz. After the ringing has decayed,
//! rounding must not determine the time steps. Each model tests one case: a loop smaller than rounding, reversals of noise below 1e-12 u_c,
//! and the rounding of time in a flyback. The motion of the foot at 50 kHz limits the steps to 5/ω.

use serde_json::Value;
use stickslip_drive::scene::Axis;
use stickslip_run::{Job, Outcome, Summary};
use stickslip_scenario::Scenario;

const STAGE: &str = r#"{
  "stickslip": 1,
  "materials": { "nitride": { "youngs_modulus": "310 GPa", "poisson_ratio": 0.27 }, "steel": { "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 } },
  "waveforms": { "drive": { "sawtooth": { "stroke": "4 um", "period": "400 ms", "flyback": "200 us" } } },
  "bodies": { "foot": { "mass": "500 mg", "x": "free" }, "stage": { "mass": "35 g", "x": "free" } },
  "contacts": {
    "balls": {
      "between": ["foot", "stage"], "materials": ["nitride", "nitride"], "profile": { "paraboloid": { "radius": "1 mm" } },
      "friction": 0.12, "count": 3, "normal": { "force": "70 mN" }
    }
  },
  "actuators": {
    "stack": { "between": ["ground", "foot"], "direction": "x", "stiffness": "50 N/um", "damping": "300 N s/m", "stroke": { "follows": "drive" } }
  },
  "run": { "cycles": 1, "limits": { "steps": 1000000 } },
  "output": { "every": "100 s" },
  "plots": []
}"#;

/// Runs the stage with overrides and an integrator.
fn run(set: &[(&str, &str)], stepper: &str) -> (Job, Outcome) {
    let set: Vec<(&str, &str)> = set.iter().copied().chain([("run.stepper", stepper)]).collect();
    let scenario = Scenario::from_str_with(STAGE, "stage", "", &set).unwrap();
    let job = Job::new(scenario, "stage".to_owned(), "".into()).unwrap();
    let outcome = job.run(&());
    assert!(outcome.error.is_none(), "{stepper}: {:?}", outcome.error);
    (job, outcome)
}

fn located(set: &[(&str, &str)], tolerance: f64) -> (Job, Outcome) {
    run(set, &format!(r#"{{"event": {{"tolerance": {tolerance:e}}}}}"#))
}

/// Returns the largest distance of a body between two final states, relative to u_c.
fn off((job, one): &(Job, Outcome), (_, other): &(Job, Outcome)) -> f64 {
    let unit = job.model.contact_natural(0).unwrap().displacement;
    let apart = |body: usize| {
        let [a, b] = [one, other].map(|end| end.state.coordinate(&job.model, body, Axis::X).unwrap().0);
        (a - b).abs() / unit
    };
    f64::max(apart(0), apart(1))
}

/// Returns the energy error relative to the throughput.
fn books((job, outcome): &(Job, Outcome)) -> f64 {
    let summary: Value = serde_json::from_str(&Summary::new(job, outcome).pretty().unwrap()).unwrap();
    summary["energy"]["largest_error_relative"].as_f64().unwrap()
}

/// Time steps must not wait for the end of a loop that is smaller than rounding.
#[test]
fn no_step_waits_for_a_loop_of_which_less_than_a_last_place_is_left() {
    let tight = located(&[], 1e-12);
    for tolerance in [1e-6, 1e-7, 1e-8, 1e-9, 1e-10] {
        let end = located(&[], tolerance);
        let (counts, off, books) = (end.1.state.counts(), off(&end, &tight), books(&end));
        println!("{tolerance:e}: {counts:?}, {off:.1e} u_c off, books {books:.1e}");
        assert!(counts.steps < 35_000 && counts.detours == 0, "{tolerance:e}: {counts:?}");
        assert!(off < 10.0 * tolerance + 1e-8, "{tolerance:e}: {off:e}");
        assert!(books < 1e-10, "{tolerance:e}: {books:e}");
    }
}

/// The same by a method without events, up to the flyback.
#[test]
fn what_rests_on_the_foot_rests_where_fixed_steps_have_it() {
    let ramp = [("run", r#"{"duration": "399.8 ms", "limits": {"steps": 1000000}}"#)];
    let fixed = ["2 us", "1 us"].map(|step| run(&ramp, &format!(r#"{{"rk4": {{"step": "{step}"}}}}"#)));
    let own = off(&fixed[0], &fixed[1]);
    for tolerance in [1e-6, 1e-7, 1e-8, 1e-9] {
        let end = located(&ramp, tolerance);
        let off = off(&end, &fixed[1]);
        println!("{tolerance:e}: {off:.1e} u_c off, rk4 {own:.1e}");
        assert!(off < 10.0 * tolerance + own, "{tolerance:e}: {off:e}, rk4 {own:e}");
    }
}

/// Reversals of less than 1e-11 u_c are rounding and must not be events.
#[test]
fn turns_of_the_noise_of_rounding_are_no_events() {
    let set = [
        ("waveforms.drive.sawtooth", r#"{"stroke": "8 um", "period": "1 s", "flyback": "20 us"}"#),
        ("contacts.balls.materials", r#"["nitride", "steel"]"#),
        ("contacts.balls.profile", r#"{"paraboloid": {"radius": "0.75 mm"}}"#),
        ("contacts.balls.friction", "0.15"),
        ("contacts.balls.normal", r#"{"force": "0.3 N"}"#),
    ];
    let tight = located(&set, 1e-12);
    for (tolerance, most) in [(1e-6, 3_000), (1e-7, 3_000), (1e-8, 10_000)] {
        let end = located(&set, tolerance);
        let (counts, off) = (end.1.state.counts(), off(&end, &tight));
        println!("{tolerance:e}: {counts:?}, {off:.1e} u_c off");
        assert!(counts.events < most && counts.steps < 80_000, "{tolerance:e}: {counts:?}");
        assert!(off < 10.0 * tolerance + 1e-8, "{tolerance:e}: {off:e}");
    }
}

#[test]
fn a_flyback_late_in_a_run_is_not_cut_to_the_rounding_of_time() {
    let set = [
        ("waveforms.drive.sawtooth", r#"{"stroke": "8 um", "period": "400 ms", "flyback": "50 us"}"#),
        ("contacts.balls.materials", r#"["nitride", "steel"]"#),
        ("contacts.balls.profile", r#"{"paraboloid": {"radius": "0.5 mm"}}"#),
        ("contacts.balls.friction", "0.1"),
        ("contacts.balls.normal", r#"{"force": "0.2 N"}"#),
        ("actuators.stack.stiffness", r#""100 N/um""#),
        ("actuators.stack.damping", r#""100 N s/m""#),
    ];
    let tight = located(&set, 1e-12);
    for tolerance in [1e-8, 1e-9, 1e-10, 1e-11] {
        let end = located(&set, tolerance);
        let (counts, off, books) = (end.1.state.counts(), off(&end, &tight), books(&end));
        println!("{tolerance:e}: {counts:?}, {off:.1e} u_c off, books {books:.1e}");
        assert!(counts.steps < 50_000, "{tolerance:e}: {counts:?}");
        assert!(off < 10.0 * tolerance + 1e-8, "{tolerance:e}: {off:e}");
        assert!(books < 1e-10, "{tolerance:e}: {books:e}");
    }
}
