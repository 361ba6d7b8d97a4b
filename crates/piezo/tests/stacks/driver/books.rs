//! Tests of the driver's energy balance and totals, and of runs that are interrupted during a current limit.

use super::parts::{FARADS, GAIN, event, every, ideal, low, ran, scene, table};
use std::f64::consts::TAU;
use stickslip_drive::scene::Scene;
use stickslip_drive::{Limits, Model, Plan, Run, RunError, Shape, State, Stepper};
use stickslip_piezo::driver::Spec;

const KEY: [u8; 32] = [7; 32];

fn saw(spec: Spec) -> Scene {
    scene(every(Shape::Sawtooth { stroke: GAIN * 100.0, flyback: 20e-6 }), spec)
}

fn slow() -> Spec {
    Spec { current: Some((0.2, 0.2)), ..ideal() }
}

/// source - lost is the change of ½CV², with and without limits.
#[test]
fn source_store_and_loss_add_up() {
    let filtered = Spec { current: Some((0.2, 0.3)), resistance: Some(20.0), ..low(2e4, 0.6) };
    for spec in [slow(), filtered, Spec { resistance: Some(50.0), ..ideal() }, low(1e4, 0.7)] {
        let ran = ran(&saw(spec), &event(1e-10, 3e-3), 7e-6);
        let [source, stored, lost] =
            ["source", "stored", "lost"].map(|name| ran.column(&format!("stack.{name}_J")));
        let through = lost.iter().chain(&stored).fold(0.0, |most: f64, x| most.max(x.abs()));
        let open =
            source.iter().zip(&stored).zip(&lost).map(|((source, stored), lost)| source - stored - lost);
        let open = open.fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!(through > 0.5 * FARADS * 90.0_f64.powi(2), "{spec:?}: {through}");
        assert!(open < 1e-8 * through, "{spec:?}: {open} of {through}");
        // The mechanical energy balance is separate.
        let [error, input] = ["error", "input"].map(|name| ran.column(&format!("energy.{name}_J")));
        let through = input.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let open = error.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!(open < 1e-8 * through, "{spec:?}: {open} of {through}");
    }
}

/// For a step of 100 V through R the source supplies C·V²; half is stored, half lost.
#[test]
fn half_of_what_a_step_takes_is_lost() {
    let step = table(&[(0.0, 0.0), (1.0, 0.0), (1.0, 100.0), (99.0, 100.0)]);
    let spec = Spec { resistance: Some(100.0), ..ideal() };
    let ran = ran(&scene(step, spec), &event(1e-10, 9e-3), 9e-3);
    let last = |name: &str| ran.column(name).pop().unwrap();
    let whole = FARADS * 1e4;
    assert!((last("stack.source_J") / whole - 1.0).abs() < 1e-9);
    assert!((last("stack.lost_J") / whole - 0.5).abs() < 1e-9);
}

/// A run resumed after any number of steps has identical bits, also if it was interrupted during a current limit.
#[test]
fn a_run_taken_up_in_saturation_goes_on_to_the_same_bits() {
    let frames = Stepper::Frames { length: 7e-6, accuracy: 1e-3 };
    let mut falling = 0;
    for stepper in [Stepper::Event { tolerance: 1e-9 }, Stepper::Rk4 { step: 1e-6 }, frames] {
        let scene = saw(slow());
        let whole = super::parts::plan(stepper, 3e-3);
        let model = Model::new(&scene).unwrap();
        let start = model.start(&whole).unwrap();
        let mut run = Run::new(&model, &whole, start.clone()).unwrap();
        run.finish(&mut ()).unwrap();
        let end = run.into_state();
        for part in 1..20 {
            let steps = part * (end.counts().steps + end.counts().rejected) / 20;
            let short = Plan { limits: Limits { steps, ..whole.limits }, ..whole };
            let mut first = Run::new(&model, &short, start.clone()).unwrap();
            assert!(matches!(first.approach(&mut ()), Err(RunError::TooManySteps { .. })));
            let bytes = first.state().to_bytes(&model, &KEY);
            let state = State::from_bytes(&model, &KEY, &bytes).unwrap();
            // The voltage falls from 0.98 ms to 1.22 ms, and again one period later.
            falling += u32::from(
                (0.98e-3..1.2e-3)
                    .contains(&(state.time() % 1e-3 + if state.time() % 1e-3 < 0.5e-3 { 1e-3 } else { 0.0 })),
            );
            let mut rest = Run::resume(&model, &whole, state).unwrap();
            rest.finish(&mut ()).unwrap();
            assert!(rest.into_state() == end, "{stepper:?} after {steps} steps");
        }
    }
    assert!(falling > 5, "{falling}");
}

/// A driver with a window only transmits jumps: from 0 V to the limit of 80 V and down to 20 V. The source supplies ½C(V₂² - V₁²).
/// The instantaneous current is not reported.
#[test]
fn a_jump_that_is_passed_on_is_in_the_books() {
    let step = table(&[(0.0, 0.0), (1.0, 0.0), (1.0, 100.0), (3.0, 100.0), (3.0, 20.0), (99.0, 20.0)]);
    let spec = Spec { window: Some((0.0, 80.0)), ..ideal() };
    for stepper in [Stepper::Event { tolerance: 1e-9 }, Stepper::Frames { length: 20e-6, accuracy: 1e-3 }] {
        let ran = ran(&scene(step.clone(), spec), &super::parts::plan(stepper, 4e-3), 0.5e-3);
        let source = ran.column("stack.source_J");
        for ((t, volts), source) in ran.volts().into_iter().zip(source) {
            // A row at the time of the jump may have either value.
            if t != 1e-3 && t != 3e-3 {
                let at = if t < 1e-3 {
                    0.0
                } else if t < 3e-3 {
                    80.0
                } else {
                    20.0
                };
                assert!((volts - at).abs() < 1e-9, "{stepper:?}: {volts} V at {t}");
                assert!((source - 0.5 * FARADS * at * at).abs() < 1e-12, "{stepper:?}: {source} J at {t}");
            }
        }
        assert_eq!(ran.figures(&spec).peak_current, 0.0);
    }
}

/// Sawtooth with a resistance: on a flank of slope g, V = f - gRC + Ke^{-t/RC} reverses at t = RC ln(K/gRC). Closed forms follow for
/// the travel of V, the energy drawn and the largest current.
#[test]
fn what_flows_back_within_a_step_is_told_apart() {
    const PERIODS: usize = 5;
    for resistance in [30.0, 100.0, 300.0, 1000.0] {
        let (spec, time) = (Spec { resistance: Some(resistance), ..ideal() }, resistance * FARADS);
        let (mut v, mut way, mut drawn, mut peak) = (0.0, 0.0, 0.0, 0.0_f64);
        for (lasts, f, g) in [(0.9e-3, 0.0, 100.0 / 0.9e-3), (0.1e-3, 100.0, -1e6)].repeat(PERIODS) {
            let k: f64 = v - f + g * time;
            let fading = |t: f64| k * (-t / time).exp();
            let volts = |t: f64| f + g * (t - time) + fading(t);
            let given = |t: f64| FARADS * (g * t * (f + 0.5 * g * t) + fading(t) * (f + g * (t + time)));
            let turn = time * (k / (g * time)).ln();
            let turn = if turn > 0.0 && turn < lasts { turn } else { lasts };
            for (from, to) in [(0.0, turn), (turn, lasts)] {
                way += (volts(to) - volts(from)).abs();
                drawn += f64::max(given(to) - given(from), 0.0);
            }
            peak =
                [0.0, lasts].map(|t| FARADS * (g - fading(t) / time).abs()).into_iter().fold(peak, f64::max);
            v = volts(lasts);
        }
        for (tolerance, allowed) in [(1e-3, 3e-3), (1e-6, 1e-4), (1e-10, 5e-6)] {
            let saw = every(Shape::Sawtooth { stroke: GAIN * 100.0, flyback: 0.1e-3 });
            let ran = ran(&scene(saw, spec), &event(tolerance, 1e-3 * PERIODS as f64), 1e-3);
            let told = ran.figures(&spec);
            let mean = FARADS * way / (1e-3 * PERIODS as f64);
            let off = [told.mean_current / mean, told.drawn / drawn, told.peak_current / peak];
            let off = off.map(|it| (it - 1.0).abs());
            assert!(off.iter().all(|off| *off < allowed), "{resistance} Ω at {tolerance:e}: {off:?}");
        }
    }
}

/// Immediately after a jump of the command the current is V/R, or the current limit.
#[test]
fn after_a_jump_the_current_is_that_of_the_resistance() {
    for (resistance, limit, peak) in
        [(30.0, None, 100.0 / 30.0), (3000.0, None, 1.0 / 30.0), (30.0, Some(2.0), 2.0)]
    {
        let spec = Spec { resistance: Some(resistance), current: limit.map(|i| (i, i)), ..ideal() };
        for tolerance in [1e-3, 1e-8] {
            let jump = table(&[(0.0, 0.0), (1.0, 0.0), (1.0, 100.0), (9.0, 100.0)]);
            let told = ran(&scene(jump, spec), &event(tolerance, 4e-3), 1e-3).figures(&spec);
            let off = told.peak_current / peak - 1.0;
            assert!(off.abs() < 1e-12, "{resistance} Ω, {limit:?}: {off:e}");
        }
    }
}

/// A voltage that follows a sine has the largest current Câω and the charge 4Câ per period.
#[test]
fn a_sine_draws_by_its_capacitance() {
    let sine = every(Shape::Sine { amplitude: GAIN * 50.0, phase: 0.0, offset: 0.0 });
    for (tolerance, allowed) in [(1e-3, 1e-5), (1e-6, 1e-6), (1e-9, 1e-6)] {
        let ran = ran(&scene(sine.clone(), ideal()), &event(tolerance, 5e-3), 1e-3);
        let told = ran.figures(&ideal());
        let off =
            [told.peak_current / (FARADS * 50.0 * TAU * 1e3), told.mean_current / (FARADS * 200.0 * 1e3)];
        let off = off.map(|it| (it - 1.0).abs());
        assert!(off.iter().all(|off| *off < allowed), "at {tolerance:e}: {off:?}");
    }
}
