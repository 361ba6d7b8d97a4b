//! Contacts far from their start: rounding of u must not cause events.

use crate::parts::{FOOT_SLIDER, channel, contact, damper, event, follower, free, named, trace, wave};
use stickslip_contact::Profile;
use stickslip_drive::scene::{Body, Coordinate, Scene, Side, Spring};
use stickslip_drive::{Shape, Timing, Waveform};

/// A foot moves far, and then back and forth by the gross slip displacement; a spring holds the slider.
fn far_and_to_and_fro(far: f64, u_c: f64) -> (Scene, f64) {
    let turns = [0.0, 0.9, 0.3, 0.8, 0.4, 0.7, 0.5, 0.65, 0.55, 0.95, -0.2, 0.9];
    let time = |k: usize| 1e-3 * k as f64;
    let way = turns.iter().enumerate().map(|(k, turn)| (time(k + 2), (far - turn) * u_c));
    let points = [(0.0, 0.0), (time(1), far * u_c)].into_iter().chain(way).collect();
    let duration = time(turns.len() + 1);
    let wave = Waveform::new(Shape::Table { points }, Timing::every(duration)).unwrap();
    let hold = Spring { stiffness: 1e8, ..damper([Side::Ground, Side::Body(1)], 100.0) };
    let scene = Scene {
        waveforms: vec![named("way", wave)],
        bodies: vec![named("foot", follower(0)), named("slider", free(1e-3))],
        contacts: vec![named("ball", contact(FOOT_SLIDER, Profile::paraboloid(1e-3).unwrap(), 0.2, 1.0))],
        springs: vec![named("hold", hold)],
        ..Scene::default()
    };
    (scene, duration)
}

/// The forces agree with those near the start up to rounding of u; oscillations of one bit are no reversals.
#[test]
fn loops_far_from_the_start_are_those_near_it() {
    let (scene, duration) = far_and_to_and_fro(1.0, 0.0);
    let (model, _, _) = trace(&scene, &event(1e-9, duration), duration);
    let u_c = model.contact_natural(0).unwrap().displacement;
    let forces = |far: f64| {
        let (scene, duration) = far_and_to_and_fro(far, u_c);
        let (model, state, rows) = trace(&scene, &event(1e-9, duration), 0.5e-3);
        let limit = model.contact_natural(0).unwrap().force;
        println!("{far:e} u_c: {:?}", state.counts());
        assert!(state.counts().events < 60);
        let (force, u) = (channel(&model, "ball.fx_N"), channel(&model, "ball.u_m"));
        let rows: Vec<&[f64]> = rows.rows().collect();
        assert!((rows[2][u] / (far * u_c) - 1.0).abs() < 1e-3 + 2.0 / far);
        rows[3..].iter().map(|row| row[force] / limit).collect::<Vec<f64>>()
    };
    let near = forces(100.0);
    for far in [1e5, 1e6, 1e7] {
        let off = forces(far).iter().zip(&near).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!("off by {off:.1e} of μF_N");
        assert!(off < 1e-8_f64.max(10.0 * far * f64::EPSILON), "{off:e}");
    }
}

/// Flat foot on a cycloid with different initial positions of the slider. Rounding must not increase the number of steps.
#[test]
fn a_start_far_from_the_origin_costs_no_steps() {
    let period = 2e-3;
    let run = |start: f64| {
        let profile = Profile::flat(94e-6).unwrap();
        let slider = free(2e-3);
        let slider = Body { x: Coordinate { position: start, ..slider.x }, ..slider };
        let scene = Scene {
            waveforms: vec![wave("drive", Shape::Cycloid { stroke: 870e-9, flyback: 88e-6 }, period)],
            bodies: vec![named("foot", follower(0)), named("slider", slider)],
            contacts: vec![named("pad", contact(FOOT_SLIDER, profile, 0.09, 74e-3))],
            ..Scene::default()
        };
        let (model, state, rows) = trace(&scene, &event(1e-12, 2.0 * period), period);
        let x = channel(&model, "slider.x_m");
        let way: Vec<f64> = rows.rows().map(|row| row[x] - start).collect();
        (state.counts().steps, state.counts().events, way)
    };
    let (steps, events, way) = run(0.0);
    for start in [1e-4, 1e-3, 1e-2] {
        let (others, other_events, other_way) = run(start);
        println!("{start:e} m: {others} steps for {steps}");
        assert!(others < 2 * steps, "{start:e}: {others} steps for {steps}");
        assert!(other_events.abs_diff(events) <= 1, "{start:e}: {other_events} events for {events}");
        let off = way.iter().zip(&other_way).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e3 * start * f64::EPSILON, "{start:e}: {off:e} m off");
    }
}
