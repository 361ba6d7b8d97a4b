//! Invalid planar models, and similar valid ones.

use crate::parts::{contact, damped, damper, event, named, of_friction, of_profile, piezo, wave};
use stickslip_contact::Profile;
use stickslip_drive::scene::{
    Axis, Body, Contact, ContactStart, Coordinate, Direction, Gravity, Load, Normal, Point, Scene, Side,
    Spring, Start, Varying,
};
use stickslip_drive::{Field, Model, Part, SceneError, Shape, State};

const MASS: f64 = 0.02;
const GROUND_BLOCK: [Side; 2] = [Side::Ground, Side::Body(0)];

/// Ball under the block, pressed by its motion.
fn ball(x: f64) -> Contact {
    Contact {
        at: [Point::default(), Point { x, z: -5e-3 }],
        normal: Normal::Coupled,
        ..contact(GROUND_BLOCK, Profile::paraboloid(5e-3).unwrap(), 0.2, 0.0)
    }
}

/// Block that is free in the plane, on two balls ±8 mm from its middle.
fn block() -> Scene {
    let free = Coordinate::FREE;
    let block = Body { mass: Some(MASS), inertia: Some(1e-6), x: free, z: free, pitch: free };
    Scene {
        bodies: vec![named("block", block)],
        contacts: vec![named("left", ball(-8e-3)), named("right", ball(8e-3))],
        gravity: Gravity { acceleration: 9.81, incline: 0.0 },
        start: Start::Equilibrium,
        ..Scene::default()
    }
}

fn start(scene: &Scene) -> Result<(Model, State), SceneError> {
    let model = Model::new(scene)?;
    let state = model.start(&event(1e-8, 1e-3))?;
    Ok((model, state))
}

type Change = fn(&mut Scene);

fn changed(change: Change) -> Scene {
    let mut scene = block();
    change(&mut scene);
    scene
}

fn refused(change: Change, place: (Part, Field), words: &str) {
    let error = start(&changed(change)).map(|_| ()).unwrap_err();
    assert_eq!((error.part, error.field), place, "{error}");
    assert!(error.fault.to_string().contains(words), "{error}");
    assert!(error.fault.advice().is_some_and(|advice| !advice.is_empty()), "{error}");
}

fn accepted(change: Change) -> (Model, State) {
    start(&changed(change)).unwrap_or_else(|error| panic!("{error}"))
}

fn spring(direction: Direction, x: f64) -> Spring {
    let at = [Point::default(), Point { x, z: 0.0 }];
    Spring { direction, at, stiffness: 1e3, ..damper(GROUND_BLOCK, 0.0) }
}

#[test]
fn a_free_z_that_nothing_holds_is_refused() {
    let (place, words) = ((Part::Body(0), Field::Coordinate(Axis::Z)), "no part holds z, which is free");
    let fixed: Change = |s| {
        s.bodies[0].part.pitch = Coordinate::default();
        for contact in &mut s.contacts {
            contact.part.normal = Normal::Force(Varying::Constant(1.0));
        }
    };
    refused(fixed, place, words);
    // A preload without stiffness does not hold it, nor does a spring along x.
    refused(
        |s| {
            s.contacts.clear();
            s.bodies[0].part.pitch = Coordinate::default();
            s.springs.push(named("tie", spring(Direction::X, 0.0)));
            s.springs
                .push(named("weight", Spring { stiffness: 0.0, preload: 1.0, ..spring(Direction::Z, 0.0) }));
        },
        place,
        words,
    );
    accepted(|s| {
        s.contacts.clear();
        s.bodies[0].part.x = Coordinate::default();
        s.bodies[0].part.pitch = Coordinate::default();
        let jack = piezo(GROUND_BLOCK, 1e6, Varying::Constant(1e-7));
        s.actuators.push(named("jack", stickslip_drive::scene::Actuator { direction: Direction::Z, ..jack }));
    });
}

#[test]
fn a_free_pitch_that_nothing_holds_is_refused() {
    let (place, words) =
        ((Part::Body(0), Field::Coordinate(Axis::Pitch)), "no part holds pitch, which is free");
    refused(
        |s| {
            s.contacts.truncate(1);
            s.contacts[0].part.at = [Point::default(); 2];
        },
        place,
        words,
    );
    // Without friction the contact force acts through the reference point.
    refused(
        |s| {
            s.contacts.truncate(1);
            s.contacts[0].part.at[1].x = 0.0;
            s.contacts[0].part = of_friction(0.0, &s.contacts[0].part);
        },
        place,
        words,
    );
    let tied: Change = |s| {
        s.contacts.truncate(1);
        s.contacts[0].part.at = [Point::default(); 2];
        s.springs.push(named("tie", spring(Direction::Z, 4e-3)));
    };
    accepted(tied);
}

#[test]
fn what_is_missing_is_named() {
    refused(|s| s.bodies[0].part.mass = None, (Part::Body(0), Field::Whole), "needs a mass");
    refused(|s| s.bodies[0].part.inertia = None, (Part::Body(0), Field::Whole), "needs a moment of inertia");
    let no_partner: Change = |s| {
        s.bodies[0].part.z = Coordinate::default();
        s.bodies[0].part.pitch = Coordinate::default();
    };
    refused(no_partner, (Part::Contact(0), Field::Normal), "neither body moves along the normal");
    let open: Change = |s| {
        s.start = Start::Given;
        s.contacts[0].part.gap = 1e-6;
        s.contacts[0].part.start = ContactStart::Force(1e-3);
    };
    refused(open, (Part::Contact(0), Field::Start), "open at the start");
}

#[test]
fn a_sphere_that_the_loads_press_beyond_its_equator_is_refused() {
    let small: Change =
        |s| s.contacts[1].part = of_profile(Profile::sphere(1e-9).unwrap(), &s.contacts[1].part);
    refused(small, (Part::Contact(1), Field::Normal), "the range of the profile");
}

/// A foot that jumps under a damped contact is refused: the impulse would be infinite.
#[test]
fn a_damped_contact_cannot_follow_a_jump() {
    let jumping: Change = |s| {
        s.waveforms.push(wave("drive", Shape::Sawtooth { stroke: 1e-7, flyback: 0.0 }, 1e-3));
        s.bodies.push(named("foot", Body { x: Coordinate::follows(0), ..Body::default() }));
        s.contacts[0].part.between[0] = Side::Body(1);
        s.contacts[0].part = damped(&s.contacts[0].part, 1e-6);
    };
    refused(
        jumping,
        (Part::Contact(0), Field::Damping),
        "a damper cannot follow the jumps of waveform `drive`",
    );
    let mut scene = changed(jumping);
    scene.contacts[0].part = damped(&scene.contacts[0].part, 0.0);
    start(&scene).unwrap();
}

#[test]
fn a_missing_equilibrium_names_its_coordinate() {
    let push = |x, z, pitch| Load {
        on: 0,
        at: Point::default(),
        x: Varying::Constant(x),
        z: Varying::Constant(z),
        pitch: Varying::Constant(pitch),
    };
    let weight = MASS * 9.81;
    // Friction holds 0.2 of the weight, the ground exerts no tension, and the block tilts when the moment exceeds the weight times 8 mm.
    let cases = [
        (push(0.21 * weight, 0.0, 0.0), "along x"),
        (push(0.0, 1.01 * weight, 0.0), "along z"),
        (push(0.0, 0.0, 8.1e-3 * weight), "in pitch"),
    ];
    for (load, way) in cases {
        let mut scene = block();
        scene.loads.push(load);
        let error = start(&scene).map(|_| ()).unwrap_err();
        assert_eq!((error.part, error.field), (Part::Run, Field::Start));
        assert!(
            error.fault.to_string().contains(&format!("`block` has no static equilibrium {way}")),
            "{error}"
        );
    }
    for load in
        [push(0.19 * weight, 0.0, 0.0), push(0.0, 0.99 * weight, 0.0), push(0.0, 0.0, 7.9e-3 * weight)]
    {
        let mut scene = block();
        scene.loads.push(load);
        let (model, state) = start(&scene).unwrap_or_else(|error| panic!("{error}"));
        assert!(state.coordinate(&model, 0, Axis::Z).unwrap().0 < 0.0);
    }
}
