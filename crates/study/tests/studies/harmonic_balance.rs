//! A mass on a spring and a Jenkins element under harmonic excitation. A Jenkins element is an elastic spring in series
//! with a friction slider; a flat punch is one with stiffness 2 G* a and limit μF_N.
//!
//! The reference solutions are harmonic balance by pyharm-os 1.2.2 (`tests/data/jenkins.py`) and by the code below. The
//! latter uses alternating frequency/time (Cameron and Griffin, J. Appl. Mech. 56 (1989) 149): the element
//! is simulated for two periods from rest, and the force of the second period is expanded in harmonics.

use nalgebra::{DMatrix, DVector};
use std::error::Error;
use std::f64::consts::TAU;
use std::path::PathBuf;
use stickslip_run::Job;
use stickslip_scenario::Scenario;
use stickslip_study::steady::{self, Options};

const MASS: f64 = 1.0;
const SPRING: f64 = 1.9e6;
const DAMPING: f64 = 60.0;
const PUSH: f64 = 6.0;
const PERIOD: f64 = 4.5e-3;
const LIMIT: f64 = 0.5 * 10.0;
/// 2 G* a of a punch with a radius of 10 µm, steel on steel: 1/G* = (2 - ν)/(2 G), G = E/(2(1 + ν)).
const ELEMENT: f64 = 2.0 * 10e-6 * 2.0 * 210e9 / (2.0 * (1.0 + 0.3) * (2.0 - 0.3));
/// Number of samples per period.
const MOMENTS: usize = 2048;

/// Basis functions at a time: 1, cos ωt, sin ωt, cos 2ωt, …
fn basis(harmonics: usize, t: f64) -> DVector<f64> {
    DVector::from_fn(2 * harmonics + 1, |i, _| {
        let angle = i.div_ceil(2) as f64 * TAU * t / PERIOD;
        if i % 2 == 0 { if i == 0 { 1.0 } else { angle.sin() } } else { angle.cos() }
    })
}

struct Balance {
    harmonics: usize,
    /// Basis at each sample, row by row.
    moments: DMatrix<f64>,
}

impl Balance {
    fn new(harmonics: usize) -> Self {
        let at = |k: usize| basis(harmonics, PERIOD * k as f64 / MOMENTS as f64).transpose();
        Self { harmonics, moments: DMatrix::from_rows(&(0..MOMENTS).map(at).collect::<Vec<_>>()) }
    }

    /// Harmonics of the element's force.
    fn element(&self, x: &DVector<f64>) -> DVector<f64> {
        let place = &self.moments * x;
        let (mut force, mut last) = (0.0_f64, place[0]);
        let mut forces = DVector::zeros(MOMENTS);
        for k in 0..2 * MOMENTS {
            let here = place[k % MOMENTS];
            force = (force + ELEMENT * (here - last)).clamp(-LIMIT, LIMIT);
            (last, forces[k % MOMENTS]) = (here, force);
        }
        let mut harmonics = self.moments.transpose() * forces * (2.0 / MOMENTS as f64);
        harmonics[0] *= 0.5;
        harmonics
    }

    /// Residual of each harmonic, N.
    fn left(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut left = self.element(x);
        left[0] += SPRING * x[0];
        for h in 1..=self.harmonics {
            let omega = h as f64 * TAU / PERIOD;
            let (stiff, damped) = (SPRING - MASS * omega * omega, DAMPING * omega);
            let (cos, sin) = (x[2 * h - 1], x[2 * h]);
            left[2 * h - 1] += stiff * cos + damped * sin;
            left[2 * h] += stiff * sin - damped * cos;
        }
        left[2] -= PUSH;
        left
    }

    /// Solution by Newton's method, starting without the element.
    fn solve(&self) -> Option<DVector<f64>> {
        let count = 2 * self.harmonics + 1;
        let mut x = DVector::zeros(count);
        x[2] = PUSH / SPRING;
        for _ in 0..60 {
            let left = self.left(&x);
            let mut gradient = DMatrix::zeros(count, count);
            for j in 0..count {
                let mut beside = x.clone();
                let by = 1e-12;
                beside[j] += by;
                gradient.set_column(j, &((self.left(&beside) - &left) / by));
            }
            let step = gradient.lu().solve(&left)?;
            x -= &step;
            if step.amax() < 1e-15 {
                return Some(x);
            }
        }
        None
    }
}

fn job() -> Result<Job, Box<dyn Error>> {
    let text = format!(
        r#"{{ "stickslip": 1,
          "materials": {{ "steel": {{ "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 }} }},
          "waveforms": {{ "push": {{ "sine": {{ "amplitude": "{PUSH} N", "period": {PERIOD:e} }} }} }},
          "bodies": {{ "mass": {{ "mass": {MASS:e}, "x": "free" }} }},
          "contacts": {{ "element": {{ "between": ["ground", "mass"], "materials": ["steel", "steel"],
              "profile": {{ "flat": {{ "radius": "10 um" }} }}, "friction": 0.5, "normal": {{ "force": "10 N" }} }} }},
          "springs": {{ "link": {{ "between": ["ground", "mass"], "stiffness": {SPRING:e}, "damping": {DAMPING:e} }} }},
          "loads": [{{ "on": "mass", "x": {{ "follows": "push" }} }}],
          "run": {{ "duration": "1 s" }} }}"#
    );
    Ok(Job::new(Scenario::from_str_alone(&text, "mass")?, "mass".to_owned(), PathBuf::new())?)
}

/// Periodic orbit with which harmonic solutions are compared.
struct Motion {
    time: Vec<f64>,
    place: Vec<f64>,
    amplitude: f64,
}

impl Motion {
    fn new() -> Result<Self, Box<dyn Error>> {
        let job = job()?;
        let found = steady::find(&job, &Options::default())?;
        // The contact must slip for a meaningful comparison.
        assert!(found.shaken_down.is_empty() && found.is_stable());
        let orbit = found.orbit(&job, 256)?;
        let place = orbit.series.column("mass", "x_m").to_vec();
        let amplitude = place.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        Ok(Self { time: orbit.series.time().to_vec(), place, amplitude })
    }

    /// Largest deviation of a solution, relative to the amplitude.
    fn missed(&self, (harmonics, x): (usize, &DVector<f64>)) -> f64 {
        let off = |(t, place): (&f64, &f64)| (basis(harmonics, *t).dot(x) - place).abs();
        self.time.iter().zip(&self.place).map(off).fold(0.0, f64::max) / self.amplitude
    }
}

fn converges(errors: &[f64]) -> bool {
    errors.windows(2).all(|pair| pair[1] < 0.5 * pair[0]) && errors.last().is_some_and(|last| *last < 1e-4)
}

#[test]
fn harmonic_balance_converges_to_the_steady_motion() -> Result<(), Box<dyn Error>> {
    let motion = Motion::new()?;
    let mut errors = Vec::new();
    for harmonics in [3, 9, 27, 51] {
        let x = Balance::new(harmonics).solve().ok_or("no balance")?;
        errors.push(motion.missed((harmonics, &x)));
    }
    assert!(converges(&errors), "{errors:?}");
    Ok(())
}

#[test]
fn a_third_party_converges_to_the_steady_motion() -> Result<(), Box<dyn Error>> {
    let reference: serde_json::Value = serde_json::from_str(include_str!("../data/jenkins.json"))?;
    let motion = Motion::new()?;
    let mut errors = Vec::new();
    for harmonics in [3, 9, 27, 51] {
        let numbers = reference["harmonics"][harmonics.to_string()].as_array().ok_or("no harmonics")?;
        let x = DVector::from_iterator(numbers.len(), numbers.iter().filter_map(serde_json::Value::as_f64));
        errors.push(motion.missed((harmonics, &x)));
    }
    assert!(converges(&errors), "{errors:?}");
    Ok(())
}
