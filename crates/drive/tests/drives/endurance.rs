//! Long runs: the behaviour far from the start equals that near it.

use crate::parts::{column, contact, end, event, fitted_order, foot_and_slider, p1, push, trace, wave};
use stickslip_contact::Profile;
use stickslip_drive::Shape;
use stickslip_drive::scene::{Named, Side};

const PERIOD: f64 = 1e-3;

/// 5 000 periods of P1, over 40 000 u_c. Its steps are constant from the tenth on, 502.996042090 nm (`tests/data/drive_p1.json`).
/// Rounding of a position of 2.5 mm is 1e-12 of a step.
#[test]
fn steps_far_away_are_those_near_by() {
    let periods = 5000.0;
    let (model, state, rows) = trace(&p1(), &event(1e-11, periods * PERIOD), PERIOD);
    let x = column(&model, &rows, "slider.x_m");
    let known = 502.996_042_090e-9;
    let worst = x.windows(2).skip(10).map(|w| ((w[1] - w[0]) / known - 1.0).abs()).fold(0.0, f64::max);
    println!("x = {:e} m, steps within {worst:.1e}", state.body(&model, 1).unwrap().0);
    assert!(x[5000] > 2.5e-3 && worst < 2e-11, "{worst:e}");
    // Rows count from the initial positions: u is the foot minus the slider.
    let [foot, u] = ["foot.x_m", "ball.u_m"].map(|name| column(&model, &rows, name));
    for ((u, foot), x) in u.iter().zip(&foot).zip(&x) {
        assert!((u - (foot - x)).abs() < 1e-18, "{u:e} {foot:e} {x:e}");
    }
}

/// The energy balance closes far away, with work of a load and friction.
#[test]
fn energy_books_close_far_away() {
    let ball = contact(crate::parts::FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    let drive = wave("drive", Shape::Sawtooth { stroke: 0.5e-6, flyback: 1e-4 }, PERIOD);
    let mut scene = foot_and_slider(drive, 0.02, ball);
    scene.loads.push(push(1, 0.03));
    let (model, state, rows) = trace(&scene, &event(1e-10, 1.0), 0.1);
    let [input, error] = ["energy.input_J", "energy.error_J"].map(|name| column(&model, &rows, name));
    println!(
        "x = {:e} m, input {:e} J, missing {:e} J",
        state.body(&model, 1).unwrap().0,
        input[10],
        error[10]
    );
    assert!(input[10] > 1e-6);
    assert!(error.iter().all(|error| error.abs() < 1e-9 * input[10]), "{error:?}");
}

/// Under constant load the stepper has order 8 through all events. Two sliders, because a single one is solved in closed form.
#[test]
fn order_through_the_events_of_p1() {
    let known = 1.008_428_628_032_075e-5;
    let mut twins = p1();
    let (slider, mut ball) = (twins.bodies[1].clone(), twins.contacts[0].clone());
    twins.bodies.push(Named { name: "twin".into(), ..slider });
    (ball.name, ball.part.between[1]) = ("its ball".into(), Side::Body(2));
    twins.contacts.push(ball);
    let points: Vec<(f64, f64)> = (5..=10)
        .map(|exponent| {
            let (model, state) = end(&twins, &event(10_f64.powi(-exponent), 20.0 * PERIOD));
            let [one, other] = [1, 2].map(|body| state.body(&model, body).unwrap().0);
            assert_eq!(one, other);
            (1.0 / state.counts().evaluations as f64, (one - known).abs())
        })
        .collect();
    let order = fitted_order(&points);
    println!("order {order:.1}, {points:?}");
    assert!(order > 7.0);
}
