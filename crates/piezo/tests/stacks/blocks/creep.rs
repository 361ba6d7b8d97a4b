//! Tests of creep against the convolution of the input with the step response.

use super::parts::{SPAN, column, plan, reading, scene, shared, table, trace};
use stickslip_drive::Stepper;
use stickslip_piezo::creep::{Creep, CreepBlock};

/// After a step up and down the stroke is the sum of two step responses, L₁[1 + γ lg(t/t₀)] within the decades.
#[test]
fn a_step_creeps_by_the_logarithm_and_back() {
    let creep = Creep::new(0.02, 1e-5, 3).unwrap();
    let points = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (9.0, 1.0), (9.0, 0.0), (20.0, 0.0)];
    let scene = scene(table(&points), vec![shared("creep", CreepBlock::new(creep.clone(), reading(0)))]);
    let plan = plan(Stepper::Event { tolerance: 1e-11 }, 15e-3);
    let (model, _, trace) = trace(&scene, &plan, 13.3e-6);
    let (t, y) = (column(&model, &trace, "time_s"), column(&model, &trace, "creep.stroke_m"));
    let (mut exact, mut log) = (0.0_f64, 0.0_f64);
    for (&t, &y) in t.iter().zip(&y) {
        let after = |since: f64| if t < since { 0.0 } else { creep.response(t - since) };
        exact = exact.max((y / SPAN - after(1e-3) + after(9e-3)).abs());
        if (1.01e-3..9e-3).contains(&t) {
            log = log.max((y / SPAN - 1.0 - 0.02 * ((t - 1e-3) / 1e-5).log10()).abs());
        }
    }
    assert!(exact < 1e-9, "{exact}");
    assert!(log < 2e-4, "{log}");
}

/// The response to a ramp is the integral of the step response, ∫₀ᵗ L(s) ds/T = (a t + Σ gᵢ[t - τᵢ(1 - e^{-t/τᵢ})])/T.
#[test]
fn a_ramp_is_the_integral_of_steps() {
    let creep = Creep::new(0.015, 1e-4, 2).unwrap();
    let scene = scene(
        table(&[(0.0, 0.0), (10.0, 1.0)]),
        vec![shared("creep", CreepBlock::new(creep.clone(), reading(0)))],
    );
    let plan = plan(Stepper::Event { tolerance: 1e-11 }, 10e-3);
    let (model, _, trace) = trace(&scene, &plan, 0.1e-3);
    let (t, y) = (column(&model, &trace, "time_s"), column(&model, &trace, "foot.x_m"));
    let v = column(&model, &trace, "foot.vx_m_s");
    for ((&t, &y), &v) in t.iter().zip(&y).zip(&v) {
        let crept = creep.times().iter().zip(creep.weights());
        let sum: f64 = crept.map(|(time, weight)| weight * (t + time * (-t / time).exp_m1())).sum();
        let exact = SPAN / 10e-3 * (creep.direct() * t + sum);
        assert!((y - exact).abs() < 1e-9 * SPAN, "{t}: {y} {exact}");
        assert!((v - SPAN / 10e-3 * creep.response(t)).abs() < 1e-9 * SPAN / 1e-3, "{t}: {v}");
    }
}
