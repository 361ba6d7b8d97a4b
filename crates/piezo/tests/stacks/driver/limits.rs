//! Tests of voltage window and current limit: voltage, and times of the events.

use super::parts::{FARADS, GAIN, Ran, event, every, ideal, plan, ran, scene, table};
use std::f64::consts::{PI, TAU};
use stickslip_drive::{Shape, Stepper};
use stickslip_piezo::driver::Spec;

/// Tolerance of event times, s.
const MOMENT: f64 = 1e-12;

fn limited(sink: f64, source: f64) -> Spec {
    Spec { current: Some((sink, source)), ..ideal() }
}

fn happened(ran: &Ran, expected: &[(f64, &str)]) {
    let events = ran.events();
    assert!(events.len() >= expected.len(), "{events:?}");
    for ((t, kind), (at, word)) in events.iter().zip(expected) {
        assert!(kind == word && (t - at).abs() < MOMENT, "{events:?} {expected:?}");
    }
}

/// Sawtooth of 100 V with a rise of 0.98 ms and a flyback of 20 µs. The driver is limited to 0.2 V/µs, so the voltage falls until it
/// meets the next rise.
#[test]
fn a_flyback_too_fast_is_left_for_the_next_rise() {
    let (stroke, period, flyback, slew) = (100.0, 1e-3, 20e-6, 2e5);
    let saw = every(Shape::Sawtooth { stroke: GAIN * stroke, flyback });
    let ran = ran(&scene(saw, limited(0.2, 0.2)), &event(1e-8, 3e-3), 13e-6);
    let (top, rise) = (period - flyback, stroke / (period - flyback));
    // stroke - slew (t - top) = rise (t - period).
    let meets = (stroke + slew * top + rise * period) / (slew + rise);
    let words = ["current limit down", "current in limits"];
    let all = [(top, words[0]), (meets, words[1]), (top + period, words[0]), (meets + period, words[1])];
    happened(&ran, &all);
    let exact = |t: f64| {
        let (n, at) = ((t / period).floor(), t % period);
        let falls = n > 0.0 && t < meets + (n - 1.0) * period;
        match (falls, at > top) {
            (true, _) => stroke - slew * (at + flyback),
            (_, true) => stroke - slew * (at - top),
            _ => rise * at,
        }
    };
    let worst = ran.worst(exact);
    assert!(worst < 1e-9 * stroke, "{worst}");
    let falling = ran.volts().iter().zip(ran.column("stack.current_A")).filter(|(_, i)| *i == -0.2).count();
    assert!(falling > 40, "{falling}");
}

/// Steps from 0 to 100 V and to -20 V become ramps of I/C, with different currents into and out of the stack.
#[test]
fn a_step_becomes_a_ramp_by_the_current_there_is() {
    let step = table(&[(0.0, 0.0), (1.0, 0.0), (1.0, 100.0), (3.0, 100.0), (3.0, -20.0), (9.0, -20.0)]);
    let ran = ran(&scene(step, limited(0.1, 0.4)), &event(1e-8, 6e-3), 13e-6);
    let (up, down) = (0.4 / FARADS, 0.1 / FARADS);
    happened(
        &ran,
        &[
            (1e-3, "current limit up"),
            (1e-3 + 100.0 / up, "current in limits"),
            (3e-3, "current limit down"),
            (3e-3 + 120.0 / down, "current in limits"),
        ],
    );
    let worst = ran.worst(|t| match t {
        t if t < 1e-3 => 0.0,
        t if t < 3e-3 => (up * (t - 1e-3)).min(100.0),
        t => (100.0 - down * (t - 3e-3)).max(-20.0),
    });
    assert!(worst < 1e-9 * 100.0, "{worst}");
}

/// For a sine A sin ωt with Aω above the limiting rate r, the limit begins where Aω cos ωt = -r. The voltage then falls at r until it
/// meets the sine.
#[test]
fn a_sine_is_left_where_it_grows_too_steep() {
    let (amplitude, omega, slew) = (50.0, TAU * 1e3, 2e5);
    let sine = every(Shape::Sine { amplitude: GAIN * amplitude, phase: 0.5 * PI, offset: 0.0 });
    let ran = ran(&scene(sine, limited(0.2, 0.2)), &event(1e-8, 2e-3), 13e-6);
    // The rate -Aω sin ωt of A cos ωt first equals -r at t = asin(r/Aω)/ω.
    let leaves = (slew / (amplitude * omega)).asin() / omega;
    let gap =
        |t: f64| amplitude * (omega * leaves).cos() - slew * (t - leaves) - amplitude * (omega * t).cos();
    // Bisection of the crossing, which is before three quarters of a period.
    let (mut low, mut high) = (0.5e-3, 0.75e-3);
    assert!(gap(low) > 0.0 && gap(high) < 0.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if gap(middle) > 0.0 { low = middle } else { high = middle }
    }
    // At the crossing the sine rises more slowly than r.
    happened(&ran, &[(leaves, "current limit down"), (low, "current in limits")]);
}

/// Step through R with a current limit: a ramp until (e - V)/R equals the limit, then an exponential.
#[test]
fn a_limit_ends_where_the_resistance_takes_over() {
    let (resistance, current) = (300.0, 0.1);
    let spec = Spec { resistance: Some(resistance), ..limited(current, current) };
    let step = table(&[(0.0, 0.0), (1.0, 0.0), (1.0, 100.0), (9.0, 100.0)]);
    let ran = ran(&scene(step, spec), &event(1e-12, 4e-3), 13e-6);
    let (slew, time) = (current / FARADS, resistance * FARADS);
    let ends = 1e-3 + (100.0 - resistance * current) / slew;
    happened(&ran, &[(1e-3, "current limit up"), (ends, "current in limits")]);
    let worst = ran.worst(|t| match t {
        t if t < 1e-3 => 0.0,
        t if t < ends => slew * (t - 1e-3),
        t => 100.0 - resistance * current * (-(t - ends) / time).exp(),
    });
    assert!(worst < 1e-9 * 100.0, "{worst}");
}

/// A triangle of ±50 V about 50 V and a sine are limited to a window of 10 to 80 V. Event times have closed forms.
#[test]
fn a_window_cuts_its_command() {
    let spec = Spec { window: Some((10.0, 80.0)), ..ideal() };
    let tent = table(&[(0.0, 50.0), (1.0, 100.0), (3.0, 0.0), (4.0, 50.0)]);
    let ran = ran(&scene(tent, spec), &event(1e-8, 4e-3), 13e-6);
    happened(
        &ran,
        &[
            (0.6e-3, "voltage at upper end"),
            (1.4e-3, "voltage in window"),
            (2.8e-3, "voltage at lower end"),
            (3.2e-3, "voltage in window"),
        ],
    );
    let tent = |t: f64| {
        50.0 + 5e4
            * if t < 1e-3 {
                t
            } else if t < 3e-3 {
                2e-3 - t
            } else {
                t - 4e-3
            }
    };
    let worst = ran.worst(|t| tent(t).clamp(10.0, 80.0));
    assert!(worst < 1e-9 * 100.0, "{worst}");
    let sine = every(Shape::Sine { amplitude: GAIN * 50.0, phase: 0.0, offset: GAIN * 50.0 });
    let ran = self::ran(&scene(sine, spec), &event(1e-10, 1e-3), 13e-6);
    let (up, down) = ((0.6_f64).asin() / (TAU * 1e3), (0.8_f64).asin() / (TAU * 1e3));
    happened(
        &ran,
        &[
            (up, "voltage at upper end"),
            (0.5e-3 - up, "voltage in window"),
            (0.5e-3 + down, "voltage at lower end"),
            (1e-3 - down, "voltage in window"),
        ],
    );
}

/// If the command returns into the window faster than the driver can follow, the current limit begins at that time.
#[test]
fn a_window_may_be_left_into_the_limit() {
    let spec = Spec { window: Some((0.0, 60.0)), ..limited(0.02, 0.02) };
    let tent = table(&[(0.0, 0.0), (5.0, 100.0), (6.0, 0.0), (12.0, 0.0)]);
    let ran = ran(&scene(tent, spec), &event(1e-8, 11e-3), 130e-6);
    happened(
        &ran,
        &[(3e-3, "voltage at upper end"), (5.4e-3, "current limit down"), (8.4e-3, "current in limits")],
    );
}

/// Steps without event location converge to the same result.
#[test]
fn steps_without_events_agree() {
    let saw = || every(Shape::Sawtooth { stroke: GAIN * 100.0, flyback: 20e-6 });
    let end = |stepper: Stepper| {
        let ran = ran(&scene(saw(), limited(0.2, 0.2)), &plan(stepper, 1.3e-3), 1.3e-3);
        (ran.volts().pop().unwrap().1, ran.state.body(&ran.model, 1).unwrap().0)
    };
    let located = end(Stepper::Event { tolerance: 1e-10 });
    for stepper in [Stepper::Rk4 { step: 20e-9 }, Stepper::Verlet { step: 20e-9 }] {
        let (volts, x) = end(stepper);
        assert!((volts - located.0).abs() < 1e-9 * 100.0, "{volts} {located:?}");
        assert!((x - located.1).abs() < 2e-4 * GAIN * 100.0, "{x} {located:?}");
    }
}

/// Sawtooth and sine with a current limit, for all steppers, with and without a resistance. The current never exceeds the limit
/// except for rounding. Between rows it may exceed the limit only by the curvature of the sine within one step.
#[test]
fn no_stepper_exceeds_the_current() {
    let saw = Shape::Sawtooth { stroke: GAIN * 100.0, flyback: 20e-6 };
    let sine = Shape::Sine { amplitude: GAIN * 50.0, phase: 0.3, offset: GAIN * 50.0 };
    let frames = Stepper::Frames { length: 20e-6, accuracy: 1e-3 };
    let steppers = [
        (Stepper::Event { tolerance: 1e-9 }, 1e-8),
        (Stepper::Rk4 { step: 5e-6 }, 0.05),
        (Stepper::Verlet { step: 5e-6 }, 0.05),
        (frames, 0.05),
        (Stepper::Dopri5 { tolerance: 1e-9 }, 0.05),
    ];
    for (shape, resistance) in [(&saw, None), (&saw, Some(10.0)), (&sine, None), (&sine, Some(10.0))] {
        let spec = Spec { resistance, ..limited(0.2, 0.3) };
        let mut first = None;
        for (stepper, near) in steppers {
            let what = format!("{stepper:?}, {resistance:?}, {shape:?}");
            let ran = ran(&scene(every(shape.clone()), spec), &plan(stepper, 3e-3), 1e-6);
            let peak = ran.figures(&spec).peak_current;
            assert!(peak <= 0.3 * (1.0 + 1e-9), "{what}: {peak}");
            let volts = ran.volts();
            for pair in volts.windows(2) {
                let rate = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0) * FARADS;
                assert!((-0.24..=0.34).contains(&rate), "{what}: {rate} at {}", pair[0].0);
            }
            let located = first.get_or_insert_with(|| volts.clone());
            let worst = located.iter().zip(&volts).fold(0.0, |most: f64, (a, b)| most.max((a.1 - b.1).abs()));
            assert!(worst <= near * 100.0, "{what}: {worst} V");
        }
    }
}
