//! Tests that steps of a run allocate no memory.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test fails by panicking, and prints what it measured"
)]

#[path = "drives/parts.rs"]
#[allow(dead_code, reason = "shared with the tests of drives")]
mod parts;

use parts::{FOOT_SLIDER, contact, damped, event, foot_and_slider, p1, plan, sine, wave};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Normal, Scene, Varying};
use stickslip_drive::{Command, Cycle, Generator, Heading, Model, Plan, Run, Shape, Stepper, Steps, run};

/// Allocations of a run of this duration (s), including the workspace.
fn allocations(scene: &Scene, plan: &Plan) -> u64 {
    let model = Model::new(scene).unwrap();
    let mut state = model.start(plan).unwrap();
    allocation_counter::measure(|| run(&model, plan, &mut state, &mut ()).unwrap()).count_total
}

/// Slider on a sine with a varying normal force: its contact grows, shrinks, stops and reverses.
fn shaken() -> Scene {
    let mut pressed = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    pressed.normal = Normal::Force(Varying::Follows(1));
    let mut scene = foot_and_slider(wave("drive", sine(0.5e-6), 1e-3), 0.02, pressed);
    scene.waveforms.push(wave("pressing", Shape::Sine { amplitude: 0.4, phase: 0.3, offset: 1.0 }, 2e-3));
    scene
}

/// P1 with a contact damping of one second, which makes it stiff.
fn stiff() -> Scene {
    let mut scene = p1();
    scene.contacts[0].part = damped(&scene.contacts[0].part, 1.0);
    scene
}

/// A run of ten times the duration allocates no more: the workspace is allocated at the start.
#[test]
fn stepping_allocates_nothing() {
    for (name, scene) in [("P1", p1()), ("shaken", shaken()), ("stiff", stiff())] {
        for tolerance in [1e-3, 1e-8] {
            let [short, long] =
                [20e-3, 200e-3].map(|duration| allocations(&scene, &event(tolerance, duration)));
            println!("{name}, tolerance {tolerance:e}: {short} allocations in 20 ms, {long} in 200 ms");
            assert_eq!(short, long);
        }
    }
}

/// Fixed steps, which commit every contact at every step, allocate nothing.
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

/// A generator that is commanded between frames allocates nothing.
#[test]
fn commands_allocate_nothing() {
    let initial =
        Command { stroke: 0.5e-6, frequency: 1e3, heading: Heading::Forward, steps: Steps::Left(0) };
    let (cycle, strokes) = (Cycle::Sawtooth { flyback: 1e-5 }, (0.0, 1e-6));
    let generator = Generator { cycle, initial, strokes, frequencies: (0.0, 5e3) };
    let ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
    let scene = foot_and_slider(wave("drive", Shape::Generator(generator), 1.0), 0.02, ball);
    let model = Model::new(&scene).unwrap();
    for stepper in [Stepper::Event { tolerance: 1e-8 }, Stepper::Verlet { step: 2e-6 }] {
        let plan = plan(stepper, 1.0);
        let mut run = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
        let mut frames = |from: u32, to: u32| {
            for k in from..to {
                let heading = if k % 3 == 0 { Heading::Backward } else { Heading::Forward };
                let steps = if k % 7 == 0 { Steps::Endless } else { Steps::Left(u64::from(k % 4)) };
                let frequency = 1e3 + 100.0 * f64::from(k % 40);
                run.command(0, Command { stroke: 1e-8 * f64::from(k % 100), frequency, heading, steps })
                    .unwrap();
                run.advance(f64::from(k) * 137e-6, &mut ()).unwrap();
                assert!(run.state().generated(0).is_some());
            }
        };
        // The memory has reached its largest depth.
        frames(1, 1500);
        let count = allocation_counter::measure(|| frames(1500, 3000)).count_total;
        println!("{}: {count} allocations in 1500 commands", stepper.name());
        assert_eq!(count, 0);
    }
}
