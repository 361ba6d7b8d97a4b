//! The same bits on any number of cores.

use super::Parted;
use crate::record::Trace;
use crate::run::horizon::Goal;
use crate::run::output::Opening;
use crate::scene::{
    Body, Contact, ContactStart, Coordinate, EngineChoice, Named, Normal, Point, Scene, Side, Varying,
};
use crate::{Limits, Model, Plan, Shape, State, Stepper, Timing, Waveform};
use stickslip_contact::{Interface, Material, Pair, Profile};

/// Sliders of several masses on one foot, which follows a sawtooth.
fn sliders(masses: &[f64]) -> Option<Scene> {
    let named = |name: String| move |part| Named { name, part };
    let sawtooth = Shape::Sawtooth { stroke: 0.5e-6, flyback: 0.1e-3 };
    let drive = Waveform::new(sawtooth, Timing::every(1e-3)).ok()?;
    let steel = Material::new(210e9, 0.3).ok()?;
    let interface = Interface::new(Pair::new(steel, steel), Profile::paraboloid(1e-3).ok()?, 0.15).ok()?;
    let foot = Body { x: Coordinate::follows(0), ..Body::default() };
    let body = |mass: &f64| Body { mass: Some(*mass), x: Coordinate::FREE, ..Body::default() };
    let contact = |slider: usize| Contact {
        between: [Side::Body(0), Side::Body(slider)],
        at: [Point::default(); 2],
        interface: interface.clone(),
        normal: Normal::Force(Varying::Constant(1.0)),
        gap: 0.0,
        start: ContactStart::Untouched,
        engine: EngineChoice::Curve,
        count: 1,
    };
    let bodies = std::iter::once(foot).chain(masses.iter().map(body));
    Some(Scene {
        waveforms: vec![Named { name: "drive".to_owned(), part: drive }],
        bodies: bodies.enumerate().map(|(i, body)| named(format!("body {i}"))(body)).collect(),
        contacts: (1..=masses.len()).map(|i| Named { name: format!("ball {i}"), part: contact(i) }).collect(),
        ..Scene::default()
    })
}

/// What a run on so many cores comes to, what it writes, and whether it had work for several.
fn on(threads: usize, model: &Model) -> Option<(State, Trace, bool)> {
    let plan = Plan {
        duration: 0.3,
        stepper: Stepper::Event { tolerance: 1e-8 },
        limits: Limits::default(),
        every: Some(1e-3),
        until_steady: None,
    };
    let (mut state, mut trace) = (model.start(&plan).ok()?, Trace::new(model));
    let mut run = Parted::new(model, &plan);
    run.threads = threads;
    run.set_out(&mut state, Opening::Row, &mut trace);
    let mut was_busy = false;
    for k in 1..=10 {
        run.go(&mut state, Goal::Moment(0.03 * f64::from(k)), &mut trace).ok()?;
        was_busy |= run.is_busy;
    }
    Some((state, trace, was_busy))
}

#[test]
fn any_number_of_cores_makes_the_same_bits() {
    let scene = sliders(&[0.02, 0.021, 0.05, 0.3, 0.02]);
    let model = scene.and_then(|scene| Model::new(&scene).ok());
    let all = model.map(|model| [1, 2, 3, 8].map(|threads| on(threads, &model)));
    let [Some(one), others @ ..] = all.unwrap_or_default() else { panic!("the run has an end") };
    assert!(one.2, "there is work for several");
    for other in others {
        assert!(other.is_some_and(|other| other == one));
    }
}
