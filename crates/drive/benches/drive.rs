//! Benchmark of one simulated second of drive P1 (1000 periods of a sawtooth, one contact), for every stepper.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use criterion::{Criterion, criterion_group, criterion_main};
use stickslip_contact::{Interface, Material, Pair, Profile};
use stickslip_drive::scene::{
    Body, Contact, ContactStart, Coordinate, EngineChoice, Named, Normal, NormalDamping, Point, Scene, Side,
    Varying,
};
use stickslip_drive::{Limits, Model, Plan, Shape, Stepper, Timing, Waveform, run};

fn named<T>(name: &str, part: T) -> Named<T> {
    Named { name: name.to_owned(), part }
}

/// Drive P1 of `tests/data/drive_p1.json`.
fn p1() -> Scene {
    let steel = Material::new(210e9, 0.3).unwrap();
    let shape = Shape::Sawtooth { stroke: 0.5e-6, flyback: 0.1e-3 };
    let body = |mass, x| Body { mass, x, ..Body::default() };
    let contact = Contact {
        between: [Side::Body(0), Side::Body(1)],
        at: [Point::default(); 2],
        interface: Interface::new(Pair::new(steel, steel), Profile::paraboloid(1e-3).unwrap(), 0.15).unwrap(),
        normal: Normal::Force(Varying::Constant(1.0)),
        gap: 0.0,
        normal_damping: NormalDamping::None,
        start: ContactStart::Untouched,
        engine: EngineChoice::Curve,
        count: 1,
    };
    Scene {
        waveforms: vec![named("drive", Waveform::new(shape, Timing::every(1e-3)).unwrap())],
        bodies: vec![
            named("foot", body(None, Coordinate::follows(0))),
            named("slider", body(Some(0.02), Coordinate::FREE)),
        ],
        contacts: vec![named("ball", contact)],
        ..Scene::default()
    }
}

fn steppers(bench: &mut Criterion) {
    let model = Model::new(&p1()).unwrap();
    let mut group = bench.benchmark_group("P1, one simulated second");
    group.sample_size(10);
    for (name, stepper) in [
        ("event 1e-3", Stepper::Event { tolerance: 1e-3 }),
        ("event 1e-6", Stepper::Event { tolerance: 1e-6 }),
        ("event 1e-9", Stepper::Event { tolerance: 1e-9 }),
        ("verlet 1 us", Stepper::Verlet { step: 1e-6 }),
        ("rk4 1 us", Stepper::Rk4 { step: 1e-6 }),
        ("dopri5 1e-6", Stepper::Dopri5 { tolerance: 1e-6 }),
    ] {
        let plan =
            Plan { duration: 1.0, stepper, limits: Limits::default(), every: None, until_steady: None };
        group.bench_function(name, |b| {
            b.iter(|| {
                let mut state = model.start(&plan).unwrap();
                run(&model, &plan, &mut state, &mut ()).unwrap();
                state.body(&model, 1)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, steppers);
criterion_main!(benches);
