//! DOP853 compared with closed forms: orders, dense output, error estimate, repeated steps.

use crate::systems::{Forced, Kepler, Oscillator, order};
use stickslip_stepper::{
    Attempt, Completion, DormandPrince, End, Grade, Method, Step, StepControl, StepLimits, System, Target,
};

fn run<S: System>(system: &S, y: &[f64], t1: f64, steps: u32) -> DormandPrince {
    let mut stepper = DormandPrince::new(system.dimension(), system.total());
    let scale = vec![1.0; system.dimension()];
    stepper.start(system, 0.0, y);
    for i in 1..=steps {
        stepper.attempt(system, Target::even(t1 * f64::from(i) / f64::from(steps)), &scale);
        stepper.complete(system, Completion::EndSlopes);
        stepper.accept();
    }
    stepper
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn order_8_on_a_nonlinear_system_with_time() {
    let points = [8, 10, 12, 16, 20].map(|n| {
        let stepper = run(&Forced, &[0.5, 1.0, 0.0], 0.9, n);
        (0.9 / f64::from(n), distance(stepper.span().begin, &Forced::exact(0.9)))
    });
    let order = order(&points);
    assert!((order - 8.0).abs() < 0.4, "{order} {points:?}");
    // Error of SciPy 1.17 for the same eight steps, to rounding.
    assert!((points[0].1 - 2.728_549_6e-10).abs() < 1e-14, "{points:?}");
}

#[test]
fn a_step_cut_short_ends_on_the_dense_output_and_goes_on_from_there() {
    let system = Oscillator { omega: 1.0 };
    let mut stepper = DormandPrince::new(2, 4);
    stepper.start(&system, 0.0, &[1.0, 0.0, 0.0, 0.0]);
    stepper.attempt(&system, Target::even(0.4), &[1.0, 1.0]);
    let whole = stepper.span().end.to_vec();
    stepper.cut(0.25);
    assert_eq!(stepper.span().end, whole, "nothing happens without dense output");
    stepper.complete(&system, Completion::Dense);
    let there: Vec<f64> = (0..4).map(|i| stepper.value(i, 0.25)).collect();
    stepper.cut(0.25);
    assert_eq!((stepper.span().end, stepper.span().end_time), (&there[..], 0.25));
    // Dense output of order 7 over a step of 0.4.
    assert!(distance(stepper.span().end, &system.exact(0.25)) < 1e-9);
    // At the new end of a cut step.
    let end: Vec<f64> = (0..4).map(|i| stepper.value(i, 0.25)).collect();
    assert_eq!(end, there);
    stepper.accept();
    assert_eq!((stepper.span().begin, stepper.span().time), (&there[..], 0.25));
    stepper.attempt(&system, Target::even(0.4), &[1.0, 1.0]);
    assert!(distance(stepper.span().end, &system.exact(0.4)) < 1e-9);
}

#[test]
fn order_8_in_each_component_and_in_quadratures() {
    let system = Oscillator { omega: 1.0 };
    for i in 0..4 {
        let points = [14, 18, 22, 28].map(|n| {
            let stepper = run(&system, &[1.0, 0.0, 0.0, 0.0], 7.0, n);
            (7.0 / f64::from(n), (stepper.span().begin[i] - system.exact(7.0)[i]).abs())
        });
        let order = order(&points);
        assert!((order - 8.0).abs() < 0.4, "component {i}: {order} {points:?}");
    }
}

/// Largest error of the dense output and of its derivative over one step from t = 0.4.
fn dense_errors(h: f64) -> [f64; 2] {
    let mut stepper = DormandPrince::new(2, 3);
    stepper.start(&Forced, 0.4, &Forced::exact(0.4));
    stepper.attempt(&Forced, Target::even(0.4 + h), &[1.0; 2]);
    stepper.complete(&Forced, Completion::Dense);
    let (mut value, mut rate) = (0.0_f64, 0.0_f64);
    for j in 1..40 {
        let t = 0.4 + h * f64::from(j) / 40.0;
        let exact = Forced::exact(t);
        let mut all = [0.0; 3];
        stepper.values(t, &mut all);
        let mut slopes = [0.0; 3];
        Forced.slopes(t, &exact[..2], &mut slopes);
        for i in 0..3 {
            assert_eq!(all[i], stepper.value(i, t));
            value = value.max((all[i] - exact[i]).abs());
            rate = rate.max((stepper.rate(i, t) - slopes[i]).abs());
        }
    }
    [value, rate]
}

#[test]
fn dense_output_has_order_7_and_its_rate_6() {
    // The error inside a step is of order h⁸, that of its derivative of order h⁷.
    let steps = [0.12, 0.1, 0.08, 0.06];
    for (which, expected) in [(0, 8.0), (1, 7.0)] {
        let points = steps.map(|h| (h, dense_errors(h)[which]));
        let order = order(&points);
        assert!((order - expected).abs() < 0.5, "{which}: {order}");
    }
}

#[test]
fn dense_output_meets_both_ends_with_their_slopes() {
    let system = Oscillator { omega: 2.0 };
    let mut stepper = DormandPrince::new(2, 4);
    stepper.start(&system, 3.0, &system.exact(3.0));
    stepper.attempt(&system, Target::even(3.25), &[1.0; 2]);
    assert!(stepper.value(0, 3.1).is_nan());
    stepper.complete(&system, Completion::Dense);
    for i in 0..4 {
        assert_eq!(stepper.value(i, 3.0), stepper.span().begin[i]);
        assert!((stepper.value(i, 3.25) - stepper.span().end[i]).abs() <= 2.0 * f64::EPSILON);
        assert!((stepper.rate(i, 3.0) - stepper.slope(i, End::Start)).abs() < 1e-13);
        assert!((stepper.rate(i, 3.25) - stepper.slope(i, End::End)).abs() < 1e-13);
    }
}

#[test]
fn error_falls_with_the_eighth_power_and_bounds_the_true_one() {
    let points = [0.5, 0.4, 0.3, 0.2].map(|h| {
        let mut stepper = DormandPrince::new(2, 3);
        stepper.start(&Forced, 0.0, &Forced::exact(0.0));
        let error = stepper.attempt(&Forced, Target::even(h), &[1e-6; 2]);
        let truth = distance(&stepper.span().end[..2], &Forced::exact(h)[..2]) / 1e-6;
        assert!(error > truth, "{h}: {error} {truth}");
        (h, error)
    });
    let order = order(&points);
    assert!((7.0..10.0).contains(&order), "{order} {points:?}");
}

#[test]
fn counts_evaluations_and_forgets_trials() {
    let system = Oscillator { omega: 1.0 };
    let mut stepper = DormandPrince::new(2, 4);
    stepper.start(&system, 0.0, &[1.0, 0.0, 0.0, 0.0]);
    assert_eq!(stepper.evaluations(), 1);
    stepper.attempt(&system, Target::even(0.9), &[1.0; 2]);
    stepper.complete(&system, Completion::Dense);
    stepper.complete(&system, Completion::Dense);
    assert_eq!(stepper.evaluations(), 1 + 11 + 4);
    stepper.attempt(&system, Target::even(0.3), &[1.0; 2]);
    stepper.complete(&system, Completion::EndSlopes);
    stepper.accept();
    assert_eq!(stepper.evaluations(), 16 + 12);
    stepper.attempt(&system, Target::even(0.6), &[1.0; 2]);
    assert_eq!(stepper.evaluations(), 28 + 11);
    // Identical bits without the trial.
    let mut direct = DormandPrince::new(2, 4);
    direct.start(&system, 0.0, &[1.0, 0.0, 0.0, 0.0]);
    direct.attempt(&system, Target::even(0.3), &[1.0; 2]);
    direct.complete(&system, Completion::EndSlopes);
    direct.accept();
    direct.attempt(&system, Target::even(0.6), &[1.0; 2]);
    assert_eq!(direct.span().end, stepper.span().end);
}

#[test]
fn a_step_without_end_slopes_evaluates_them_when_due() {
    let system = Oscillator { omega: 1.0 };
    let mut stepper = DormandPrince::new(2, 4);
    stepper.start(&system, 0.0, &[1.0, 0.0, 0.0, 0.0]);
    stepper.attempt(&system, Target::even(0.3), &[1.0; 2]);
    stepper.accept();
    assert!(stepper.slope(0, End::Start).is_nan());
    stepper.attempt(&system, Target::even(0.6), &[1.0; 2]);
    assert_eq!(stepper.evaluations(), 1 + 11 + 1 + 11);
    assert!(distance(stepper.span().end, &system.exact(0.6)) < 1e-10);
}

#[test]
fn what_is_not_finite_is_an_infinite_error() {
    struct Wall;
    impl System for Wall {
        fn dimension(&self) -> usize {
            1
        }
        fn positions(&self) -> usize {
            0
        }
        fn total(&self) -> usize {
            2
        }
        fn slopes(&self, t: f64, _y: &[f64], dy: &mut [f64]) {
            dy[0] = 1.0;
            dy[1] = if t > 0.5 { f64::NAN } else { 1.0 };
        }
    }
    let mut stepper = DormandPrince::new(1, 2);
    stepper.start(&Wall, 0.0, &[0.0; 2]);
    assert_eq!(stepper.attempt(&Wall, Target::even(1.0), &[1.0]), f64::INFINITY);
    assert!(stepper.attempt(&Wall, Target::even(0.5), &[1.0]) < 1e-12);
    let mut stepper = DormandPrince::new(2, 4);
    let system = Oscillator { omega: f64::MAX };
    stepper.start(&system, 0.0, &[1.0, 0.0, 0.0, 0.0]);
    assert_eq!(stepper.attempt(&system, Target::even(1.0), &[1.0; 2]), f64::INFINITY);
}

#[test]
fn ends_at_the_time_asked_for_to_the_last_bit() {
    let system = Oscillator { omega: 1.0 };
    let mut stepper = DormandPrince::new(2, 4);
    stepper.start(&system, 0.1 + 0.2, &[1.0, 0.0, 0.0, 0.0]);
    let corner = 1.0 / 3.0 * 7.0;
    stepper.attempt(&system, Target::even(corner), &[1.0; 2]);
    assert_eq!(stepper.span().end_time, corner);
    stepper.accept();
    assert_eq!(stepper.span().time, corner);
}

#[test]
fn kepler_under_control_keeps_its_tolerance() {
    let system = Kepler { e: 0.6 };
    let t1 = 3.0 * std::f64::consts::TAU;
    for (tolerance, most) in [(1e-6, 900), (1e-9, 1_800), (1e-12, 3_200)] {
        let mut stepper = DormandPrince::new(4, 4);
        let mut control = StepControl::new(8, StepLimits::default());
        stepper.start(&system, 0.0, &system.start());
        let scale = [tolerance; 4];
        let mut h = stepper.first_step(&system, t1, &scale);
        while stepper.span().time < t1 {
            let end = (stepper.span().time + h).min(t1);
            let error = stepper.attempt(&system, Target::even(end), &scale);
            let verdict = control.propose(error, end - stepper.span().time);
            if verdict.accepted {
                stepper.complete(&system, Completion::EndSlopes);
                stepper.accept();
            }
            h = verdict.next;
        }
        let error = distance(&stepper.span().begin[..2], &system.exact(t1));
        // Phase errors grow with the number of orbits. SciPy 1.17's DOP853 has errors of 1.4e-4, 3.7e-8 and 1.5e-11 at these
        // absolute tolerances, with 758, 1634 and 2858 evaluations.
        assert!(error < 200.0 * tolerance, "{tolerance}: {error}");
        assert!(stepper.evaluations() < most, "{tolerance}: {}", stepper.evaluations());
    }
}

/// ẏ = -r y cos t for several rates, and the integral of the square of the first.
struct Fading<'a>(&'a [f64]);

impl System for Fading<'_> {
    fn dimension(&self) -> usize {
        self.0.len()
    }

    fn positions(&self) -> usize {
        0
    }

    fn total(&self) -> usize {
        self.0.len() + 1
    }

    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        assert_eq!((y.len(), dy.len()), (self.0.len(), self.0.len() + 1), "no component more than there are");
        dy.iter_mut().zip(y).zip(self.0).for_each(|((dy, y), rate)| *dy = -rate * y * t.cos());
        dy[self.0.len()] = y[0] * y[0];
    }
}

/// A component has the same bits with or without others: for even, few-stage and graded steps, their ends, dense output and error.
#[test]
fn neighbours_change_no_bit() {
    let rates = [0.3, 1.1, -0.7, 2.3, 0.9];
    for grade in [Grade::Even, Grade::Few, Grade::Start, Grade::End] {
        let stepped = |rates: &[f64]| {
            let mut stepper = DormandPrince::new(rates.len(), rates.len() + 1);
            stepper.start(&Fading(rates), 0.1, &vec![1.0; rates.len()]);
            let scale = vec![1e-9; rates.len()];
            let error = stepper.attempt(&Fading(rates), Target { end: 0.7, grade }, &scale);
            stepper.complete(&Fading(rates), Completion::Dense);
            (stepper, error)
        };
        let alone = rates.map(|rate| stepped(&[rate]));
        for count in 1..=rates.len() {
            let (stepper, error) = stepped(&rates[..count]);
            assert_eq!(stepper.span().end.len(), count + 1);
            for (i, (own, _)) in alone[..count].iter().enumerate() {
                assert_eq!(stepper.span().end[i], own.span().end[0], "{grade:?} {count} {i}");
                assert_eq!(stepper.value(i, 0.45), own.value(0, 0.45), "{grade:?} {count} {i}");
                assert_eq!(stepper.slope(i, End::End), own.slope(0, End::End), "{grade:?} {count} {i}");
            }
            assert_eq!(stepper.span().end[count], alone[0].0.span().end[1]);
            assert!(stepper.value(count + 1, 0.45).is_nan() && stepper.slope(count + 1, End::End).is_nan());
            let most = alone[..count].iter().fold(0.0, |most: f64, (_, error)| most.max(*error));
            // The error of order 5 is the largest of all; that of order 8 combines the maxima of two estimates.
            assert!(if grade == Grade::Few { error == most } else { error > 0.0 }, "{error} {most}");
        }
    }
}
