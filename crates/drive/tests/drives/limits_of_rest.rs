//! Unusual supports, missing supports, and bodies at rest.

use crate::parts::{channel, contact, event, named, trace, wave};
use crate::stages::{
    BALL, Foot, GROUND_STAGE, MASS, SIX, THREE, coupled, earth, force_at, hertz, moment, normal_modulus,
    rest, stage, tangential_modulus, upright,
};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Body, Contact, Coordinate, EngineChoice, Named, Point, Scene, Side, Varying};
use stickslip_drive::{EventKind, Field, Part, Shape};

const HEIGHT: f64 = 6e-3;

/// Name and imbalance of the error `NoEquilibrium`.
fn lost(scene: &Scene) -> (String, f64) {
    let error = rest(scene).unwrap_err();
    assert_eq!((error.part, error.field), (Part::Run, Field::Start));
    assert!(error.fault.advice().is_some());
    let message = error.fault.to_string();
    let (what, amount) = message.split_once(": ").unwrap();
    (what.to_owned(), amount.split(' ').next().unwrap().parse().unwrap())
}

fn check(scene: &Scene, way: &str, amount: f64) {
    let (what, got) = lost(scene);
    assert_eq!(what, format!("`stage` has no static equilibrium {way}"));
    assert!((got - amount).abs() < 1e-3 * amount.abs(), "{way}: {got:e}, expected {amount:e}");
}

#[test]
fn a_load_beyond_friction_leaves_the_rest_of_it_along_x() {
    for gap in [0.0, 100e-6, -0.5e-6] {
        let mut scene = stage(&THREE, HEIGHT, 0.2);
        scene.gravity = earth(0.0);
        scene.contacts.iter_mut().for_each(|c| c.part.gap = gap);
        scene.loads.push(force_at(0, (0.0, -HEIGHT), (0.15, 0.0)));
        check(&scene, "along x", 0.15 - 0.2 * MASS * 9.81);
        scene.loads[0].x = Varying::Constant(-0.15);
        check(&scene, "along x", -0.15 + 0.2 * MASS * 9.81);
    }
}

#[test]
fn a_load_upwards_leaves_itself_along_z() {
    let mut scene = stage(&SIX, HEIGHT, 0.2);
    scene.gravity = earth(0.0);
    scene.loads.push(force_at(0, (4e-3, 1e-3), (0.1, 0.7)));
    check(&scene, "along z", 0.7 - MASS * 9.81);
}

#[test]
fn a_load_outside_the_support_leaves_its_moment_about_the_last_foot() {
    for (at, last) in [(17e-3, THREE[1].x), (-10e-3, THREE[0].x)] {
        let mut scene = stage(&THREE, HEIGHT, 0.2);
        scene.loads.push(force_at(0, (at, 0.0), (0.0, -2.0)));
        check(&scene, "in pitch", -2.0 * (at - last));
    }
    let mut scene = stage(&SIX, HEIGHT, 0.2);
    (scene.gravity, scene.loads) = (earth(0.0), vec![moment(0, 8e-3)]);
    // A moment from x to z unloads the front feet: it tilts about the last one.
    check(&scene, "in pitch", 8e-3 + MASS * 9.81 * SIX[0].x);
}

/// A block on two feet at ±a, h below its centre, tilts at F h = m g a, for any stiffness of the feet. Beyond it there is no equilibrium.
#[test]
fn a_block_stands_up_to_the_load_that_tips_it_and_no_further() {
    let (a, h) = (8e-3, 20e-3);
    let block = |load: f64| {
        let mut scene = stage(&[Foot { x: a, count: 1 }, Foot { x: -a, count: 1 }], h, 2.0);
        scene.gravity = earth(0.0);
        scene.loads.push(force_at(0, (0.0, 0.0), (load, 0.0)));
        scene
    };
    let limit = MASS * 9.81 * a / h;
    for k in 0..200 {
        let beside = 10.0_f64.powf(-3.0 - 4.0 * f64::from(k) / 199.0);
        for way in [1.0, -1.0] {
            let scene = block(way * limit * (1.0 - beside));
            let still = rest(&scene).unwrap_or_else(|error| panic!("{beside:e} {way}: {error}"));
            // Load of the rear foot.
            let left = 0.5 * MASS * 9.81 * beside;
            let last = still.normal(&scene, if way > 0.0 { 1 } else { 0 }, hertz);
            assert!((last - left).abs() < 1e-8 * MASS * 9.81, "{beside:e} {way}: {last:e} {left:e}");
            let error = rest(&block(way * limit * (1.0 + beside))).unwrap_err().fault.to_string();
            assert!(
                error.starts_with("`stage` has no static equilibrium in pitch: "),
                "{beside:e} {way}: {error}"
            );
        }
    }
}

/// Two springs carry a plate, which turns under a moment by M/(2 k a²). Angles beyond the small-angle limit are refused.
#[test]
fn what_balances_beyond_small_angles_is_no_equilibrium() {
    let (a, k) = (8e-3, 1e3);
    let turned = |angle: f64| {
        let springs = [-a, a].map(|x| named(&format!("at {x}"), upright(0, Point { x, z: 0.0 }, k, 0.0)));
        let mut scene = stage(&[], HEIGHT, 0.2);
        scene.bodies[0].part.x = Coordinate::default();
        scene.springs = springs.into();
        scene.loads.push(moment(0, 2.0 * k * a * a * angle));
        scene
    };
    for angle in [0.0999, -0.0999] {
        let [_, z, pitch] = rest(&turned(angle)).unwrap().pose(0);
        assert!((pitch - angle).abs() < 1e-12 && z.abs() < 1e-12, "{angle}: {z} {pitch}");
    }
    for angle in [0.1001, -0.1001, 3.0] {
        let error = rest(&turned(angle)).unwrap_err();
        assert_eq!((error.part, error.field), (Part::Run, Field::Start));
        assert_eq!(
            error.fault.to_string(),
            format!(
                "`stage` has no static equilibrium in pitch: it would rotate to {angle:.3e} rad, beyond the limit of small angles, 0.1 rad"
            )
        );
    }
}

#[test]
fn without_friction_a_stage_rests_on_the_level_and_slides_on_an_incline() {
    let mut scene = stage(&THREE, HEIGHT, 0.0);
    scene.gravity = earth(0.0);
    let level = rest(&scene).unwrap();
    let weight: f64 = (0..2).map(|c| f64::from(THREE[c].count) * level.normal(&scene, c, hertz)).sum();
    assert!((weight - MASS * 9.81).abs() < 1e-10 * weight && level.pose(0)[0] == 0.0);
    scene.gravity = earth(1e-3);
    check(&scene, "along x", -MASS * 9.81 * 1e-3_f64.sin());
}

#[test]
fn a_follower_that_presses_from_above_shares_its_force_with_the_weight() {
    // The ram moves down by 0.3 µm onto the slider.
    let ball = || Profile::paraboloid(BALL).unwrap();
    let stroke = Shape::Sine { amplitude: 1e-6, phase: 0.0, offset: -0.3e-6 };
    let slider = Body { mass: Some(MASS), z: Coordinate::FREE, ..Body::default() };
    let ram = Body { z: Coordinate::follows(0), ..Body::default() };
    let mut scene = Scene {
        waveforms: vec![wave("ram", stroke, 1e-3)],
        bodies: vec![named("slider", slider), named("ram", ram)],
        contacts: vec![
            named("below", coupled(GROUND_STAGE, Point::default(), ball(), 0.2)),
            named("above", coupled([Side::Body(0), Side::Body(1)], Point::default(), ball(), 0.2)),
        ],
        ..stage(&[], HEIGHT, 0.0)
    };
    scene.gravity = earth(0.0);
    let both = rest(&scene).unwrap();
    let (below, above) = (both.depth(&scene.contacts[0].part), both.depth(&scene.contacts[1].part));
    assert!((below + above - 0.3e-6).abs() < 1e-20 && above > 0.0);
    let weight = hertz(below) - hertz(above);
    assert!((weight - MASS * 9.81).abs() < 1e-10 * weight, "{weight:e}");
}

#[test]
fn a_prescribed_force_and_coupled_contacts_hold_one_body_together() {
    // A brake with a given force and the feet carry the load along x in stick, in proportion to their stiffness.
    let mut scene = stage(&THREE, HEIGHT, 0.3);
    scene.gravity = earth(0.0);
    let brake = contact(GROUND_STAGE, Profile::flat(0.05e-3).unwrap(), 0.3, 1.0);
    let at = [Point { x: 0.0, z: 0.0 }, Point { x: 0.0, z: -HEIGHT }];
    scene.contacts.push(named("brake", Contact { at, ..brake }));
    scene.loads.push(force_at(0, (0.0, -HEIGHT), (-0.05, 0.0)));
    let shared = rest(&scene).unwrap();
    let feet: f64 = (0..2).map(|c| f64::from(THREE[c].count) * shared.tangential(c)).sum();
    assert!((feet + shared.tangential(2) - 0.05).abs() < 1e-11);
    // A flat punch of radius b has the constant stick stiffness 2G*b: F_x = 2G*b u.
    let [x, _, pitch] = shared.pose(0);
    let want = -2.0 * tangential_modulus() * 0.05e-3 * (x + HEIGHT * pitch);
    assert!((shared.tangential(2) - want).abs() < 1e-10 * want.abs() && want > 0.0);
}

fn on_rows(mut scene: Scene, span: Option<f64>) -> Scene {
    for Named { part, .. } in &mut scene.contacts {
        part.engine = EngineChoice::Springs { count: 2048, span };
    }
    scene
}

#[test]
fn rows_of_springs_come_to_the_same_rest() {
    let mut scene = stage(&SIX, HEIGHT, 0.3);
    scene.gravity = earth(0.1);
    let rows = on_rows(scene.clone(), None);
    let (curve, row) = (rest(&scene).unwrap(), rest(&rows).unwrap());
    for c in 0..3 {
        let (a, b) = (curve.tangential(c), row.tangential(c));
        assert!((a - b).abs() < 1e-4 * a.abs(), "{a:e} {b:e}");
        let (a, b) = (curve.normal(&scene, c, hertz), row.normal(&scene, c, hertz));
        assert!((a - b).abs() < 1e-6 * a, "{a:e} {b:e}");
    }
    let short = rest(&on_rows(scene, Some(1e-6))).unwrap_err();
    assert_eq!((short.part, short.field), (Part::Contact(0), Field::Engine));
    assert!(short.fault.to_string().starts_with("in static equilibrium the indentation"), "{short}");
}

/// Stage on an incline that needs half of the friction limit.
fn inclined() -> Scene {
    let friction = 0.3;
    let mut scene = stage(&THREE, HEIGHT, friction);
    scene.gravity = earth((0.5_f64 * friction).atan());
    scene
}

#[test]
fn a_stage_at_rest_on_an_incline_stays_there() {
    // The slowest mode is the motion along the slide; 1000 of its periods.
    let scene = inclined();
    let start = rest(&scene).unwrap();
    let feet = |c: usize| f64::from(THREE[c].count);
    let depth = |c: usize| start.depth(&scene.contacts[c].part);
    let stiffness: f64 =
        (0..2).map(|c| feet(c) * 2.0 * tangential_modulus() * (BALL * depth(c)).sqrt()).sum();
    let period = std::f64::consts::TAU * (MASS / stiffness).sqrt();
    let (model, state, rows) = trace(&scene, &event(1e-8, 1000.0 * period), 10.0 * period);
    let slopes = 0.3 * normal_modulus() / tangential_modulus();
    let d = depth(0).min(depth(1));
    for (name, scale) in [("stage.x_m", slopes * d), ("stage.z_m", d), ("stage.pitch_rad", d / 14e-3)] {
        let c = channel(&model, name);
        let values: Vec<f64> = rows.column(c).collect();
        let most = values.iter().map(|v| (v - values[0]).abs()).fold(0.0, f64::max) / scale;
        println!("{name}: {most:.1e}");
        assert!(most < 32.0 * f64::EPSILON, "{name}: {most:e}");
    }
    println!("{:?}", state.counts());
    assert!(rows.events().all(|(e, _)| e.kind != EventKind::LiftOff) && state.counts().events < 10);
}
