//! Tests of the charge due to strain, Q = CV + kα(e - αV): time constants, limits, resonances and energy balance.

use super::parts::{FARADS, GAIN, Ran, event, every, named, plan, ran, table};
use std::f64::consts::TAU;
use stickslip_drive::component::Input;
use stickslip_drive::scene::{Actuator, Body, Coordinate, Direction, Freedom, Point, Scene, Side, Varying};
use stickslip_drive::{Shape, Stepper, Waveform};
use stickslip_piezo::driver::{Driver, Spec};

/// Coupling κ, from which the stiffness follows: k = κC/α².
const COUPLING: f64 = 0.25;
const STIFFNESS: f64 = COUPLING * FARADS / (GAIN * GAIN);
const MASS: f64 = 0.5;
const ENDS: [Side; 2] = [Side::Ground, Side::Body(0)];

/// Stack between ground and a foot, with charge due to strain.
fn stack(command: Waveform, spec: Spec, foot: Coordinate) -> Scene {
    let elongation =
        Input::Length { between: [ENDS[1], ENDS[0]], at: [Point::default(); 2], direction: Direction::X };
    let range = command.range();
    let driver = Driver::new(spec, 0, range).reciprocal(COUPLING, elongation);
    let actuator = Actuator {
        between: ENDS,
        at: [Point::default(); 2],
        direction: Direction::X,
        stiffness: STIFFNESS,
        damping: 0.0,
        stroke: Varying::Follows(1),
    };
    Scene {
        waveforms: vec![named("drive", command)],
        blocks: vec![named("stack", driver.shared())],
        bodies: vec![named("foot", Body { mass: Some(MASS), x: foot, ..Body::default() })],
        actuators: vec![named("stack", actuator)],
        ..Scene::default()
    }
}

fn spec(resistance: Option<f64>, current: Option<f64>) -> Spec {
    Spec { resistance, current: current.map(|current| (current, current)), ..super::parts::ideal() }
}

const HELD: Coordinate = Coordinate { position: 0.0, velocity: 0.0, freedom: Freedom::Fixed };
const STEP: &[(f64, f64)] = &[(0.0, 0.0), (0.1, 0.0), (0.1, 100.0), (9.0, 100.0)];

/// A held stack has the capacitance C(1 - κ): V = 100 V (1 - e^{-t/RC(1-κ)}).
#[test]
fn a_held_stack_charges_through_a_resistance_by_its_clamped_capacitance() {
    let ran = ran(&stack(table(STEP), spec(Some(300.0), None), HELD), &event(1e-12, 2e-3), 37e-6);
    let time = 300.0 * FARADS * (1.0 - COUPLING);
    let exact = |t: f64| if t < 1e-4 { 0.0 } else { -100.0 * (-(t - 1e-4) / time).exp_m1() };
    let worst = ran.worst(exact);
    assert!(worst < 1e-9 * 100.0, "{worst}");
}

/// The voltage of a held stack rises at I/C(1 - κ) until it meets the command.
#[test]
fn a_held_stack_rises_faster_at_a_limited_current() {
    let ran = ran(&stack(table(STEP), spec(None, Some(0.2)), HELD), &event(1e-10, 1e-3), 37e-6);
    let slew = 0.2 / (FARADS * (1.0 - COUPLING));
    let worst = ran.worst(|t| (slew * (t - 1e-4)).clamp(0.0, 100.0));
    assert!(worst < 1e-9 * 100.0, "{worst}");
    let ends = ran.events();
    assert!((ends[1].0 - 1e-4 - 100.0 / slew).abs() < 1e-12, "{ends:?}");
    let fixed = super::parts::ran(
        &stack(table(&[(0.0, 0.0), (0.01, 100.0), (9.0, 100.0)]), spec(None, Some(0.2)), HELD),
        &plan(Stepper::Rk4 { step: 0.5e-6 }, 0.2e-3),
        37e-6,
    );
    let worst = fixed.worst(|t| slew * t.min(0.2e-3));
    assert!(worst < 1e-6 * 100.0, "{worst}");
}

/// Mean period, from the first and the last upward crossing of 0.
fn period(ran: &Ran) -> f64 {
    let (t, x) = (ran.column("time_s"), ran.column("foot.x_m"));
    let crossings: Vec<f64> = (1..x.len())
        .filter(|&i| x[i - 1] < 0.0 && x[i] >= 0.0)
        .map(|i| t[i - 1] + (t[i] - t[i - 1]) * x[i - 1] / (x[i - 1] - x[i]))
        .collect();
    (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64
}

/// With an ideal source (short circuit) the mass oscillates at √(k/m), with 1 MΩ (open circuit) at √(k/m(1 - κ)), to order (RCω)⁻².
#[test]
fn open_electrodes_stiffen_the_stack() {
    let released = Coordinate { position: 0.0, velocity: 1e-3, freedom: Freedom::Free };
    let still = || table(&[(0.0, 0.0), (99.0, 0.0)]);
    let natural = TAU / (STIFFNESS / MASS).sqrt();
    for (resistance, expected) in [(None, natural), (Some(1e6), natural * (1.0 - COUPLING).sqrt())] {
        let scene = stack(still(), spec(resistance, None), released);
        let ran = ran(&scene, &event(1e-11, 40.0 * natural), natural / 200.0);
        let measured = period(&ran);
        assert!((measured / expected - 1.0).abs() < 1e-5, "{resistance:?}: {measured} {expected}");
    }
}

/// The balance source = stored + lost + work holds, and the work of the stack is the mechanical input of the model.
#[test]
fn books_close_with_the_work_of_the_stack_in_them() {
    let saw = || every(Shape::Sawtooth { stroke: 100.0 * GAIN, flyback: 50e-6 });
    let cases = [
        (saw(), spec(None, None)),
        (saw(), spec(None, Some(0.3))),
        (saw(), spec(Some(40.0), Some(0.3))),
        (table(STEP), spec(None, None)),
    ];
    for (command, spec) in cases {
        let ran = ran(&stack(command, spec, Coordinate::FREE), &event(1e-11, 5e-3), 11e-6);
        let [source, stored, lost, worked] = ["source_J", "stored_J", "lost_J", "mechanical_J"]
            .map(|name| ran.column(&format!("stack.{name}")));
        let scale = stored.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for i in 0..source.len() {
            let open = source[i] - lost[i] - worked[i] - (stored[i] - stored[0]);
            assert!(open.abs() < 1e-8 * scale, "{spec:?}: {open} of {scale} in row {i}");
        }
        let input = ran.column("energy.input_J");
        let apart = worked.iter().zip(&input).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-8 * scale, "{spec:?}: {apart} of {scale}");
        assert!(worked.iter().any(|work| work.abs() > 1e-4 * scale), "it works");
    }
}

/// With a time constant of nanoseconds V = f, so the current is C(1 - κ)ḟ + kαv. This holds at every row, also between the ends of
/// steps, where the small difference f - V of the dense output would be inaccurate.
#[test]
fn the_current_is_right_inside_steps_over_what_settles() {
    const OHMS: f64 = 1e-3;
    let swing = 50.0;
    let command = every(Shape::Sine { amplitude: swing * GAIN, phase: -0.25 * TAU, offset: swing * GAIN });
    for tolerance in [1e-3, 1e-4, 1e-6] {
        let ran = ran(
            &stack(command.clone(), spec(Some(OHMS), None), Coordinate::FREE),
            &event(tolerance, 4e-3),
            3.7e-6,
        );
        let (t, v) = (ran.column("time_s"), ran.column("foot.vx_m_s"));
        let current = ran.column("stack.current_A");
        let omega = TAU / crate::parts::PERIOD;
        let exact = |t: f64, v: f64| {
            FARADS * (1.0 - COUPLING) * swing * omega * (omega * t).sin() + STIFFNESS * GAIN * v
        };
        // Because the voltage lags by RC, the relative error of the current is ωRC.
        let peak = current.iter().fold(0.0, |most: f64, i| most.max(i.abs()));
        let worst =
            t.iter().zip(&v).zip(&current).map(|((t, v), i)| (i - exact(*t, *v)).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-4 * peak, "{tolerance:e}: {worst} of {peak}");
        assert!(t.len() as u64 > 4 * ran.state.counts().steps, "{:?}", ran.state.counts());
    }
}

/// The rounding of a voltage over 1 µΩ is a power far above the tolerance 1e-11. The step size must not depend on this power.
#[test]
fn rounding_of_what_settles_shortens_no_steps() {
    let command = every(Shape::Sine { amplitude: 50.0 * GAIN, phase: -0.25 * TAU, offset: 50.0 * GAIN });
    let scene = stack(command, spec(Some(1e-6), None), Coordinate::FREE);
    let [coarse, fine] = [1e-7, 1e-11].map(|tolerance| {
        let ran = ran(&scene, &event(tolerance, 2e-3), 1e-3);
        ran.state.counts().steps
    });
    assert!(fine < 10 * coarse, "{coarse} {fine}");
}
