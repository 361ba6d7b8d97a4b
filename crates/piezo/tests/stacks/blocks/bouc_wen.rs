//! Tests of the Bouc–Wen block against closed forms for n = 1 and an independent integration for other n.

use super::parts::{PERIOD, SPAN, column, event, every, plan, reading, scene, shared, table, trace};
use stickslip_drive::{Plan, Shape, Stepper, Timing, Waveform};
use stickslip_piezo::hysteresis::{BoucWen, BoucWenBlock, BoucWenError};

const SLOPE: f64 = 0.3;
const LIMIT: f64 = 0.1 * SPAN;
const SHARE: f64 = 0.8;

fn block(exponent: f64) -> Vec<stickslip_drive::scene::Named<stickslip_drive::component::SharedBlock>> {
    let law = BoucWen::new(SLOPE, LIMIT, SHARE, exponent).unwrap();
    vec![shared("lag", BoucWenBlock::new(law, reading(0)))]
}

/// Closed form of z for n = 1, after a monotone change of v from v₀ to v.
///
/// For rising v from ζ₀ ≥ 0, ζ = 1 - (1 - ζ₀)e^{-x}. From ζ₀ < 0, first ζ = (1 - (1 - qζ₀)e^{-qx})/q up to ζ = 0. Here q = 2·share -
/// 1 and x = A(v - v₀)/z_m. Falling v is the mirror image.
fn exponentials(z: f64, v0: f64, v: f64) -> f64 {
    let sign = (v - v0).signum();
    let (zeta, x, q) = (sign * z / LIMIT, SLOPE * (v - v0).abs() / LIMIT, 2.0 * SHARE - 1.0);
    let up = |zeta: f64, x: f64| 1.0 - (1.0 - zeta) * (-x).exp();
    let zero = (1.0 - q * zeta).ln() / q;
    sign * LIMIT
        * if zeta >= 0.0 {
            up(zeta, x)
        } else if x < zero {
            (1.0 - (1.0 - q * zeta) * (-q * x).exp()) / q
        } else {
            up(0.0, x - zero)
        }
}

/// The reversals of a triangle are known; two periods are compared.
#[test]
fn exponential_branches_come_out_for_n_of_one() {
    let scene = scene(every(Shape::Triangle { stroke: SPAN }), block(1.0));
    let plan = plan(Stepper::Event { tolerance: 1e-11 }, 2.0 * PERIOD);
    let (model, _, trace) = trace(&scene, &plan, PERIOD / 531.3);
    let (t, y) = (column(&model, &trace, "time_s"), column(&model, &trace, "lag.stroke_m"));
    let v = |t: f64| SPAN * (1.0 - (2.0 * (t / PERIOD).fract() - 1.0).abs());
    let (mut worst, mut kept) = (0.0_f64, 0.0_f64);
    for (&t, &y) in t.iter().zip(&y) {
        let turns = (2.0 * t / PERIOD).floor() as usize;
        let mut at = (0.0, 0.0);
        for k in 1..=turns {
            let to = if k % 2 == 1 { SPAN } else { 0.0 };
            at = (exponentials(at.0, at.1, to), to);
        }
        let z = exponentials(at.0, at.1, v(t));
        kept = kept.max(z.abs());
        worst = worst.max((y - (v(t) - z)).abs());
    }
    assert!(kept > 0.9 * LIMIT);
    assert!(worst < 1e-9 * SPAN, "{worst}");
    let kinds: Vec<&str> = trace.events().map(|(event, _)| event.kind.name()).collect();
    assert_eq!(kinds.iter().filter(|kind| **kind == "input turns").count(), 4, "{kinds:?}");
    assert_eq!(kinds.iter().filter(|kind| **kind == "lag turns").count(), 3, "{kinds:?}");
}

/// Integrates the Bouc–Wen equation for a sine with the Runge–Kutta method, in many steps of the phase.
fn integrated(exponent: f64, phase: f64, steps: usize) -> f64 {
    let (beta, gamma) = (SHARE * SLOPE / LIMIT.powf(exponent), (1.0 - SHARE) * SLOPE / LIMIT.powf(exponent));
    let amplitude = 0.5 * SPAN;
    let slope = |phase: f64, z: f64| {
        let dv = amplitude * phase.cos();
        SLOPE * dv - beta * dv.abs() * z.abs().powf(exponent - 1.0) * z - gamma * dv * z.abs().powf(exponent)
    };
    let h = phase / steps as f64;
    let mut z = 0.0;
    for k in 0..steps {
        let at = h * k as f64;
        let a = slope(at, z);
        let b = slope(at + 0.5 * h, z + 0.5 * h * a);
        let c = slope(at + 0.5 * h, z + 0.5 * h * b);
        let d = slope(at + h, z + h * c);
        z += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    z
}

#[test]
fn an_integration_of_its_own_agrees_for_n_of_two() {
    let sine = Shape::Sine { amplitude: 0.5 * SPAN, phase: 0.0, offset: 0.0 };
    for exponent in [1.0, 1.5, 2.0, 3.0] {
        let scene = scene(every(sine.clone()), block(exponent));
        let plan = plan(Stepper::Event { tolerance: 1e-11 }, 1.4 * PERIOD);
        let (model, _, trace) = trace(&scene, &plan, 0.2 * PERIOD);
        let (t, y) = (column(&model, &trace, "time_s"), column(&model, &trace, "lag.stroke_m"));
        for (&t, &y) in t.iter().zip(&y).skip(1) {
            let phase = std::f64::consts::TAU * t / PERIOD;
            let z = integrated(exponent, phase, 400_000);
            let off = (y - (0.5 * SPAN * phase.sin() - z)).abs();
            assert!(off < 1e-9 * SPAN, "n = {exponent}, {t}: {off}");
        }
    }
}

/// The model is rate-independent: a motion ten times as fast gives the same loop.
#[test]
fn the_time_taken_does_not_matter() {
    let rows = |period: f64| {
        let sine = Shape::Sine { amplitude: 0.5 * SPAN, phase: 0.0, offset: 0.0 };
        let scene = scene(Waveform::new(sine, Timing::every(period)).unwrap(), block(2.0));
        let plan = Plan { ..plan(Stepper::Event { tolerance: 1e-11 }, period) };
        let (model, _, trace) = trace(&scene, &plan, period / 50.0);
        column(&model, &trace, "lag.stroke_m")
    };
    let (slow, fast) = (rows(PERIOD), rows(0.1 * PERIOD));
    assert_eq!(slow.len(), fast.len());
    for (a, b) in slow.iter().zip(&fast) {
        assert!((a - b).abs() < 1e-9 * SPAN, "{a} {b}");
    }
}

/// A jump of the input has the same effect as a fast ramp.
#[test]
fn a_jump_goes_the_straight_way() {
    for exponent in [1.0, 2.0, 1.5] {
        let end = |points: &[(f64, f64)]| {
            let (model, _, trace) = trace(&scene(table(points), block(exponent)), &event(1e-3), 1e-3);
            column(&model, &trace, "lag.stroke_m").pop().unwrap()
        };
        let jump = end(&[(0.0, 0.0), (0.3, 0.6), (0.3, 0.1), (0.5, 0.4), (0.5, 0.8), (0.8, 0.7)]);
        let ramp = end(&[(0.0, 0.0), (0.3, 0.6), (0.32, 0.1), (0.5, 0.4), (0.52, 0.8), (0.8, 0.7)]);
        assert!((jump - ramp).abs() < 2e-9 * SPAN, "{exponent}: {jump} {ramp}");
    }
}

#[test]
fn laws_that_do_not_hold_are_refused() {
    assert_eq!(BoucWen::new(0.3, 1.0, 0.4, 1.0), Err(BoucWenError::Share(0.4)));
    assert_eq!(BoucWen::new(0.7, 1.0, 0.8, 1.0), Err(BoucWenError::Slope { most: 0.625, got: 0.7 }));
    assert_eq!(BoucWen::new(0.3, 0.0, 0.8, 1.0), Err(BoucWenError::Limit(0.0)));
    assert_eq!(BoucWen::new(0.3, 1.0, 0.8, 0.5), Err(BoucWenError::Exponent { got: 0.5 }));
}
