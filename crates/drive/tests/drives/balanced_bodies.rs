//! Balanced bodies along z, on several contacts, and the loss of their equilibrium.

use crate::balanced::{BALANCED, FORCE, MU, PERIOD, fails, rig, sine, spring, table};
use crate::parts::{column, contact, event, named, of_friction, trace, wave};
use std::f64::consts::TAU;
use stickslip_contact::{ContactError, Interface, Profile};
use stickslip_drive::scene::{
    Body, ContactStart, Direction, EngineChoice, Load, Named, Normal, Scene, Side, Spring, Varying,
};
use stickslip_drive::{Model, RunError, SceneFault, Shape, Timing, Waveform};

const RADIUS: f64 = 1e-3;

fn ball() -> Profile {
    Profile::paraboloid(RADIUS).unwrap()
}

/// A ball that a waveform presses onto the ground, by forces along -z.
fn pressed(drive: Named<Waveform>) -> Scene {
    let mut scene = rig(ball(), sine(0.0));
    scene.waveforms[0] = drive;
    scene.loads = vec![Load { on: 0, z: Varying::Follows(0), ..Load::default() }];
    scene.bodies[0].part = Body { z: BALANCED, ..Body::default() };
    scene.contacts[0].part.normal = Normal::Coupled;
    scene.contacts[0].part.between = [Side::Ground, Side::Body(0)];
    scene
}

/// d of F = (4/3)E*√R d^{3/2}, m.
fn hertz(law: &Interface, force: f64) -> f64 {
    (0.75 * force / (law.normal_modulus() * RADIUS.sqrt())).powf(2.0 / 3.0)
}

/// First root of an increasing function between bounds, by bisection.
fn root(mut low: f64, mut high: f64, excess: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// A load that starts at 0 N and presses, at once or later, is accepted; one that lifts at once is refused.
#[test]
fn a_load_along_z_may_set_out_from_nothing() {
    let ramp = |loads: &[f64]| table("press", loads);
    let drives = [
        ramp(&[0.0, -FORCE, -0.5 * FORCE, -FORCE]),
        ramp(&[0.0, 0.0, -FORCE, -FORCE]),
        wave("press", Shape::Sine { amplitude: -FORCE, phase: 0.0, offset: 0.0 }, 8.0 * PERIOD),
        // -F(1 - cos): its rate starts at zero, too.
        wave("press", Shape::Sine { amplitude: FORCE, phase: TAU / 4.0, offset: -FORCE }, 8.0 * PERIOD),
    ];
    for (k, drive) in drives.into_iter().enumerate() {
        for friction in [MU, 0.0] {
            let mut scene = pressed(drive.clone());
            scene.contacts[0].part = of_friction(friction, &scene.contacts[0].part);
            let (model, state, rows) = trace(&scene, &event(1e-6, 3.0 * PERIOD), PERIOD / 16.0);
            let law = model.contacts().next().unwrap().1.clone();
            let columns = ["time_s", "ball.z_m", "ball.d_m", "energy.error_J"];
            let [t, z, d, error] = columns.map(|name| column(&model, &rows, name));
            let deepest = hertz(&law, 2.0 * FORCE);
            for i in 0..t.len() {
                let place = t[i] / PERIOD;
                let load = match k {
                    0 if place <= 1.0 => FORCE * place,
                    0 => FORCE * (1.0 - 0.5 * (1.0 - (place - 2.0).abs())),
                    1 => FORCE * (place - 1.0).clamp(0.0, 1.0),
                    2 => FORCE * (TAU * place / 8.0).sin(),
                    _ => FORCE * (1.0 - (TAU * place / 8.0).cos()),
                };
                let wanted = hertz(&law, load);
                assert!((d[i] - wanted).abs() < 1e-9 * deepest, "{k} at {i}: {:e} {wanted:e}", d[i]);
                assert_eq!(z[i], -d[i]);
                assert!(error[i].abs() < 1e-8 * FORCE * deepest, "{k} at {i}: {:e}", error[i]);
            }
            println!("{k}, {friction}: {:?}", state.counts());
        }
    }
    let lifted = Model::new(&pressed(ramp(&[0.0, FORCE]))).unwrap();
    let refused = lifted.start(&event(1e-6, PERIOD)).unwrap_err();
    assert!(matches!(refused.fault, SceneFault::Unbalanced { .. }), "{refused:?}");
}

/// A load that rests at 0 N and then lifts: the run ends when it begins to lift.
#[test]
fn a_load_that_rests_at_nothing_and_lifts_ends_where_it_begins_to() {
    let (_, state, _, error) = fails(&pressed(table("press", &[0.0, 0.0, FORCE])), 2.0 * PERIOD);
    assert!(matches!(error, RunError::Unbalanced { .. }), "{error}");
    assert_eq!(state.time(), PERIOD);
}

/// Between floor and ceiling, clamped or with a gap, a body is held in both directions.
#[test]
fn a_body_between_floor_and_ceiling_is_held_both_ways() {
    let scale = 3e-7;
    for gap in [-scale, 0.0, scale] {
        for friction in [MU, 0.0] {
            let drive = wave("press", Shape::Sine { amplitude: FORCE, phase: 1.0, offset: 0.0 }, PERIOD);
            let mut scene = pressed(drive);
            scene.contacts[0].part = of_friction(friction, &scene.contacts[0].part);
            let mut ceiling = scene.contacts[0].clone();
            ceiling.name = "ceiling".to_owned();
            ceiling.part.between = [Side::Body(0), Side::Ground];
            ceiling.part.gap = gap;
            scene.contacts.push(ceiling);
            let (model, state, rows) = trace(&scene, &event(1e-6, 2.0 * PERIOD), PERIOD / 64.0);
            let law = model.contacts().next().unwrap().1.clone();
            let columns = ["time_s", "ball.z_m", "ball.fn_N", "ceiling.fn_N", "energy.error_J"];
            let [t, z, floor, above, error] = columns.map(|name| column(&model, &rows, name));
            let force = |d: f64| 4.0 / 3.0 * law.normal_modulus() * RADIUS.sqrt() * d.max(0.0).powf(1.5);
            let mut most: f64 = 0.0;
            for i in 0..t.len() {
                let load = FORCE * (TAU * t[i] / PERIOD + 1.0).sin();
                let far = hertz(&law, 2.0 * FORCE) + scale;
                let wanted = root(-far, far, |z| force(z - gap) - force(-z) - load);
                assert!((z[i] - wanted).abs() < 1e-12 * far, "{gap} at {i}: {:e} {wanted:e}", z[i]);
                assert!((above[i] - floor[i] - load).abs() < 1e-11 * FORCE, "{gap} at {i}");
                most = most.max(error[i].abs() / (FORCE * far));
            }
            println!("{gap:e}, {friction}: books {most:e}, {:?}", state.counts());
            assert!(most < 1e-8, "{gap}: {most:e}");
        }
    }
}

/// Spring parallel to the contact: a body that is pulled off is held by it and returns.
#[test]
fn a_spring_holds_along_z_what_the_contact_lets_go() {
    for friction in [MU, 0.0] {
        let drive = wave("press", Shape::Sine { amplitude: FORCE, phase: 0.3, offset: -0.2 * FORCE }, PERIOD);
        let mut scene = pressed(drive);
        scene.contacts[0].part = of_friction(friction, &scene.contacts[0].part);
        let stiffness = 2e7;
        let leaf = spring([Side::Ground, Side::Body(0)], stiffness);
        scene.springs.push(named("leaf", Spring { direction: Direction::Z, ..leaf }));
        let (model, state, rows) = trace(&scene, &event(1e-6, 2.0 * PERIOD), PERIOD / 64.0);
        let law = model.contacts().next().unwrap().1.clone();
        let columns = ["time_s", "ball.z_m", "ball.fn_N", "energy.error_J"];
        let [t, z, normal, error] = columns.map(|name| column(&model, &rows, name));
        let force = |d: f64| 4.0 / 3.0 * law.normal_modulus() * RADIUS.sqrt() * d.max(0.0).powf(1.5);
        let far = 2.0 * FORCE / stiffness;
        for i in 0..t.len() {
            let load = FORCE * ((TAU * t[i] / PERIOD + 0.3).sin() - 0.2);
            let wanted = root(-far, far, |z| stiffness * z - force(-z) - load);
            assert!((z[i] - wanted).abs() < 1e-12 * far, "{i}: {:e} {wanted:e}", z[i]);
            assert!((normal[i] - force(-wanted)).abs() < 1e-11 * FORCE, "{i}");
            // A tenth of the tolerance, because the error of the balance varies from 2e-10 to 4e-8.
            assert!(error[i].abs() < 1e-7 * FORCE * far, "{i}: {:e}", error[i]);
        }
        assert!(normal.contains(&0.0) && normal.iter().any(|n| *n > 0.1 * FORCE));
        println!("{:?}", state.counts());
    }
}

/// Two different contacts, one of them reversed, hold a load. After gross slip of the first the run continues until gross slip of
/// the other. Their sum follows Masing's rules.
#[test]
fn several_contacts_hold_a_body_together() {
    let parts = [(ball(), 1.5, FORCE), (Profile::cone(0.01).unwrap(), 2.0, 0.4 * FORCE)];
    let limit = MU * 1.4 * FORCE;
    let of = |share: f64| {
        let mut scene = rig(ball(), Shape::Sine { amplitude: share * limit, phase: 0.0, offset: 0.0 });
        scene.contacts = vec![
            named("ball", contact([Side::Body(0), Side::Ground], parts[0].0.clone(), MU, parts[0].2)),
            named("tip", contact([Side::Ground, Side::Body(0)], parts[1].0.clone(), MU, parts[1].2)),
        ];
        scene
    };
    let scene = of(0.95);
    let (model, state, rows) = trace(&scene, &event(1e-6, 2.0 * PERIOD), PERIOD / 64.0);
    let u_c = [0, 1].map(|c| model.contact_scale(c).unwrap().0);
    let share = |c: usize, u: f64| MU * parts[c].2 * (1.0 - (1.0 - u / u_c[c]).max(0.0).powf(parts[c].1));
    let first = |u: f64| share(0, u) + share(1, u);
    let far = u_c[0].max(u_c[1]);
    let top = root(0.0, far, |u| first(u) - 0.95 * limit);
    assert!(top > u_c[0].min(u_c[1]), "the first should have given way");
    let columns = ["time_s", "ball.x_m", "energy.error_J", "energy.friction_J"];
    let [t, u, error, friction] = columns.map(|name| column(&model, &rows, name));
    for i in 0..t.len() {
        let (load, phase) = (0.95 * limit * (TAU * t[i] / PERIOD).sin(), t[i] / PERIOD);
        let back = |load: f64| root(-top, top, |u| first(top) - 2.0 * first(0.5 * (top - u)) - load);
        let wanted = match phase {
            _ if phase <= 0.25 => root(0.0, far, |u| first(u) - load),
            _ if (phase - 0.25).fract() <= 0.5 => back(load),
            _ => -back(-load),
        };
        assert!((u[i] - wanted).abs() < 1e-11 * far, "{i}: {:e}", (u[i] - wanted) / far);
        assert!(error[i].abs() < 1e-9 * friction[128], "{i}: {:e}", error[i] / friction[128]);
    }
    println!("{:?}", state.counts());
    let (_, state, _, error) = fails(&of(1.2), PERIOD);
    let wanted = PERIOD * (1.0_f64 / 1.2).asin() / TAU;
    assert!((state.time() / wanted - 1.0).abs() < 1e-11, "{error}: {:e}", state.time() / wanted - 1.0);
}

/// A contact with an initial load moves to the balance with its body's load before the start.
#[test]
fn a_contact_loaded_at_the_start_goes_where_the_load_holds_it() {
    let limit = MU * FORCE;
    let first = |f: f64| f.signum() * (1.0 - (1.0 - f.abs()).powf(2.0 / 3.0));
    for (given, held) in [(0.6, 0.6), (0.6, 0.0), (0.6, 0.8), (-0.5, 0.3)] {
        let mut scene = rig(ball(), Shape::Sine { amplitude: 0.0, phase: 0.0, offset: held * limit });
        scene.contacts[0].part.start = ContactStart::Force(given * limit);
        let (model, _, rows) = trace(&scene, &event(1e-6, PERIOD), PERIOD);
        let u_c = model.contact_scale(0).unwrap().0;
        let [x, u, force] = ["ball.x_m", "ball.u_m", "ball.fx_N"].map(|name| column(&model, &rows, name));
        let (start, further): (f64, bool) = (first(given), held / given >= 1.0);
        let wanted = if further { first(held) } else { start + 2.0 * first(0.5 * (held - given)) };
        assert!((u[0] / u_c - wanted).abs() < 1e-12, "{given} {held}: {} {wanted}", u[0] / u_c);
        assert!((x[0] / u_c - (wanted - start)).abs() < 1e-12, "{given} {held}: {}", x[0] / u_c);
        assert!((force[0] - held * limit).abs() < 1e-12 * limit);
    }
}

/// Exact sphere over two cycles: d = (a/2) ln((R+a)/(R-a)), F_N = E*[(R²+a²)/2 ln((R+a)/(R-a)) - aR] (Popov, Heß, Willert (2019),
/// section 2.5.4), F_x = μ[F_N(a) - F_N(c)], u = κ[d(a) - d(c)]. The work of a cycle between ±u₁ is 8∫₀ F_x du - 4F₁u₁.
#[test]
fn two_cycles_of_the_exact_sphere_take_what_its_closed_form_says() {
    // Depth at which sphere and paraboloid differ by 1 %.
    let (radius, share) = (1e-4, 0.8);
    let load = 40.0;
    let mut scene = rig(
        Profile::sphere(radius).unwrap(),
        Shape::Sine { amplitude: share * MU * load, phase: 0.0, offset: 0.0 },
    );
    scene.contacts[0].part.normal = Normal::Force(Varying::Constant(load));
    let (model, _, rows) = trace(&scene, &event(1e-6, 2.0 * PERIOD), PERIOD / 64.0);
    let law = model.contacts().next().unwrap().1.clone();
    let log = |a: f64| ((radius + a) / (radius - a)).ln();
    let depth = |a: f64| 0.5 * a * log(a);
    let modulus = law.normal_modulus();
    let force = |a: f64| modulus * (0.5 * (radius * radius + a * a) * log(a) - a * radius);
    let edge = root(0.0, 0.9 * radius, |a| force(a) - load);
    let inner = root(0.0, edge, |c| force(c) - (1.0 - share) * load);
    let kappa = MU * modulus / law.tangential_modulus();
    let top = kappa * (depth(edge) - depth(inner));
    // ∫F_x du = μκ∫[F_N(a) - F_N(c)] d'(c) dc by Simpson's rule.
    let slope = |c: f64| 0.5 * log(c) + c * radius / (radius * radius - c * c);
    let parts = 2000;
    let sum: f64 = (0..=parts)
        .map(|i| {
            let c = inner + (edge - inner) * f64::from(i) / f64::from(parts);
            let weight = if i == 0 || i == parts { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            weight * (load - force(c)) * slope(c)
        })
        .sum();
    let area = MU * kappa * sum * (edge - inner) / (3.0 * f64::from(parts));
    let wanted = 8.0 * area - 4.0 * share * MU * load * top;
    let paraboloid = (radius * depth(edge)).sqrt() / edge - 1.0;
    let (u, friction) = (column(&model, &rows, "ball.x_m"), column(&model, &rows, "energy.friction_J"));
    println!(
        "a/√(Rd) - 1 = {:e}; u₁ off by {:e}, W by {:e}",
        -paraboloid,
        u[16] / top - 1.0,
        (friction[128] - friction[64]) / wanted - 1.0
    );
    assert!(paraboloid.abs() > 1e-3);
    assert!((u[16] / top - 1.0).abs() < 1e-10 && (u[80] / top - 1.0).abs() < 1e-10);
    assert!((u[48] / top + 1.0).abs() < 1e-10 && (u[112] / top + 1.0).abs() < 1e-10);
    assert!(((friction[128] - friction[64]) / wanted - 1.0).abs() < 1e-9);
}

/// Rows of many springs under a varying normal load use the full force law: the run ends where the load exceeds μF_N(t).
#[test]
fn a_load_beyond_the_limit_ends_a_run_by_the_whole_law() {
    for (count, share) in [(8200, 3.0), (64, 1.2)] {
        let mut scene = rig(ball(), sine(share));
        let press = Shape::Sine { amplitude: 0.2 * FORCE, phase: 0.7, offset: FORCE };
        scene.waveforms.push(wave("press", press, 3.3 * PERIOD));
        scene.contacts[0].part.normal = Normal::Force(Varying::Follows(1));
        scene.contacts[0].part.engine = EngineChoice::Springs { count, span: None };
        let (model, state, rows, error) = fails(&scene, 20.0 * PERIOD);
        let normal = |t: f64| FORCE * (1.0 + 0.2 * (TAU * t / (3.3 * PERIOD) + 0.7).sin());
        let excess = |t: f64| share * FORCE * (TAU * t / PERIOD).sin().abs() - normal(t);
        // First time on a fine grid, then bisection.
        let step = PERIOD / 4096.0;
        let before = (0..).map(|k| step * f64::from(k)).find(|t| excess(t + step) > 0.0).unwrap();
        let wanted = root(before, before + step, excess);
        println!("{count}, {share}: {error}; {:e}, {:?}", state.time() / wanted - 1.0, state.counts());
        assert!(matches!(error, RunError::Unbalanced { .. }), "{error}");
        assert!((state.time() / wanted - 1.0).abs() < 1e-9, "{:e}", state.time() / wanted - 1.0);
        let u_c = model.contact_scale(0).unwrap().0;
        let u = column(&model, &rows, "ball.x_m");
        assert!(u.iter().all(|u| u.abs() < 4.0 * u_c), "{u:?}");
    }
}

/// A jump that a row of springs cannot follow ends the run and leaves the memory unchanged.
#[test]
fn a_jump_beyond_the_springs_ends_the_run() {
    let shallow = 1e-7;
    let mut scene = rig(ball(), sine(0.0));
    let points = vec![(0.0, shallow), (0.5 * PERIOD, shallow), (0.5 * PERIOD, 10.0 * shallow)];
    scene.waveforms[0] = named("press", Waveform::new(Shape::Table { points }, Timing::every(1.0)).unwrap());
    scene.bodies[0].part = Body::default();
    scene.loads.clear();
    scene.contacts[0].part.normal = Normal::Indentation(Varying::Follows(0));
    let span = Some(2.2 * (RADIUS * shallow).sqrt());
    scene.contacts[0].part.engine = EngineChoice::Springs { count: 32, span };
    scene.bodies[0].part.x = crate::parts::follower(0).x;
    let (_, state, rows, error) = fails(&scene, PERIOD);
    let RunError::Contact { t, source: ContactError::Outgrown { d, .. }, .. } = error else {
        panic!("{error}")
    };
    assert_eq!((t, d, state.time()), (0.5 * PERIOD, 10.0 * shallow, 0.5 * PERIOD));
    assert!(rows.rows().count() > 30);
}
