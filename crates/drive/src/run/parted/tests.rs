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

const PLAN: Plan = Plan {
    duration: 0.3,
    stepper: Stepper::Event { tolerance: 1e-8 },
    limits: Limits { steps: u64::MAX, events: u64::MAX, wall: None },
    every: Some(1e-3),
    until_steady: None,
};

/// What a run on so many cores comes to, what it writes, and whether it had work for several.
fn on(threads: usize, model: &Model) -> Option<(State, Trace, bool)> {
    let plan = PLAN;
    let (mut state, mut trace) = (model.start(&plan).ok()?, Trace::new(model));
    let mut run = Parted::new(model, &plan);
    run.threads = Some(threads);
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

/// The attempts of scouts and which part went first at the end, where a part goes first whose share of the work is beyond this.
fn led(most: f64, model: &Model) -> Option<(State, Trace, f64, Option<usize>)> {
    let (mut state, mut trace) = (model.start(&PLAN).ok()?, Trace::new(model));
    let mut run = Parted::new(model, &PLAN);
    run.calendar.most = most;
    run.set_out(&mut state, Opening::Row, &mut trace);
    for k in 1..=5 {
        run.go(&mut state, Goal::Glance(0.06 * f64::from(k)), &mut trace).ok()?;
    }
    Some((state, trace, run.calendar.work(&run.lanes), run.calendar.first))
}

#[test]
fn a_part_that_is_most_of_the_work_is_gone_through_once_and_writes_the_same() {
    // The heavy slider rests in its contact, and has no events of its own but corners.
    for masses in [[0.02, 500.0], [500.0, 0.02]] {
        let model = sliders(&masses).and_then(|scene| Model::new(&scene).ok());
        let both = model.map(|model| [0.5, 2.0].map(|most| led(most, &model)));
        let [Some(once), Some(twice)] = both.unwrap_or_default() else { panic!("the run has an end") };
        assert_eq!((once.3.is_some(), twice.3), (true, None));
        assert!((&once.0, &once.1) == (&twice.0, &twice.1), "bits");
        assert!(once.2 < 0.7 * twice.2, "{} of {}", once.2, twice.2);
    }
}
