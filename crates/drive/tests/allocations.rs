//! Once a model is built and its start made, stepping allocates nothing.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and prints what it measured"
)]

#[path = "drives/parts.rs"]
#[allow(dead_code, reason = "shared with the tests of drives")]
mod parts;

use parts::{FOOT_SLIDER, contact, event, foot_and_slider, p1, plan, sine, wave};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Normal, Scene, Varying};
use stickslip_drive::{Model, Plan, Shape, Stepper, run};

/// Allocations of a run of so many seconds, the workspace included.
fn allocations(scene: &Scene, plan: &Plan) -> u64 {
    let model = Model::new(scene).unwrap();
    let mut state = model.start(plan).unwrap();
    allocation_counter::measure(|| run(&model, plan, &mut state, &mut ()).unwrap()).count_total
}

/// A slider on a sine, pressed by a force that varies: contacts that grow, shrink, stop and turn.
fn shaken() -> Scene {
    let mut pressed = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    pressed.normal = Normal::Force(Varying::Follows(1));
    let mut scene = foot_and_slider(wave("drive", sine(0.5e-6), 1e-3), 0.02, pressed);
    scene.waveforms.push(wave("pressing", Shape::Sine { amplitude: 0.4, phase: 0.3, offset: 1.0 }, 2e-3));
    scene
}

/// Ten times as long a run allocates no more: all of it is the workspace, made at the start.
#[test]
fn stepping_allocates_nothing() {
    for (name, scene) in [("P1", p1()), ("shaken", shaken())] {
        for tolerance in [1e-3, 1e-8] {
            let [short, long] =
                [20e-3, 200e-3].map(|duration| allocations(&scene, &event(tolerance, duration)));
            println!("{name}, tolerance {tolerance:e}: {short} allocations in 20 ms, {long} in 200 ms");
            assert_eq!(short, long);
        }
    }
}

/// Nor do fixed steps, which commit every contact at every step.
#[test]
fn fixed_steps_allocate_nothing() {
    let step = 2e-6;
    for (name, scene) in [("P1", p1()), ("shaken", shaken())] {
        for stepper in [Stepper::Verlet { step }, Stepper::Rk4 { step }] {
            let [short, long] = [20e-3, 200e-3].map(|duration| allocations(&scene, &plan(stepper, duration)));
            println!("{name}, {}: {short} allocations in 20 ms, {long} in 200 ms", stepper.name());
            assert_eq!(short, long);
        }
    }
}
