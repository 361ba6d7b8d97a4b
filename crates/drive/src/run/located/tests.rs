//! Tests of slip memories that commit at their own events only, and of the force kernel for many coordinates.

use super::located;
use crate::equations::Equations;
use crate::interval::Interval;
use crate::run::horizon::Goal;
use crate::run::output::Opening;
use crate::scene::{
    Body, Contact, ContactStart, Coordinate, Direction, EngineChoice, Named, Normal, NormalDamping, Point,
    Scene, Side, Spring, Varying,
};
use crate::{Limits, Model, Plan, Shape, State, Stepper, Timing, Waveform};
use stickslip_contact::{Interface, Material, Pair, Profile};
use stickslip_stepper::{Conservative, System};

const PERIOD: f64 = 1e-3;
const TOLERANCE: f64 = 1e-8;
const PLAN: Plan = Plan {
    duration: 3.0 * PERIOD,
    stepper: Stepper::Event { tolerance: TOLERANCE },
    limits: Limits { steps: u64::MAX, events: u64::MAX, wall: None },
    every: None,
    until_steady: None,
};

fn named<T>(name: &str, part: T) -> Named<T> {
    Named { name: name.to_owned(), part }
}

/// Returns a foot on a waveform with different sliders, connected by springs; `damping` (s) applies to every contact.
fn chain(shape: Shape, (contacts, damping): (&[usize], f64)) -> Option<Scene> {
    let steel = Pair::new(Material::new(210e9, 0.3).ok()?, Material::new(210e9, 0.3).ok()?);
    let mut scene = Scene {
        waveforms: vec![named("drive", Waveform::new(shape, Timing::every(PERIOD)).ok()?)],
        bodies: vec![named("foot", Body { x: Coordinate::follows(0), ..Body::default() })],
        ..Scene::default()
    };
    for (k, count) in contacts.iter().enumerate() {
        let slider = scene.bodies.len();
        let mass = 0.02 * (1.0 + 0.037 * k as f64);
        scene.bodies.push(named(
            &format!("slider {k}"),
            Body { mass: Some(mass), x: Coordinate::FREE, ..Body::default() },
        ));
        for ball in 0..*count {
            let radius = 1e-3 * (1.0 + 0.11 * ball as f64);
            let interface = Interface::new(steel, Profile::paraboloid(radius).ok()?, 0.15).ok()?;
            let contact = Contact {
                between: [Side::Body(0), Side::Body(slider)],
                at: [Point::default(); 2],
                interface: if damping > 0.0 { interface.with_damping(damping) } else { interface },
                normal: Normal::Force(Varying::Constant(1.0 / *count as f64)),
                gap: 0.0,
                normal_damping: NormalDamping::None,
                start: ContactStart::Untouched,
                engine: EngineChoice::Curve,
                count: 1,
            };
            scene.contacts.push(named(&format!("ball {k} {ball}"), contact));
        }
        if k > 0 {
            let spring = Spring {
                between: [Side::Body(slider - 1), Side::Body(slider)],
                at: [Point::default(); 2],
                direction: Direction::X,
                stiffness: 3e5,
                damping: 0.0,
                preload: 0.0,
            };
            scene.springs.push(named(&format!("spring {k}"), spring));
        }
    }
    Some(scene)
}

/// Returns times and components after every step, the final state, and how often a memory lagged behind a step.
///
/// If `all`, the slip memories commit after every step, otherwise at events and at the end.
fn run(model: &Model, all: bool) -> Option<(Vec<f64>, State, usize)> {
    let plan = PLAN;
    let mut state = model.start(&plan).ok()?;
    let mut run = located(model, &plan, TOLERANCE);
    run.set_out(&mut state, Opening::Row, &mut ());
    let (mut way, mut behind) = (Vec::new(), 0);
    while state.t < plan.duration {
        let next = state.t.next_up();
        run.go(&mut state, Goal::Past(next), &mut ()).ok()?;
        if all {
            run.settle_books(&mut state);
        }
        let there = |c: usize| {
            let motion =
                Equations::on(model, &state, model.layout())
                    .motion(&model.contacts[c], state.t, |i| state.y[i]);
            let way = state.memories[c].apex().u - motion.u;
            way.abs() < 1e-12 * model.contacts[c].natural.displacement
        };
        behind += (0..model.contacts.len()).filter(|c| !there(*c)).count();
        way.push(state.t);
        way.extend(&state.y);
    }
    run.settle_books(&mut state);
    Some((way, state, behind))
}

fn sawtooth() -> Shape {
    Shape::Sawtooth { stroke: 0.5e-6, flyback: 0.1e-3 }
}

fn sine() -> Shape {
    Shape::Sine { amplitude: 0.3e-6, phase: 0.4, offset: 0.0 }
}

#[test]
fn memories_that_move_at_their_own_events_only_come_to_the_same() {
    let scenes = [
        ("chain on a sawtooth", chain(sawtooth(), (&[1; 6], 0.0))),
        ("chain on a sine", chain(sine(), (&[1; 5], 0.0))),
        ("many contacts each", chain(sawtooth(), (&[4, 1, 3], 0.0))),
        ("one slider", chain(sine(), (&[9], 0.0))),
        ("damped", chain(sawtooth(), (&[2, 2], 1e-6))),
    ];
    for (name, scene) in scenes {
        let model = scene.and_then(|scene| Model::new(&scene).ok());
        let both = model.as_ref().map(|model| [false, true].map(|all| run(model, all)));
        let (Some(model), Some([Some((own, at_own, left)), Some((all, at_all, none))])) = (&model, both)
        else {
            panic!("{name} has an end")
        };
        assert!(left > 0 && none == 0, "{name}: {left} left behind");
        assert_eq!(own.len(), all.len(), "{name}: steps");
        // Only the division of the memory's path differs, which changes its last bits.
        let size = |i: usize| own.iter().skip(i % (at_own.y.len() + 1)).step_by(at_own.y.len() + 1);
        for (i, (a, b)) in own.iter().zip(&all).enumerate() {
            let scale = size(i).fold(0.0_f64, |most, y| most.max(y.abs()));
            assert!((a - b).abs() <= 1e-12 * scale, "{name}: {i}: {a} {b}");
        }
        assert_eq!(at_own.counts.events, at_all.counts.events, "{name}");
        for (c, contact) in model.contacts.iter().enumerate() {
            let near = |a: f64, b: f64, unit: f64| (a - b).abs() <= 1e-11 * unit;
            let [a, b] = [&at_own, &at_all].map(|state| state.memories[c].apex());
            let natural = contact.natural.displacement;
            assert!(near(a.u, b.u, natural), "{name}: {}", contact.name);
            let [f, g] = [&at_own, &at_all].map(|state| state.memories[c].force(&contact.interface, a));
            assert!(near(f, g, contact.friction_limit()), "{name}: {}: {f} {g}", contact.name);
            let [f, g] = [&at_own, &at_all].map(|state| state.friction[c]);
            assert!(near(f, g, contact.friction_limit() * natural + f), "{name}: {}: {f} {g}", contact.name);
            assert!(f > 0.0, "{name}: {} slips", contact.name);
        }
    }
}

/// Returns a chain with a damper, a preload, and springs to the foot and to the ground.
fn tied(shape: Shape) -> Option<Scene> {
    let mut scene = chain(shape, (&[1, 2, 1, 1, 3, 1], 0.0))?;
    let spring = scene.springs.first()?.part;
    scene.springs[0].part.damping = 3.0;
    scene.springs[1].part.preload = 0.01;
    for (name, first) in [("tow", Side::Body(0)), ("tie", Side::Ground)] {
        let part = Spring { between: [first, Side::Body(3)], preload: -0.02, ..spring };
        scene.springs.push(named(name, part));
    }
    Some(scene)
}

#[test]
fn forces_on_many_coordinates_are_those_of_the_general_equations() {
    for shape in [sawtooth(), sine()] {
        let Some(model) = tied(shape).and_then(|scene| Model::new(&scene).ok()) else { panic!("a scene") };
        let Ok(mut state) = model.start(&PLAN) else { panic!("a start") };
        located(&model, &PLAN, TOLERANCE).set_out(&mut state, Opening::Row, &mut ());
        let n = model.free.len();
        for (i, y) in state.y.iter_mut().enumerate() {
            *y += ((7 * i + 3) % 11) as f64 * if i < n { 3e-9 } else { 2e-4 };
        }
        let mut interval = Interval::of(&model);
        interval.begin(&model, &state);
        assert!(n > 4 && interval.kernel.is_laid_out() && interval.closed.len() == model.contacts.len());
        let plain = Equations::on(&model, &state, model.layout());
        let laid_out = Equations { interval: Some(&interval), ..plain };
        let slopes = |eq: &Equations<'_>| {
            let mut slopes = vec![f64::NAN; state.y.len()];
            eq.slopes(state.t, &state.y, &mut slopes);
            slopes
        };
        let accelerations = |eq: &Equations<'_>| {
            let mut rates = vec![f64::NAN; n + 1];
            eq.accelerations(state.t, &state.y[..n], &mut rates);
            rates
        };
        let close = |a: &[f64], b: &[f64]| {
            let size = b.iter().fold(0.0_f64, |most, b| most.max(b.abs()));
            assert!(size > 0.0 && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-12 * size), "{a:?} {b:?}");
        };
        let (own, other) = (slopes(&laid_out), slopes(&plain));
        // Velocities, accelerations, and each of the powers.
        for range in [0..n, n..2 * n, 2 * n..2 * n + 1, 2 * n + 1..2 * n + 2] {
            close(&own[range.clone()], &other[range]);
        }
        let (own, other) = (accelerations(&laid_out), accelerations(&plain));
        close(&own[..n], &other[..n]);
        close(&own[n..], &other[n..]);
    }
}
