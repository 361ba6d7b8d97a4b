//! Stability limits for decaying and oscillating motions.

use stickslip_stepper::{Attempt, Conservative, DormandPrince, Method, Nystrom, Step, System, Target};

/// ẏ = λy, λ = rate e^{i angle}.
struct Fades {
    real: f64,
    imaginary: f64,
}

impl System for Fades {
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
        dy[0] = self.real * y[0] - self.imaginary * y[1];
        dy[1] = self.imaginary * y[0] + self.real * y[1];
    }
}

/// |R(hλ)| of one step.
fn growth(angle: f64, step: f64) -> f64 {
    let system = Fades { real: angle.cos(), imaginary: angle.sin() };
    let mut stepper = DormandPrince::new(2, 2);
    stepper.start(&system, 0.0, &[1.0, 0.0]);
    stepper.attempt(&system, Target::even(step), &[1.0; 2]);
    stepper.span().end[0].hypot(stepper.span().end[1])
}

#[test]
fn below_the_limit_of_dop853_nothing_grows_that_fades_or_swings() {
    let limit = DormandPrince::new(2, 2).stability_limit();
    for k in 0..=90 {
        let angle = f64::from(90 + k).to_radians();
        for part in 1..=50 {
            let within = growth(angle, limit * f64::from(part) / 50.0);
            assert!(within < 1.0 + 1e-12, "{angle} {part}: {within}");
        }
    }
    // An oscillation at the largest step decays by a sixth; one with a step longer by a quarter grows.
    assert!(growth(90_f64.to_radians(), limit) < 0.85 && growth(90_f64.to_radians(), 1.25 * limit) > 1.1);
}

/// ẍ = -x.
struct Swings;

impl Conservative for Swings {
    fn accelerations(&self, _: f64, x: &[f64], a: &mut [f64]) {
        a[0] = -x[0];
    }
}

/// Spectral radius of the step's matrix for (x, v).
fn spectral_radius(step: f64) -> f64 {
    let column = |start: [f64; 2]| {
        let mut stepper = Nystrom::new(1, 0);
        stepper.start(&Swings, 0.0, &start);
        stepper.attempt(&Swings, Target::even(step), &[1.0; 2]);
        let end = stepper.span().end;
        [end[0], end[1]]
    };
    let ([a, c], [b, d]) = (column([1.0, 0.0]), column([0.0, 1.0]));
    let (half, determinant) = (0.5 * (a + d), a * d - b * c);
    let root = half * half - determinant;
    if root < 0.0 { determinant.sqrt() } else { half.abs() + root.sqrt() }
}

#[test]
fn below_the_limit_of_nystrom_no_swing_grows() {
    let limit = Nystrom::new(1, 0).stability_limit();
    for part in 1..=100 {
        let within = spectral_radius(limit * f64::from(part) / 100.0);
        assert!(within < 1.0 + 1e-12, "{part}: {within}");
    }
    assert!(spectral_radius(limit) < 1.0 - 1e-4 && spectral_radius(1.2 * limit) > 1.0);
}
