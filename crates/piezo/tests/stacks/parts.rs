//! Common model of the tests: a foot follows the last of a chain of blocks and carries a slider.

use stickslip_contact::{Interface, Material, Pair, Profile};
use stickslip_drive::component::SharedBlock;
use stickslip_drive::scene::{
    Body, Contact, ContactStart, Coordinate, EngineChoice, Named, Normal, NormalDamping, Point, Scene, Side,
    Varying,
};
use stickslip_drive::{Limits, Model, Plan, Shape, State, Stepper, Timing, Trace, Waveform, run};

pub(crate) const PERIOD: f64 = 1e-3;

pub(crate) fn named<T>(name: &str, part: T) -> Named<T> {
    Named { name: name.to_owned(), part }
}

/// Periodic waveform of a shape.
pub(crate) fn every(shape: Shape) -> Waveform {
    Waveform::new(shape, Timing::every(PERIOD)).unwrap()
}

/// Linear table of (ms, units). Two values at the same time are a jump.
pub(crate) fn table(points: &[(f64, f64)], unit: f64) -> Waveform {
    let points = points.iter().map(|(t, v)| (1e-3 * t, unit * v)).collect();
    Waveform::new(Shape::Table { points }, Timing::every(1.0)).unwrap()
}

/// Model in which the foot follows the last signal.
pub(crate) fn scene(wave: Waveform, blocks: Vec<Named<SharedBlock>>) -> Scene {
    let steel = Material::new(210e9, 0.3).unwrap();
    let pair = Pair::new(steel, steel);
    let ball = Contact {
        between: [Side::Body(0), Side::Body(1)],
        at: [Point::default(); 2],
        interface: Interface::new(pair, Profile::paraboloid(1e-3).unwrap(), 0.15).unwrap(),
        normal: Normal::Force(Varying::Constant(1.0)),
        gap: 0.0,
        normal_damping: NormalDamping::None,
        start: ContactStart::Untouched,
        engine: EngineChoice::Curve,
        count: 1,
    };
    let last = blocks.len();
    Scene {
        waveforms: vec![named("drive", wave)],
        blocks,
        bodies: vec![
            named("foot", Body { x: Coordinate::follows(last), ..Body::default() }),
            named("slider", Body { mass: Some(0.02), x: Coordinate::FREE, ..Body::default() }),
        ],
        contacts: vec![named("ball", ball)],
        ..Scene::default()
    }
}

pub(crate) fn plan(stepper: Stepper, duration: f64) -> Plan {
    let limits = Limits { steps: 5_000_000, events: 1_000_000, wall: Some(60.0) };
    Plan { duration, stepper, limits, every: None, until_steady: None }
}

pub(crate) fn trace(scene: &Scene, plan: &Plan, every: f64) -> (Model, State, Trace) {
    let model = Model::new(scene).unwrap();
    let plan = Plan { every: Some(every), ..*plan };
    let mut state = model.start(&plan).unwrap();
    let mut trace = Trace::new(&model);
    run(&model, &plan, &mut state, &mut trace).unwrap();
    (model, state, trace)
}

pub(crate) fn column(model: &Model, trace: &Trace, name: &str) -> Vec<f64> {
    let channel = model.channels().iter().position(|channel| channel.name == name).unwrap();
    trace.column(channel).collect()
}
