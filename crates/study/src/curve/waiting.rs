//! Steady motion waited for: a run, period by period.
//!
//! Lengths of steps s₀, s₁, … are those of the periods of the figures' waveform. They are steady where what is still to come is
//! known to be nothing: near a steady motion the changes eₖ = sₖ - sₖ₋₁ fall by a fixed share r from period to period, so that
//! eₖ r/(1-r) is left of the way to the limit (Aitken, *Proc. R. Soc. Edinburgh* 46 (1926) 289). Creep falls so slowly that it is
//! not waited for: where three limits by Aitken's rule agree, that is the step, unless rounding could have made them agree: what it
//! does to a limit grows as 1/(1-r)², and steps that grow evenly, as where a load drags the body away, have r = 1.
//!
//! What a body flies or slides in a period may be even by itself: only steps in which a contact holds it are taken for steady.
//!
//! A run that begins near a motion that it leaves stays with it as long as a disturbance takes to grow. It is run on, and what has not left
//! is no motion that a drive would have in the end.

use super::motion::{Course, Motion, Motionless, STILL, natural, waveform};
use crate::grip::{Grip, Loose};
use stickslip_drive::{Event, Plan, Record, Run, RunError};
use stickslip_measure::{Bounds, Mean, Moved, Settling};
use stickslip_run::summary::step_bounds;
use stickslip_run::{Job, Watcher};

/// Most periods that are waited for, and while a swing about a motion that a run leaves is growing.
const WAITED: u32 = 400;
const LEAVING: u32 = 10_000;
/// What may be left of the way to the limit, as a share of the step or of the natural length of the body's contacts, whichever
/// is longer.
const LEFT: f64 = 1e-6;
/// Periods for which a limit has to last: what a memory forgets slowly shows when all else is over. Steps of 1.6 pm that were to fade to
/// nothing were told within 0.7 fm.
const LASTING: u32 = 16;
/// Fewest steps that say anything.
const FEWEST: usize = 5;
/// How many limits must agree.
const AGREEING: usize = 3;
/// By which share a beat that stays as it is may be larger or smaller in the last quarter of the periods than in the one before.
const STAYS: f64 = 0.05;
/// How many times as far as a mean that becomes slower has to go it may go.
const SURE: f64 = 2.0;
/// By which share it may be so by the whole of the last half, as its fit tells.
const DRIFTS: f64 = 0.01;
/// Part of the growth of a disturbance at which a swing has not grown with it.
const LAGS: f64 = 0.1;
/// By which power of e rounding has become anything.
const OUTGROWN: f64 = 80.0;
/// How many times the least step those of a waveform that ends may ring, whose mean is none.
const RINGS: f64 = 10.0;
/// By which share what has left a motion may range wider or less in the last quarter than in the one before.
const WIDER: f64 = 0.25;
/// Where the changes of steps are rounding, as a share of their scale.
const ROUNDING: f64 = 1e-11;

/// A motion that repeats itself and that a run leaves: its step and how far that may be off, m, and by which factor a disturbance grows
/// in a period.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unstable {
    pub(super) step: f64,
    pub(super) error: f64,
    pub(super) growth: f64,
}

/// Runs a job period by period until its steps are steady: on another motion than the one it `leaves`, if there is one.
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
        // A cheap period is over before its run asks.
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
    // Since when there is a limit, and which.
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

/// Since which period a limit is the same, and which it was then, m, with what was known of it before.
fn lasts(since: Option<(u32, Mean)>, (k, limit): (u32, Mean), natural: f64) -> (u32, Mean) {
    let is_same =
        |first: &Mean| (limit.value - first.value).abs() <= first.error.max(ROUNDING * natural) + limit.error;
    since.filter(|(_, first)| is_same(first)).unwrap_or((k, limit))
}

impl Unstable {
    /// Whether a limit of steps, m, is that of another motion.
    fn is_other(&self, limit: &Mean, near: f64) -> bool {
        (limit.value - self.step).abs() > limit.error + self.error + near
    }

    /// Whether what steps do, which swing with a period, in steps, may be that of a run that has not left, or is on its way: they are those of
    /// this motion, range wider than before, or have another mean.
    fn may_hold(&self, steps: &[f64], (course, mean, spread): (Course, Mean, f64), period: f64) -> bool {
        if course == Course::Steady {
            // What rounding has had so long to grow by, and has not, does not grow.
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

/// How the mean of steps that swing with a period, in steps, moves by more than chance and rounding; none where it does not, or they are
/// too few to tell.
fn moved(steps: &[f64], period: f64) -> Option<Moved> {
    let scale = steps.iter().fold(0.0, |most: f64, step| most.max(step.abs()));
    Mean::moved(steps, period).filter(|moved| moved.by > ROUNDING * scale)
}

/// In which periods something held the body.
#[derive(Debug, Clone, Copy, Default)]
struct Hold {
    /// How many there were when the last was over in which nothing did, and in which something did.
    loose_until: usize,
    held_until: usize,
    /// What it did in the last, if nothing held it.
    loose: Option<Loose>,
}

impl Hold {
    fn note(&mut self, count: usize, loose: Option<Loose>) {
        let until = if loose.is_some() { &mut self.loose_until } else { &mut self.held_until };
        (*until, self.loose) = (count, loose);
    }
}

/// The limit of steps and how far it may be off, where they are steady.
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
    // Aitken's rule from each of the last periods.
    let limits: Vec<f64> = (0..AGREEING)
        .map(|back| steps[steps.len() - 1 - back] + changes[back] * shares[back] / (1.0 - shares[back]))
        .collect();
    let apart = limits.iter().fold(0.0, |most: f64, limit| most.max((limit - limits[0]).abs()));
    let rounding = ROUNDING * scale / (1.0 - slowest).powi(2);
    let is_creep = shares.iter().all(|share| *share > 0.0);
    let agree = apart <= 0.1 * change * scale && rounding <= change * scale;
    (is_creep && agree).then(|| Mean { value: limits[0], error: 10.0 * apart + rounding })
}

/// What steps do that have not become steady: with their mean and by how much they swing about it.
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
    // Even steps are what they are, however long: whether they are none is a matter of what holds the body.
    let settling = Settling::of(steps, Bounds { most: f64::INFINITY, ..bounds });
    let slides = Motionless::SlidesAway { periods, step: last, change };
    let swings = matches!(settling, Settling::Beats { .. } | Settling::Irregular { .. });
    // What hops may touch in every third period alone.
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
    // Too few swings say no more than that the mean lies between their ends.
    let mean = |period, spread| Mean::of(half, period).unwrap_or(Mean { value: plain, error: spread });
    let (found, period) = match settling {
        Settling::Settled(settled) => {
            ((Course::Steady, Mean { value: settled.value, error: settled.error }, 0.0), 0.0)
        }
        Settling::Beats { period, growth, amplitude, .. } => {
            let Mean { value, error } = mean(period, amplitude);
            // One that goes on growing or fading takes the mean with it, and nobody knows how far. What has left a motion is asked below.
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
            // Where nobody knows how long a step can be, one that grows to no limit that is foreseen.
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

/// How far the first half of steps ranges, and the last.
fn extents(steps: &[f64]) -> [f64; 2] {
    let (first, last) = steps.split_at(steps.len() / 2);
    [extent(first), extent(last)]
}

/// How far apart the longest and the shortest step are.
fn extent(steps: &[f64]) -> f64 {
    let bounds = |(low, high): (f64, f64), step: &f64| (low.min(*step), high.max(*step));
    let (low, high) = steps.iter().fold((f64::INFINITY, f64::NEG_INFINITY), bounds);
    high - low
}

/// A record that keeps nothing, hears when it is to end, and what happens to contacts.
struct Looker<'a> {
    watcher: &'a dyn Watcher,
    grip: Grip,
}

impl Record for Looker<'_> {
    fn row(&mut self, _: &[f64]) {}
    fn event(&mut self, event: &Event, _: &[f64]) {
        self.grip.event(event);
    }
    fn wants_event_rows(&self) -> bool {
        false
    }
    fn goes_on(&mut self, _: f64) -> bool {
        self.watcher.goes_on()
    }
}

#[cfg(test)]
mod tests;
