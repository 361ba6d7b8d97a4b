//! Impacts of a sphere on a plane.

use crate::lottery::Draw;
use crate::parts::{column, end, event, fitted_order, follower, named, plan, trace, wave};
use stickslip_contact::{Interface, Pair, Profile};
use stickslip_drive::scene::{
    Axis, Body, Contact, ContactStart, Coordinate, EngineChoice, Freedom, Gravity, Normal, NormalDamping,
    Point, Scene, Side, Varying,
};
use stickslip_drive::{EventKind, Model, Shape, State, Stepper};

/// Radius, mass, friction and approach velocity of the ball; the results do not depend on them.
const RADIUS: f64 = 0.01;
const MASS: f64 = 0.03;
const FRICTION: f64 = 0.25;
const SPEED: f64 = 0.1;
const MODULUS: f64 = 1e11;

/// Solid ball that lands on the ground with ψ₁ = (G*/(E*μ)) V_x/V_z, without rotation.
fn ball(ratio: f64, psi: f64) -> Scene {
    let coordinate = |velocity| Coordinate { freedom: Freedom::Free, position: 0.0, velocity };
    let body = Body {
        mass: Some(MASS),
        inertia: Some(0.4 * MASS * RADIUS * RADIUS),
        x: coordinate(psi * FRICTION / ratio * SPEED),
        z: coordinate(-SPEED),
        pitch: coordinate(0.0),
    };
    let contact = Contact {
        between: [Side::Ground, Side::Body(0)],
        at: [Point::default(), Point { x: 0.0, z: -RADIUS }],
        interface: Interface::new(
            Pair::from_moduli(MODULUS, ratio * MODULUS).unwrap(),
            Profile::paraboloid(RADIUS).unwrap(),
            FRICTION,
        )
        .unwrap(),
        normal: Normal::Coupled,
        gap: 0.0,
        normal_damping: NormalDamping::None,
        start: ContactStart::Untouched,
        engine: EngineChoice::Curve,
        count: 1,
    };
    Scene { bodies: vec![named("ball", body)], contacts: vec![named("foot", contact)], ..Scene::default() }
}

/// Largest indentation by Hertz, m: (15mv²/(16E\*√R))^{2/5}.
fn deepest() -> f64 {
    (15.0 * MASS * SPEED * SPEED / (16.0 * MODULUS * RADIUS.sqrt())).powf(0.4)
}

/// Contact time by Hertz, s: 2 d_max/v ∫₀¹ dx/√(1-x^{5/2}) = (4√π/5) Γ(2/5)/Γ(9/10) d_max/v.
fn contact_time() -> f64 {
    const GAMMA_2_5: f64 = 2.218_159_543_757_688;
    const GAMMA_9_10: f64 = 1.068_628_702_119_319;
    0.8 * std::f64::consts::PI.sqrt() * GAMMA_2_5 / GAMMA_9_10 * deepest() / SPEED
}

fn impact(ratio: f64, psi: f64, stepper: Stepper) -> (Model, State) {
    end(&ball(ratio, psi), &plan(stepper, 1.2 * contact_time()))
}

/// ψ₂ = (G\*/(E\*μ)) V_x/V_z of the contact point after the impact.
fn rebound(ratio: f64, (model, state): &(Model, State)) -> f64 {
    let rate = |axis| state.coordinate(model, 0, axis).unwrap().1;
    ratio / FRICTION * (rate(Axis::X) + RADIUS * rate(Axis::Pitch)) / SPEED
}

/// ψ₂ by the event stepper.
fn psi_2(ratio: f64, psi: f64, tolerance: f64) -> f64 {
    rebound(ratio, &impact(ratio, psi, Stepper::Event { tolerance }))
}

/// G\*/E\* of two bodies of one material: 2(1-ν)/(2-ν).
fn like(nu: f64) -> f64 {
    2.0 * (1.0 - nu) / (2.0 - nu)
}

/// Reference: independent integration in long double with located events, confirmed by rows of up to 32 000 springs.
#[test]
fn oblique_impact_of_a_solid_sphere() {
    let digits = [
        (0.5, 0.047831, 5e-7),
        (1.0, -0.059696704, 1e-8),
        (1.5, -0.428016532, 1e-8),
        (2.0, -0.837210007, 1e-8),
        (3.0, -1.379683, 5e-7),
        (4.0, -1.436512, 5e-7),
    ];
    for (psi, known, digits) in digits {
        let found = psi_2(like(0.3), psi, 1e-11);
        assert!((found - known).abs() < digits, "ψ₁ = {psi}: {found} instead of {known}");
    }
}

/// Two published solutions of the same problem: ν = 0.23 and ν = 0.
#[test]
fn oblique_impact_at_other_poisson_ratios() {
    for (nu, psi, known) in
        [(0.23, 1.0, 0.04340), (0.23, 2.0, -0.70723), (0.0, 1.0, 0.28478), (0.0, 2.0, -0.30813)]
    {
        let found = psi_2(like(nu), psi, 1e-11);
        assert!((found - known).abs() < 1e-4, "ν = {nu}, ψ₁ = {psi}: {found} instead of {known}");
    }
}

/// For ψ₁ ≥ 4χ-1 the contact slips throughout: ψ₂ = ψ₁ - 4χ, χ = (7/4)G\*/E\*.
#[test]
fn gross_slip_all_the_way() {
    for nu in [0.0, 0.23, 0.3] {
        let ratio = like(nu);
        for psi in [7.0 * ratio - 0.9, 7.0 * ratio, 7.0, 8.0] {
            let found = psi_2(ratio, psi, 1e-12);
            assert!((found - (psi - 7.0 * ratio)).abs() < 1e-10, "ν = {nu}, ψ₁ = {psi}: {found}");
        }
    }
}

/// Central impact: depth, duration and rebound velocity.
#[test]
fn normal_impact_by_hertz() {
    let scene = ball(like(0.3), 0.0);
    let half = end(&scene, &event(1e-12, 0.5 * contact_time()));
    let depth = -half.1.coordinate(&half.0, 0, Axis::Z).unwrap().0;
    assert!((depth / deepest() - 1.0).abs() < 1e-9, "{depth} instead of {}", deepest());
    let (model, state, trace) = trace(&scene, &event(1e-12, 1.2 * contact_time()), contact_time());
    let lift = trace.events().find(|(event, _)| event.kind == EventKind::LiftOff).unwrap().0.t;
    assert!((lift / contact_time() - 1.0).abs() < 1e-9, "{lift} instead of {}", contact_time());
    let speed = state.coordinate(&model, 0, Axis::Z).unwrap().1;
    assert!((speed / SPEED - 1.0).abs() < 1e-11, "{speed}");
}

/// Integrates m z̈ = -F_N(d + βḋ) from a touch at the speed v with 2 000 000 steps of Runge and Kutta up to d + βḋ = 0; returns e.
fn own_restitution(law: &Interface, (mass, speed, beta): (f64, f64, f64), until: f64) -> f64 {
    let pull = |[d, v]: [f64; 2]| [v, -law.normal_force(d + beta * v) / mass];
    let add = |a: [f64; 2], h: f64, b: [f64; 2]| [a[0] + h * b[0], a[1] + h * b[1]];
    let (mut y, h) = ([0.0, speed], until / 2e6);
    loop {
        let k1 = pull(y);
        let k2 = pull(add(y, 0.5 * h, k1));
        let k3 = pull(add(y, 0.5 * h, k2));
        let k4 = pull(add(y, h, k3));
        let mean = [0, 1].map(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0);
        y = add(y, h, mean);
        if y[1] < 0.0 && y[0] + beta * y[1] <= 0.0 {
            return -y[1] / speed;
        }
    }
}

/// Four profiles, restitution 0.5 to 0.9: the rebound of the run, the own integration, and the coefficient asked for.
#[test]
fn a_damped_impact_rebounds_with_the_restitution_asked_for() {
    let profiles =
        [Profile::paraboloid(RADIUS), Profile::cone(0.05), Profile::flat(1e-4), Profile::power(1e4, 3.0)];
    for profile in profiles {
        let profile = profile.unwrap();
        for coefficient in [0.5, 0.7, 0.9, 1.0] {
            let mut scene = ball(like(0.3), 0.0);
            let contact = &mut scene.contacts[0].part;
            *contact = crate::parts::of_profile(profile.clone(), contact);
            contact.normal_damping = NormalDamping::Restitution { coefficient, speed: SPEED };
            let law = contact.interface.clone();
            let beta = law.damping_of_restitution((MASS, SPEED), coefficient).unwrap();
            let (model, state, trace) = trace(&scene, &event(1e-12, 1e-2), 1e-3);
            let found = state.coordinate(&model, 0, Axis::Z).unwrap().1 / SPEED;
            let lift = trace.events().find(|(event, _)| event.kind == EventKind::LiftOff).unwrap().0.t;
            let own = own_restitution(&law, (MASS, SPEED, beta), lift);
            println!("{coefficient}: {found} {own}");
            assert!((found - own).abs() < 1e-9, "{coefficient}: {found} {own}");
            assert!((found - coefficient).abs() < 1e-6, "{found} {coefficient}");
            let energies = column(&model, &trace, "energy.error_J");
            let worst = energies.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
            assert!(worst < 1e-9 * 0.5 * MASS * SPEED * SPEED, "{worst:e}");
        }
    }
}

/// Oblique impacts with damping along the normal and of the springs: both engines, located events and fixed steps.
#[test]
fn an_oblique_damped_impact_is_that_of_rows_and_of_fixed_steps() {
    for (psi, tangential) in [(1.0, 0.0), (2.0, 0.0), (4.0, 0.0), (1.5, 5e-6)] {
        let mut scene = ball(like(0.3), psi);
        let part = &mut scene.contacts[0].part;
        part.normal_damping = NormalDamping::Restitution { coefficient: 0.7, speed: SPEED };
        *part = crate::parts::damped(part, tangential);
        let span = 2.0 * contact_time();
        let [exact, coarse, fine, row] = [
            (&scene, event(1e-10, span)),
            (&scene, plan(Stepper::Rk4 { step: contact_time() / 4e3 }, span)),
            (&scene, plan(Stepper::Rk4 { step: contact_time() / 1.6e4 }, span)),
            (&crate::lottery::on_rows(&scene, 2000), event(1e-8, span)),
        ]
        .map(|(scene, plan)| {
            let (model, state, trace) = trace(scene, &plan, span / 500.0);
            let [force, normal] = ["foot.fx_N", "foot.fn_N"].map(|name| column(&model, &trace, name));
            for (force, normal) in force.iter().zip(&normal) {
                assert!(force.abs() <= FRICTION * normal * (1.0 + 1e-9) + 1e-12, "{force} {normal}");
            }
            let error = column(&model, &trace, "energy.error_J");
            let worst =
                error.iter().fold(0.0_f64, |most, e| most.max(e.abs())) / (0.5 * MASS * SPEED * SPEED);
            (rebound(like(0.3), &(model, state)), worst)
        });
        println!("{psi} {tangential}: {exact:?} {coarse:?} {fine:?} {row:?}");
        assert!((exact.0 - fine.0).abs() < 1e-4 && (exact.0 - row.0).abs() < 2e-3);
        assert!((exact.0 - fine.0).abs() < 0.6 * (exact.0 - coarse.0).abs() + 1e-6);
        assert!(exact.1 < 1e-8, "{exact:?}");
    }
}

/// The speed of the restitution asked for is 30 times that of the impact, for which a row of springs is made. Both engines rebound alike.
#[test]
fn a_row_has_the_damping_of_its_profile() {
    let mut scene = ball(like(0.3), 0.0);
    let part = &mut scene.contacts[0].part;
    part.normal_damping = NormalDamping::Restitution { coefficient: 0.5, speed: 30.0 * SPEED };
    let span = 2.0 * contact_time();
    let [curve, row] = [scene.clone(), crate::lottery::on_rows(&scene, 2000)].map(|scene| {
        let (model, state) = end(&scene, &event(1e-9, span));
        state.coordinate(&model, 0, Axis::Z).unwrap().1 / SPEED
    });
    assert!(curve < 0.8 && (curve - row).abs() < 1e-5, "{curve} {row}");
}

/// A damped punch that falls without weight rebounds alike from 100 heights, of which some put the touch before d = 0 by rounding.
#[test]
fn a_damped_impact_does_not_depend_on_the_height_of_the_fall() {
    let rebounds = (0..100).map(|k| {
        let mut scene = ball(like(0.3), 2.0);
        let height = 1e-6 * (1.0 + 0.37 * f64::from(k));
        scene.bodies[0].part.z.position = height;
        let part = &mut scene.contacts[0].part;
        *part = crate::parts::of_profile(Profile::flat(1e-4).unwrap(), part);
        part.normal_damping = NormalDamping::Restitution { coefficient: 0.5, speed: SPEED };
        let (model, state, trace) = trace(&scene, &event(1e-10, height / SPEED + 1e-2), 1e-4);
        let worst =
            column(&model, &trace, "energy.error_J").iter().fold(0.0_f64, |most, e| most.max(e.abs()));
        assert!(worst < 1e-7 * 0.5 * MASS * SPEED * SPEED, "{height:e}: {worst:e}");
        [Axis::X, Axis::Z].map(|axis| state.coordinate(&model, 0, axis).unwrap().1 / SPEED)
    });
    let rebounds: Vec<[f64; 2]> = rebounds.collect();
    for rebound in &rebounds {
        assert!((0..2).all(|i| (rebound[i] - rebounds[0][i]).abs() < 1e-7), "{rebound:?} {:?}", rebounds[0]);
    }
}

/// A prescribed triangle of the indentation costs (8/15)E\*√R [(D + βv)^{5/2} - (βv)^{5/2} - (D - βv)^{5/2}] each period.
#[test]
fn a_prescribed_indentation_pays_for_its_damping() {
    const DEPTH: f64 = 2e-7;
    const PERIOD: f64 = 7e-4;
    const BETA: f64 = 2e-5;
    let mut scene = ball(like(0.3), 0.0);
    scene.waveforms = vec![wave("press", Shape::Triangle { stroke: DEPTH }, PERIOD)];
    scene.bodies = vec![named("ball", Body { mass: None, ..follower(0) })];
    scene.bodies[0].part.x = Coordinate::default();
    let part = &mut scene.contacts[0].part;
    (part.normal, part.normal_damping) =
        (Normal::Indentation(Varying::Follows(0)), NormalDamping::Time(BETA));
    let lead = BETA * 2.0 * DEPTH / PERIOD;
    let powers = [DEPTH + lead, lead, DEPTH - lead].map(|d| d.powf(2.5));
    let cycle = 8.0 / 15.0 * MODULUS * RADIUS.sqrt() * (powers[0] - powers[1] - powers[2]);
    for tolerance in [1e-6, 1e-9] {
        let (model, _, trace) = trace(&scene, &event(tolerance, 10.0 * PERIOD), 0.1 * PERIOD);
        let [input, damping, error] = ["input", "damping", "error"]
            .map(|name| *column(&model, &trace, &format!("energy.{name}_J")).last().unwrap());
        for work in [input, damping] {
            assert!((work / (10.0 * cycle) - 1.0).abs() < 1e-3 * tolerance.sqrt(), "{work} {cycle}");
        }
        assert!(error.abs() < 1e-6 * cycle, "{error} {cycle}");
    }
}

/// Free bounces on a damped contact fade: the speed falls by e at each of them, and the ball comes to rest on the ground.
#[test]
fn bounces_fade() {
    let mut scene = ball(like(0.3), 0.0);
    scene.gravity = Gravity { acceleration: 9.81, ..Gravity::default() };
    scene.contacts[0].part.normal_damping = NormalDamping::Time(3e-6);
    let (model, state, trace) = trace(&scene, &event(1e-8, 0.5), 1e-3);
    let touches = trace.events().filter(|(event, _)| event.kind == EventKind::Touch).count();
    let speed = state.coordinate(&model, 0, Axis::Z).unwrap().1;
    println!("{touches} touches, {speed:e} m/s, {:?}", state.counts());
    assert!(touches > 3 && speed.abs() < 1e-3 * SPEED);
}

/// Error versus evaluations over six tolerances: with F_x as a state the order is kept through full stick. The run with the
/// smallest tolerance replaces the exact value.
#[test]
fn the_event_stepper_keeps_its_order_through_an_impact() {
    let ratio = like(0.3);
    for (psi, known) in [(1.0, -0.059696704), (2.0, -0.837210007)] {
        let exact = psi_2(ratio, psi, 1e-13);
        assert!((exact - known).abs() < 1e-9, "ψ₁ = {psi}: {exact}");
        let points: Vec<(f64, f64)> = (0..6)
            .map(|k| {
                let tolerance = 1e-5 * 0.06_f64.powi(k);
                let run = impact(ratio, psi, Stepper::Event { tolerance });
                (run.1.counts().evaluations as f64, (rebound(ratio, &run) - exact).abs())
            })
            .collect();
        let order = -fitted_order(&points);
        assert!(order > 5.0, "ψ₁ = {psi}: order {order}, {points:?}");
        assert!(points[5].1 < 1e-9, "{points:?}");
    }
}

/// The initial energy is kinetic; the loss is friction, in every row.
#[test]
fn the_books_of_an_impact_close() {
    for psi in [0.5, 1.0, 2.0, 3.0, 8.0] {
        let plan = event(1e-10, 1.2 * contact_time());
        let (model, _, trace) = trace(&ball(like(0.3), psi), &plan, 0.01 * contact_time());
        let kinetic = column(&model, &trace, "energy.kinetic_J");
        let worst = column(&model, &trace, "energy.error_J").iter().fold(0.0, |w: f64, e| w.max(e.abs()));
        assert!(worst < 1e-8 * kinetic[0], "ψ₁ = {psi}: {worst} of {}", kinetic[0]);
        let friction = column(&model, &trace, "energy.friction_J");
        let lost = kinetic[0] - kinetic.last().unwrap();
        assert!((lost / friction.last().unwrap() - 1.0).abs() < 1e-6, "ψ₁ = {psi}: {lost}");
    }
}

/// The same impact with rows of springs and small fixed steps, an independent solution.
#[test]
fn a_row_of_springs_bounces_like_the_curve() {
    let ratio = like(0.3);
    for psi in [1.0, 2.0, 4.0] {
        let exact = psi_2(ratio, psi, 1e-11);
        let errors = [256.0, 512.0, 1024.0, 2048.0, 4096.0].map(|count: f64| {
            let mut scene = ball(ratio, psi);
            scene.contacts[0].part.engine = EngineChoice::Springs { count: count as usize, span: None };
            let step = contact_time() / (4.0 * count);
            let run = end(&scene, &plan(Stepper::Verlet { step }, 1.2 * contact_time()));
            (1.0 / count, (rebound(ratio, &run) - exact).abs())
        });
        assert!(errors[4].1 < 1e-7, "ψ₁ = {psi}: {errors:?}");
        assert!(fitted_order(&errors) > 1.5, "ψ₁ = {psi}: {errors:?}");
    }
}

/// Body that bounces on its contact under its weight, drawn at random; all forces are conservative.
fn bouncer(seed: u64) -> (Scene, f64) {
    let mut draw = Draw::new(seed);
    let profile = match seed % 6 {
        0 => Profile::flat(draw.spread(1e-6, 1e-4)),
        1 => Profile::cone(draw.spread(1e-3, 0.1)),
        2 => Profile::power(draw.spread(1e6, 1e9), 3.0),
        3 => Profile::power(draw.spread(10.0, 1e3), 1.5),
        4 => Profile::sphere(draw.spread(1e-4, 1e-2)),
        _ => Profile::paraboloid(draw.spread(1e-4, 1e-2)),
    };
    let mut scene = ball(like(0.3), 0.0);
    let mass = draw.spread(1e-5, 0.1);
    let acceleration = draw.spread(1.0, 1e3);
    let pair = Pair::from_moduli(MODULUS, like(0.3) * MODULUS).unwrap();
    let interface = Interface::new(pair, profile.unwrap(), FRICTION).unwrap();
    let depth = interface.indentation(mass * acceleration);
    let frequency = (interface.normal_stiffness(depth) / mass).sqrt();
    let speed = depth * frequency * draw.spread(0.5, 10.0);
    let body = &mut scene.bodies[0].part;
    (body.mass, body.inertia) = (Some(mass), None);
    (body.x, body.pitch) = (Coordinate::default(), Coordinate::default());
    body.z = Coordinate { freedom: Freedom::Free, position: 0.0, velocity: -speed };
    scene.contacts[0].part.interface = interface;
    scene.contacts[0].part.at = [Point::default(); 2];
    scene.gravity = Gravity { acceleration, ..Gravity::default() };
    (scene, 2.0 * speed / acceleration + std::f64::consts::PI / frequency)
}

/// The total energy of a bouncing body, (z + v²/2g) mg plus the stored energy, is constant within some tolerances.
#[test]
fn a_body_that_bounces_rises_to_where_it_was() {
    const BOUNCES: f64 = 12.0;
    let (mut worst, mut off) = (0.0_f64, Vec::new());
    for seed in 0..30 {
        let (scene, time) = bouncer(seed);
        let (mass, contact) = (scene.bodies[0].part.mass.unwrap(), &scene.contacts[0].part.interface);
        let speed = scene.bodies[0].part.z.velocity;
        for tolerance in [1e-3, 1e-4, 1e-5, 1e-6] {
            let (model, state) = end(&scene, &plan(Stepper::Event { tolerance }, BOUNCES * time));
            let (z, v) = state.coordinate(&model, 0, Axis::Z).unwrap();
            let energy = mass * (0.5 * v * v + scene.gravity.acceleration * z) + contact.normal_energy(-z);
            let missed = (energy / (0.5 * mass * speed * speed) - 1.0).abs() / tolerance;
            worst = worst.max(missed);
            if missed > 20.0 * BOUNCES {
                off.push((seed, tolerance, missed));
            }
        }
    }
    println!("at most {worst} tolerances");
    assert!(off.is_empty(), "off by tolerances: {off:?}");
}
