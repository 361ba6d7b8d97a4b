//! Chains of sliders connected by springs: many contacts, an event of one of them at a time, and steps with few stages.

use crate::lottery::on_rows;
use crate::parts::{channel, contact, damper, event, follower, free, named, plan, sine, trace, wave};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Scene, Side};
use stickslip_drive::{Method, Plan, Shape, State, Stepper};

const PERIOD: f64 = 1e-3;
const STROKE: f64 = 0.5e-6;

/// Different sliders on balls on one foot, connected by springs with a thirtieth of a contact's stiffness.
pub(crate) fn chain(shape: Shape, links: usize) -> Scene {
    let mut scene = Scene {
        waveforms: vec![wave("drive", shape, PERIOD)],
        bodies: vec![named("foot", follower(0))],
        ..Scene::default()
    };
    for k in 0..links {
        let slider = k + 1;
        let name = |what: &str| format!("{what} {slider}");
        scene.bodies.push(named(&name("slider"), free(0.02 * (1.0 + 0.013 * k as f64))));
        let between = [Side::Body(0), Side::Body(slider)];
        let ball = contact(between, Profile::paraboloid(1e-3).unwrap(), 0.15, 1.0);
        scene.contacts.push(named(&name("ball"), ball));
        if k > 0 {
            let mut spring = damper([Side::Body(slider - 1), Side::Body(slider)], 0.0);
            spring.stiffness = 1e5;
            scene.springs.push(named(&name("spring"), spring));
        }
    }
    scene
}

fn sawtooth() -> Shape {
    Shape::Sawtooth { stroke: STROKE, flyback: 0.1e-3 }
}

/// Positions of all sliders in rows of a run, and the final state.
fn places(scene: &Scene, plan: &Plan) -> (Vec<f64>, State) {
    let (model, state, rows) = trace(scene, plan, plan.duration / 32.0);
    let sliders = scene.bodies.iter().filter(|body| body.part.is_free());
    let columns: Vec<usize> = sliders.map(|body| channel(&model, &format!("{}.x_m", body.name))).collect();
    (rows.rows().flat_map(|row| columns.iter().map(|c| row[*c])).collect(), state)
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Comparison with rows of springs and velocity Verlet, an independent method, extrapolated from two steps h and h/2.
#[test]
fn a_chain_agrees_with_rows_at_fixed_steps() {
    for (name, shape) in [("sawtooth", sawtooth()), ("sine", sine(0.5 * STROKE))] {
        let scene = chain(shape, 6);
        let (located, state) = places(&scene, &event(1e-6, 2.0 * PERIOD));
        assert!(state.tally().steps(Method::BriefNystrom) > 0, "{name}");
        let rows = on_rows(&scene, 1024);
        let verlet =
            |steps: f64| places(&rows, &plan(Stepper::Verlet { step: PERIOD / steps }, 2.0 * PERIOD)).0;
        let (coarse, fine) = (verlet(4_000.0), verlet(8_000.0));
        let exact: Vec<f64> =
            fine.iter().zip(&coarse).map(|(fine, coarse)| fine + (fine - coarse) / 3.0).collect();
        let (off, step) = (largest_difference(&located, &exact), largest_difference(&fine, &exact));
        println!("{name}: off by {:.1e} of the stroke ({:.1e})", off / STROKE, step / STROKE);
        assert!(off < 1e-5 * STROKE, "{name}: {off:e}");
    }
}

/// Comparison with a run at 1e-12, which does not use steps with few stages.
#[test]
fn errors_of_a_chain_stay_below_the_tolerance() {
    for (name, shape) in [("sawtooth", sawtooth()), ("sine", sine(0.5 * STROKE))] {
        let scene = chain(shape, 8);
        let run = |tolerance: f64| places(&scene, &event(tolerance, 10.0 * PERIOD));
        let (exact, state) = run(1e-12);
        assert_eq!(state.tally().steps(Method::BriefNystrom), 0);
        for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
            let (located, state) = run(tolerance);
            let off = largest_difference(&located, &exact) / STROKE;
            let [few, all] =
                [Method::BriefNystrom, Method::Nystrom].map(|method| state.tally().steps(method));
            println!(
                "{name} at {tolerance:e}: off by {off:.1e} of the stroke, {few} steps of few stages, {all} of all"
            );
            assert!(off < 0.3 * tolerance, "{name} at {tolerance:e}: {off:e}");
        }
    }
}

/// The energy balance closes; friction work is computed from slip.
#[test]
fn books_of_a_chain_close() {
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let scene = chain(sawtooth(), 8);
        let (model, _, rows) = trace(&scene, &event(tolerance, 5.0 * PERIOD), PERIOD / 7.0);
        let of = |name: &str| rows.column(channel(&model, name)).fold(0.0_f64, |most, e| most.max(e.abs()));
        let (error, friction) = (of("energy.error_J"), of("energy.friction_J"));
        println!("at {tolerance:e}: books {error:.1e} J of {friction:.1e} J");
        assert!(friction > 0.0 && error < tolerance * friction, "{tolerance:e}: {error:e} of {friction:e}");
    }
}
