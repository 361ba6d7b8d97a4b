//! Radau IIA of order 9 compared with closed forms and published values: orders for stiff and nonstiff systems, dense output;
//! cut, resumed and rejected steps.

use crate::systems::{Forced, Oscillator, order};
use stickslip_stepper::{
    Attempt, Completion, End, Method, RADAU_ORDER, Radau, Step, StepControl, StepLimits, System, Target,
};

fn stepper<S: System>(system: &S) -> Radau {
    let n = system.dimension();
    Radau::new((n, system.positions()), system.total(), vec![1e-7; n])
}

/// With equal steps, without error control.
fn run<S: System>(system: &S, y: &[f64], t1: f64, steps: u32) -> Radau {
    let mut stepper = stepper(system);
    let scale = vec![1e-13; system.total()];
    stepper.start(system, 0.0, y);
    for i in 1..=steps {
        stepper.attempt(system, Target::even(t1 * f64::from(i) / f64::from(steps)), &scale);
        stepper.complete(system, Completion::EndSlopes);
        stepper.accept();
    }
    stepper
}

/// With error control; also returns the number of accepted steps.
fn adapt<S: System>(system: &S, y: &[f64], t1: f64, tolerance: f64) -> (Radau, u32) {
    let mut stepper = stepper(system);
    let limits = StepLimits { shrink: 0.1, ..StepLimits::default() };
    let (mut control, mut steps) = (StepControl::new(RADAU_ORDER, limits), 0);
    let scale = vec![tolerance; system.total()];
    stepper.start(system, 0.0, y);
    let mut h = stepper.first_step(system, t1, &scale);
    while stepper.span().time < t1 {
        let t = stepper.span().time;
        let end = if t + 1.001 * h > t1 { t1 } else { t + h };
        let error = stepper.attempt(system, Target::even(end), &scale);
        let verdict = control.propose(error, end - t);
        assert!(verdict.next > 1e-16, "stuck at {t}");
        if verdict.accepted {
            stepper.complete(system, Completion::EndSlopes);
            stepper.accept();
            steps += 1;
        }
        h = verdict.next;
    }
    (stepper, steps)
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn order_9_where_nothing_is_stiff() {
    // With fewer steps the simplified Newton iteration fails.
    let points = [4, 5, 6, 8].map(|n| {
        let stepper = run(&Forced, &[0.5, 1.0, 0.0], 0.9, n);
        (0.9 / f64::from(n), distance(stepper.span().begin, &Forced::exact(0.9)))
    });
    let order = order(&points);
    assert!((order - 9.0).abs() < 0.6, "{order} {points:?}");
}

/// Positions, which follow from velocities, have the same order.
#[test]
fn positions_follow_at_the_same_order() {
    let system = Oscillator { omega: 2.0 };
    let points = [2, 3, 4, 6].map(|n| {
        let stepper = run(&system, &[1.0, 0.0, 0.0, 0.0], 2.0, n);
        (2.0 / f64::from(n), distance(stepper.span().begin, &system.exact(2.0)))
    });
    let order = order(&points);
    assert!((order - 9.0).abs() < 0.6, "{order} {points:?}");
}

/// ẏ = -λ(y - cos t) - sin t with the solution cos t, and the quadrature ∫y² dt (Prothero and Robinson 1974).
struct ProtheroRobinson {
    rate: f64,
}

impl System for ProtheroRobinson {
    fn dimension(&self) -> usize {
        1
    }
    fn positions(&self) -> usize {
        0
    }
    fn total(&self) -> usize {
        2
    }
    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = -self.rate * (y[0] - t.cos()) - t.sin();
        dy[1] = y[0] * y[0];
    }
}

/// At hλ = 10⁹ the error at the end is limited by the stage order divided by λ; the quadrature has its own order.
#[test]
fn what_is_stiff_stays_on_its_solution() {
    let system = ProtheroRobinson { rate: 1e10 };
    for n in [4, 8, 16] {
        let stepper = run(&system, &[1.0, 0.0], 2.0, n);
        let end = stepper.span().begin;
        let exact = [2.0_f64.cos(), 1.0 + 0.25 * 4.0_f64.sin()];
        assert!((end[0] - exact[0]).abs() < 1e-14 && (end[1] - exact[1]).abs() < 1e-10, "{n}: {end:?}");
    }
}

/// A visit inside a step is on the solution. The dense output is off by 10⁻¹⁰, which is large for slopes at λ = 10⁷/s. Neither
/// changes the step.
#[test]
fn a_visit_inside_a_step_is_where_what_is_stiff_belongs() {
    let system = ProtheroRobinson { rate: 1e7 };
    let scale = [1e-10; 2];
    let mut stepper = stepper(&system);
    stepper.start(&system, 0.0, &[1.0, 0.0]);
    stepper.attempt(&system, Target::even(0.5), &scale);
    stepper.complete(&system, Completion::Dense);
    let (end, evaluations) = (stepper.span().end.to_vec(), stepper.evaluations());
    let slope = |t: f64, y: f64| -system.rate * (y - t.cos()) - t.sin();
    let mut dense: f64 = 0.0;
    for t in [0.02, 0.1, 0.2, 0.3, 0.45] {
        let mut at = [0.0; 2];
        assert!(stepper.visit(&system, t, &scale, &mut at));
        assert!((slope(t, at[0]) + t.sin()).abs() < 1e-6, "{t}: {at:?}");
        assert!((at[1] - (0.5 * t + 0.25 * (2.0 * t).sin())).abs() < 1e-10, "{t}: {at:?}");
        dense = dense.max((slope(t, stepper.value(0, t)) + t.sin()).abs());
    }
    assert!(dense > 1e-2, "{dense}");
    assert!(!stepper.visit(&system, 0.5, &scale, &mut [0.0; 2]), "the end is as exact");
    assert!(stepper.span().end == end && stepper.evaluations() == evaluations);
    // A step cut there has the same end.
    stepper.cut_exactly(&system, 0.3, &scale);
    let cut = stepper.span().end[0];
    assert!((slope(0.3, cut) + 0.3_f64.sin()).abs() < 1e-6 && stepper.span().end_time == 0.3);
}

/// A fast decay at 10⁹/s is resolved: its integral ∫(y-cos t)² is 1/(2λ).
#[test]
fn a_layer_is_resolved_and_left_behind() {
    let rate = 1e9;
    let system = ProtheroRobinson { rate };
    let mut before = 0;
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-11] {
        let (stepper, steps) = adapt(&system, &[2.0, 0.0], 2.0, tolerance);
        let end = stepper.span().begin;
        // y = cos t + e^{-λt}: y² contains 2 cos t e^{-λt} and e^{-2λt}, with the integrals 2λ/(λ²+1) and 1/(2λ).
        let exact = 1.0 + 0.25 * 4.0_f64.sin() + 2.0 * rate / (rate * rate + 1.0) + 0.5 / rate;
        let off = (end[0] - 2.0_f64.cos()).abs().max((end[1] - exact).abs());
        assert!(off < tolerance, "{tolerance:e}: {off:e} after {steps}");
        assert!(steps > before && steps < 500, "{tolerance:e}: {steps} after {before}");
        before = steps;
    }
}

/// Van der Pol oscillator, ẋ = v, εv̇ = (1-x²)v - x with ε = 10⁻⁶ from (2, 0). Published values at t = 2: Test Set for IVP
/// Solvers (Mazzia, Magherini, release 2.4, II-1).
#[test]
fn van_der_pol_comes_to_the_published_values() {
    struct VanDerPol;
    impl System for VanDerPol {
        fn dimension(&self) -> usize {
            2
        }
        fn positions(&self) -> usize {
            1
        }
        fn total(&self) -> usize {
            2
        }
        fn slopes(&self, _: f64, y: &[f64], dy: &mut [f64]) {
            (dy[0], dy[1]) = (y[1], ((1.0 - y[0] * y[0]) * y[1] - y[0]) * 1e6);
        }
    }
    let published = [1.706_167_732_170_483, -0.892_809_701_024_797_5];
    for (tolerance, most) in [(1e-4, 1e-3), (1e-7, 1e-6), (1e-10, 1e-9)] {
        let (stepper, steps) = adapt(&VanDerPol, &[2.0, 0.0], 2.0, tolerance);
        let off = distance(stepper.span().begin, &published);
        assert!(off < most && steps < 4000, "{tolerance:e}: {off:e} after {steps}");
    }
}

/// The dense output has order 5; a cut step continues from it.
#[test]
fn dense_output_and_steps_cut_short() {
    let system = Oscillator { omega: 1.0 };
    // From a point where no derivative vanishes.
    let (from, start) = (0.5, system.exact(0.5));
    let points = [0.8, 0.4, 0.2].map(|h| {
        let mut stepper = stepper(&system);
        stepper.start(&system, from, &start);
        stepper.attempt(&system, Target::even(from + h), &[1e-13; 4]);
        stepper.complete(&system, Completion::Dense);
        let t = from + 0.4 * h;
        let inside: Vec<f64> = (0..4).map(|i| stepper.value(i, t)).collect();
        (h, distance(&inside, &system.exact(t)))
    });
    let found = order(&points);
    assert!((found - 6.0).abs() < 0.4, "{found} {points:?}");
    let mut stepper = stepper(&system);
    stepper.start(&system, 0.0, &[1.0, 0.0, 0.0, 0.0]);
    stepper.attempt(&system, Target::even(0.4), &[1e-13; 4]);
    stepper.complete(&system, Completion::Dense);
    let there: Vec<f64> = (0..4).map(|i| stepper.value(i, 0.25)).collect();
    stepper.cut(0.25);
    stepper.complete(&system, Completion::EndSlopes);
    assert_eq!((stepper.span().end, stepper.span().end_time), (&there[..], 0.25));
    assert!((stepper.slope(1, End::End) + 0.25_f64.cos()).abs() < 1e-6);
    stepper.accept();
    stepper.attempt(&system, Target::even(0.4), &[1e-13; 4]);
    assert!(distance(stepper.span().end, &system.exact(0.4)) < 1e-7);
}

/// Rejected attempts leave no trace, and a resumed stepper has the same bits and counts.
#[test]
fn nothing_is_left_behind_and_nothing_is_forgotten() {
    let (system, scale) = (ProtheroRobinson { rate: 1e6 }, [1e-9, 1e-9]);
    let mut one = stepper(&system);
    one.start(&system, 0.0, &[2.0, 0.0]);
    one.attempt(&system, Target::even(0.5), &scale);
    one.attempt(&system, Target::even(1e-7), &scale);
    one.complete(&system, Completion::EndSlopes);
    one.accept();
    let mut other = stepper(&system);
    other.start(&system, 0.0, &[2.0, 0.0]);
    other.attempt(&system, Target::even(1e-7), &scale);
    assert_eq!(one.span().begin, other.span().end);
    one.attempt(&system, Target::even(0.5), &scale);
    let (mut slopes, spent) = (Vec::new(), one.evaluations());
    one.first_slopes(&mut slopes);
    let mut third = stepper(&system);
    third.take_up(&system, (one.span().time, one.span().begin), one.hand(), &slopes);
    let errors = [&mut one, &mut third].map(|stepper| stepper.attempt(&system, Target::even(2e-7), &scale));
    assert_eq!(errors[0], errors[1]);
    assert_eq!(one.span().end, third.span().end);
    assert_eq!(one.evaluations() - spent, third.evaluations());
}

/// Capacitor that follows a ramp through a resistance, τẏ = t - y, with its loss as a coupled component, τq̇ = (t - y)². Its
/// first Newton correction is large, which must not reject long steps. The solution approaches y = t - τ and q = τt - 3τ²/2.
struct Charged {
    time: f64,
}

impl System for Charged {
    fn dimension(&self) -> usize {
        2
    }
    fn positions(&self) -> usize {
        0
    }
    fn total(&self) -> usize {
        2
    }
    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = (t - y[0]) / self.time;
        dy[1] = (t - y[0]).powi(2) / self.time;
    }
}

#[test]
fn a_coupled_loss_does_not_shorten_steps() {
    for time in [1e-6, 1e-8, 1e-10] {
        let (stepper, steps) = adapt(&Charged { time }, &[0.0, 0.0], 1.0, 1e-9);
        let end = stepper.span().begin;
        let lost = time - 1.5 * time * time;
        assert!((end[0] - 1.0 + time).abs() < 1e-9, "{time:e}: {end:?}");
        assert!((end[1] - lost).abs() < 1e-9, "{time:e}: {end:?}");
        assert!(steps < 100, "{time:e}: {steps}");
    }
}
