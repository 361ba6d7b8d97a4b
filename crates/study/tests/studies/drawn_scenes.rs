//! Steady motions of random scenarios, compared with simulations of 300 periods.

use crate::prepared;
use std::error::Error;
use std::path::{Path, PathBuf};
use stickslip_drive::scene::Side;
use stickslip_drive::{Plan, Run, RunError};
use stickslip_measure::{Bounds, Settling};
use stickslip_run::Job;
use stickslip_study::curve::{Course, Curve, Kind, Motion, Motionless};

const DRIVES: [&str; 7] = [
    "quickstart.json",
    "ruby_drive.json",
    "sine_drive.json",
    "impact_drive.json",
    "three_ball_stage.json",
    "walking_drive.json",
    "vibrated_slider.json",
];
const PERIODS: u32 = 300;
/// Largest difference of equal steps, relative to u_c or to the step: the runs have a tolerance of 1e-9.
const SAME: f64 = 1e-4;

/// Largest ratio of deviations from the second to the last quarter of a run that counts as decay.
const FADES: f64 = 0.9;

type Set = Vec<(String, String)>;

/// Random numbers from 0 to 1 (Knuth's MMIX).
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name)
}

/// Returns overrides with random friction of 0 to 1 for all contacts and a random load of up to ±3 μF_N, and u_c.
/// Returns `None` if the scenario is invalid.
fn drawn(name: &str, draw: &mut Draw) -> Result<Option<(Set, f64)>, Box<dyn Error>> {
    let job = Job::prepare(&file(name), &[], Path::new(""))?;
    let body = job.scenario.figures.body.ok_or("a body")?;
    let friction = draw.next();
    let contacts = &job.scenario.scene.contacts;
    let mut set: Set =
        contacts.iter().map(|c| (format!("contacts.{}.friction", c.name), friction.to_string())).collect();
    let own = contacts.iter().enumerate().filter(|(_, c)| c.part.between.contains(&Side::Body(body)));
    let pressed: f64 = own.map(|(c, contact)| f64::from(contact.part.count) * job.contact_scale(c).1).sum();
    let load = (6.0 * draw.next() - 3.0) * friction * pressed;
    let on = &job.scenario.scene.bodies[body].name;
    set.push(("loads[+]".to_owned(), format!(r#"{{"on": "{on}", "x": {load}}}"#)));
    // Some scenarios start at equilibrium, which does not exist with such a load.
    let job = Job::prepare(&file(name), &set, Path::new(""));
    Ok(job.ok().map(|job| (set, job.contact_scale(0).0)))
}

/// Returns the step lengths of a simulation.
fn steps(job: &Job, period: f64) -> Result<Vec<f64>, RunError> {
    let plan = Plan { every: None, until_steady: None, duration: f64::MAX, ..job.scenario.plan };
    let mut run = Run::new(&job.model, &plan, job.start.clone())?;
    let body = job.scenario.figures.body.unwrap_or_default();
    let mut place = |k: u32| {
        run.advance(f64::from(k) * period, &mut ())?;
        Ok(run.state().body(&job.model, body).map_or(f64::NAN, |(x, _)| x))
    };
    let places = (0..=PERIODS).map(&mut place).collect::<Result<Vec<f64>, RunError>>()?;
    Ok(places.windows(2).map(|pair| pair[1] - pair[0]).collect())
}

/// Describes how a simulation contradicts a steady step length. Returns `None` if it agrees or approaches it, because
/// ringing may decay over a thousand periods.
fn contradiction(motion: &Motion, steps: &[f64]) -> Option<String> {
    let bounds = Bounds { least: SAME * motion.natural, most: f64::INFINITY, error: 0.0 };
    let scale = SAME * motion.natural.max(motion.step.abs());
    let is_other = |step: f64, error: f64| (step - motion.step).abs() > error + motion.error + scale;
    let said = Settling::of(steps, bounds);
    let far = |part: &[f64]| {
        (part.iter().map(|step| (step - motion.step).powi(2)).sum::<f64>() / part.len() as f64).sqrt()
    };
    let (quarter, end) = (steps.len() / 4, far(&steps[3 * steps.len() / 4..]));
    let is_near = end <= scale + motion.error || end <= FADES * far(&steps[quarter..2 * quarter]);
    let is_against = match said {
        Settling::Settled(settled) => is_other(settled.value, settled.error),
        Settling::NotSettled { limit: Some((limit, error)), .. } => is_other(limit, error),
        _ => !is_near,
    };
    is_against.then(|| format!("{motion:?}\n {said:?}, last {:e}", steps[steps.len() - 1]))
}

#[test]
fn no_plain_run_contradicts_a_steady_step() -> Result<(), Box<dyn Error>> {
    let count = std::env::var("DRAWN").ok().and_then(|count| count.parse().ok()).unwrap_or(21);
    let mut draw = Draw(20);
    for _ in 0..100 {
        draw.next();
    }
    let mut told = [0; 5];
    for k in 0..count {
        let name = DRIVES[k % DRIVES.len()];
        let Some((set, natural)) = drawn(name, &mut draw)? else { continue };
        // From 0.1 to 1000 u_c, logarithmic.
        let amplitude = natural * 10.0_f64.powf(4.0 * draw.next() - 1.0);
        let curve = Curve::new(prepared(&file(name), &set)?, Kind::StepAmplitude)?;
        let traced = curve.trace(&[amplitude], 1, &());
        let point = &traced.points[0];
        let place = match &point.motion {
            Ok(motion) => motion.course as usize,
            Err(Motionless::SlidesAway { .. }) => 3,
            Err(_) => 4,
        };
        told[place] += 1;
        let all: Set = set.into_iter().chain(point.set.clone()).collect();
        let Ok(motion) = &point.motion else { continue };
        if motion.course != Course::Steady {
            continue;
        }
        let job = Job::prepare(&file(name), &all, Path::new(""))?;
        let found = contradiction(motion, &steps(&job, motion.period)?);
        assert_eq!(found, None, "{k} {name} {all:?}");
    }
    // The comparison must include enough cases.
    assert!(told[0] >= count / 4 && told[3] > 0, "{told:?}");
    Ok(())
}
