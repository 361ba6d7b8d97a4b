//! The benchmark drive with other profiles and with a sine, by closed-form leaps, compared with a Runge–Kutta–Nyström method.

use std::path::PathBuf;
use stickslip_drive::{Method, Model, State, run};
use stickslip_scenario::Scenario;

/// Models and the final slider positions after 20 periods, m, computed by Runge–Kutta–Nyström steps at a tolerance of 1e-13.
const STEPPED: [(&str, f64); 3] = [
    ("p1_cone", 9.64957582475719e-6),
    ("p1_power4", 1.0370759769434074e-5),
    ("p1_sphere", 1.0084259523886863e-5),
];
/// Length of less than a fifteenth of u_c of these models, m.
const LENGTH: f64 = 3e-9;

/// Returns the final state of a run at a tolerance, and the slider position, m.
fn ended(name: &str, tolerance: &str) -> (State, f64) {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(format!("{name}.json"));
    let scenario = Scenario::load_with(&file, &[("run.stepper.event.tolerance", tolerance)]).unwrap();
    let model = Model::new(&scenario.scene).unwrap();
    let mut state = model.start(&scenario.plan).unwrap();
    run(&model, &scenario.plan, &mut state, &mut ()).unwrap();
    let (place, _) = state.body(&model, 1).unwrap();
    (state, place)
}

/// Errors are below a fifteenth of the tolerance in u_c, except for rounding, and every interval is one leap.
#[test]
fn other_profiles_swing_to_where_steps_lead() {
    for (name, stepped) in STEPPED {
        for (tolerance, allowed) in [("1e-3", 1e-3), ("1e-6", 1e-6), ("1e-9", 1e-9), ("1e-12", 1e-10)] {
            let (state, place) = ended(name, tolerance);
            let off = (place - stepped).abs();
            println!("{name} at {tolerance}: {off:e} m");
            assert!(off < allowed * LENGTH, "{name} at {tolerance}: {off:e} m");
            let leaps = state.tally().steps(Method::Swing) + state.tally().steps(Method::Parabola);
            assert_eq!(leaps, state.counts().steps, "{name} at {tolerance}");
        }
    }
}

/// Final slider position of P1 with a sine, m, computed by time steps at a tolerance of 1e-13.
const SINE: f64 = -1.4017567711419356e-7;

/// Errors are below a fifteenth of the tolerance in u_c, and every slip interval is one leap.
#[test]
fn slides_over_a_sine_end_where_steps_lead() {
    for (tolerance, allowed) in [("1e-3", 1e-3), ("1e-6", 1e-6), ("1e-9", 1e-9), ("1e-12", 1e-11)] {
        let (state, place) = ended("p1_sine", tolerance);
        let off = (place - SINE).abs();
        println!("p1_sine at {tolerance}: {off:e} m");
        assert!(off < allowed * LENGTH, "{tolerance}: {off:e} m");
        // 41 intervals start, and the last one has no end.
        assert_eq!(state.tally().steps(Method::Parabola), 40, "{tolerance}: {:?}", state.tally());
    }
}
