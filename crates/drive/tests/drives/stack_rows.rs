//! Both engines for a foot on a piezo stack: P1's contact and sawtooth, a foot of 5 g on 20 N/µm with 20 N s/m, a slider of 20 g
//! against 20 mN. The engines are independent of each other.

use crate::parts::{column, event, free, p1, piezo, push, trace};
use stickslip_drive::scene::{Actuator, EngineChoice, Side, Varying};

/// Positions of the slider in ten periods.
fn way(engine: EngineChoice, tolerance: f64) -> Vec<f64> {
    let mut scene = p1();
    scene.bodies[0].part = free(5e-3);
    let stack = piezo([Side::Ground, Side::Body(0)], 20e6, Varying::Follows(0));
    scene.actuators.push(crate::parts::named("stack", Actuator { damping: 20.0, ..stack }));
    scene.loads.push(push(1, -0.02));
    scene.contacts[0].part.engine = engine;
    let (model, _, trace) = trace(&scene, &event(tolerance, 10e-3), 50e-6);
    column(&model, &trace, "slider.x_m")
}

/// Largest difference of two motions, relative to the end of the first.
fn apart(first: &[f64], second: &[f64]) -> f64 {
    assert_eq!(first.len(), second.len());
    let distances = first.iter().zip(second).map(|(a, b)| (a - b).abs());
    distances.fold(0.0, f64::max) / first[first.len() - 1]
}

/// They agree to 1e-5 with 256 springs, and to a tenth of that with four times as many.
#[test]
fn curve_and_row_agree_and_the_row_comes_closer_with_its_springs() {
    let curve = way(EngineChoice::Curve, 1e-10);
    assert!(curve[curve.len() - 1] > 4e-6, "it walks");
    let misses =
        [256, 1024].map(|count| apart(&curve, &way(EngineChoice::Springs { count, span: None }, 1e-10)));
    println!("row less curve, of the way: {misses:?}");
    assert!(misses[0] < 1e-5 && misses[1] < 0.15 * misses[0], "{misses:?}");
}

#[test]
fn its_way_converges_with_the_tolerance() {
    let exact = way(EngineChoice::Curve, 1e-12);
    let misses = [1e-7, 1e-9].map(|tolerance| apart(&exact, &way(EngineChoice::Curve, tolerance)));
    println!("1e-7 and 1e-9 less 1e-12, of the way: {misses:?}");
    assert!(misses[1] < 1e-9, "{misses:?}");
}
