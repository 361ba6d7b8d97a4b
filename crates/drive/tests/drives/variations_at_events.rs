//! Variations through one kind of event each: a touch, events at one moment.

use crate::parts::{event, free, named, p1, steel};
use crate::variations::{differences, led, size, varied};
use stickslip_contact::{Interface, Profile};
use stickslip_drive::scene::{
    Axis, Body, Contact, ContactStart, Coordinate, EngineChoice, Freedom, Normal, Point, Scene, Side, Spring,
};
use stickslip_drive::section::{Section, Unknown};
use stickslip_drive::{Model, Run};

/// A flat end that comes down obliquely and sticks: from the touch on it swings on E\*2b and G\*2b, whose anchors are where it touched.
/// A touch later by δt₁ leaves x later by ẋ(1 - cos ωτ)δt₁ and z by ż cos Ωτ δt₁.
#[test]
fn a_flat_end_that_touches_varies_with_where_it_has_touched() {
    let (radius, mass, gap, fall, slide) = (50e-6, 0.02, 2e-6, 1e-3, 2e-4);
    let at = |velocity| Coordinate { freedom: Freedom::Free, position: 0.0, velocity };
    let body = Body { mass: Some(mass), x: at(slide), z: at(-fall), ..Body::default() };
    let interface = Interface::new(steel(), Profile::flat(radius).unwrap(), 0.8).unwrap();
    let [along, normal] = [interface.tangential_modulus(), interface.normal_modulus()];
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
    let scene =
        Scene { bodies: vec![named("body", body)], contacts: vec![named("foot", foot)], ..Scene::default() };
    let (mut model, tight) = (Model::new(&scene).unwrap(), event(1e-13, f64::MAX));
    model.keep_together();
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
    let mut variation = section.variation(section.base(), 1e-13).unwrap();
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
    let (mut model, tight) = (Model::new(&scene).unwrap(), event(1e-13, f64::MAX));
    model.keep_together();
    let scale = model.contact_natural(0).unwrap();
    let section = Section::new(&model, led(&model, &tight, model.start(&tight).unwrap(), 1.45e-3));
    let until = 2.6e-3;
    let (columns, end) = varied((&model, &tight), &section, until).unwrap();
    assert!(end.counts().events > section.base().counts().events + 10, "{:?}", end.counts());
    let natural = [scale.displacement, scale.velocity];
    let known = [1e-4, 2e-5, 4e-6].into_iter().filter_map(|h| {
        let (by_runs, mended) = differences((&model, &tight), &section, until, h)?;
        Some((size(mended.into_iter(), &by_runs, natural), by_runs))
    });
    let (doubt, by_runs) = known.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    let pairs = columns.iter().zip(&by_runs);
    let apart = pairs.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a - b).collect());
    let off = size(apart, &by_runs, natural);
    println!("off by {off:.1e}, differences by {doubt:.1e}");
    assert!(doubt < 1e-7 && off < 1e-7, "{off:e}, differences {doubt:e}");
}
