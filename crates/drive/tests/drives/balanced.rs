//! Bodies without mass: force-controlled quasi-static motion against closed forms.
//!
//! Power law n, p = (n+1)/n, Popov, Heß, Willert (2019), section 4.4: F_x = μF_N[1 - (1 - u/u_c)^p] from rest,
//! F₁ - 2μF_N[1 - (1 - (u₁-u)/(2u_c))^p] back from (u₁, F₁).

use crate::parts::{column, contact, event, follower, named, trace, wave};
use stickslip_contact::{Apex, Engine, Interface, Memory, Profile, Segment};
use stickslip_drive::scene::{
    Body, Coordinate, Direction, EngineChoice, Freedom, Load, Normal, Point, Scene, Side, Spring, Varying,
};
use stickslip_drive::{EventKind, Model, Plan, Run, RunError, Shape, State, Timing, Trace, Waveform, run};

pub(crate) const MU: f64 = 0.3;
pub(crate) const FORCE: f64 = 10.0;
pub(crate) const PERIOD: f64 = 1e-2;
pub(crate) const BALANCED: Coordinate =
    Coordinate { freedom: Freedom::Balanced, position: 0.0, velocity: 0.0 };

fn pulled() -> Load {
    Load { on: 0, x: Varying::Follows(0), ..Load::default() }
}

/// A body without mass on the ground, pulled by a waveform.
pub(crate) fn rig(profile: Profile, load: Shape) -> Scene {
    Scene {
        waveforms: vec![wave("load", load, PERIOD)],
        bodies: vec![named("ball", Body { x: BALANCED, ..Body::default() })],
        contacts: vec![named("ball", contact([Side::Body(0), Side::Ground], profile, MU, FORCE))],
        loads: vec![pulled()],
        ..Scene::default()
    }
}

pub(crate) fn sine(share: f64) -> Shape {
    Shape::Sine { amplitude: share * MU * FORCE, phase: 0.0, offset: 0.0 }
}

/// u/u_c under a sine of `share` of μF_N after a time in periods, by Masing's rules.
fn masing(share: f64, p: f64, t: f64) -> f64 {
    let first = |f: f64| f.signum() * (1.0 - (1.0 - f.abs()).powf(1.0 / p));
    let f = share * (std::f64::consts::TAU * t).sin();
    let top = first(share);
    match t {
        _ if t <= 0.25 => first(f),
        // Time in the period, from the first crest.
        _ if (t - 0.25).fract() <= 0.5 => top - 2.0 * first(0.5 * (share - f)),
        _ => -top + 2.0 * first(0.5 * (share + f)),
    }
}

#[test]
fn a_sine_of_force_walks_the_closed_form() {
    for (n, profile) in [
        (1.0, Profile::cone(0.01).unwrap()),
        (2.0, Profile::paraboloid(1e-3).unwrap()),
        (4.0, Profile::power(1e6, 4.0).unwrap()),
    ] {
        let scene = rig(profile, sine(0.8));
        let (model, state, rows) = trace(&scene, &event(1e-6, 2.0 * PERIOD), PERIOD / 64.0);
        let u_c = model.contact_scale(0).unwrap().0;
        let (t, u) = (column(&model, &rows, "time_s"), column(&model, &rows, "ball.x_m"));
        let p = (n + 1.0) / n;
        let off = t.iter().zip(&u).map(|(t, u)| (u / u_c - masing(0.8, p, t / PERIOD)).abs());
        let off = off.fold(0.0, f64::max);
        let friction = column(&model, &rows, "energy.friction_J");
        let cycle = friction[128] - friction[64];
        let first = friction[16];
        let error = column(&model, &rows, "energy.error_J");
        let error = error.iter().fold(0.0, |most: f64, e| most.max(e.abs()));
        let counts = state.counts();
        println!(
            "n = {n}: u off by {off:e} u_c, W/4W₁ - 1 = {:e}, books {:e}, {counts:?}",
            cycle / first / 4.0 - 1.0,
            error / cycle
        );
        assert!(off < 1e-12);
        assert!((cycle / first / 4.0 - 1.0).abs() < 1e-12);
        assert!(counts.events <= 40);
        assert!(error < 1e-9 * cycle);
    }
}

pub(crate) fn spring(between: [Side; 2], stiffness: f64) -> Spring {
    Spring {
        between,
        at: [Point::default(); 2],
        direction: Direction::X,
        stiffness,
        damping: 0.0,
        preload: 0.0,
    }
}

/// Rod in series: its far end is at u + F/k.
#[test]
fn the_far_end_of_a_rod_is_ahead_by_its_stretch() {
    let profile = Profile::paraboloid(1e-3).unwrap();
    let (stiffness, share) = (3e6, 0.8);
    let mut scene = rig(profile, sine(share));
    scene.bodies.push(named("end", Body { x: BALANCED, ..Body::default() }));
    scene.springs.push(named("rod", spring([Side::Body(0), Side::Body(1)], stiffness)));
    scene.loads[0].on = 1;
    let (model, state, rows) = trace(&scene, &event(1e-6, 2.0 * PERIOD), PERIOD / 64.0);
    let u_c = model.contact_scale(0).unwrap().0;
    let columns = ["time_s", "ball.x_m", "end.x_m", "energy.error_J", "energy.friction_J"];
    let [t, u, end, error, friction] = columns.map(|name| column(&model, &rows, name));
    for i in 0..t.len() {
        let wanted = u_c * masing(share, 1.5, t[i] / PERIOD);
        let load = share * MU * FORCE * (std::f64::consts::TAU * t[i] / PERIOD).sin();
        assert!((u[i] - wanted).abs() < 1e-12 * u_c, "{i}");
        assert!((end[i] - wanted - load / stiffness).abs() < 1e-12 * u_c, "{i}");
        assert!(error[i].abs() < 1e-9 * friction[128], "{i}: {:e}", error[i] / friction[128]);
    }
    assert!(state.counts().events <= 40);
}

/// Prescribed motion through a leaf spring: k(s - u) = F_x(u), by bisection of the closed forms of loading and unloading.
#[test]
fn a_leaf_in_series_takes_its_part_of_the_stroke() {
    let profile = Profile::paraboloid(1e-3).unwrap();
    let stroke = 1e-6;
    let mut scene = rig(profile, Shape::Sine { amplitude: stroke, phase: 0.0, offset: 0.0 });
    scene.loads.clear();
    scene.bodies.push(named("shaker", follower(0)));
    let model = Model::new(&rig(Profile::paraboloid(1e-3).unwrap(), sine(0.5))).unwrap();
    let (u_c, limit) = (model.contact_scale(0).unwrap().0, MU * FORCE);
    let stiffness = 0.7 * limit / u_c;
    scene.springs.push(named("leaf", spring([Side::Body(0), Side::Body(1)], stiffness)));
    let (model, state, rows) = trace(&scene, &event(1e-6, 2.0 * PERIOD), PERIOD / 64.0);
    let columns = ["time_s", "ball.x_m", "ball.fx_N", "energy.error_J"];
    let [t, u, force, error] = columns.map(|name| column(&model, &rows, name));
    let first = |u: f64| limit * (1.0 - (1.0 - u / u_c).powf(1.5));
    let root = |excess: &dyn Fn(f64) -> f64| {
        let (mut low, mut high) = (-2.0 * u_c, u_c);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if excess(middle) > 0.0 { high = middle } else { low = middle }
        }
        0.5 * (low + high)
    };
    let foot = |t: f64| stroke * (std::f64::consts::TAU * t / PERIOD).sin();
    let top = root(&|u| first(u) - stiffness * (stroke - u));
    let back = |u: f64| first(top) - 2.0 * first(0.5 * (top - u));
    for i in 0..t.len() {
        let (s, phase) = (foot(t[i]), t[i] / PERIOD);
        let wanted = match phase {
            _ if phase <= 0.25 => root(&|u| first(u) - stiffness * (s - u)),
            _ if (phase - 0.25).fract() <= 0.5 => root(&|u| back(u) - stiffness * (s - u)),
            _ => -root(&|u| back(u) - stiffness * (-s - u)),
        };
        assert!((u[i] - wanted).abs() < 1e-12 * u_c, "{i}: {:e}", (u[i] - wanted) / u_c);
        assert!((force[i] - stiffness * (s - u[i])).abs() < 1e-12 * limit, "{i}");
        assert!(error[i].abs() < 1e-9 * limit * u_c, "{i}: {:e}", error[i]);
    }
    assert!(state.counts().events <= 40, "{:?}", state.counts());
}

pub(crate) fn fails(scene: &Scene, duration: f64) -> (Model, State, Trace, RunError) {
    let model = Model::new(scene).unwrap();
    let plan = Plan { every: Some(PERIOD / 64.0), ..event(1e-6, duration) };
    let mut state = model.start(&plan).unwrap();
    let mut rows = Trace::new(&model);
    let error = run(&model, &plan, &mut state, &mut rows).unwrap_err();
    (model, state, rows, error)
}

/// Beyond μF_N: sin 2πt/T = 1/1.2.
#[test]
fn a_load_beyond_the_limit_ends_where_gross_slip_begins() {
    for profile in [
        Profile::cone(0.01).unwrap(),
        Profile::paraboloid(1e-3).unwrap(),
        Profile::sphere(1e-3).unwrap(),
        Profile::power(1e6, 4.0).unwrap(),
        Profile::flat(1e-4).unwrap(),
    ] {
        let (model, state, rows, error) = fails(&rig(profile, sine(1.2)), 2.0 * PERIOD);
        let wanted = PERIOD * (1.0_f64 / 1.2).asin() / std::f64::consts::TAU;
        println!("{error}; {:e}, {:?}", state.time() / wanted - 1.0, state.counts());
        assert!((state.time() / wanted - 1.0).abs() < 1e-12, "{:e}", state.time() / wanted - 1.0);
        let RunError::Unbalanced { t, body, load, limit, .. } = error else { panic!("{error}") };
        assert_eq!((t, body.as_str()), (state.time(), "ball"));
        assert!((load / (MU * FORCE) - 1.0).abs() < 1e-11 && (limit / (MU * FORCE) - 1.0).abs() < 1e-12);
        let u = column(&model, &rows, "ball.x_m");
        let u_c = model.contact_scale(0).unwrap().0;
        assert!((u[u.len() - 1] / u_c - 1.0).abs() < 1e-7, "{}", u[u.len() - 1] / u_c);
        assert!(rows.events().any(|(event, _)| event.kind == EventKind::GrossSlip));
    }
}

/// A load that just reaches the limit reverses in stick; a slightly larger one causes gross slip.
#[test]
fn a_load_that_just_reaches_the_limit_turns_and_one_beyond_it_slips() {
    for (share, slips) in [(1.0 - 1e-12, false), (1.0, false), (1.0 + 1e-12, true)] {
        let scene = rig(Profile::paraboloid(1e-3).unwrap(), sine(share));
        let model = Model::new(&scene).unwrap();
        let plan = Plan { every: Some(PERIOD / 64.0), ..event(1e-6, 2.0 * PERIOD) };
        let mut state = model.start(&plan).unwrap();
        let outcome = run(&model, &plan, &mut state, &mut ());
        println!("{share}: {outcome:?} {:?}", state.counts());
        assert_eq!(outcome.is_err(), slips, "{share}");
    }
}

/// Independent quasi-static solution of one contact: interface and memory, moved in small parts along (d, u).
struct Walked {
    law: Interface,
    memory: Memory,
}

impl Walked {
    fn of(model: &Model, d: f64) -> Self {
        let law = model.contacts().next().unwrap().1.clone();
        let memory = Engine::Curve.memory(&law, Apex { d, u: 0.0 });
        Self { law, memory }
    }

    /// Moves to F_x + ku = load at a depth, by bisection of trial chords.
    fn go(&mut self, d: f64, stiffness: f64, load: f64, u_c: f64) -> f64 {
        let here = self.memory.apex().u;
        let (mut low, mut high) = (here - 4.0 * u_c, here + 4.0 * u_c);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            let excess = self.memory.force(&self.law, Apex { d, u: middle }) + stiffness * middle - load;
            if excess > 0.0 { high = middle } else { low = middle }
        }
        let u = 0.5 * (low + high);
        self.memory.commit(&self.law, Segment::Straight(Apex { d, u })).unwrap();
        u
    }
}

/// Random numbers in [0, 1).
struct Lot(u64);

impl Lot {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
    fn pick(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }
    fn profile(&mut self) -> Profile {
        match self.pick(5) {
            0 => Profile::cone(0.01).unwrap(),
            1 => Profile::paraboloid(1e-3).unwrap(),
            2 => Profile::power(1e6, 4.0).unwrap(),
            3 => Profile::power(30.0, 2.5).unwrap(),
            _ => Profile::sphere(1e-3).unwrap(),
        }
    }
}

pub(crate) fn table(name: &str, points: &[f64]) -> stickslip_drive::scene::Named<Waveform> {
    let points = points.iter().enumerate().map(|(i, value)| (i as f64 * PERIOD, *value)).collect();
    named(name, Waveform::new(Shape::Table { points }, Timing::every(1.0)).unwrap())
}

/// Random loads below the limit, with and without a spring, compared with bisection on a separate memory.
#[test]
fn random_loads_are_held_where_halving_finds_them() {
    let mut lot = Lot(15);
    for scene_number in 0..200 {
        let profile = lot.profile();
        let limit = MU * FORCE;
        let loads: Vec<f64> =
            (0..12).map(|i| if i == 0 { 0.0 } else { limit * (1.98 * lot.next() - 0.99) }).collect();
        let mut scene = rig(profile, sine(0.5));
        scene.waveforms[0] = table("load", &loads);
        let spring_share = if lot.pick(2) == 0 { 0.0 } else { 0.1 + lot.next() };
        let (u_c, _) = Model::new(&scene).unwrap().contact_scale(0).unwrap();
        let stiffness = spring_share * limit / u_c;
        if stiffness > 0.0 {
            scene.springs.push(named("leaf", spring([Side::Ground, Side::Body(0)], stiffness)));
        }
        let (model, _, rows) = trace(&scene, &event(1e-6, 11.0 * PERIOD), 0.5 * PERIOD);
        let mut walked = Walked::of(&model, model.contacts().next().unwrap().1.indentation(FORCE));
        let (t, u) = (column(&model, &rows, "time_s"), column(&model, &rows, "ball.x_m"));
        for i in 1..t.len() {
            let load = model_load(&loads, t[i] / PERIOD);
            let wanted = walked.go(walked.memory.apex().d, stiffness, load, u_c);
            assert!(
                (u[i] - wanted).abs() < 1e-11 * u_c,
                "{scene_number} at {i}: {:e}",
                (u[i] - wanted) / u_c
            );
        }
    }
}

/// Value of a table between its points.
fn model_load(points: &[f64], place: f64) -> f64 {
    let i = (place.floor() as usize).min(points.len() - 2);
    points[i] + (place - i as f64) * (points[i + 1] - points[i])
}

/// Sinusoidal load with a varying normal force, compared with fine chords of second order. Paths of growth in full stick are curved.
#[test]
fn a_normal_force_that_varies_is_followed_to_the_tolerance() {
    let mut lot = Lot(7);
    let mut curved: f64 = 0.0;
    for scene_number in 0..12 {
        let profile = lot.profile();
        let force: Vec<f64> = (0..6).map(|_| FORCE * (0.5 + 0.5 * lot.next())).collect();
        let (share, wave_length) = (0.1 + 0.35 * lot.next(), 1.0 + 2.0 * lot.next());
        let mut scene = rig(profile, sine(share));
        scene.waveforms = vec![wave("load", sine(share), wave_length * PERIOD), table("force", &force)];
        scene.contacts[0].part.normal = Normal::Force(Varying::Follows(1));
        let load = |place: f64| share * MU * FORCE * (std::f64::consts::TAU * place / wave_length).sin();
        let (model, state, rows) = trace(&scene, &event(1e-6, 5.0 * PERIOD), 0.25 * PERIOD);
        let law = model.contacts().next().unwrap().1.clone();
        let u_c = law.gross_slip_displacement(law.indentation(FORCE));
        let (t, u) = (column(&model, &rows, "time_s"), column(&model, &rows, "ball.x_m"));
        let error = column(&model, &rows, "energy.error_J");
        let error = error.iter().fold(0.0, |most: f64, e| most.max(e.abs())) / (MU * FORCE * u_c);
        let fine = |parts: usize| {
            let mut walked = Walked::of(&model, law.indentation(force[0]));
            let mut places = vec![0.0];
            for i in 1..t.len() {
                for k in 1..=parts {
                    let place = (t[i - 1] + (t[i] - t[i - 1]) * k as f64 / parts as f64) / PERIOD;
                    walked.go(law.indentation(model_load(&force, place)), 0.0, load(place), u_c);
                }
                places.push(walked.memory.apex().u);
            }
            places
        };
        let (coarse, fine) = (fine(250), fine(500));
        let far =
            |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs())) / u_c;
        let (off, left) = (far(&u, &fine), far(&coarse, &fine));
        println!(
            "{scene_number}: off by {off:e} u_c, chords by {left:e}, books {error:e}, {:?}",
            state.counts()
        );
        // A third of the change remains as the error of the fine chords.
        assert!(off < 0.6 * left + 1e-9, "{scene_number}: {off:e}");
        curved = curved.max(left);
        assert!(error < 1e-7, "{error:e}");
    }
    assert!(curved > 1e-8, "growth should be curved somewhere: {curved:e}");
}

/// Prescribed normal force: z = -d by the closed inverse; x by the load at the present depth.
#[test]
fn a_balanced_depth_is_the_inverse_of_the_normal_force() {
    for count in [1, 3] {
        let profile = Profile::paraboloid(1e-3).unwrap();
        let mut scene = rig(profile, sine(0.3));
        let press = Shape::Sine { amplitude: 0.4 * FORCE, phase: 0.0, offset: -FORCE };
        // Pressed down onto the ground.
        scene.contacts[0].part.between = [Side::Ground, Side::Body(0)];
        scene.waveforms.push(wave("press", press, 1.7 * PERIOD));
        scene.bodies[0].part.z = BALANCED;
        scene.contacts[0].part.normal = Normal::Coupled;
        scene.contacts[0].part.count = count;
        scene.loads[0].z = Varying::Follows(1);
        let (model, state, rows) = trace(&scene, &event(1e-6, 2.0 * PERIOD), PERIOD / 64.0);
        let columns = ["time_s", "ball.z_m", "ball.d_m", "ball.fn_N", "ball.fx_N", "energy.error_J"];
        let [t, z, d, normal, force, error] = columns.map(|name| column(&model, &rows, name));
        let law = model.contacts().next().unwrap().1.clone();
        let u_c = law.gross_slip_displacement(law.indentation(FORCE));
        for i in 0..t.len() {
            let wanted = FORCE * (1.0 - 0.4 * (std::f64::consts::TAU * t[i] / (1.7 * PERIOD)).sin());
            let pull = -0.3 * MU * FORCE * (std::f64::consts::TAU * t[i] / PERIOD).sin();
            // F_N = (4/3)E*√R d^{3/2}.
            let each = wanted / f64::from(count);
            let depth = (0.75 * each / (law.normal_modulus() * 1e-3_f64.sqrt())).powf(2.0 / 3.0);
            assert!((d[i] / depth - 1.0).abs() < 1e-13 && z[i] == -d[i], "{i}: {:e}", d[i] / depth - 1.0);
            assert!((normal[i] / wanted - 1.0).abs() < 1e-13);
            assert!((force[i] - pull).abs() < 1e-9 * MU * FORCE, "{i}: {:e}", force[i] - pull);
            assert!(error[i].abs() < 1e-7 * FORCE * u_c, "{i}: {:e}", error[i] / (FORCE * u_c));
        }
        println!("{count}: {:?}", state.counts());
    }
}

/// A body that is pulled off: the run ends when the load changes its sign.
#[test]
fn a_load_that_pulls_a_body_off_ends_where_it_parts() {
    let mut scene = rig(Profile::paraboloid(1e-3).unwrap(), sine(0.0));
    scene.loads.clear();
    let press = Shape::Sine { amplitude: 2.0 * FORCE, phase: 0.0, offset: -FORCE };
    scene.waveforms[0] = wave("press", press, PERIOD);
    scene.bodies[0].part = Body { z: BALANCED, ..Body::default() };
    scene.contacts[0].part.normal = Normal::Coupled;
    scene.contacts[0].part.between = [Side::Ground, Side::Body(0)];
    scene.loads.push(Load { on: 0, z: Varying::Follows(0), ..Load::default() });
    let (_, state, _, error) = fails(&scene, PERIOD);
    println!("{error}, {:?}", state.counts());
    assert!(
        (state.time() / (PERIOD / 12.0) - 1.0).abs() < 1e-11,
        "{:e}",
        state.time() / (PERIOD / 12.0) - 1.0
    );
}

/// A jump of the load is a jump of the position; a load at t = 0 moves the body before the start.
#[test]
fn a_jump_of_the_load_is_a_jump_of_the_place() {
    let limit = MU * FORCE;
    let step = |from: f64, to: f64| Shape::Table {
        points: vec![(0.0, from * limit), (0.5 * PERIOD, from * limit), (0.5 * PERIOD, to * limit)],
    };
    let ways: [(f64, f64); 5] = [(0.0, 0.7), (0.5, 0.9), (0.9, -0.9), (-0.4, 0.0), (0.3, 1.1)];
    for (from, to) in ways {
        let mut scene = rig(Profile::paraboloid(1e-3).unwrap(), sine(0.0));
        scene.waveforms[0] = named("load", Waveform::new(step(from, to), Timing::every(1.0)).unwrap());
        let model = Model::new(&scene).unwrap();
        let plan = Plan { every: Some(0.25 * PERIOD), ..event(1e-6, PERIOD) };
        let mut state = model.start(&plan).unwrap();
        let mut rows = Trace::new(&model);
        let outcome = run(&model, &plan, &mut state, &mut rows);
        assert_eq!(outcome.is_err(), to > 1.0, "{outcome:?}");
        if outcome.is_err() {
            assert_eq!(state.time(), 0.5 * PERIOD);
            continue;
        }
        let (u_c, _) = model.contact_scale(0).unwrap();
        let first = |f: f64| f.signum() * (1.0 - (1.0 - f.abs()).powf(2.0 / 3.0));
        let (u, error) = (column(&model, &rows, "ball.x_m"), column(&model, &rows, "energy.error_J"));
        let before = first(from);
        let after = match () {
            () if to.abs() >= from.abs() && to * from >= 0.0 => first(to),
            () => before - from.signum() * 2.0 * first(0.5 * (from - to).abs()),
        };
        for (i, wanted) in [before, before, before, after, after].into_iter().enumerate() {
            assert!((u[i] / u_c - wanted).abs() < 1e-13, "{from} {to}, {i}: {} {wanted}", u[i] / u_c);
            assert!(error[i].abs() < 1e-13 * limit * u_c, "{from} {to}, {i}: {:e}", error[i]);
        }
    }
}

/// Both coordinates, a spring, a varying load and a varying normal force.
fn full_rig() -> Scene {
    let mut scene = rig(Profile::paraboloid(1e-3).unwrap(), sine(0.3));
    let press = Shape::Sine { amplitude: 0.4 * FORCE, phase: 0.0, offset: -FORCE };
    scene.waveforms.push(wave("press", press, 1.7 * PERIOD));
    scene.bodies[0].part.z = BALANCED;
    scene.contacts[0].part.normal = Normal::Coupled;
    scene.contacts[0].part.between = [Side::Ground, Side::Body(0)];
    scene.loads[0].z = Varying::Follows(1);
    scene.springs.push(named("leaf", spring([Side::Ground, Side::Body(0)], 1e6)));
    scene
}

/// A run resumed from its bytes at any event, with rows or without, has the bits of the whole run.
#[test]
fn a_run_taken_up_from_its_bytes_is_the_whole_run() {
    for scene in [full_rig(), rig(Profile::sphere(1e-3).unwrap(), sine(0.8))] {
        let model = Model::new(&scene).unwrap();
        let plan = Plan { every: Some(PERIOD / 64.0), ..event(1e-6, 2.0 * PERIOD) };
        let whole = |plan: &Plan| {
            let mut state = model.start(plan).unwrap();
            run(&model, plan, &mut state, &mut ()).unwrap();
            state
        };
        let end = whole(&plan);
        assert_eq!(end, whole(&Plan { every: None, ..plan }));
        for part in [0.1, 0.3, 0.52, 0.9] {
            let mut first = Run::new(
                &model,
                &Plan { duration: part * plan.duration, ..plan },
                model.start(&plan).unwrap(),
            )
            .unwrap();
            first.approach(&mut ()).unwrap();
            let bytes = first.state().to_bytes(&model, &[7; 32]);
            let state = State::from_bytes(&model, &[7; 32], &bytes).unwrap();
            let mut second = Run::resume(&model, &plan, state).unwrap();
            second.finish(&mut ()).unwrap();
            assert_eq!(second.into_state(), end, "{part}");
        }
        // A caller who advances step by step obtains the same positions.
        let mut held = Run::new(&model, &plan, model.start(&plan).unwrap()).unwrap();
        for i in 1..=40 {
            held.advance(f64::from(i) * 0.05 * PERIOD, &mut ()).unwrap();
        }
        let place = |state: &State| state.body(&model, 0).unwrap().0;
        let (u_c, _) = model.contact_scale(0).unwrap();
        assert!((place(held.state()) - place(&end)).abs() < 1e-9 * u_c);
    }
}

/// Rows of springs: the position under a load agrees with bisection of the row's own forces.
#[test]
fn a_row_of_springs_holds_a_load_where_its_springs_say() {
    let mut scene = rig(Profile::paraboloid(1e-3).unwrap(), sine(0.8));
    scene.contacts[0].part.engine = EngineChoice::Springs { count: 64, span: None };
    let (model, state, rows) = trace(&scene, &event(1e-6, 2.0 * PERIOD), PERIOD / 64.0);
    let model_of_curve = Model::new(&rig(Profile::paraboloid(1e-3).unwrap(), sine(0.8))).unwrap();
    let u_c = model_of_curve.contact_scale(0).unwrap().0;
    let (t, u) = (column(&model, &rows, "time_s"), column(&model, &rows, "ball.x_m"));
    let force = column(&model, &rows, "ball.fx_N");
    for i in 0..t.len() {
        let pull = 0.8 * MU * FORCE * (std::f64::consts::TAU * t[i] / PERIOD).sin();
        assert!((force[i] - pull).abs() < 1e-12 * FORCE, "{i}: {:e}", force[i] - pull);
        // The discretisation of the row causes a difference.
        assert!((u[i] / u_c - masing(0.8, 1.5, t[i] / PERIOD)).abs() < 1e-2, "{i}");
    }
    println!("{:?}", state.counts());
    let mut beyond = scene;
    beyond.waveforms[0] = wave("load", sine(1.2), PERIOD);
    let (_, state, _, error) = fails(&beyond, PERIOD);
    let wanted = PERIOD * (1.0_f64 / 1.2).asin() / std::f64::consts::TAU;
    assert!((state.time() / wanted - 1.0).abs() < 1e-10, "{error}: {:e}", state.time() / wanted - 1.0);
}

/// Scaling of lengths by s and moduli by 1/s scales forces by s.
#[test]
fn scenes_of_any_size_walk_alike() {
    for scale in [1e-9, 1e-3, 1e3, 1e6] {
        let mut scene = rig(Profile::paraboloid(1e-3 * scale).unwrap(), sine(0.8));
        scene.waveforms[0] = wave(
            "load",
            Shape::Sine { amplitude: 0.8 * MU * FORCE * scale * scale, phase: 0.0, offset: 0.0 },
            PERIOD,
        );
        scene.contacts[0].part.normal = Normal::Force(Varying::Constant(FORCE * scale * scale));
        let (model, state, rows) = trace(&scene, &event(1e-6, 2.0 * PERIOD), PERIOD / 64.0);
        let u_c = model.contact_scale(0).unwrap().0;
        let (t, u) = (column(&model, &rows, "time_s"), column(&model, &rows, "ball.x_m"));
        for i in 0..t.len() {
            assert!((u[i] / u_c - masing(0.8, 1.5, t[i] / PERIOD)).abs() < 1e-12, "{scale:e}: {i}");
        }
        assert!(state.counts().events <= 40);
    }
}

/// Unsupported properties of balanced models are refused with part and field.
#[test]
fn a_place_that_nothing_can_balance_is_refused() {
    use stickslip_drive::SceneFault;
    let mut hanging = rig(Profile::paraboloid(1e-3).unwrap(), sine(0.8));
    hanging.bodies.push(named("end", Body { x: BALANCED, ..Body::default() }));
    assert!(matches!(Model::new(&hanging).unwrap_err().fault, SceneFault::Unbalanceable(_)));
    // A chain without a fixed end.
    hanging.bodies.push(named("other", Body { x: BALANCED, ..Body::default() }));
    hanging.springs.push(named("rod", spring([Side::Body(1), Side::Body(2)], 1e6)));
    assert!(matches!(Model::new(&hanging).unwrap_err().fault, SceneFault::Unbalanceable(_)));
    let mut rod = rig(Profile::paraboloid(1e-3).unwrap(), sine(0.8));
    rod.bodies.push(rod.bodies[0].clone());
    rod.contacts.push(named(
        "second",
        contact([Side::Body(1), Side::Ground], Profile::cone(0.01).unwrap(), MU, FORCE),
    ));
    rod.springs.push(named("rod", spring([Side::Body(0), Side::Body(1)], 1e6)));
    assert!(matches!(Model::new(&rod).unwrap_err().fault, SceneFault::BalancedTogether));
}
