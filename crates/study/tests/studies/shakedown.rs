//! Multipliers of orbits with neutral unknowns, and of orbits whose number of memory corners changes when disturbed.

use std::error::Error;
use std::path::Path;
use stickslip_run::Job;
use stickslip_study::steady::{self, Multiplier, Options, Steady};

fn found(tolerance: f64) -> Result<Steady, Box<dyn Error>> {
    found_with(tolerance, 1.0)
}

/// All masses are multiplied by `factor`.
fn found_with(tolerance: f64, factor: f64) -> Result<Steady, Box<dyn Error>> {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes/riding_on_springs.json");
    let masses =
        [("slider", 0.018971336644657607), ("second", 0.003846040405993169), ("third", 0.10448293451975191)];
    let set = masses.map(|(body, mass)| (format!("bodies.{body}.mass"), format!("{:?}", mass * factor)));
    let job = Job::prepare(Path::new(file), &set, Path::new(""))?;
    Ok(steady::find(&job, &Options { tolerance, ..Options::default() })?)
}

/// The slider bounces undamped on two worn spherical caps: λ = e^{±iωT}, ω² = k/m. For a cap worn to the radius b, F = 2E*/3R (2a² + b²)
/// √(a² - b²) and k = 2E*a (Popov, Heß, Willert, *Handbook of Contact Mechanics*, sec. 2.5.9). The bodies on it keep their memory for
/// ever.
#[test]
fn an_undamped_bounce_beside_what_is_held_for_ever_keeps_its_modulus() -> Result<(), Box<dyn Error>> {
    let (modulus, flat, radius) = (210e9 / (2.0 * (1.0 - 0.3_f64.powi(2))), 1.3885066760561482e-5_f64, 1e-3);
    let (mass, load, period) = (0.018971336644657607, 0.5 * 0.2413518496485078, 0.0004371375771447785);
    let force =
        |a: f64| 2.0 * modulus / (3.0 * radius) * (2.0 * a * a + flat * flat) * (a * a - flat * flat).sqrt();
    let mut ends = [flat, 2.0 * flat];
    for _ in 0..60 {
        let middle = 0.5 * (ends[0] + ends[1]);
        ends[usize::from(force(middle) > load)] = middle;
    }
    let turn = (2.0 * 2.0 * modulus * ends[0] / mass).sqrt() * period;
    let found = found(1e-12)?;
    // All moduli are 1, so rounding decides which is the largest.
    let is_bounce =
        |one: &&Multiplier| (one.re - turn.cos()).abs() < 1e-6 && (one.im - turn.sin().abs()).abs() < 1e-6;
    let bounce = found.multipliers.iter().find(is_bounce).ok_or("no multiplier of the bounce")?;
    assert!((bounce.modulus() - 1.0).abs() < 1e-6, "{bounce:?}");
    let held = found.multipliers.iter().filter(|one| (one.re - 1.0).abs() < 1e-9 && one.im == 0.0).count();
    assert!(held >= 8 && found.is_one_of_many(), "{:?}", found.multipliers);
    Ok(())
}

/// The third body is not influenced by the others. Its multiplier agrees for loose and tight tolerances within the error.
#[test]
fn multipliers_by_loose_tolerances_hold_within_their_errors() -> Result<(), Box<dyn Error>> {
    let [loose, tight] = [found(1e-8)?, found(1e-12)?];
    // Errors due to rounding are estimated and may be too small in one of eight cases, so the median of five is used.
    let mut shares = Vec::new();
    for k in 0..5 {
        let loose = found_with(1e-8, 1.0 + 2e-15 * f64::from(k))?;
        let is_third = |one: &&Multiplier| one.im == 0.0 && (0.4..0.45).contains(&one.re);
        let only = loose.multipliers.iter().find(is_third).ok_or("no multiplier of the third body")?;
        let off = tight.multipliers.iter().filter(|one| one.im == 0.0).map(|one| (one.re - only.re).abs());
        shares.push(off.fold(f64::INFINITY, f64::min) / only.error);
    }
    shares.sort_by(f64::total_cmp);
    assert!(shares[2] < 1.0, "{shares:?}");
    assert!(tight.untold.is_empty() && loose.comes_back().is_none());
    Ok(())
}
