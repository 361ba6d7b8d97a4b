//! Fixed steps against closed forms.

use crate::systems::{Driven, Forced, Oscillator, order};
use stickslip_stepper::{FixedStep, Rk4, Stepping, System, Verlet};

fn rk4<S: System>(system: &S, mut y: Vec<f64>, t1: f64, steps: u32) -> Vec<f64> {
    let mut stepper = Rk4::sized(system.positions(), system.dimension(), system.total());
    let h = t1 / f64::from(steps);
    for i in 0..steps {
        stepper.step(system, f64::from(i) * h, &mut y, h);
    }
    assert_eq!(stepper.evaluations(), 4 * u64::from(steps));
    y
}

fn verlet<S: System>(system: &S, mut y: Vec<f64>, t1: f64, steps: u32) -> Vec<f64> {
    let mut stepper = Verlet::sized(system.positions(), system.dimension(), system.total());
    let h = t1 / f64::from(steps);
    for i in 0..steps {
        stepper.step(system, f64::from(i) * h, &mut y, h);
    }
    assert_eq!(stepper.evaluations(), u64::from(steps) + 1);
    y
}

#[test]
fn rk4_has_order_4_also_in_quadratures() {
    for i in 0..3 {
        let points = [20, 40, 80, 160].map(|n| {
            let y = rk4(&Forced, vec![0.5, 1.0, 0.0], 1.2, n);
            (1.2 / f64::from(n), (y[i] - Forced::exact(1.2)[i]).abs())
        });
        let order = order(&points);
        assert!((order - 4.0).abs() < 0.4, "component {i}: {order} {points:?}");
    }
}

#[test]
fn verlet_has_order_2_under_damping_and_drive() {
    for i in 0..2 {
        let points = [100, 200, 400, 800].map(|n| {
            let y = verlet(&Driven, vec![0.0; 4], 7.0, n);
            (7.0 / f64::from(n), (y[i] - Driven::exact(7.0)[i]).abs())
        });
        let order = order(&points);
        assert!((order - 2.0).abs() < 0.2, "component {i}: {order} {points:?}");
    }
}

#[test]
fn verlet_carries_further_components_and_quadratures_at_order_2() {
    // Compared with RK4 at a step whose error is a million times smaller.
    let exact = rk4(&Driven, vec![0.0; 4], 7.0, 4000);
    for i in 2..4 {
        let points = [100, 200, 400, 800].map(|n| {
            let y = verlet(&Driven, vec![0.0; 4], 7.0, n);
            (7.0 / f64::from(n), (y[i] - exact[i]).abs())
        });
        let order = order(&points);
        assert!((order - 2.0).abs() < 0.2, "component {i}: {order} {points:?}");
    }
}

#[test]
fn verlet_conserves_its_own_energy() {
    // Closed form: for ẍ = -x velocity Verlet conserves v² + (1 - h²/4) x² exactly.
    let (mut stepper, mut y, h) = (Verlet::new(1, 2, 4), vec![1.0, 0.0, 0.0, 0.0], 0.1);
    let system = Oscillator { omega: 1.0 };
    let invariant = |y: &[f64]| y[1] * y[1] + (1.0 - 0.25 * h * h) * y[0] * y[0];
    let start = invariant(&y);
    for i in 0..100_000 {
        stepper.step(&system, f64::from(i) * h, &mut y, h);
    }
    assert!((invariant(&y) - start).abs() < 1e-11);
}

#[test]
fn verlet_saved_slopes_go_on_bit_for_bit() {
    let mut one = Verlet::new(1, 3, 4);
    let mut y = vec![0.0; 4];
    one.step(&Driven, 0.0, &mut y, 0.01);
    let (mut two, mut z) = (Verlet::new(1, 3, 4), y.clone());
    two.keep(one.kept().unwrap());
    one.step(&Driven, 0.01, &mut y, 0.01);
    two.step(&Driven, 0.01, &mut z, 0.01);
    assert_eq!(y, z);
    assert_eq!(one.evaluations(), 3);
    one.restart();
    assert!(one.kept().is_none());
    one.step(&Driven, 0.02, &mut y, 0.01);
    assert_eq!(one.evaluations(), 5);
}
