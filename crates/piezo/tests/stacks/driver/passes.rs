//! Tests of resistance and bandwidth: step and ramp responses.

use super::parts::{FARADS, GAIN, event, every, ideal, low, ran, scene, table};
use std::f64::consts::{SQRT_2, TAU};
use stickslip_drive::{Method, Shape};
use stickslip_piezo::driver::Spec;

/// Step to 100 V at 1 ms.
const STEP: &[(f64, f64)] = &[(0.0, 0.0), (1.0, 0.0), (1.0, 100.0), (9.0, 100.0)];
/// Ramp of 10 V/ms.
const RAMP: &[(f64, f64)] = &[(0.0, 0.0), (10.0, 100.0)];

fn through(resistance: f64) -> Spec {
    Spec { resistance: Some(resistance), ..ideal() }
}

/// The step response with a resistance is V = 100 V (1 - e^{-t/RC}).
#[test]
fn a_step_through_a_resistance_is_an_exponential() {
    let time = 300.0 * FARADS;
    let ran = ran(&scene(table(STEP), through(300.0)), &event(1e-12, 4e-3), 37e-6);
    let exact = |t: f64| if t < 1e-3 { 0.0 } else { -100.0 * (-(t - 1e-3) / time).exp_m1() };
    let worst = ran.worst(exact);
    assert!(worst < 1e-9 * 100.0, "{worst}");
    assert!(ran.volts().last().unwrap().1 > 99.9);
}

/// The response to a ramp of rate v is V = v(t - RC(1 - e^{-t/RC})), with the current I = C V̇.
#[test]
fn a_ramp_through_a_resistance_lags_by_its_time_constant() {
    let time = 300.0 * FARADS;
    let ran = ran(&scene(table(RAMP), through(300.0)), &event(1e-12, 4e-3), 37e-6);
    let worst = ran.worst(|t| 1e4 * (t + time * (-t / time).exp_m1()));
    assert!(worst < 1e-9 * 40.0, "{worst}");
    let current = ran.column("stack.current_A").pop().unwrap();
    let exact = -FARADS * 1e4 * (-4e-3 / time).exp_m1();
    assert!((current - exact).abs() < 1e-9 * exact, "{current} {exact}");
}

/// The step response of the low-pass is V/100 V = 1 - e^{-ζωt}(cos ω_d t + ζ/√(1-ζ²) sin ω_d t), ω_d = ω√(1-ζ²).
#[test]
fn a_step_within_a_bandwidth_rings_by_its_damping_ratio() {
    for ratio in [0.3, 0.5_f64.sqrt()] {
        let omega = TAU * 1e3;
        let damped = omega * (1.0 - ratio * ratio).sqrt();
        let ran = ran(&scene(table(STEP), low(1e3, ratio)), &event(1e-12, 4e-3), 37e-6);
        let exact = |t: f64| {
            let t = (t - 1e-3).max(0.0);
            let swing = (damped * t).cos() + ratio * omega / damped * (damped * t).sin();
            100.0 * (1.0 - (-ratio * omega * t).exp() * swing)
        };
        let worst = ran.worst(exact);
        assert!(worst < 1e-9 * 100.0, "{ratio}: {worst}");
    }
}

/// The response of the low-pass to a ramp of rate v is V = v[t - 2ζ/ω + e^{-ζωt}(2ζ/ω cos ω_d t + (2ζ²-1)/ω_d sin ω_d t)].
#[test]
fn a_ramp_within_a_bandwidth_lags_by_two_damping_ratios() {
    let (ratio, omega) = (0.4_f64, TAU * 1e3);
    let damped = omega * (1.0 - ratio * ratio).sqrt();
    let ran = ran(&scene(table(RAMP), low(1e3, ratio)), &event(1e-12, 4e-3), 37e-6);
    let exact = |t: f64| {
        let swing = 2.0 * ratio / omega * (damped * t).cos()
            + (2.0 * ratio * ratio - 1.0) / damped * (damped * t).sin();
        1e4 * (t - 2.0 * ratio / omega + (-ratio * omega * t).exp() * swing)
    };
    let worst = ran.worst(exact);
    assert!(worst < 1e-9 * 40.0, "{worst}");
}

/// With RC = 0.1 ns or a bandwidth of 1 GHz the voltage lags a sawtooth by RC or 2ζ/ω. Explicit integration would need millions of
/// evaluations.
#[test]
fn drivers_of_nanoseconds_are_stepped_over() {
    let cases = [(through(1e-4), 1e-4 * FARADS), (low(1e9, 0.5_f64.sqrt()), SQRT_2 / (TAU * 1e9))];
    for (spec, lag) in cases {
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let saw = every(Shape::Sawtooth { stroke: GAIN * 100.0, flyback: 0.1e-3 });
            let ran = ran(&scene(saw, spec), &event(tolerance, 0.97e-3), 37e-6);
            let exact = |t: f64| match t % 1e-3 - lag {
                _ if t == 0.0 => 0.0,
                s if s < 0.9e-3 => 100.0 / 0.9e-3 * s,
                s => 100.0 - 1e6 * (s - 0.9e-3),
            };
            let (worst, evaluations) = (ran.worst(exact), ran.state.counts().evaluations);
            let told = format!("{spec:?} at {tolerance:e}: {worst:e} V, {evaluations} evaluations");
            assert!(worst < tolerance * 100.0 && evaluations < 10_000, "{told}");
            assert!(ran.state.tally().steps(Method::Radau) > 0, "{told}");
        }
    }
}

/// Compares the voltage for RC = 5 µs and a piecewise linear command with V = f - ḟRC + (V₀ - f₀ + ḟRC)e^{-t/RC}. Events of the
/// contact shorten steps, and the voltage must stay accurate at their ends.
#[test]
fn events_of_contacts_leave_a_lagging_voltage_where_it_belongs() {
    const OHMS: f64 = 5.0;
    let time = OHMS * FARADS;
    let points =
        [(0.0, 0.0), (0.9, 100.0), (0.905, 0.0), (1.9, 100.0), (1.905, 0.0), (2.9, 100.0), (9.0, 100.0)];
    let exact = |t: f64| {
        let (mut volts, mut at) = (0.0, 0.0);
        for ends in points.windows(2) {
            let [(t0, f0), (t1, f1)] = [ends[0], ends[1]].map(|(t, f)| (1e-3 * t, f));
            let rate = (f1 - f0) / (t1 - t0);
            let until = t.min(t1);
            volts = f0 + rate * (until - t0) - rate * time
                + (volts - f0 + rate * time) * (-(until - t0) / time).exp();
            at = until;
            if t <= t1 {
                break;
            }
        }
        assert!(at <= t);
        volts
    };
    let spec = Spec { resistance: Some(OHMS), ..ideal() };
    for tolerance in [1e-3, 1e-4, 1e-6] {
        let ran = ran(&scene(table(&points), spec), &event(tolerance, 3e-3), 1.7e-6);
        assert!(ran.state.counts().events > 10, "{:?}", ran.state.counts());
        let worst = ran.worst(exact);
        assert!(worst < 0.5 * tolerance * 100.0, "{tolerance:e}: {worst} V");
    }
}
