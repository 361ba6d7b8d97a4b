//! Tests of the ideal inertia drive, which depends on the contact alone.
//!
//! The flyback is instantaneous: u decreases by the stroke S at constant d. The slow phase is quasi-static: u increases until F_x
//! carries the opposing load λμF_N. The advance of a cycle is S minus this increase. The steady step length is max(0, S-S₀) with the
//! zero-step stroke
//!
//! S₀ = 2u_c[1-((1-λ)/2)^{n/(n+1)}],
//!
//! the increase from full backward slip along Masing's branch -1+2[1-(1-s/2u_c)^p] = λ. The drive stalls at λ =
//! 1-2(1-S/2u_c)^{(n+1)/n}, but not for S above 2u_c.

use stickslip_contact::{Apex, Curve, Interface, Move, Pair, Profile, Segment};

const E: f64 = 1.15e11;
const G: f64 = 0.95e11;
const MU: f64 = 0.15;
const D: f64 = 1.8e-7;
const U_C: f64 = MU * E / G * D;

/// Contact at indentation D in an ideal drive; lengths in units of u_c, forces in units of μF_N.
struct Drive {
    law: Interface,
    limit: f64,
    curve: Curve,
    at: f64,
}

impl Drive {
    /// Creates the drive; `area` is M(D) from its closed form.
    fn new(profile: Profile, area: f64) -> Self {
        let law = Interface::new(Pair::from_moduli(E, G).unwrap(), profile, MU).unwrap();
        let curve = Curve::new(&law, Apex { d: D, u: 0.0 });
        Self { law, limit: MU * E * area, curve, at: 0.0 }
    }

    fn force(&self, part: f64) -> f64 {
        self.curve.trial(&self.law, Move::Chord(Apex { d: D, u: part * U_C })).force / self.limit
    }

    fn go(&mut self, part: f64) {
        self.curve.commit(&self.law, Segment::Straight(Apex { d: D, u: part * U_C })).unwrap();
        self.at = part;
    }

    /// Slow phase: moves to the first position whose force carries the load.
    fn rise(&mut self, load: f64) -> f64 {
        let (from, mut low, mut high) = (self.at, self.at, self.at + 3.0);
        assert!(self.force(high) >= load);
        while self.force(low) < load {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                low = high;
            } else if self.force(middle) < load {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.go(low);
        low - from
    }

    /// Advance of one cycle.
    fn cycle(&mut self, stroke: f64, load: f64) -> f64 {
        let before = self.at;
        self.go(before - stroke);
        self.rise(load);
        // The result is a difference of positions, so that a closed cycle advances by exactly 0.
        stroke - (self.at - (before - stroke))
    }

    /// Steady advance per cycle, after the transient: 2000 consecutive cycles must agree to rounding.
    fn settled(&mut self, stroke: f64, load: f64) -> f64 {
        self.rise(load);
        let (mut last, mut repeats) = (f64::INFINITY, 0);
        for _ in 0..100_000 {
            let step = self.cycle(stroke, load);
            repeats = if (step - last).abs() <= NOTHING * (1.0 + self.at.abs()) { repeats + 1 } else { 0 };
            if repeats == 2000 {
                return step;
            }
            last = step;
        }
        panic!("S = {stroke}, λ = {load}: still changing, {last:e}")
    }
}

/// Rounding of a step: a few units in the last place of the positions.
const NOTHING: f64 = 4.0 * f64::EPSILON;

/// Exponents n and drives: cone, paraboloid, power 8. M = 2n/(n+1) a d.
fn drives() -> [(f64, Drive); 3] {
    let area = |n: f64, a: f64| 2.0 * n / (n + 1.0) * a * D;
    [
        (1.0, Drive::new(Profile::cone(0.01).unwrap(), area(1.0, D / (std::f64::consts::FRAC_PI_2 * 0.01)))),
        (2.0, Drive::new(Profile::paraboloid(1e-3).unwrap(), area(2.0, (1e-3 * D).sqrt()))),
        (8.0, Drive::new(Profile::foundation_power(1e26, 8.0).unwrap(), area(8.0, (D / 1e26).powf(0.125)))),
    ]
}

/// Zero-step stroke S₀/u_c.
fn zero_step_stroke(n: f64, load: f64) -> f64 {
    2.0 * (1.0 - (0.5 * (1.0 - load)).powf(n / (n + 1.0)))
}

#[test]
fn the_paraboloid_has_the_published_zero_step_strokes() {
    for (load, published) in [(0.0, 0.74008), (0.5, 1.20630)] {
        assert!((zero_step_stroke(2.0, load) - published).abs() <= 5e-6);
        // Numerical zero of the steady advance, without the formula.
        let (mut low, mut high) = (0.0, 2.0);
        while high - low > 1e-7 {
            let stroke = 0.5 * (low + high);
            let [_, (_, mut drive), _] = drives();
            if drive.settled(stroke, load) > 1e-12 { high = stroke } else { low = stroke }
        }
        assert!((high - published).abs() <= 5e-6, "{high}");
    }
}

// At S = S₀ itself (a cone, λ = 1/2, S = u_c) the transient decreases only as a power of the number of cycles.

#[test]
fn steps_are_stroke_less_the_zero_step_stroke() {
    for load in [0.0, 0.5, -0.5] {
        for stroke in [0.3, 0.5, 0.74, 0.75, 0.99, 1.01, 1.2, 1.21, 1.7, 2.0, 2.5, 5.0] {
            for (n, mut drive) in drives() {
                let expected = f64::max(0.0, stroke - zero_step_stroke(n, load));
                let step = drive.settled(stroke, load);
                let place = format!("n = {n}, λ = {load}, S = {stroke}");
                assert!((step - expected).abs() <= 1e-9, "{place}: {step} {expected}");
                // Below S₀ the position does not change.
                let start = drive.at;
                let worst = (0..1000).map(|_| drive.cycle(stroke, load).abs()).fold(0.0, f64::max);
                if expected == 0.0 {
                    let trend = (drive.at - start).abs();
                    assert!(worst <= NOTHING && trend <= NOTHING, "{place}: creeps {worst:e} {trend:e}");
                }
            }
        }
    }
}

#[test]
fn it_stalls_where_the_zero_step_stroke_meets_the_stroke() {
    for (n, _) in drives() {
        for stroke in [0.3_f64, 0.8, 1.3, 1.9] {
            let stall = 1.0 - 2.0 * (1.0 - 0.5 * stroke).powf((n + 1.0) / n);
            for (load, moves) in [(stall - 1e-4, true), (stall + 1e-4, false)] {
                let (_, mut drive) = drives().into_iter().find(|(other, _)| *other == n).unwrap();
                let step = drive.settled(stroke, load);
                let expected = f64::max(0.0, stroke - zero_step_stroke(n, load));
                assert!((step - expected).abs() <= 1e-9, "n = {n}, S = {stroke}, λ = {load}: {step}");
                assert_eq!(step > NOTHING, moves, "n = {n}, S = {stroke}, λ = {load}: {step:e}");
            }
        }
    }
}

#[test]
fn beyond_twice_u_c_no_load_below_the_limit_stalls_it() {
    for (n, mut drive) in drives() {
        let (stroke, load) = (2.0 + 1e-6, 1.0 - 1e-9);
        let step = drive.settled(stroke, load);
        let expected = stroke - zero_step_stroke(n, load);
        assert!(step > 0.0 && (step - expected).abs() <= 1e-9, "n = {n}: {step:e} {expected:e}");
    }
}

#[test]
fn below_the_zero_step_stroke_it_creeps_and_stops() {
    // From the first loading curve the advance decreases in each cycle, until the position is steady.
    for (n, mut drive) in drives() {
        drive.rise(0.2);
        let steps: Vec<f64> = (0..200).map(|_| drive.cycle(0.4, 0.2)).collect();
        assert!(steps[0] > 1e-5 && steps.iter().sum::<f64>() < 1.0, "n = {n}: {steps:?}");
        assert!(steps.windows(2).all(|pair| pair[1] <= pair[0] + NOTHING), "n = {n}: {steps:?}");
        assert!(steps[100..].iter().all(|step| step.abs() <= NOTHING), "n = {n}: {steps:?}");
    }
}
