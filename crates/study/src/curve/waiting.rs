//! Steady motion waited for: a run, period by period.
//!
//! Lengths of steps s₀, s₁, … are those of the periods of the figures' waveform. They are steady where what is still to come is
//! known to be nothing: near a steady motion the changes eₖ = sₖ - sₖ₋₁ fall by a fixed share r from period to period, so that
//! eₖ r/(1-r) is left of the way to the limit (Aitken, *Proc. R. Soc. Edinburgh* 46 (1926) 289). Creep falls so slowly that it is
//! not waited for: where three limits by Aitken's rule agree, that is the step.

use super::motion::{Course, Motion, Motionless, STILL, natural, waveform};
use stickslip_analysis::{Bounds, Settling};
use stickslip_drive::{Event, Plan, Record, Run, RunError};
use stickslip_results::{Job, Watcher};

/// Most periods that are waited for.
const WAITED: u32 = 400;
/// What may be left of the way to the limit, as a share of the step or of the natural length of the body's contacts, whichever
/// is longer.
const LEFT: f64 = 1e-6;
/// Fewest steps that say anything.
const FEWEST: usize = 5;
/// How many limits must agree.
const AGREEING: usize = 3;
/// Where the changes of steps are rounding, as a share of their scale.
const ROUNDING: f64 = 1e-11;

/// Runs a job period by period until its steps are steady.
pub(super) fn waited(job: &Job, watcher: &dyn Watcher) -> Result<Motion, Motionless> {
    let body = job.scenario.figures.body.ok_or(Motionless::NoSteps)?;
    let waveform = waveform(job)?;
    let period = waveform.period().ok_or(Motionless::NoSteps)?;
    let (start, stop) = waveform.window();
    let cycles = ((stop - start) / period * (1.0 + 1e-12)).floor();
    let most = f64::from(WAITED).min(cycles) as u32;
    if (most as usize) < FEWEST {
        return Err(Motionless::Ends(most));
    }
    let failed = |error: RunError| match error {
        RunError::Interrupted { .. } => Motionless::NotRun,
        error => Motionless::Run(error),
    };
    let plan = Plan { every: None, until_steady: None, ..job.scenario.plan };
    let mut run = Run::new(&job.model, &plan, job.start.clone()).map_err(failed)?;
    let mut looker = Looker(watcher);
    let mut place = |k: u32| -> Result<f64, Motionless> {
        // A cheap period is over before its run asks.
        if !watcher.goes_on() {
            return Err(Motionless::NotRun);
        }
        run.advance(start + f64::from(k) * period, &mut looker).map_err(failed)?;
        run.state().body(&job.model, body).map(|(x, _)| x).ok_or(Motionless::NoSteps)
    };
    let natural = natural(job, body);
    let motion = |step, error, spread, course, work| Motion {
        step,
        error,
        spread,
        period,
        course,
        multiplier: None,
        work,
        natural,
    };
    let (mut before, mut steps) = (place(0)?, Vec::new());
    for k in 1..=most {
        let x = place(k)?;
        steps.push(x - before);
        before = x;
        if let Some((limit, error)) = limit(&steps, natural, LEFT) {
            return Ok(motion(limit, error, 0.0, Course::Steady, k));
        }
    }
    let (course, step, error, spread) = judged(&steps, natural)?;
    Ok(motion(step, error, spread, course, most))
}

/// The limit of steps and how far it may be off, where they are steady.
fn limit(steps: &[f64], natural: f64, change: f64) -> Option<(f64, f64)> {
    if steps.len() < FEWEST {
        return None;
    }
    let last = *steps.last()?;
    let scale = steps.iter().rev().take(FEWEST).fold(natural, |most, step| most.max(step.abs()));
    let changes: Vec<f64> = steps.windows(2).rev().take(AGREEING + 1).map(|pair| pair[1] - pair[0]).collect();
    let largest = changes.iter().take(AGREEING).fold(0.0, |most: f64, e| most.max(e.abs()));
    if largest <= ROUNDING * scale {
        return Some((last, largest));
    }
    let shares: Vec<f64> = changes.windows(2).map(|pair| pair[0] / pair[1]).collect();
    let slowest = shares.iter().fold(0.0, |most: f64, share| most.max(share.abs()));
    if slowest.is_nan() || slowest >= 1.0 {
        return None;
    }
    let left = changes[0].abs() * slowest / (1.0 - slowest);
    if left <= change * scale {
        return Some((last, left));
    }
    // Aitken's rule from each of the last periods.
    let limits: Vec<f64> = (0..AGREEING)
        .map(|back| steps[steps.len() - 1 - back] + changes[back] * shares[back] / (1.0 - shares[back]))
        .collect();
    let apart = limits.iter().fold(0.0, |most: f64, limit| most.max((limit - limits[0]).abs()));
    let is_creep = shares.iter().all(|share| *share > 0.0);
    (is_creep && apart <= 0.1 * change * scale).then_some((limits[0], 10.0 * apart))
}

/// What steps do that have not become steady: with a step, its error and the spread.
fn judged(steps: &[f64], natural: f64) -> Result<(Course, f64, f64, f64), Motionless> {
    let half = &steps[steps.len() / 2..];
    let mean = half.iter().sum::<f64>() / half.len() as f64;
    let bounds = Bounds { least: STILL * natural, most: f64::INFINITY, error: 0.0 };
    match Settling::of(steps, bounds) {
        Settling::Settled(settled) => Ok((Course::Steady, settled.value, settled.error, 0.0)),
        Settling::Beats { about, amplitude, .. } => Ok((Course::Beats, about, amplitude, amplitude)),
        Settling::Irregular { spread } => Ok((Course::Irregular, mean, spread, spread)),
        Settling::Drifts { .. } | Settling::NotSettled { .. } => {
            let step = steps.last().copied().unwrap_or(0.0);
            let change = steps.windows(2).last().map_or(0.0, |pair| pair[1] - pair[0]);
            Err(Motionless::Unsettled { periods: steps.len() as u32, step, change })
        }
    }
}

/// A record that keeps nothing and hears when it is to end.
struct Looker<'a>(&'a dyn Watcher);

impl Record for Looker<'_> {
    fn row(&mut self, _: &[f64]) {}
    fn event(&mut self, _: &Event, _: &[f64]) {}
    fn wants_events(&self) -> bool {
        false
    }
    fn goes_on(&mut self, _: f64) -> bool {
        self.0.goes_on()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// s + a rᵏ: the limit s is known after few values, long before they have come there.
    #[test]
    fn a_slow_approach_is_not_waited_for() {
        let steps = |count: i32, share: f64| -> Vec<f64> {
            (0..count).map(|k| 3e-8 + 1e-8 * share.powi(k)).collect()
        };
        let (found, error) = limit(&steps(8, 0.99), 4e-8, 1e-6).unwrap();
        assert!((found - 3e-8).abs() < 1e-14 && error < 1e-13, "{found} {error}");
        let (found, error) = limit(&steps(60, 0.7), 4e-8, 1e-6).unwrap();
        assert!((found - 3e-8).abs() <= error.max(1e-22), "{found} {error}");
        // Two rates at once follow no single share.
        let mixed: Vec<f64> = (0..8).map(|k| 1e-8 * (0.9_f64.powi(k) + 0.5_f64.powi(k))).collect();
        assert_eq!(limit(&mixed, 4e-8, 1e-6), None);
    }

    #[test]
    fn what_grows_or_swings_is_no_limit() {
        let grows: Vec<f64> = (0..50).map(|k| 1e-9 * 1.01_f64.powi(k)).collect();
        assert_eq!(limit(&grows, 4e-8, 1e-6), None);
        let swings: Vec<f64> = (0..50).map(|k| 1e-8 * (1.0 + 0.1 * f64::from(k).sin())).collect();
        assert_eq!(limit(&swings, 4e-8, 1e-6), None);
        let (course, step, ..) = judged(&swings, 4e-8).unwrap();
        assert!(matches!(judged(&grows, 4e-8), Err(Motionless::Unsettled { periods: 50, .. })));
        assert_eq!(course, Course::Beats);
        assert!((step - 1e-8).abs() < 1e-11, "{step}");
    }
}
