//! Steady motion by simulation, period by period.
//!
//! The step length sₖ is the displacement in period k of the waveform named in `figures`. Near a periodic orbit, the changes eₖ = sₖ - sₖ₋₁
//! decrease by a constant ratio r per period. The remaining change is then eₖ r/(1-r) (Aitken, *Proceedings of the Royal Society of
//! Edinburgh* 46 (1926) 289). The motion is steady if the remaining change is negligible.
//!
//! Creep decays slowly, so the simulation does not wait for the end of creep. If three successive limits by Aitken's rule agree, their
//! value is the step length. Rounding errors of a limit grow as 1/(1-r)²; limits that rounding could have made equal are rejected. For
//! example, a load that drags the body away has r = 1.
//!
//! A body that flies or slides may move a constant distance per period. Periods in which no contact holds the body do not count as steady.
//!
//! A run that begins near an unstable periodic orbit stays near this orbit until a disturbance has grown. The run continues until it has
//! left the orbit.

use super::motion::{Course, Motion, Motionless, STILL, natural, waveform};
use crate::grip::{Grip, Loose};
use stickslip_drive::{Entry, Plan, Record, Run, RunError, Wants};
use stickslip_measure::{Bounds, Mean, Moved, Settling};
use stickslip_run::summary::step_bounds;
use stickslip_run::{Job, Watcher};

/// Maximum number of periods: normally, and while an oscillation about an unstable periodic orbit grows.
const WAITED: u32 = 400;
const LEAVING: u32 = 10_000;
/// Largest remaining change of a step length that counts as steady, relative to the larger of the step length and u_c.
const LEFT: f64 = 1e-6;
/// Number of periods for which an extrapolated limit must remain constant, so that slow changes of the slip memory become visible.
const LASTING: u32 = 16;
/// Minimum number of step lengths for the extrapolation of their limit.
const FEWEST: usize = 5;
/// Number of successive extrapolated limits that must agree.
const AGREEING: usize = 3;
/// Largest relative change, from the third to the last quarter of the periods, of the range of an oscillation with constant amplitude.
const STAYS: f64 = 0.05;
/// Safety factor on the extrapolated remaining change of a mean whose drift slows down.
const SURE: f64 = 2.0;
/// Largest relative growth, fitted over the second half of the periods, of an amplitude that counts as constant.
const DRIFTS: f64 = 0.01;
/// Smallest growth of an oscillation, relative to the predicted growth of a disturbance, for an oscillation that still grows.
const LAGS: f64 = 0.1;
/// Logarithm of the factor by which a disturbance must grow from rounding error to become visible.
const OUTGROWN: f64 = 80.0;
/// Largest step, as a multiple of the shortest displacement that counts as a step, that counts as ringing about zero.
const RINGS: f64 = 10.0;
/// Largest relative change of the range of a motion that has left an unstable orbit, from the third to the last quarter of the periods.
const WIDER: f64 = 0.25;
/// Changes of the step length below this fraction of the step length or of u_c are rounding errors.
const ROUNDING: f64 = 1e-11;

/// Unstable periodic orbit: step length and its error, m, and growth factor of a disturbance per period.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unstable {
    pub(super) step: f64,
    pub(super) error: f64,
    pub(super) growth: f64,
}

/// Simulates a scenario until its steps are steady. The steady steps must differ from those of the unstable orbit `leaves`, if given.
///
/// # Errors
/// Fails if the waveform ends too early, the run fails, or the steps are not steady after the maximum number of
/// periods.
pub(super) fn waited(
    job: &Job,
    watcher: &dyn Watcher,
    leaves: Option<Unstable>,
) -> Result<Motion, Motionless> {
    let body = job.scenario.figures.body.ok_or(Motionless::NoSteps)?;
    let waveform = waveform(job)?;
    let period = waveform.period().ok_or(Motionless::NoSteps)?;
    let (start, stop) = waveform.window();
    let cycles = ((stop - start) / period * (1.0 + 1e-12)).floor();
    let most = f64::from(if leaves.is_some() { LEAVING } else { WAITED }).min(cycles) as u32;
    if (most as usize) < FEWEST {
        return Err(Motionless::Ends(most));
    }
    let failed = |error: RunError| match error {
        RunError::Interrupted { .. } => Motionless::NotRun,
        error => Motionless::Stopped(error.to_string()),
    };
    let plan = Plan { every: None, until_steady: None, ..job.scenario.plan };
    let mut run = Run::new(&job.model, &plan, job.start.clone()).map_err(failed)?;
    let mut looker = Looker { watcher, grip: Grip::new(job, body) };
    let mut place = |k: u32| -> Result<(f64, Option<Loose>), Motionless> {
        // A short period may end before the run calls `goes_on`.
        if !watcher.goes_on() {
            return Err(Motionless::NotRun);
        }
        looker.grip.begin();
        run.advance(start + f64::from(k) * period, &mut looker).map_err(failed)?;
        let x = run.state().body(&job.model, body).map(|(x, _)| x).ok_or(Motionless::NoSteps)?;
        Ok((x, looker.grip.loose(&job.model, &run)))
    };
    let natural = natural(job, body);
    let bounds = Bounds { least: STILL * natural, error: 0.0, ..step_bounds(job) };
    let motion = |(course, mean, spread): (Course, Mean, f64), work| {
        let (step, error, multiplier) = (mean.value, mean.error, None);
        Motion { step, error, spread, period, course, multiplier, work, natural }
    };
    let ((mut before, _), mut steps, mut hold) = (place(0)?, Vec::new(), Hold::default());
    // Period since which the extrapolated limit is constant, and the limit in that period.
    let mut since: Option<(u32, Mean)> = None;
    let mut k = 0;
    loop {
        k += 1;
        let (x, loose) = place(k)?;
        steps.push(x - before);
        before = x;
        hold.note(k as usize, loose);
        let other = |limit: &Mean| leaves.is_none_or(|it| it.is_other(limit, LEFT * natural));
        let limit = limit(&steps[hold.loose_until..], natural, LEFT).filter(other);
        since = limit.map(|limit| lasts(since, (k, limit), natural));
        if let (Some(limit), Some((from, _))) = (limit, since)
            && (k - from >= LASTING || k == most)
        {
            return Ok(motion((Course::Steady, limit, 0.0), k));
        }
        if k == most || k % WAITED == 0 {
            match judged(&steps, hold, bounds, leaves) {
                Err(Motionless::Grows { .. } | Motionless::Unsettled { .. }) if k < most => (),
                found => return Ok(motion(found?, k)),
            }
        }
    }
}

/// Returns the period since which the extrapolated limit is constant, with the limit and its error in that period.
fn lasts(since: Option<(u32, Mean)>, (k, limit): (u32, Mean), natural: f64) -> (u32, Mean) {
    let is_same =
        |first: &Mean| (limit.value - first.value).abs() <= first.error.max(ROUNDING * natural) + limit.error;
    since.filter(|(_, first)| is_same(first)).unwrap_or((k, limit))
}

impl Unstable {
    /// Returns whether a limit of the step length, m, belongs to another motion than the unstable orbit.
    fn is_other(&self, limit: &Mean, near: f64) -> bool {
        (limit.value - self.step).abs() > limit.error + self.error + near
    }

    /// Returns whether the run may still be near the unstable orbit or in transition from it.
    ///
    /// The run may still be near the orbit if the steps oscillate about the step length of the orbit, their range changes or their mean
    /// drifts. `period` is the period of the oscillation in steps.
    fn may_hold(&self, steps: &[f64], (course, mean, spread): (Course, Mean, f64), period: f64) -> bool {
        if course == Course::Steady {
            // If rounding errors have had time to grow into a visible disturbance, steady steps belong to another, stable motion.
            let has_grown = math::ln(self.growth) * (2 * steps.len()) as f64 > OUTGROWN;
            return !has_grown && !self.is_other(&mean, 0.0);
        }
        let [before, after] = extents(steps);
        let wider = (after / before - 1.0).abs();
        let grown = math::powf(self.growth, (steps.len() - steps.len() / 2) as f64) - 1.0;
        let swings_on = (mean.value - self.step).abs() < spread && wider > LAGS * grown.min(1.0);
        swings_on || wider.is_nan() || wider > WIDER || moved(steps, period).is_some()
    }
}

/// Returns the drift of the mean of oscillating steps if it exceeds statistical scatter and rounding errors. Returns `None` otherwise or
/// for too few steps. `period` is the period of the oscillation in steps.
fn moved(steps: &[f64], period: f64) -> Option<Moved> {
    let scale = steps.iter().fold(0.0, |most: f64, step| most.max(step.abs()));
    Mean::moved(steps, period).filter(|moved| moved.by > ROUNDING * scale)
}

/// Periods in which contacts held the body.
#[derive(Debug, Clone, Copy, Default)]
struct Hold {
    /// Number of the last period in which no contact held the body, and of the last period in which a contact held the body.
    loose_until: usize,
    held_until: usize,
    /// State of the body in the last period if no contact held it.
    loose: Option<Loose>,
}

impl Hold {
    fn note(&mut self, count: usize, loose: Option<Loose>) {
        let until = if loose.is_some() { &mut self.loose_until } else { &mut self.held_until };
        (*until, self.loose) = (count, loose);
    }
}

/// Returns the limit of the step length with its error if the steps are steady.
fn limit(steps: &[f64], natural: f64, change: f64) -> Option<Mean> {
    if steps.len() < FEWEST {
        return None;
    }
    let last = *steps.last()?;
    let scale = steps.iter().rev().take(FEWEST).fold(natural, |most, step| most.max(step.abs()));
    let changes: Vec<f64> = steps.windows(2).rev().take(AGREEING + 1).map(|pair| pair[1] - pair[0]).collect();
    let largest = changes.iter().take(AGREEING).fold(0.0, |most: f64, e| most.max(e.abs()));
    if largest <= ROUNDING * scale {
        return Some(Mean { value: last, error: largest });
    }
    let shares: Vec<f64> = changes.windows(2).map(|pair| pair[0] / pair[1]).collect();
    let slowest = shares.iter().fold(0.0, |most: f64, share| most.max(share.abs()));
    if slowest.is_nan() || slowest >= 1.0 {
        return None;
    }
    let left = changes[0].abs() * slowest / (1.0 - slowest);
    if left <= change * scale {
        return Some(Mean { value: last, error: left });
    }
    // Limit by Aitken's rule for each of the last periods.
    let limits: Vec<f64> = (0..AGREEING)
        .map(|back| steps[steps.len() - 1 - back] + changes[back] * shares[back] / (1.0 - shares[back]))
        .collect();
    let apart = limits.iter().fold(0.0, |most: f64, limit| most.max((limit - limits[0]).abs()));
    let rounding = ROUNDING * scale / (1.0 - slowest).powi(2);
    let is_creep = shares.iter().all(|share| *share > 0.0);
    let agree = apart <= 0.1 * change * scale && rounding <= change * scale;
    (is_creep && agree).then(|| Mean { value: limits[0], error: 10.0 * apart + rounding })
}

/// Evaluates step lengths that are not constant. Returns the type of motion, the mean step length and the oscillation amplitude.
///
/// # Errors
/// Fails if the body slides away or flies, or the steps have no stationary behaviour yet.
fn judged(
    steps: &[f64],
    hold: Hold,
    bounds: Bounds,
    leaves: Option<Unstable>,
) -> Result<(Course, Mean, f64), Motionless> {
    let periods = steps.len() as u32;
    let half = &steps[steps.len() / 2..];
    let last = steps.last().copied().unwrap_or(0.0);
    let change = steps.windows(2).last().map_or(0.0, |pair| pair[1] - pair[0]);
    // The step length has no upper bound here. Whether a large displacement is a step depends on the contacts that hold the body.
    let settling = Settling::of(steps, Bounds { most: f64::INFINITY, ..bounds });
    let slides = Motionless::SlidesAway { periods, step: last, change };
    let swings = matches!(settling, Settling::Beats { .. } | Settling::Irregular { .. });
    // A hopping body may touch its support in every third period only.
    let long = if swings { half.len() } else { (steps.len() / 10).max(1) };
    let is_loose = steps.len() - hold.held_until >= long;
    match hold.loose.filter(|_| is_loose && last.abs() > bounds.least) {
        Some(Loose::Flies) => return Err(Motionless::Flies { periods }),
        Some(Loose::Slides) => return Err(slides),
        None => {}
    }
    let plain = half.iter().sum::<f64>() / half.len() as f64;
    let end = &steps[steps.len() - (steps.len() / 4).max(2).min(steps.len())..];
    let largest = end.iter().fold(0.0, |most: f64, step| most.max(step.abs()));
    let rings =
        (end.iter().sum::<f64>() / end.len() as f64).abs() <= bounds.least && largest <= RINGS * bounds.least;
    // Too few oscillations only show that the mean step length lies between the extremes of the steps.
    let mean = |period, spread| Mean::of(half, period).unwrap_or(Mean { value: plain, error: spread });
    let (found, period) = match settling {
        Settling::Settled(settled) => {
            ((Course::Steady, Mean { value: settled.value, error: settled.error }, 0.0), 0.0)
        }
        Settling::Beats { period, growth, amplitude, .. } => {
            let Mean { value, error } = mean(period, amplitude);
            // A growing or decaying oscillation changes the mean by an unknown amount. Motions leaving an unstable orbit are examined
            // below.
            let [before, after] = extents(half);
            let drifts = growth.is_some_and(|growth| (math::ln(growth) * half.len() as f64).abs() > DRIFTS);
            let stays = leaves.is_some() || !drifts && (after - before).abs() <= STAYS * before;
            let to_go = moved(half, period).map_or(0.0, |moved| SURE * moved.to_go);
            let error = error.max(if stays { to_go.min(amplitude) } else { amplitude });
            ((Course::Beats, Mean { value, error }, amplitude), period)
        }
        Settling::Irregular { spread } => {
            let Mean { value, error } = mean(0.0, spread);
            let error = error.max(moved(half, 0.0).map_or(0.0, |moved| moved.by));
            ((Course::Irregular, Mean { value, error }, spread), 0.0)
        }
        Settling::Drifts { .. } | Settling::NotSettled { .. } if rings => {
            ((Course::Steady, Mean { value: last, error: largest }, 0.0), 0.0)
        }
        Settling::Drifts { .. } | Settling::NotSettled { .. } => {
            // If no upper bound of the step length is known, steps that grow without a predicted limit count as sliding.
            let is_foreseen = matches!(settling, Settling::NotSettled { limit: Some(_), .. });
            let grows = bounds.most == f64::INFINITY && change * last > 0.0 && !is_foreseen;
            return Err(match grows || last.abs() > bounds.most {
                true => slides,
                false => Motionless::Unsettled { periods, step: last, change },
            });
        }
    };
    match leaves.filter(|unstable| unstable.may_hold(half, found, period)) {
        Some(Unstable { growth, .. }) => {
            let (_, Mean { value: step, .. }, spread) = found;
            Err(Motionless::Grows { periods, step, spread, growth })
        }
        None => Ok(found),
    }
}

/// Returns the ranges of the step lengths in the first and in the second half of the steps.
fn extents(steps: &[f64]) -> [f64; 2] {
    let (first, last) = steps.split_at(steps.len() / 2);
    [extent(first), extent(last)]
}

/// Returns the difference of the largest and smallest step length.
fn extent(steps: &[f64]) -> f64 {
    let bounds = |(low, high): (f64, f64), step: &f64| (low.min(*step), high.max(*step));
    let (low, high) = steps.iter().fold((f64::INFINITY, f64::NEG_INFINITY), bounds);
    high - low
}

/// Receiver of run output that passes contact events to the [`Grip`] observer and lets the watcher interrupt the run.
struct Looker<'a> {
    watcher: &'a dyn Watcher,
    grip: Grip,
}

impl Record for Looker<'_> {
    fn take(&mut self, entry: Entry<'_>) {
        if let Entry::Event(event, _) = entry {
            self.grip.event(event);
        }
    }

    fn wants(&self) -> Wants {
        Wants::bare_events()
    }

    fn goes_on(&mut self, _: f64) -> bool {
        self.watcher.goes_on()
    }
}

#[cfg(test)]
mod tests;
