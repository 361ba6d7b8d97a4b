//! Variations of runs by numbers of their scenes, against closed forms and against differences of runs.

use crate::lottery::{Draw, deal};
use crate::parts::{damper, event, free, named, of_friction, of_pair, of_profile, p1, push, wave};
use crate::variations::{Columns, led, size};
use stickslip_contact::{Pair, Profile};
use stickslip_drive::scene::{Axis, Body, ContactStart, Load, Normal, Scene, Side, Spring, Varying};
use stickslip_drive::{
    Harmonic, Model, Parameter, Plan, Run, Shape, State, Timing, VariationError, Waveform,
};

/// Distance of the models beside a value, as a share of it.
const NEAR: f64 = 5e-5;

/// A number of a scene: what multiplies it by a factor; false where the scene has none.
pub(crate) type Number = (&'static str, fn(&mut Scene, f64) -> bool);

pub(crate) const NUMBERS: [Number; 15] = [
    ("friction", |scene, by| {
        let contact = &mut scene.contacts[0].part;
        *contact = of_friction(by * contact.interface.friction(), contact);
        true
    }),
    ("force", |scene, by| multiplies(&mut scene.contacts[0].part.normal, by)),
    ("shear modulus", |scene, by| {
        let contact = &mut scene.contacts[0].part;
        let law = &contact.interface;
        let pair = Pair::from_moduli(law.normal_modulus(), by * law.tangential_modulus()).unwrap();
        *contact = of_pair(pair, contact);
        true
    }),
    ("normal modulus", |scene, by| {
        let contact = &mut scene.contacts[0].part;
        let law = &contact.interface;
        let pair = Pair::from_moduli(by * law.normal_modulus(), law.tangential_modulus()).unwrap();
        *contact = of_pair(pair, contact);
        true
    }),
    ("mass", |scene, by| {
        let mass = &mut scene.bodies[1].part.mass;
        *mass = mass.map(|mass| by * mass);
        true
    }),
    ("mass of the foot", |scene, by| {
        let mass = &mut scene.bodies[0].part.mass;
        *mass = mass.map(|mass| by * mass);
        mass.is_some()
    }),
    ("stiffness", |scene, by| {
        let springs = scene.springs.iter_mut().map(|spring| &mut spring.part.stiffness);
        let actuators = scene.actuators.iter_mut().map(|actuator| &mut actuator.part.stiffness);
        springs.chain(actuators).filter(|k| **k > 0.0).map(|k| *k *= by).count() > 0
    }),
    ("damping", |scene, by| scene.springs.iter_mut().map(|spring| spring.part.damping *= by).count() > 0),
    ("preload", |scene, by| {
        scene.springs.iter_mut().map(|spring| spring.part.preload *= by).count() > 0
            && scene.springs[0].part.preload != 0.0
    }),
    ("load", |scene, by| scene.loads.first_mut().is_some_and(|load| scales(&mut load.x, by))),
    ("gravity", |scene, by| {
        scene.gravity.acceleration *= by;
        scene.gravity.acceleration != 0.0
    }),
    ("amplitude", |scene, by| {
        (0..scene.waveforms.len()).for_each(|w| taller(&mut scene.waveforms[w].part, by));
        true
    }),
    ("period", |scene, by| {
        let waveform = &mut scene.waveforms[0].part;
        let timing = Timing { period: by * waveform.given().period, ..*waveform.given() };
        *waveform = Waveform::new(waveform.shape().clone(), timing).unwrap();
        !matches!(waveform.shape(), Shape::Table { .. })
    }),
    ("starting speed", |scene, by| {
        scene.bodies[1].part.x.velocity *= by;
        scene.bodies[1].part.x.velocity != 0.0
    }),
    ("starting displacement", |scene, by| match &mut scene.contacts[0].part.start {
        ContactStart::Displacement(displacement) => {
            *displacement *= by;
            true
        }
        _ => false,
    }),
];

fn scales(value: &mut Varying, by: f64) -> bool {
    match value {
        Varying::Constant(value) => {
            *value *= by;
            *value != 0.0
        }
        Varying::Follows(_) => false,
    }
}

fn multiplies(normal: &mut Normal, by: f64) -> bool {
    match normal {
        Normal::Force(value) | Normal::Indentation(value) | Normal::Radius(value) => scales(value, by),
        Normal::Coupled => false,
    }
}

/// The same waveform, so many times as tall.
fn taller(waveform: &mut Waveform, by: f64) {
    let shape = match waveform.shape().clone() {
        Shape::Sawtooth { stroke, flyback } => Shape::Sawtooth { stroke: by * stroke, flyback },
        Shape::Sine { amplitude, phase, offset } => {
            Shape::Sine { amplitude: by * amplitude, phase, offset: by * offset }
        }
        Shape::Harmonics { terms } => {
            let term = |term: Harmonic| Harmonic { amplitude: by * term.amplitude, ..term };
            Shape::Harmonics { terms: terms.into_iter().map(term).collect() }
        }
        Shape::Triangle { stroke } => Shape::Triangle { stroke: by * stroke },
        Shape::Cycloid { stroke, flyback } => Shape::Cycloid { stroke: by * stroke, flyback },
        Shape::Table { points } => {
            Shape::Table { points: points.into_iter().map(|(t, value)| (t, by * value)).collect() }
        }
        other => other,
    };
    *waveform = Waveform::new(shape, *waveform.given()).unwrap();
}

pub(crate) fn built(scene: &Scene) -> Model {
    Model::new(scene).unwrap()
}

/// x and ẋ of all bodies.
fn motions(model: &Model, state: &State) -> Vec<f64> {
    (0..).map_while(|body| state.body(model, body)).flat_map(|(x, v)| [x, v]).collect()
}

/// The number of a scene, its models beside the value at so many distances.
pub(crate) fn parameter(of: &dyn Fn(f64) -> Scene, model: &Model) -> Result<Parameter, VariationError> {
    let beside = [-2.0, -1.0, 1.0, 2.0].map(|k| built(&of(1.0 + k * NEAR)));
    Parameter::new(model, beside, NEAR)
}

/// Derivatives of x and ẋ of the slider at a time by a number, as a share of its value, and the state there.
fn varied(
    (model, plan): (&Model, &Plan),
    parameters: &[Parameter],
    until: f64,
) -> Result<(Columns, State), VariationError> {
    let start = model.start(plan).unwrap();
    let mut variation = model.variation((plan, &start), parameters)?;
    let mut run = Run::new(model, plan, start).unwrap();
    run.advance(until, &mut variation).unwrap();
    run.stop(&mut ());
    variation.finish(run.state())?;
    let of = |j: usize| {
        let (x, v) = variation.coordinate(1, Axis::X, j).unwrap();
        vec![x, v]
    };
    Ok(((0..parameters.len()).map(of).collect(), run.into_state()))
}

/// The same by central differences over h and h/2, extrapolated, and by how much the shorter ones were mended.
fn differences(of: &dyn Fn(f64) -> Scene, plan: &Plan, until: f64, h: f64) -> (Vec<f64>, Vec<f64>) {
    let at = |by: f64| {
        let model = built(&of(1.0 + by));
        let state = led(&model, plan, model.start(plan).unwrap(), until);
        motions(&model, &state)[2..4].to_vec()
    };
    let central =
        |h: f64| -> Vec<f64> { at(h).iter().zip(at(-h)).map(|(a, b)| (a - b) / (2.0 * h)).collect() };
    let (coarse, fine) = (central(h), central(0.5 * h));
    let mended: Vec<f64> = fine.iter().zip(&coarse).map(|(fine, coarse)| (fine - coarse) / 3.0).collect();
    (fine.iter().zip(&mended).map(|(fine, mended)| fine + mended).collect(), mended)
}

/// How far a variation is off from differences, and these from themselves; each row in units of itself or of a natural scale.
pub(crate) fn apart(of: &dyn Fn(f64) -> Scene, until: f64) -> Result<(f64, f64), VariationError> {
    let (model, tight) = (built(&of(1.0)), event(1e-13, f64::MAX));
    let scale = model.contact_natural(0).unwrap();
    let natural = [scale.displacement, scale.velocity];
    let parameter = parameter(of, &model)?;
    let (columns, _) = varied((&model, &tight), &[parameter], until)?;
    let known = [1e-3, 2e-4, 4e-5].into_iter().map(|h| {
        let (by_runs, mended) = differences(of, &tight, until, h);
        (size([mended].into_iter(), std::slice::from_ref(&by_runs), natural), by_runs)
    });
    let (doubt, by_runs) = known.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    let off = columns[0].iter().zip(&by_runs).map(|(a, b)| a - b).collect();
    Ok((size([off].into_iter(), &[by_runs], natural), doubt))
}

/// Random drives, as in `random_drives_vary_as_their_differences_say`, every number that they have.
#[test]
#[ignore = "takes long: .ci/full"]
fn random_drives_vary_by_their_numbers_as_differences_say() {
    let (mut told, mut sharp, mut worst) = (0, 0, 0.0_f64);
    for seed in 0..30 {
        let drawn = deal(seed);
        let mut draw = Draw::new(2_000 + seed);
        let until = draw.between(0.5, 2.5) * drawn.period;
        for (name, change) in NUMBERS {
            if !change(&mut drawn.scene.clone(), 1.0) {
                continue;
            }
            let of = |by: f64| {
                let mut scene = drawn.scene.clone();
                change(&mut scene, by);
                scene
            };
            match apart(&of, until) {
                Ok((off, doubt)) => {
                    told += 1;
                    sharp += usize::from(doubt < 1e-8);
                    let mark = if doubt < 1e-8 && off > 1e-7 { "!!" } else { "" };
                    println!("{}: {name}: off by {off:.1e}, differences by {doubt:.1e} {mark}", drawn.title);
                    if doubt < 1e-8 {
                        worst = worst.max(off);
                    }
                }
                Err(VariationError::Profile(_)) => {}
                Err(error) => println!("{}: {name}: {error}", drawn.title),
            }
        }
    }
    println!("{sharp} of {told}, {worst:e}");
    assert!(sharp > 100 && worst < 1e-7, "{sharp} of {told}: {worst:e}");
}

/// The benchmark drive by the radius of its ball, the flyback of its foot, and stroke and period of a foot that jumps; corners move
/// with flyback and period.
#[test]
fn the_benchmark_drive_varies_by_its_numbers() {
    let radius = |by: f64| {
        let mut scene = p1();
        let contact = &mut scene.contacts[0].part;
        *contact = of_profile(Profile::paraboloid(by * 1e-3).unwrap(), contact);
        scene
    };
    let drive = |[stroke, flyback, period]: [f64; 3]| {
        let mut scene = p1();
        let shape = Shape::Sawtooth { stroke, flyback };
        scene.waveforms[0].part = Waveform::new(shape, Timing::every(period)).unwrap();
        scene
    };
    let flyback = |by: f64| drive([0.5e-6, by * 0.1e-3, 1e-3]);
    let stroke = |by: f64| drive([by * 0.5e-6, 0.0, 1e-3]);
    let period = |by: f64| drive([0.5e-6, 0.0, by * 1e-3]);
    for until in [0.93e-3, 1.05e-3, 3.3e-3] {
        let numbers: [(&str, &dyn Fn(f64) -> Scene); 4] =
            [("radius", &radius), ("flyback", &flyback), ("stroke", &stroke), ("period", &period)];
        for (name, of) in numbers {
            let (off, doubt) = apart(of, until).unwrap();
            println!("{name} until {until}: off by {off:.1e}, differences by {doubt:.1e}");
            assert!(off < 1e-7 + 10.0 * doubt, "{name} until {until}: {off:e}, differences {doubt:e}");
        }
    }
}

/// m ẍ = F - kx from rest: x = (F/k)(1 - cos ωt), ω² = k/m, by shares of m, k and F.
#[test]
fn an_oscillator_varies_by_its_numbers_as_its_closed_form() {
    let (mass, stiffness, force, t) = (0.02, 3e5_f64, 0.5, 4e-3);
    let scene = |[m, k, f]: [f64; 3]| {
        let tie = Spring { stiffness: k * stiffness, ..damper([Side::Ground, Side::Body(1)], 0.0) };
        Scene {
            bodies: vec![named("table", Body::default()), named("mass", free(m * mass))],
            springs: vec![named("tie", tie)],
            loads: vec![push(1, f * force)],
            ..Scene::default()
        }
    };
    let (model, tight) = (built(&scene([1.0; 3])), event(1e-13, f64::MAX));
    let number = |i: usize| {
        let of = |by: f64| scene(std::array::from_fn(|j| if i == j { by } else { 1.0 }));
        parameter(&of, &model).unwrap()
    };
    let (columns, _) = varied((&model, &tight), &[number(0), number(1), number(2)], t).unwrap();
    let omega = (stiffness / mass).sqrt();
    let ((sine, cosine), swing) = ((omega * t).sin_cos(), force / stiffness);
    let (x, v) = (swing * (1.0 - cosine), swing * omega * sine);
    // By a share of ω, x at F/k.
    let turned = [swing * omega * t * sine, swing * omega * (sine + omega * t * cosine)];
    let exact = [turned.map(|slope| -0.5 * slope), [0.5 * turned[0] - x, 0.5 * turned[1] - v], [x, v]];
    for (column, exact) in columns.iter().zip(exact) {
        for (k, unit) in [swing, swing * omega].into_iter().enumerate() {
            assert!((column[k] - exact[k]).abs() < 1e-8 * unit, "{column:?}, exactly {exact:?}");
        }
    }
}

/// A free mass under a load that grows evenly and falls to nothing with each period T: m ẍ = A frac(t/T). Over the second period
/// ẋ = (A/m)[T/2 + (t-T)²/2T] and x = (A/m)[T²/6 + (t-T)T/2 + (t-T)³/6T]: the load jumps at a time that moves with T.
#[test]
fn a_load_that_jumps_varies_by_when_it_does() {
    let (mass, force, period, t) = (0.02, 0.5, 1e-3, 1.7e-3);
    let of = |by: f64| Scene {
        waveforms: vec![wave("wind", Shape::Sawtooth { stroke: force, flyback: 0.0 }, by * period)],
        bodies: vec![named("table", Body::default()), named("mass", free(mass))],
        loads: vec![Load { on: 1, x: Varying::Follows(0), ..Load::default() }],
        ..Scene::default()
    };
    let (model, tight) = (built(&of(1.0)), event(1e-13, f64::MAX));
    let number = parameter(&of, &model).unwrap();
    let (columns, end) = varied((&model, &tight), &[number], t).unwrap();
    let (rest, unit) = (t - period, force / mass);
    // The law itself first: the load begins at 0.
    let (_, v) = end.body(&model, 1).unwrap();
    let expected = unit * (0.5 * period + rest * rest / (2.0 * period));
    assert!((v / expected - 1.0).abs() < 1e-9, "{v:e} {expected:e}");
    let by_x = period / 3.0 + 0.5 * rest
        - 0.5 * period
        - rest * rest / (2.0 * period)
        - rest.powi(3) / (6.0 * period * period);
    let by_v = 0.5 - rest / period - rest * rest / (2.0 * period * period);
    let exact = [unit * period * by_x, unit * period * by_v];
    println!("{columns:?}, exactly {exact:?}");
    assert!((columns[0][0] - exact[0]).abs() < 1e-9 * unit * period * period, "{columns:?} {exact:?}");
    assert!((columns[0][1] - exact[1]).abs() < 1e-9 * unit * period, "{columns:?} {exact:?}");
}
