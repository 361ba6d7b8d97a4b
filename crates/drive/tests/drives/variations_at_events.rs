//! Variations through one kind of event each: a touch, events at one moment, jumps, turns that graze.

use crate::parts::{event, free, named, p1, steel, wave};
use crate::variations::{differences, led, size, varied};
use stickslip_contact::{Interface, Profile};
use stickslip_drive::scene::{
    Axis, Body, Contact, ContactStart, Coordinate, EngineChoice, Freedom, Normal, Point, Scene, Side, Spring,
    Varying,
};
use stickslip_drive::section::{Section, Unknown};
use stickslip_drive::{Harmonic, Model, Plan, Run, Shape, State, VariationError};

/// A body that comes down on the ground obliquely, with velocities [ẋ, -ż] in m/s.
fn falling(interface: Interface, mass: f64, gap: f64, [slide, fall]: [f64; 2]) -> Scene {
    let at = |velocity| Coordinate { freedom: Freedom::Free, position: 0.0, velocity };
    let body = Body { mass: Some(mass), x: at(slide), z: at(-fall), ..Body::default() };
    let foot = Contact {
        between: [Side::Ground, Side::Body(0)],
        at: [Point::default(); 2],
        interface,
        normal: Normal::Coupled,
        gap,
        start: ContactStart::Untouched,
        engine: EngineChoice::Curve,
        count: 1,
    };
    Scene { bodies: vec![named("body", body)], contacts: vec![named("foot", foot)], ..Scene::default() }
}

/// A ball that sticks while it comes down, and leaves again: by no number nothing is led along its path of growth.
#[test]
fn a_ball_that_touches_is_led_by_no_number() {
    let interface = Interface::new(steel(), Profile::paraboloid(1e-3).unwrap(), 0.8).unwrap();
    let scene = falling(interface, 0.02, 2e-6, [2e-4, 1e-3]);
    let (model, tight) = (Model::new(&scene).unwrap(), event(1e-9, f64::MAX));
    let start = model.start(&tight).unwrap();
    let mut variation = model.variation((&tight, &start), &[]).unwrap();
    let mut run = Run::new(&model, &tight, start.clone()).unwrap();
    run.advance(10e-3, &mut variation).unwrap();
    run.stop(&mut ());
    variation.finish(run.state()).unwrap();
    assert_eq!(variation.count(), 0);
    assert_eq!(run.into_state(), led(&model, &tight, start, 10e-3));
}

/// A flat end that comes down obliquely and sticks: from the touch on it swings on E\*2b and G\*2b, whose anchors are where it touched.
/// A touch later by δt₁ leaves x later by ẋ(1 - cos ωτ)δt₁ and z by ż cos Ωτ δt₁.
#[test]
fn a_flat_end_that_touches_varies_with_where_it_has_touched() {
    let (radius, mass, gap, fall, slide) = (50e-6, 0.02, 2e-6, 1e-3, 2e-4);
    let interface = Interface::new(steel(), Profile::flat(radius).unwrap(), 0.8).unwrap();
    let [along, normal] = [interface.tangential_modulus(), interface.normal_modulus()];
    let scene = falling(interface, mass, gap, [slide, fall]);
    let (model, tight) = (Model::new(&scene).unwrap(), event(1e-13, f64::MAX));
    let section = Section::new(&model, model.start(&tight).unwrap());
    let [omega, swing] = [along, normal].map(|modulus| (modulus * 2.0 * radius / mass).sqrt());
    let (touch, tau) = (gap / fall, 1.0 / swing);
    let (columns, _) = varied((&model, &tight), &section, touch + tau).unwrap();
    let ((sine, cosine), (sine_z, cosine_z)) = ((omega * tau).sin_cos(), (swing * tau).sin_cos());
    // By the time of the touch alone.
    let later = [slide * (1.0 - cosine), slide * omega * sine];
    // x and ẋ by z, ẋ and ż.
    let exact = |unknown: Unknown| match unknown {
        Unknown::Place(_) => later.map(|x| x / fall),
        Unknown::Speed(0) => [touch + sine / omega, cosine],
        _ => later.map(|x| x * touch / fall),
    };
    let upright = |unknown: Unknown| match unknown {
        Unknown::Place(_) => [cosine_z, -swing * sine_z],
        Unknown::Speed(0) => [0.0, 0.0],
        _ => [sine_z / swing + touch * cosine_z, cosine_z - touch * swing * sine_z],
    };
    assert_eq!(section.unknowns(), [Unknown::Place(1), Unknown::Speed(0), Unknown::Speed(1)]);
    let mut variation = section.variation((section.base(), &[]), 1e-13).unwrap();
    let mut run = Run::new(&model, &tight, section.base().clone()).unwrap();
    run.advance(touch + tau, &mut variation).unwrap();
    run.stop(&mut ());
    variation.finish(run.state()).unwrap();
    for (j, (unknown, scale)) in section.unknowns().iter().zip(section.scales()).enumerate() {
        let unit = if matches!(unknown, Unknown::Place(_)) { 1.0 } else { touch };
        let (z, vz) = variation.coordinate(0, Axis::Z, j).unwrap();
        let got = [columns[j][0], columns[j][1], z, vz].map(|x| x / scale);
        let exact = [exact(*unknown), upright(*unknown)].concat();
        for (k, (got, exact)) in got.into_iter().zip(exact).enumerate() {
            let unit = unit * [1.0, swing][k % 2];
            assert!((got - exact).abs() < 1e-9 * unit, "{unknown:?} {k}: {got:e}, exactly {exact:e}");
        }
    }
}

/// Two equal sliders on one foot, tied together, have all their events at the same moments, and what disturbs one of them parts them:
/// against differences, whose runs have the events one after the other.
#[test]
fn events_at_one_moment_vary_as_those_apart() {
    let mut scene = p1();
    scene.bodies.push(named("twin", free(0.02)));
    let twin = Contact { between: [Side::Body(0), Side::Body(2)], ..scene.contacts[0].part.clone() };
    scene.contacts.push(named("other", twin));
    let between = [Side::Body(1), Side::Body(2)];
    let tie = Spring { stiffness: 1e6, ..crate::parts::damper(between, 5.0) };
    scene.springs.push(named("tie", tie));
    let (model, tight) = (Model::new(&scene).unwrap(), event(1e-13, f64::MAX));
    let section = Section::new(&model, led(&model, &tight, model.start(&tight).unwrap(), 1.45e-3));
    let end = agrees((&model, &tight), &section, 2.6e-3);
    assert!(end.counts().events > section.base().counts().events + 10, "{:?}", end.counts());
}

/// Derivatives at a time within 1e-7 of differences, each row in units of its largest or of a natural scale; tells the state there.
fn agrees((model, plan): (&Model, &Plan), section: &Section<'_>, until: f64) -> State {
    let scale = model.contact_natural(0).unwrap();
    let natural = [scale.displacement, scale.velocity];
    let (columns, end) = varied((model, plan), section, until).unwrap();
    let known = [1e-4, 2e-5, 4e-6].into_iter().filter_map(|h| {
        let (by_runs, mended) = differences((model, plan), section, until, h)?;
        Some((size(mended.into_iter(), &by_runs, natural), by_runs))
    });
    let (doubt, by_runs) = known.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    let pairs = columns.iter().zip(&by_runs);
    let apart = pairs.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a - b).collect());
    let off = size(apart, &by_runs, natural);
    println!("until {until}: off by {off:.1e}, differences by {doubt:.1e}");
    assert!(doubt < 1e-7 && off < 1e-7, "{off:e}, differences {doubt:e}");
    end
}

/// A foot that jumps sweeps an edge in no time, which the motion after it turns away from: in partial slip (a jump of half u_c) and gross
/// slip, at one jump and at several.
#[test]
fn jumps_vary_as_their_differences_say() {
    let tight = event(1e-13, f64::MAX);
    for stroke in [0.03e-6, 0.1e-6, 0.5e-6] {
        let mut scene = p1();
        scene.waveforms[0] = wave("drive", Shape::Sawtooth { stroke, flyback: 0.0 }, 1e-3);
        let model = Model::new(&scene).unwrap();
        for (from, until) in [(0.3e-3, 1.01e-3), (0.3e-3, 3.2e-3), (1.45e-3, 2.6e-3)] {
            let section = Section::new(&model, led(&model, &tight, model.start(&tight).unwrap(), from));
            agrees((&model, &tight), &section, until);
        }
    }
}

/// A normal force with corners: the contact grows after one and shrinks after the next, on the path by which it grew or with an edge.
#[test]
fn corners_of_a_normal_force_vary_as_their_differences_say() {
    let tight = event(1e-13, f64::MAX);
    let forces = [1.0, 1.3, 0.8, 1.1, 0.9, 1.2, 1.0, 1.4];
    let points = forces.into_iter().enumerate().map(|(k, force)| (0.37e-3 * k as f64, force)).collect();
    let mut scene = p1();
    scene.waveforms.push(wave("pressing", Shape::Table { points }, 1e-3));
    scene.contacts[0].part.normal = Normal::Force(Varying::Follows(1));
    let model = Model::new(&scene).unwrap();
    for (from, until) in [(0.3e-3, 0.9e-3), (0.3e-3, 2.3e-3), (1.0e-3, 1.6e-3)] {
        let section = Section::new(&model, led(&model, &tight, model.start(&tight).unwrap(), from));
        agrees((&model, &tight), &section, until);
    }
}

/// With more of its fourth harmonic a foot turns back for a moment. As long as it nearly does, and once it does for good, derivatives are
/// those of differences; where it just so does, the turn is told and no number.
#[test]
fn a_turn_that_grazes_is_told() {
    let tight = event(1e-13, f64::MAX);
    let built = |share: f64| {
        let harmonic = |amplitude: f64, order: f64| Harmonic { amplitude, order, phase: 0.0 };
        let terms = vec![harmonic(1e-6, 1.0), harmonic(share * 1e-6, 4.0)];
        let mut scene = p1();
        scene.waveforms[0] = wave("drive", Shape::Harmonics { terms }, 1e-3);
        Model::new(&scene).unwrap()
    };
    let until = 1e-3;
    let events = |share: f64| {
        let model = built(share);
        led(&model, &tight, model.start(&tight).unwrap(), until).counts().events
    };
    let (mut without, mut with) = (0.12, 0.13);
    let few = events(without);
    // To and fro, and the loop between closes.
    assert_eq!(events(with), few + 3);
    for _ in 0..60 {
        let middle = 0.5 * (without + with);
        if events(middle) == few { without = middle } else { with = middle }
    }
    for share in [without - 1e-3, with + 1e-3] {
        let model = built(share);
        let section = Section::new(&model, model.start(&tight).unwrap());
        agrees((&model, &tight), &section, until);
    }
    let model = built(with);
    let section = Section::new(&model, model.start(&tight).unwrap());
    let refused = varied((&model, &tight), &section, until).unwrap_err();
    println!("{with}: {refused}");
    assert!(matches!(&refused, VariationError::Grazes { contact, .. } if contact == "ball"), "{refused}");
}
