//! Measured waveform with noise, sampled every few microseconds: the contact has hundreds of reversals per period.

use serde_json::{Value, json};
use std::error::Error;
use std::path::Path;
use stickslip_run::Job;
use stickslip_study::steady::{self, Kind, Options};

/// Period of the drive, s, and number of points.
const PERIOD: f64 = 2e-3;
const POINTS: u32 = 1000;
/// Mass of the slider, kg; stiffness, N/m, and damping, N s/m, of the spring that holds it down; and preload, N.
const MASS: f64 = 0.05;
const SPRING: (f64, f64) = (6e3, 40.0);
const LOAD: f64 = 1.8;
/// E\* of steel on steel, Pa, and radius of the ball, m.
const MODULUS: f64 = 210e9 / (2.0 * (1.0 - 0.3 * 0.3));
const RADIUS: f64 = 0.4e-3;

/// Slow forward motion by half a micrometre, return in a fifth of the period, with noise of five nanometres.
fn table() -> Vec<[f64; 2]> {
    let mut draws = 1_u64;
    let mut noise = || {
        draws = draws.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        5e-9 * (2.0 * (draws >> 11) as f64 / (1_u64 << 53) as f64 - 1.0)
    };
    let point = |k: u32| {
        let part = f64::from(k) / f64::from(POINTS);
        let way = if part < 0.8 { part / 0.8 } else { (1.0 - part) / 0.2 };
        [part * PERIOD, 0.5e-6 * way + if k.is_multiple_of(POINTS) { 0.0 } else { noise() }]
    };
    (0..=POINTS).map(point).collect()
}

fn scene() -> Value {
    json!({
        "stickslip": 1,
        "materials": { "steel": { "youngs_modulus": "210 GPa", "poisson_ratio": 0.3 } },
        "waveforms": { "drive": { "table": { "points": table(), "interpolation": "cubic", "repeat": true } } },
        "bodies": {
            "foot": { "x": { "follows": "drive" } },
            "slider": { "mass": MASS, "x": "free", "z": "free" }
        },
        "contacts": { "ball": {
            "between": ["foot", "slider"], "materials": ["steel", "steel"], "friction": 0.18,
            "profile": { "paraboloid": { "radius": RADIUS } }, "normal": "coupled"
        } },
        "springs": { "clamp": {
            "between": ["ground", "slider"], "direction": "z", "stiffness": SPRING.0, "damping": SPRING.1
        } },
        "loads": [{ "on": "slider", "z": -LOAD }],
        "figures": { "waveform": "drive", "body": "slider" },
        "run": { "cycles": 3, "start": "equilibrium", "stepper": { "event": { "tolerance": 1e-9 } } },
        "plots": []
    })
}

/// z and x are not coupled: λ = exp((-c/2m ± iω)T), ω² = k/m - (c/2m)². k is the sum of the spring stiffness and 2E*√(Rd) of the ball,
/// with d at equilibrium. Reversals at the corners of the waveform must not accumulate errors of λ.
#[test]
fn turns_at_the_corners_of_noise_do_not_accumulate() -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("noisy.json");
    std::fs::write(&file, scene().to_string())?;
    let job = Job::prepare(&file, &[], Path::new(""))?;
    let run = job.run(&());
    assert!(run.error.is_none(), "{:?}", run.error);
    let counts = run.state.counts();
    assert!(counts.detours == 0 && counts.events > 3000, "{counts:?}");

    let pressed = |d: f64| 4.0 / 3.0 * MODULUS * (RADIUS * d.powi(3)).sqrt() + SPRING.0 * d;
    let [low, high] = (0..100).fold([0.0, 1e-5], |[low, high], _| {
        let middle = 0.5 * (low + high);
        if pressed(middle) < LOAD { [middle, high] } else { [low, middle] }
    });
    let stiffness = SPRING.0 + 2.0 * MODULUS * (RADIUS * 0.5 * (low + high)).sqrt();
    let fading = SPRING.1 / (2.0 * MASS);
    let turn = (stiffness / MASS - fading * fading).sqrt() * PERIOD;
    let size = (-fading * PERIOD).exp();
    for tolerance in [1e-9, 1e-12] {
        let found = steady::find(&job, &Options { tolerance, ..Options::default() })?;
        let first = found.multipliers[0];
        let told = format!("{tolerance}: {:?}, {size} · cos {turn}", found.multipliers);
        assert!((first.modulus() - size).abs() < 1e-8 && first.kind() == Kind::Fades, "{told}");
        assert!((first.re - size * turn.cos()).abs() < 1e-7, "{told}");
    }
    Ok(())
}
