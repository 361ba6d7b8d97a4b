//! Steps with few stages at large tolerances: their error includes time-dependent forces and their work.

use crate::parts::{column, contact, event, foot_and_slider, plan, push, trace, wave};
use stickslip_contact::Profile;
use stickslip_drive::scene::{EngineChoice, Scene};
use stickslip_drive::{Plan, Shape, Stepper};

const PERIOD: f64 = 1.64e-3;

/// Slider of 110 g on balls without closed form, with a flyback of 0.2 µs.
fn flyback() -> Scene {
    let profile = Profile::powers(&[(1e3, 2.0), (4.4e12, 4.0)]).unwrap();
    let drive = wave("drive", Shape::Sawtooth { stroke: 0.1e-6, flyback: 0.2e-6 }, PERIOD);
    let mut scene = foot_and_slider(drive, 0.11, contact(crate::parts::FOOT_SLIDER, profile, 0.25, 0.27));
    scene.loads.push(push(1, -2e-3));
    scene
}

/// During a short flyback the input work is an integral over time alone, and must be accurate.
#[test]
fn the_work_of_a_short_flank_is_met() {
    let duration = 9.3 * PERIOD;
    for (tolerance, allowed) in [(1e-5, 1e-5), (1e-6, 1e-5)] {
        let (model, _, trace) = trace(&flyback(), &event(tolerance, duration), 0.1 * PERIOD);
        let [input, kinetic, elastic, friction] = ["input", "kinetic", "elastic", "friction"]
            .map(|name| column(&model, &trace, &format!("energy.{name}_J")));
        let stored = |i: usize| kinetic[i] + elastic[i] - elastic[0];
        let misses = (0..input.len()).map(|i| (input[i] - stored(i) - friction[i]).abs());
        let off = misses.fold(0.0, f64::max) / input[input.len() - 1];
        println!("{tolerance:e}: books miss {off:.1e} of the work");
        assert!(off < allowed, "{tolerance:e}: {off:e}");
    }
}

/// Sixteen springs that slip one by one under a parabolic foot motion, compared with 4e5 Runge–Kutta steps.
#[test]
fn springs_that_slip_on_the_way_are_not_stepped_over() {
    let period = 0.2e-3;
    let drive = wave("drive", Shape::Parabola { stroke: 0.83e-6, turn: 0.15 * period }, period);
    let ball = contact(crate::parts::FOOT_SLIDER, Profile::paraboloid(2e-3).unwrap(), 0.21, 2.2);
    let mut scene = foot_and_slider(drive, 0.02, ball);
    scene.contacts[0].part.engine = EngineChoice::Springs { count: 16, span: None };
    let duration = 10.0 * period;
    let way_of = |plan: &Plan, mass: f64| {
        let mut scene = scene.clone();
        scene.bodies[1].part.mass = scene.bodies[1].part.mass.map(|own| own * mass);
        let (model, _, trace) = trace(&scene, plan, 0.1 * period);
        (column(&model, &trace, "slider.x_m"), model.contact_natural(0).unwrap().displacement)
    };
    let way = |plan: &Plan| way_of(plan, 1.0);
    let (exact, unit) = way(&plan(Stepper::Rk4 { step: duration / 4e5 }, duration));
    for tolerance in [1e-5, 1e-6] {
        // Rounding affects where steps end: the median of five runs counts.
        let mut offs = [0, 1, 2, 3, 4].map(|k| {
            let (found, _) = way_of(&event(tolerance, duration), 1.0 + 1e-13 * f64::from(k));
            found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / unit
        });
        println!("{offs:?}");
        offs.sort_by(f64::total_cmp);
        let off = offs[2];
        println!("{tolerance:e}: {off:.1e} u_c off");
        assert!(off < 4e-4, "{tolerance:e}: {off:e}");
    }
}
