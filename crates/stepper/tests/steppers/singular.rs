//! DOP853 where slopes vary with a square root of time, and where they are constant.

use crate::systems::order;
use stickslip_stepper::{Attempt, Completion, DormandPrince, Grade, Method, Step, System, Target};

/// ẏ = ±(3/2) √s y with s the time from a singular moment T, or to it: y = e^{s^{3/2}} up to a factor.
struct Root {
    singular: f64,
}

impl Root {
    fn exact(&self, t: f64) -> f64 {
        (t - self.singular).abs().powf(1.5).exp()
    }
}

impl System for Root {
    fn dimension(&self) -> usize {
        1
    }
    fn positions(&self) -> usize {
        0
    }
    fn total(&self) -> usize {
        1
    }
    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        let s = t - self.singular;
        dy[0] = 1.5 * s.abs().sqrt().copysign(s) * y[0];
    }
}

/// Relative error at the end of one step from 0 to `h` and, by the dense output, at its worst inside.
fn errors(system: &Root, h: f64, grade: Grade) -> [f64; 2] {
    let mut stepper = DormandPrince::new(1, 1);
    stepper.start(system, 0.0, &[system.exact(0.0)]);
    stepper.attempt(system, Target { end: h, grade }, &[1.0]);
    stepper.complete(system, Completion::Dense);
    let error = |t: f64| (stepper.value(0, t) / system.exact(t) - 1.0).abs();
    let inside = (1..100).map(|k| error(h * f64::from(k) / 100.0)).fold(0.0, f64::max);
    [error(h), inside]
}

/// A graded step has order 8 in the square root of time and its dense output order 7: 4.5 (error of one step) and 4 in its
/// length. Even stages have order 1.5.
#[test]
fn a_graded_step_keeps_its_order_at_a_singular_end() {
    for (grade, at_end) in [(Grade::Start, false), (Grade::End, true)] {
        let of = |grade: Grade, h: f64| errors(&Root { singular: if at_end { h } else { 0.0 } }, h, grade);
        let lengths = [0.8, 0.56, 0.4, 0.28, 0.2, 0.14, 0.1];
        for (place, least) in [(0, 4.2), (1, 3.5)] {
            let graded = lengths.map(|h| (h, of(grade, h)[place]));
            let even = lengths.map(|h| (h, of(Grade::Even, h)[place]));
            assert!(order(&graded) > least, "{grade:?} {place}: {graded:?}");
            assert!(order(&even) < 1.8, "{grade:?} {place}: {even:?}");
            assert!(graded[6].1 < 1e-4 * even[6].1, "{grade:?} {place}: {graded:?} {even:?}");
        }
    }
}

/// Free fall, ẍ = -g, and a linear quadrature.
struct Stone;

impl System for Stone {
    fn dimension(&self) -> usize {
        2
    }
    fn positions(&self) -> usize {
        1
    }
    fn total(&self) -> usize {
        3
    }
    fn slopes(&self, _: f64, y: &[f64], dy: &mut [f64]) {
        dy.copy_from_slice(&[y[1], -9.81, 3.0]);
    }
    fn coasts(&self) -> bool {
        true
    }
}

#[test]
fn what_coasts_is_exact_at_any_length_and_free() {
    let mut stepper = DormandPrince::new(2, 3);
    stepper.start(&Stone, 1.0, &[2.0, 20.0, 0.5]);
    assert_eq!(stepper.attempt(&Stone, Target::even(4.0), &[1.0; 2]), 0.0);
    stepper.complete(&Stone, Completion::Dense);
    let exact = |s: f64| [2.0 + 20.0 * s - 0.5 * 9.81 * s * s, 20.0 - 9.81 * s, 0.5 + 3.0 * s];
    for t in [1.0, 1.3, 2.5, 4.0] {
        for (i, exact) in exact(t - 1.0).into_iter().enumerate() {
            assert!((stepper.value(i, t) - exact).abs() < 1e-13, "{t} {i}: {}", stepper.value(i, t));
        }
    }
    stepper.cut(2.5);
    assert!((stepper.span().end[0] - exact(1.5)[0]).abs() < 1e-13);
    stepper.accept();
    assert_eq!(stepper.evaluations(), 1);
}
