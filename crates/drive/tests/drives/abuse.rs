//! Extreme models end, or stop with an error within their limits.

use crate::lottery::Draw;
use crate::parts::{
    FOOT_SLIDER, contact, damper, event, foot_and_slider, free, named, p1, piezo, plan, push, sine, wave,
};
use stickslip_contact::Profile;
use stickslip_drive::scene::{
    Actuator, ContactStart, Coordinate, Normal, Scene, Side, Spring, Start, Varying,
};
use stickslip_drive::{Field, Limits, Model, Part, Plan, RunError, Shape, Stepper, Trace, run};

const GROUND_SLIDER: [Side; 2] = [Side::Ground, Side::Body(1)];

/// Runs with at most `steps` steps; all rows are finite.
fn survives(scene: &Scene, plan: &Plan, title: &str) -> Result<(), RunError> {
    let model = Model::new(scene).unwrap_or_else(|e| panic!("{title}: {e}"));
    let Ok(mut state) = model.start(plan) else { return Ok(()) };
    let mut trace = Trace::new(&model);
    let outcome = run(&model, plan, &mut state, &mut trace);
    let tried = state.counts().steps + state.counts().rejected;
    assert!(tried <= plan.limits.steps + 1, "{title}: {:?}", state.counts());
    match &outcome {
        Ok(()) => assert_eq!(state.time(), plan.duration, "{title}"),
        Err(error) => assert!(!error.to_string().is_empty() && !error.advice().is_empty()),
    }
    // Unstable explicit steps stop before energies overflow.
    assert!(trace.rows().flatten().all(|x| x.is_finite()), "{title}: {outcome:?}");
    outcome
}

/// A position of 1e148 m is finite, but its kinetic energy is not.
#[test]
fn a_motion_whose_energy_is_no_number_stops() {
    let bodies = vec![named("slider", free(0.02))];
    let scene = Scene { bodies, loads: vec![push(0, 1e155)], ..Scene::default() };
    let limits = Limits { steps: 10_000, ..Limits::default() };
    for stepper in [Stepper::Verlet { step: 1e-5 }, Stepper::Rk4 { step: 1e-5 }] {
        let plan = Plan { every: Some(1e-5), limits, ..plan(stepper, 1e-3) };
        let outcome = survives(&scene, &plan, "pushed away");
        assert!(matches!(outcome, Err(RunError::NotFinite { .. })), "{stepper:?}: {outcome:?}");
    }
}

fn pick(draw: &mut Draw, of: &[f64]) -> f64 {
    of[(draw.bits() % of.len() as u64) as usize]
}

fn profile(draw: &mut Draw) -> Profile {
    let profile = match draw.bits() % 5 {
        0 => Profile::paraboloid(draw.spread(1e-6, 1e2)),
        1 => Profile::cone(draw.spread(1e-4, 1e2)),
        2 => Profile::flat(draw.spread(1e-9, 1e-1)),
        3 => Profile::foundation(&[0.0, 0.0, 1e-9, 1e-3], &[1e-6; 4]),
        _ => Profile::foundation_power(1e12, 8.0),
    };
    profile.unwrap()
}

fn shape(draw: &mut Draw, period: f64) -> Shape {
    let stroke = draw.sign() * pick(draw, &[0.0, 1e-15, 1e-9, 1e-6, 1e-2, 1e3]);
    match draw.bits() % 5 {
        0 => Shape::Sawtooth { stroke, flyback: pick(draw, &[1e-9, 0.01, 0.5, 0.999_999]) * period },
        1 => sine(stroke),
        2 => Shape::Triangle { stroke },
        3 => Shape::Cycloid { stroke, flyback: pick(draw, &[1e-9, 0.3]) * period },
        _ => Shape::Table { points: vec![(0.0, 0.0), (0.2 * period, stroke), (0.9 * period, -stroke)] },
    }
}

/// Masses from 1e-9 to 1e3 kg, stiffnesses from 1e-3 to 1e12 N/m, μ from 0 to 1000, forces from 0, periods from 1e-9 s
/// to 1e3 s, damping up to 1e9 N s/m.
fn extreme(seed: u64) -> (Scene, f64) {
    let mut draw = Draw::new(seed ^ 0xabad_1dea);
    let period = pick(&mut draw, &[1e-9, 1e-6, 1e-3, 1.0, 1e3]);
    let friction = pick(&mut draw, &[0.0, 1e-9, 0.2, 1.0, 1000.0]);
    let force = pick(&mut draw, &[0.0, 1e-12, 1e-3, 1.0, 1e6]);
    let mut ball = contact(FOOT_SLIDER, profile(&mut draw), friction, force);
    ball.count = pick(&mut draw, &[1.0, 3.0, 1e6]) as u32;
    let mass = pick(&mut draw, &[1e-9, 1e-3, 1.0, 1e3]);
    let shape = shape(&mut draw, period);
    let mut scene = foot_and_slider(wave("drive", shape, period), mass, ball);
    if draw.bits() & 1 == 0 {
        let amplitude = draw.between(0.0, 1.0) * force;
        let pressing = Shape::Sine { amplitude, phase: 0.0, offset: force };
        scene.waveforms.push(wave("pressing", pressing, period * pick(&mut draw, &[1e-3, 0.7, 1e3])));
        scene.contacts[0].part.normal = Normal::Force(Varying::Follows(1));
    }
    let (stiffness, damping) =
        (pick(&mut draw, &[1e-3, 1.0, 1e6, 1e12]), pick(&mut draw, &[0.0, 1e-3, 1e3, 1e9]));
    match draw.bits() % 3 {
        0 => scene.springs.push(named("tie", Spring { stiffness, ..damper(GROUND_SLIDER, damping) })),
        1 => {
            scene.bodies[0].part = free(pick(&mut draw, &[1e-9, 1e-3, 1e3]));
            let between = [Side::Ground, Side::Body(0)];
            scene
                .actuators
                .push(named("stack", Actuator { damping, ..piezo(between, stiffness, Varying::Follows(0)) }));
        }
        _ => {}
    }
    if draw.bits() & 1 == 0 {
        scene.loads.push(push(1, draw.sign() * pick(&mut draw, &[1e-12, 1e-3, friction * force, 1e6])));
    }
    if draw.bits().is_multiple_of(4) {
        scene.start = Start::Equilibrium;
    }
    (scene, period)
}

#[test]
fn extreme_scenes_end_or_say_why_not() {
    let (mut ended, mut stopped) = (0, std::collections::BTreeMap::new());
    for seed in 0..400 {
        let (scene, period) = extreme(seed);
        let limits = Limits { steps: 3_000, events: 2_000, wall: Some(20.0) };
        let stepper = match seed % 4 {
            3 => [
                Stepper::Verlet { step: period / 500.0 },
                Stepper::Rk4 { step: period / 300.0 },
                Stepper::Dopri5 { tolerance: 1e-4 },
            ][(seed / 4 % 3) as usize],
            _ => Stepper::Event { tolerance: [1e-3, 1e-6, 1e-9][(seed % 4) as usize] },
        };
        let plan = Plan { limits, every: Some(0.13 * period), ..plan(stepper, 1.5 * period) };
        match survives(&scene, &plan, &format!("seed {seed}")) {
            Ok(()) => ended += 1,
            Err(RunError::OutOfTime { .. }) => panic!("seed {seed}: 3000 steps took 20 s"),
            Err(error) => *stopped.entry(error.advice()).or_insert(0) += 1,
        }
    }
    println!("{ended} of 400 ended, the others: {stopped:#?}");
    // The other half contains time scales too different for the limit of steps.
    assert!(ended > 150);
}

#[test]
fn a_contact_without_friction_or_without_force_does_nothing() {
    for (friction, force) in [(0.0, 1.0), (0.2, 0.0)] {
        let ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), friction, force);
        let mut scene = foot_and_slider(wave("drive", sine(1e-6), 1e-3), 0.02, ball);
        scene.loads.push(push(1, 0.01));
        let model = Model::new(&scene).unwrap();
        let plan = event(1e-9, 10e-3);
        let mut state = model.start(&plan).unwrap();
        run(&model, &plan, &mut state, &mut ()).unwrap();
        // x = ½(F/m)t²
        let x = 0.5 * (0.01 / 0.02) * 1e-4;
        assert!((state.body(&model, 1).unwrap().0 / x - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_contact_that_never_slips_is_a_spring() {
    // μ = 1000: the slider follows the foot like an oscillator, m ẍ = k(s - x), s = A sin ωt, from rest; k = 2G*b.
    let (amplitude, radius, mass, t) = (1e-7, 20e-6, 0.02, 4.3e-3);
    let ball = contact(FOOT_SLIDER, Profile::flat(radius).unwrap(), 1000.0, 1.0);
    let natural = (2.0 * ball.interface.tangential_modulus() * radius / mass).sqrt();
    let scene = foot_and_slider(wave("drive", sine(amplitude), 1e-3), mass, ball);
    let model = Model::new(&scene).unwrap();
    // The tolerance is relative to u_c, here some thousand amplitudes.
    let plan = event(1e-13, t);
    let mut state = model.start(&plan).unwrap();
    run(&model, &plan, &mut state, &mut ()).unwrap();
    let ratio = std::f64::consts::TAU / 1e-3 / natural;
    let x = amplitude / (1.0 - ratio * ratio) * ((ratio * natural * t).sin() - ratio * (natural * t).sin());
    let off = (state.body(&model, 1).unwrap().0 - x).abs() / amplitude;
    println!("off by {off:.1e} of the amplitude");
    assert!(off < 1e-8);
}

#[test]
fn loads_at_the_very_limit_of_friction() {
    for part in [1.0 - 1e-15, 1.0, 1.0 + 1e-15, 1.0 + 1e-6] {
        for stepper in [Stepper::Event { tolerance: 1e-9 }, Stepper::Verlet { step: 1e-6 }] {
            let mut scene = p1();
            scene.loads.push(push(1, part * 0.15));
            let limits = Limits { steps: 100_000, events: 50_000, wall: Some(20.0) };
            let _ = survives(&scene, &Plan { limits, ..plan(stepper, 10e-3) }, "limit");
            scene.start = Start::Equilibrium;
            let _ = survives(&scene, &Plan { limits, ..plan(stepper, 10e-3) }, "limit, equilibrium");
        }
    }
}

#[test]
fn a_normal_force_that_touches_zero_lets_go_and_grips_again() {
    for phase in [0.0, 1.0, -std::f64::consts::FRAC_PI_2] {
        let mut ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
        ball.normal = Normal::Force(Varying::Follows(1));
        ball.start = ContactStart::Untouched;
        let mut scene = foot_and_slider(wave("drive", sine(2e-7), 1e-3), 0.02, ball);
        let pressing = Shape::Sine { amplitude: 1.0, phase, offset: 1.0 };
        scene.waveforms.push(wave("pressing", pressing, 0.7e-3));
        let limits = Limits { steps: 100_000, events: 20_000, wall: Some(20.0) };
        let plan = Plan { limits, every: Some(1e-5), ..event(1e-8, 10e-3) };
        survives(&scene, &plan, "touches zero").unwrap();
    }
}

/// Friction without a normal force does not affect steps, whether or not the normal force varies. The equilibrium of a model
/// without free coordinates is its start.
#[test]
fn where_nothing_is_free_the_equilibrium_is_the_start() {
    let punch = contact(FOOT_SLIDER, Profile::flat(1e-5).unwrap(), 0.2, 1.0);
    let mut scene = foot_and_slider(wave("drive", sine(1e-7), 1e-3), 0.01, punch);
    scene.bodies[1].part.x = Coordinate::default();
    let plan = event(1e-8, 1e-3);
    let given = Model::new(&scene).unwrap().start(&plan).unwrap();
    scene.start = Start::Equilibrium;
    assert_eq!(Model::new(&scene).unwrap().start(&plan).unwrap(), given);
}

#[test]
fn a_varying_contact_without_friction_or_without_force_does_nothing() {
    for (friction, force) in [(0.0, 1.0), (0.2, 0.0)] {
        let mut ball = contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), friction, 1.0);
        ball.normal = Normal::Force(Varying::Follows(1));
        let mut scene = foot_and_slider(wave("drive", sine(1e-6), 1e-3), 0.02, ball);
        let pressing = Shape::Sine { amplitude: 0.5 * force, phase: 0.0, offset: force };
        scene.waveforms.push(wave("pressing", pressing, 0.7e-3));
        scene.loads.push(push(1, 0.01));
        let model = Model::new(&scene).unwrap();
        let plan = event(1e-9, 10e-3);
        let mut state = model.start(&plan).unwrap();
        run(&model, &plan, &mut state, &mut ()).unwrap();
        let x = 0.5 * (0.01 / 0.02) * 1e-4;
        assert!((state.body(&model, 1).unwrap().0 / x - 1.0).abs() < 1e-12);
    }
}

#[test]
fn an_equilibrium_of_too_many_bodies_is_not_sought() {
    // A chain in which each body rests on the previous one.
    let chain = |count: usize| {
        let side = |i: usize| if i == 0 { Side::Ground } else { Side::Body(i - 1) };
        let link = |i: usize| {
            let between = [side(i), side(i + 1)];
            contact(between, Profile::paraboloid(1e-3).unwrap(), 0.5, 1.0)
        };
        Scene {
            bodies: (0..count).map(|i| named(&format!("body {i}"), free(0.01))).collect(),
            contacts: (0..count).map(|i| named(&format!("contact {i}"), link(i))).collect(),
            loads: vec![push(count - 1, 0.1)],
            start: Start::Equilibrium,
            ..Scene::default()
        }
    };
    let start = |count: usize| Model::new(&chain(count)).unwrap().start(&event(1e-8, 1e-3));
    assert!(start(200).is_ok());
    let error = start(201).unwrap_err();
    assert_eq!((error.part, error.field), (Part::Run, Field::Start));
    assert_eq!(error.fault.to_string(), "expected at most 200 free bodies for an equilibrium, got 201");
}
