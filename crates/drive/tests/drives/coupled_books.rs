//! Energy balance of bodies that move in the plane: contacts land, grow, rock, shrink and separate.

use crate::parts::{
    channel, column, event, fitted_order, foot_and_slider, named, of_profile, plan, trace, wave,
};
use crate::stages::{BALL, Foot, GROUND_STAGE, SIX, THREE, coupled, earth, planar, rest, stage, upright};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Coordinate, Direction, Gravity, Point, Scene, Side, Spring, Start};
use stickslip_drive::{EventKind, Model, Plan, Shape, Stepper, Trace};

const HEIGHT: f64 = 6e-3;

fn moving(velocity: f64) -> Coordinate {
    Coordinate { velocity, ..Coordinate::FREE }
}

/// Ball that falls by 10 µm, with sliding and rotation.
fn bouncing() -> Scene {
    let radius = 5e-3;
    let mut body = planar(0.01, 0.4 * 0.01 * radius * radius);
    (body.x, body.pitch) = (moving(0.02), moving(3.0));
    body.z.position = 10e-6;
    let at = Point { x: 0.0, z: -radius };
    let ball = coupled(GROUND_STAGE, at, Profile::paraboloid(radius).unwrap(), 0.2);
    Scene {
        bodies: vec![named("stage", body)],
        contacts: vec![named("ball", ball)],
        gravity: Gravity { acceleration: 9.81, incline: 0.05 },
        ..Scene::default()
    }
}

/// Stage with an initial velocity.
fn rocking(feet: &[Foot], push: f64) -> Scene {
    let mut scene = stage(feet, HEIGHT, 0.3);
    scene.gravity = earth(0.0);
    let pose = rest(&scene).unwrap().pose(0);
    let body = &mut scene.bodies[0].part;
    for ((coordinate, place), speed) in
        [&mut body.x, &mut body.z, &mut body.pitch].into_iter().zip(pose).zip([4e-4, -1e-4, 0.02])
    {
        (coordinate.position, coordinate.velocity) = (place, push * speed);
    }
    scene.start = Start::Given;
    scene
}

const SAWTOOTH: Shape = Shape::Sawtooth { stroke: 0.5e-6, flyback: 0.1e-3 };

/// Foot that moves back and forth under a stage on three balls.
fn driven(shape: Shape, profile: &Profile) -> Scene {
    let mut scene = stage(&THREE, HEIGHT, 0.15);
    let slider = scene.bodies.remove(0);
    let base = foot_and_slider(wave("drive", shape, 1e-3), 1.0, scene.contacts[0].part.clone());
    (scene.waveforms, scene.bodies) = (base.waveforms, vec![base.bodies[0].clone(), slider]);
    for contact in &mut scene.contacts {
        contact.part.between = [Side::Body(0), Side::Body(1)];
        contact.part = of_profile(profile.clone(), &contact.part);
    }
    scene.gravity = earth(0.0);
    scene
}

/// The same with a preloaded spring, dampers and damped contacts.
fn damped(mut scene: Scene, beta: f64, viscous: f64) -> Scene {
    let body = scene.bodies.len() - 1;
    for contact in &mut scene.contacts {
        contact.part = crate::parts::damped(&contact.part, beta);
    }
    let at = Point { x: 3e-3, z: 4e-3 };
    let press = Spring { damping: viscous, ..upright(body, at, 1e4, -0.5) };
    let drag = Spring { direction: Direction::X, stiffness: 1e3, preload: 0.0, ..press };
    scene.springs = vec![named("press", press), named("drag", drag)];
    scene
}

struct Books {
    time: Vec<f64>,
    error: Vec<f64>,
    damping: Vec<f64>,
    friction: Vec<f64>,
    throughput: f64,
    events: Vec<EventKind>,
    model: Model,
    trace: Trace,
}

fn books(scene: &Scene, plan: &Plan, rows: u32) -> Books {
    let (model, _, trace) = trace(scene, plan, plan.duration / f64::from(rows));
    let energy = |part: &str| column(&model, &trace, &format!("energy.{part}_J"));
    let entries = ["input", "kinetic", "elastic", "friction", "damping"].map(energy);
    Books {
        time: column(&model, &trace, "time_s"),
        error: energy("error"),
        damping: energy("damping"),
        friction: energy("friction"),
        throughput: entries.iter().flatten().fold(0.0_f64, |most, e| e.abs().max(most)),
        events: trace.events().map(|(e, _)| e.kind).collect(),
        model,
        trace,
    }
}

impl Books {
    /// Largest error of any row relative to the throughput.
    fn worst(&self) -> f64 {
        self.error.iter().fold(0.0_f64, |most, e| e.abs().max(most)) / self.throughput
    }

    fn column(&self, name: &str) -> Vec<f64> {
        column(&self.model, &self.trace, name)
    }

    fn count(&self, kind: EventKind) -> usize {
        self.events.iter().filter(|k| **k == kind).count()
    }
}

/// Models with a duration and the smallest numbers of landings, full stick and gross slip.
fn scenes() -> Vec<(&'static str, Scene, f64, [usize; 3])> {
    let paraboloid = || Profile::paraboloid(BALL).unwrap();
    vec![
        ("bouncing ball", bouncing(), 15e-3, [5, 1, 4]),
        ("rocking on three", rocking(&THREE, 0.1), 5e-3, [0, 15, 0]),
        ("rocking on six", rocking(&SIX, 1.0), 5e-3, [0, 30, 1]),
        ("rocking off three", rocking(&THREE, 5.0), 5e-3, [2, 10, 10]),
        ("driven stage", driven(SAWTOOTH, &paraboloid()), 10e-3, [0, 30, 30]),
        ("driven stage on flats", driven(SAWTOOTH, &Profile::flat(0.05e-3).unwrap()), 10e-3, [0, 30, 30]),
        ("damped contacts", damped(driven(SAWTOOTH, &paraboloid()), 2e-6, 0.0), 10e-3, [0, 30, 30]),
        ("damped springs", damped(rocking(&THREE, 1.0), 0.0, 5.0), 5e-3, [0, 15, 1]),
        ("all damped", damped(rocking(&SIX, 5.0), 2e-6, 5.0), 5e-3, [1, 30, 10]),
        ("damped ball", damped(bouncing(), 2e-6, 0.1), 15e-3, [4, 1, 1]),
    ]
}

#[test]
fn books_of_coupled_motion_balance_in_every_row() {
    for (name, scene, duration, least) in scenes() {
        let books = books(&scene, &event(1e-10, duration), 200);
        let happened =
            [EventKind::Touch, EventKind::FullStick, EventKind::GrossSlip].map(|kind| books.count(kind));
        println!("{name}: {:.1e} of {:.1e} J, {happened:?}", books.worst(), books.throughput);
        assert!(books.worst() < 1e-8, "{name}: {:e}", books.worst());
        assert!(happened.iter().zip(least).all(|(n, least)| *n >= least), "{name}: {happened:?}");
        let lost = |entry: &[f64]| entry.windows(2).all(|w| w[1] >= w[0] - 1e-10 * books.throughput);
        assert!(lost(&books.friction) && lost(&books.damping), "{name}");
        assert!(books.friction[200] > 1e-4 * books.throughput, "{name}");
    }
}

/// ∫ f dt over the rows by Simpson's rule.
fn integral(time: &[f64], power: &[f64]) -> f64 {
    let pair = |k: usize| (time[k + 2] - time[k]) / 6.0 * (power[k] + 4.0 * power[k + 1] + power[k + 2]);
    (0..time.len() - 2).step_by(2).map(pair).sum()
}

#[test]
fn damping_is_the_integral_of_the_power_of_the_dampers() {
    // At (3 mm, 4 mm): ė = v_x - 4 mm θ̇ along x, v_z + 3 mm θ̇ along z.
    let books = books(&damped(rocking(&THREE, 1.0), 0.0, 5.0), &event(1e-10, 5e-3), 4000);
    let [x, z, turn] = ["vx_m_s", "vz_m_s", "vpitch_rad_s"].map(|v| books.column(&format!("stage.{v}")));
    let power = |k: usize| 5.0 * ((x[k] - 4e-3 * turn[k]).powi(2) + (z[k] + 3e-3 * turn[k]).powi(2));
    let power: Vec<f64> = (0..x.len()).map(power).collect();
    let (got, want) = (books.damping[4000], integral(&books.time, &power));
    println!("{got:e}, integral {want:e}");
    assert!((got - want).abs() < 1e-8 * want, "{got:e} {want:e}");
}

#[test]
fn fixed_steps_balance_at_their_own_order() {
    let scenes = [
        ("rocking", rocking(&SIX, 0.2), 2e-3),
        ("rocking with slip", rocking(&THREE, 1.0), 2e-3),
        ("damped", damped(rocking(&THREE, 1.0), 2e-6, 5.0), 2e-3),
    ];
    for (name, scene, duration) in scenes {
        for method in ["verlet", "rk4"] {
            let points: Vec<(f64, f64)> = (0..5)
                .map(|k| {
                    let step = 1e-6 / f64::from(1 << k);
                    let stepper =
                        if method == "rk4" { Stepper::Rk4 { step } } else { Stepper::Verlet { step } };
                    (step, books(&scene, &plan(stepper, duration), 50).worst())
                })
                .collect();
            let order = fitted_order(&points);
            println!("{method}, {name}: order {order:.2}, {:.1e} down to {:.1e}", points[0].1, points[4].1);
            assert!(order > 1.9, "{method}, {name}: {points:?}");
        }
    }
}

/// Falls from several heights, with landings at different positions in a step. v² = 2g(h-z) at the touch.
#[test]
fn flight_ends_with_the_speed_of_free_fall() {
    for height in [1e-6, 3e-6, 10e-6, 31e-6, 100e-6] {
        let mut scene = bouncing();
        scene.bodies[0].part.z.position = height;
        let books = books(&scene, &event(1e-6, 6e-3), 6);
        let [place, speed] = ["stage.z_m", "stage.vz_m_s"].map(|name| channel(&books.model, name));
        let (touch, row) = books.trace.events().next().unwrap();
        assert_eq!(touch.kind, EventKind::Touch);
        let off = row[speed].powi(2) / (2.0 * 9.81 * 0.05_f64.cos() * (height - row[place])) - 1.0;
        println!("{height:e} m: off by {off:.1e}");
        assert!(off.abs() < 1e-12);
    }
}
