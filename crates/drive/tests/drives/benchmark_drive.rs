//! Benchmark drive P1, compared with a reference by two independent methods in 50-digit and 113-bit arithmetic, which agree to
//! 5e-19 (`tests/data/drive_p1.json`).

use crate::parts::{column, end, event, fitted_order, p1, plan, trace};
use stickslip_drive::{Plan, Stepper};

const STROKE: f64 = 0.5e-6;
const END: f64 = 20e-3;

/// x and v at 20 ms and the first eight steps, SI.
struct Reference {
    x: f64,
    v: f64,
    steps: Vec<f64>,
}

fn reference() -> Reference {
    let data: serde_json::Value = serde_json::from_str(include_str!("../data/drive_p1.json")).unwrap();
    let number = |key: &str| data[key].as_f64().unwrap();
    let steps = data["steps_nm_first_eight"].as_array().unwrap();
    Reference {
        x: number("slider_x_m_at_20_ms"),
        v: number("slider_v_m_per_s_at_20_ms"),
        steps: steps.iter().map(|s| s.as_f64().unwrap() * 1e-9).collect(),
    }
}

/// Error of x(20 ms) in strokes, and the number of evaluations.
fn error(plan: &Plan) -> (f64, u64) {
    let (model, state) = end(&p1(), plan);
    ((state.body(&model, 1).unwrap().0 - reference().x).abs() / STROKE, state.counts().evaluations)
}

#[test]
fn the_scene_is_the_one_of_the_reference() {
    let data: serde_json::Value = serde_json::from_str(include_str!("../data/drive_p1.json")).unwrap();
    let derived = |key: &str| data["derived"][key].as_f64().unwrap();
    let model = stickslip_drive::Model::new(&p1()).unwrap();
    let (u_c, force) = model.contact_scale(0).unwrap();
    assert!((u_c / derived("gross_slip_displacement_m") - 1.0).abs() < 2e-7, "{u_c:e}");
    assert!((force / data["normal_force_N"].as_f64().unwrap() - 1.0).abs() < 1e-14);
    let stuck = (derived("tangential_stiffness_N_per_m") / data["slider_mass_kg"].as_f64().unwrap()).sqrt();
    assert!((model.contact_frequency(0).unwrap() / stuck - 1.0).abs() < 2e-7);
}

#[test]
fn position_velocity_and_steps_meet_the_reference() {
    let reference = reference();
    let (model, state, rows) = trace(&p1(), &event(1e-10, END), 1e-3);
    let (x, v) = state.body(&model, 1).unwrap();
    let (dx, dv) = (x / reference.x - 1.0, v / reference.v - 1.0);
    println!("tolerance 1e-10: x off by {dx:e}, v by {dv:e} (relative)");
    assert!(dx.abs() < 1e-9 && dv.abs() < 1e-9);
    let at: Vec<f64> = column(&model, &rows, "slider.x_m");
    // The reference has a resolution of 1e-9 nm.
    for (pair, step) in at.windows(2).zip(&reference.steps) {
        assert!((pair[1] - pair[0] - step).abs() < 2e-9 * 1e-9 + 1e-10 * STROKE, "{:e}", pair[1] - pair[0]);
    }
    assert_eq!(at.len(), 21);
}

#[test]
fn the_event_steppers_error_falls_with_its_tolerance() {
    for exponent in 3..=13 {
        let tolerance = 10_f64.powi(-exponent);
        let (error, evaluations) = error(&event(tolerance, END));
        println!("event {tolerance:e}: error {error:.2e} of the stroke, {evaluations} evaluations");
        // Twenty periods of about eight intervals; rounding alone is about 1e-14.
        assert!(error < 10.0 * tolerance + 1e-13);
    }
}

#[test]
fn fixed_steps_are_second_order_at_best() {
    // Steps that divide rise and fall, so that no step crosses a corner.
    let steps: Vec<f64> = (3..=9).map(|k| 1e-4 / f64::from(1 << k)).collect();
    for (name, stepper) in [
        ("verlet", (|step| Stepper::Verlet { step }) as fn(f64) -> Stepper),
        ("rk4", |step| Stepper::Rk4 { step }),
    ] {
        let errors: Vec<(f64, f64)> = steps.iter().map(|h| (*h, error(&plan(stepper(*h), END)).0)).collect();
        let order = fitted_order(&errors);
        println!("{name}: order {order:.2}, {errors:?}");
        assert!((1.5..3.0).contains(&order));
        assert!(errors.last().unwrap().1 < 1e-4);
    }
}

#[test]
fn the_plain_reference_stepper_without_events_converges_but_misses_its_tolerance() {
    let errors: Vec<(f64, f64)> = (3..=10)
        .map(|exponent| {
            let tolerance = 10_f64.powi(-exponent);
            let (error, evaluations) = error(&plan(Stepper::Dopri5 { tolerance }, END));
            println!("dopri5 {tolerance:e}: error {error:.2e} of the stroke, {evaluations} evaluations");
            (tolerance, error)
        })
        .collect();
    assert!(errors.last().unwrap().1 < 1e-3);
    assert!(errors.iter().any(|(tolerance, error)| error > &(10.0 * tolerance)));
}
