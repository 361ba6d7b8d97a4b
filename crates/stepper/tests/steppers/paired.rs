//! Nyström's method and DOP853 alternately on one motion.

use crate::systems::order;
use stickslip_stepper::{Attempt, Completion, Conservative, Grade, Paired, Step, System, Target};

/// ẍ = (35/4) s^{3/2} - ω² (x - s^{7/2}) with s the time left until T, and the rate x of a quadrature: x = s^{7/2} from
/// x = T^{7/2}, ẋ = -(7/2) T^{5/2}.
struct Closing {
    singular: f64,
    omega: f64,
}

impl Closing {
    /// x, ẋ and ∫x dt.
    fn exact(&self, t: f64) -> [f64; 3] {
        let (s, all) = (self.singular - t, self.singular);
        [s.powf(3.5), -3.5 * s.powf(2.5), (all.powf(4.5) - s.powf(4.5)) / 4.5]
    }

    fn acceleration(&self, t: f64, x: f64) -> f64 {
        let s = (self.singular - t).max(0.0);
        8.75 * s.powf(1.5) - self.omega * self.omega * (x - s.powf(3.5))
    }

    fn start(&self, stepper: &mut Paired<stickslip_stepper::One>) {
        stepper.start(self, 0.0, &self.exact(0.0));
    }
}

impl Conservative for Closing {
    fn accelerations(&self, t: f64, x: &[f64], out: &mut [f64]) {
        out.copy_from_slice(&[self.acceleration(t, x[0]), x[0]]);
    }
}

impl System for Closing {
    fn dimension(&self) -> usize {
        2
    }
    fn positions(&self) -> usize {
        1
    }
    fn total(&self) -> usize {
        3
    }
    fn slopes(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy.copy_from_slice(&[y[1], self.acceleration(t, y[0]), y[0]]);
    }
}

/// Largest error of the three components at `t`, against exact ones.
fn error(got: &[f64], exact: [f64; 3]) -> f64 {
    got.iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// One step up to the singular moment: graded, its error is of order 4.5 or higher, as for [`Grade`]; even steps have order 2.5
/// for the velocity.
#[test]
fn graded_steps_keep_their_order() {
    let errors = |grade: Grade| {
        [0.28, 0.2, 0.14, 0.1, 0.07, 0.05].map(|h| {
            let system = Closing { singular: h, omega: 3.0 };
            let mut stepper = Paired::one(3);
            system.start(&mut stepper);
            stepper.attempt(&system, Target { end: h, grade }, &[1.0; 3]);
            (h, error(stepper.span().end, system.exact(h)))
        })
    };
    let (graded, even) = (errors(Grade::End), errors(Grade::Even));
    assert!(order(&graded) > 4.2, "{graded:?}");
    assert!(order(&even) < 3.0, "{even:?}");
    assert!(graded[5].1 < 1e-2 * even[5].1, "{graded:?} {even:?}");
}

/// Even and graded steps alternately: each continues where the other one ended, also after a rejected attempt and a cut step.
#[test]
fn both_methods_follow_one_motion() {
    let system = Closing { singular: 2.0, omega: 3.0 };
    let mut stepper = Paired::one(3);
    system.start(&mut stepper);
    let time = |stepper: &Paired<_>| stepper.span().time;
    for k in 0..24 {
        let end = time(&stepper) + 0.05;
        let grade = if k % 2 == 0 { Grade::Even } else { Grade::Start };
        let other = if k % 3 == 0 { Grade::End } else { Grade::Even };
        stepper.attempt(&system, Target { end, grade: other }, &[1.0; 3]);
        let begun = stepper.span().begin[0];
        stepper.attempt(&system, Target { end, grade }, &[1.0; 3]);
        assert_eq!(begun, stepper.span().begin[0], "an attempt leaves no trace");
        stepper.complete(&system, Completion::EndSlopes);
        if k % 4 == 3 {
            stepper.complete(&system, Completion::Dense);
            stepper.cut(end - 0.01);
        }
        stepper.accept();
        let t = time(&stepper);
        let off = error(stepper.span().begin, system.exact(t));
        assert!(off < 1e-6, "step {k} to {t}: {off:e}");
    }
    assert!(time(&stepper) > 1.0);
}
