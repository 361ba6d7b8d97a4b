//! Tests of the longest stable step of a driver: slightly shorter steps are stable, longer ones are not.

use super::parts::{FARADS, ideal, low, named, plan, ran, scene, table};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;
use std::sync::Arc;
use stickslip_drive::component::{Block, SharedBlock};
use stickslip_drive::{Model, Stepper};
use stickslip_piezo::Reading;
use stickslip_piezo::creep::{Creep, CreepBlock};
use stickslip_piezo::driver::Spec;
use stickslip_piezo::hysteresis::{BoucWen, BoucWenBlock};
use stickslip_stepper::{Rk4, Stepping, System, Verlet};

/// Linear system y' = A y.
struct Linear(DMatrix<f64>);

impl System for Linear {
    fn dimension(&self) -> usize {
        self.0.nrows()
    }
    fn positions(&self) -> usize {
        0
    }
    fn total(&self) -> usize {
        self.0.nrows()
    }
    fn slopes(&self, _: f64, y: &[f64], slopes: &mut [f64]) {
        slopes.copy_from_slice((&self.0 * DVector::from_column_slice(y)).as_slice());
    }
}

/// Norm of y after many steps from 1; infinite after an overflow.
fn late(system: &Linear, stepper: Stepper) -> f64 {
    let n = system.dimension();
    let mut y = vec![1.0; n];
    let (mut verlet, mut rk4) = (Verlet::new(0, n, n), Rk4::new(n, n));
    for _ in 0..20_000 {
        match stepper {
            Stepper::Verlet { step } => verlet.step(system, 0.0, &mut y, step),
            Stepper::Rk4 { step } => rk4.step(system, 0.0, &mut y, step),
            _ => unreachable!("fixed steps"),
        }
    }
    let size = y.iter().map(|y| y.abs()).sum::<f64>();
    if size.is_finite() { size } else { f64::INFINITY }
}

const STEPPERS: [fn(f64) -> Stepper; 2] = [|step| Stepper::Verlet { step }, |step| Stepper::Rk4 { step }];
/// Rise to 100 V within 2 µs.
const STEP: &[(f64, f64)] = &[(0.0, 0.0), (0.05, 0.0), (0.052, 100.0), (9.0, 100.0)];

fn of(spec: Spec) -> Model {
    Model::new(&scene(table(STEP), spec)).unwrap()
}

fn resistive(resistance: f64) -> Spec {
    Spec { resistance: Some(resistance), ..ideal() }
}

/// Compares the driver with the equivalent linear system. At 2 % below the longest stable step the voltage is steady. At 2 % above,
/// the linear system is unstable and the model rejects the step.
fn judged(spec: Spec, system: &Linear) {
    let model = of(spec);
    for stepper in STEPPERS {
        let longest = model.longest_step(stepper(1.0)).unwrap();
        let (below, above) = (stepper(0.98 * longest), stepper(1.02 * longest));
        assert!(late(system, below) < 10.0 * late(system, stepper(0.1 * longest)).max(1.0), "{below:?}");
        assert!(late(system, above) > 1e6, "{above:?}");
        let ran = ran(&scene(table(STEP), spec), &plan(below, 4e-3), 1.0);
        let end = ran.volts().last().unwrap().1;
        // With light damping some oscillation remains.
        assert!((end - 100.0).abs() < 1e-3, "{below:?}: {end}");
        assert!(model.start(&plan(above, 4e-3)).is_err(), "{above:?}");
    }
}

/// Longest stable step with a time constant RC. Verlet treats states of first order as Adams–Bashforth does, with the limit h/RC = 1.
/// For Runge–Kutta the limit is 2.785293563405282, from the real root of 1 + z/2 + z²/6 + z³/24.
#[test]
fn a_resistance_bounds_the_step_by_its_time_constant() {
    for resistance in [2.0, 0.04] {
        let time = resistance * FARADS;
        let model = of(resistive(resistance));
        for (stepper, share) in STEPPERS.into_iter().zip([1.0, 2.785_293_563_405_282]) {
            let longest = model.longest_step(stepper(1.0)).unwrap();
            assert!((longest / (share * time) - 1.0).abs() < 1e-9, "{longest} {share}");
        }
    }
    judged(resistive(2.0), &Linear(DMatrix::from_element(1, 1, -1.0 / (2.0 * FARADS))));
}

#[test]
fn a_bandwidth_bounds_the_step_by_its_frequency_and_damping() {
    for ratio in [0.1, 0.5_f64.sqrt(), 1.0, 3.0] {
        let omega = TAU * 50e3;
        // States f and ḟ/ω.
        let matrix = DMatrix::from_row_slice(2, 2, &[0.0, omega, -omega, -2.0 * ratio * omega]);
        judged(low(50e3, ratio), &Linear(matrix));
    }
    // With a resistance behind the low-pass, the faster of both determines the limit.
    let both = Spec { resistance: Some(0.5), ..low(50e3, 0.5) };
    let longest = of(both).longest_step(Stepper::Rk4 { step: 1.0 }).unwrap();
    assert!((longest / (2.785_293_563_405_282 * 0.5 * FARADS) - 1.0).abs() < 1e-9, "{longest}");
}

/// The stepper for frames chooses stable steps for a stiff driver.
#[test]
fn frames_follow_a_driver_faster_than_the_bodies() {
    let spec = resistive(0.5);
    let frames = Stepper::Frames { length: 100e-6, accuracy: 1e-3 };
    let substeps = of(spec).substeps(100e-6, 1e-3);
    // (120·10⁻³)^{1/5} RC.
    let expected = (100e-6 / (0.12_f64.powf(0.2) * 0.5 * FARADS)).ceil();
    assert_eq!(substeps, expected);
    let ran = ran(&scene(table(STEP), spec), &plan(frames, 4e-3), 1.0);
    let end = ran.volts().last().unwrap().1;
    assert!((end - 100.0).abs() < 1e-6, "{end}");
}

/// The eigenvalues of creep are -1/τ, those of its inverse the roots of a + Σ g/(1 + λτ) = 0. For Bouc–Wen the eigenvalue is -n A/z_m
/// |v̇|.
#[test]
fn ceramics_tell_how_fast_their_states_settle() {
    let law = Creep::new(0.02, 0.1, 3).unwrap();
    let reading = Reading { signal: 0, span: 2e-6, swings: 500.0, turns: 900.0, column: "stroke_m" };
    let forward = sorted(&CreepBlock::new(law.clone(), reading));
    let mut times = law.times().to_vec();
    times.sort_by(f64::total_cmp);
    assert_eq!(forward.len(), times.len());
    for (rate, time) in forward.iter().zip(&times) {
        assert!((rate * time + 1.0).abs() < 1e-9, "{rate} {time}");
    }
    for rate in sorted(&CreepBlock::inverse(law.clone(), reading)) {
        let terms = law.weights().iter().zip(law.times()).map(|(g, time)| g / (1.0 + rate * time));
        let (sum, size) = terms.fold((law.direct(), law.direct()), |(s, z), x| (s + x, z + x.abs()));
        assert!(sum.abs() < 1e-7 * size, "{rate}: {sum} of {size}");
    }
    let bouc_wen = BoucWenBlock::new(BoucWen::new(0.3, 0.2e-6, 0.6, 2.0).unwrap(), reading);
    let (rate, swing) = bouc_wen.eigenvalues(&[])[0];
    assert!(
        (rate + 2.0 * 0.3 / 0.2e-6 * 2e-6 * 0.25 * 900.0).abs() < 1e-9 * rate.abs() && swing == 0.0,
        "{rate}"
    );
    // In a complete drive.
    let mut drive = scene(table(STEP), ideal());
    drive.blocks.push(named("lag", SharedBlock(Arc::new(bouc_wen))));
    let longest = Model::new(&drive).unwrap().longest_step(Stepper::Verlet { step: 1.0 }).unwrap();
    assert!(longest <= -1.0 / rate, "{longest}");
}

/// Real parts of the eigenvalues, the fastest first.
fn sorted(block: &CreepBlock) -> Vec<f64> {
    let first = stickslip_drive::Sample { value: 0.0, rate: 0.0, acceleration: 0.0 };
    let mut rates: Vec<f64> = block.eigenvalues(&[first]).iter().map(|(rate, _)| *rate).collect();
    rates.sort_by(f64::total_cmp);
    rates
}
