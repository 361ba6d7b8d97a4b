//! Reference method compared with closed forms, and with a memory.

use crate::systems::{Forced, Oscillator};
use stickslip_stepper::System;
use stickslip_stepper::reference::{Accepting, ReferenceError, ReferenceOptions, integrate};

/// System that records accepted steps.
struct Log<S> {
    system: S,
    accepted: Vec<(f64, Vec<f64>)>,
    /// Time from which it refuses steps, s.
    enough: f64,
}

impl<S: System> System for Log<S> {
    fn dimension(&self) -> usize {
        self.system.dimension()
    }
    fn positions(&self) -> usize {
        self.system.positions()
    }
    fn total(&self) -> usize {
        self.system.total()
    }
    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.system.slopes(t, y, dy);
    }
}

impl<S: System> Accepting for Log<S> {
    fn accept(&mut self, t: f64, y: &[f64]) -> bool {
        self.accepted.push((t, y.to_vec()));
        t < self.enough
    }
}

fn log<S>(system: S) -> Log<S> {
    Log { system, accepted: Vec::new(), enough: f64::INFINITY }
}

/// `pairs` oscillators ẍ = -x of different starts and one quadrature ∫Σx dt.
struct Many {
    pairs: usize,
}

impl System for Many {
    fn dimension(&self) -> usize {
        2 * self.pairs
    }
    fn positions(&self) -> usize {
        self.pairs
    }
    fn total(&self) -> usize {
        2 * self.pairs + 1
    }
    fn slopes(&self, _t: f64, y: &[f64], dy: &mut [f64]) {
        let n = self.pairs;
        for i in 0..n {
            dy[i] = y[n + i];
            dy[n + i] = -y[i];
        }
        dy[2 * n] = y[..n].iter().sum();
    }
}

#[test]
fn every_size_of_state_meets_the_closed_form() {
    // Totals from 3 to 21: all padded sizes and the generic one.
    for pairs in 1..=10 {
        let mut system = log(Many { pairs });
        let mut y = vec![0.0; 2 * pairs + 1];
        for (i, x) in y[..pairs].iter_mut().enumerate() {
            *x = 1.0 + i as f64;
        }
        let start = y.clone();
        let scale = vec![1e-9; 2 * pairs];
        let run = integrate(&mut system, 0.0..2.0, &y, &scale, &ReferenceOptions::default()).unwrap();
        let (sin, cos) = 2.0_f64.sin_cos();
        for (i, x) in start[..pairs].iter().enumerate() {
            assert!((run.y[i] - x * cos).abs() < 1e-7);
            assert!((run.y[pairs + i] + x * sin).abs() < 1e-7);
        }
        let sum: f64 = start[..pairs].iter().sum();
        assert!((run.y[2 * pairs] - sum * sin).abs() < 1e-7);
        assert_eq!(run.steps as usize, system.accepted.len());
    }
}

#[test]
fn accepts_each_step_once_in_order_with_its_own_state() {
    let mut system = log(Forced);
    let run =
        integrate(&mut system, 0.0..1.2, &[0.5, 1.0, 0.0], &[1e-9; 2], &ReferenceOptions::default()).unwrap();
    assert!(run.steps > 5 && run.evaluations >= 6 * run.steps);
    let mut before = 0.0;
    for (t, y) in &system.accepted {
        assert!(*t > before);
        before = *t;
        for (got, exact) in y.iter().zip(Forced::exact(*t)) {
            assert!((got - exact).abs() < 2e-7, "{t}: {got} {exact}");
        }
    }
    assert_eq!(before, 1.2);
    assert_eq!(run.y, system.accepted.last().unwrap().1);
}

#[test]
fn tolerance_counts_coupled_components_only() {
    // The same oscillator with and without padding and quadratures has the same steps.
    struct Bare;
    impl System for Bare {
        fn dimension(&self) -> usize {
            2
        }
        fn positions(&self) -> usize {
            1
        }
        fn total(&self) -> usize {
            2
        }
        fn slopes(&self, _t: f64, y: &[f64], dy: &mut [f64]) {
            dy.copy_from_slice(&[y[1], -y[0]]);
        }
    }
    let options = ReferenceOptions { first: Some(0.01), ..ReferenceOptions::default() };
    let bare = integrate(&mut log(Bare), 0.0..9.0, &[1.0, 0.0], &[1e-8; 2], &options).unwrap();
    let mut full = log(Oscillator { omega: 1.0 });
    let full = integrate(&mut full, 0.0..9.0, &[1.0, 0.0, 0.0, 0.0], &[1e-8; 2], &options).unwrap();
    assert_eq!((bare.steps, bare.rejected, bare.evaluations), (full.steps, full.rejected, full.evaluations));
    assert!((bare.y[0] - full.y[0]).abs() < 1e-14);
}

#[test]
fn stretches_join_and_the_longest_step_is_kept() {
    let mut system = log(Oscillator { omega: 1.0 });
    let exact = Oscillator { omega: 1.0 }.exact(3.0);
    let options = ReferenceOptions { longest: 0.05, ..ReferenceOptions::default() };
    let mut y = vec![1.0, 0.0, 0.0, 0.0];
    for (a, b) in [(0.0, 1.0), (1.0, 2.5), (2.5, 3.0)] {
        let run = integrate(&mut system, a..b, &y, &[1e-10; 2], &options).unwrap();
        assert!(run.step <= 0.05 * (1.0 + 1e-12));
        y = run.y;
    }
    for (got, exact) in y.iter().zip(exact) {
        assert!((got - exact).abs() < 1e-9);
    }
}

#[test]
fn errors_say_what_was_wrong() {
    let options = ReferenceOptions::default();
    let mut system = log(Oscillator { omega: 1.0 });
    let y = [1.0, 0.0, 0.0, 0.0];
    let mut try_it = |span, y: &[f64], scale: &[f64], options: &ReferenceOptions| {
        integrate(&mut system, span, y, scale, options).unwrap_err()
    };
    assert_eq!(try_it(1.0..1.0, &y, &[1.0; 2], &options), ReferenceError::Span { start: 1.0, end: 1.0 });
    assert_eq!(try_it(0.0..1.0, &y[..3], &[1.0; 2], &options), ReferenceError::State { expected: 4, got: 3 });
    assert_eq!(try_it(0.0..1.0, &y, &[1.0, 0.0], &options), ReferenceError::Scale { index: 1, got: 0.0 });
    let few = ReferenceOptions { steps: 10, ..options };
    assert!(matches!(try_it(0.0..1e6, &y, &[1e-9; 2], &few), ReferenceError::TooManySteps { steps: 10, .. }));
    let none = ReferenceOptions { longest: 0.0, ..options };
    assert!(matches!(try_it(0.0..1.0, &y, &[1.0; 2], &none), ReferenceError::Options { .. }));
}

#[test]
fn slopes_that_are_not_finite_end_in_an_error() {
    let mut system = log(Oscillator { omega: f64::NAN });
    let options = ReferenceOptions { steps: 100, ..ReferenceOptions::default() };
    let run = integrate(&mut system, 0.0..1.0, &[1.0, 0.0, 0.0, 0.0], &[1e-6; 2], &options);
    assert!(
        matches!(run, Err(ReferenceError::TooManySteps { .. } | ReferenceError::StepTooSmall { .. })),
        "{run:?}"
    );
    assert!(system.accepted.is_empty());
}

#[test]
fn who_has_had_enough_ends_the_stretch() {
    let mut log = Log { enough: 2.0, ..log(Many { pairs: 1 }) };
    let y = [1.0, 0.0, 0.0];
    let run = integrate(&mut log, 0.0..10.0, &y, &[1e-8; 2], &ReferenceOptions::default()).unwrap();
    let (last, before) = (log.accepted.last().unwrap(), &log.accepted[log.accepted.len() - 2]);
    assert!(before.0 < 2.0 && (2.0..3.0).contains(&last.0), "{} {}", before.0, last.0);
    assert_eq!(run.y, last.1);
}
