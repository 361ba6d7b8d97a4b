//! What is looked for on a curve: where it meets zero, and where it is best.

use super::{Bracket, Curve, CurveError, Kind, Motion, Motionless, Peak, Seen, Traced};
use crate::each::each;
use std::sync::atomic::{AtomicUsize, Ordering};
use stickslip_results::Watcher;
use thiserror::Error;

/// A point of a curve that has a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Landmark {
    /// `zero_step` (S₀: the largest amplitude without a steady step), `stall` (the least load against which there is none), or
    /// `best_speed`, `best_power`, `best_step`.
    pub name: &'static str,
    /// What is varied there, SI, or why that is not known.
    pub at: Result<f64, Unfound>,
    /// How far it may be off: half of the bracket, and at edges by how much the error of the steps there moves it. 0 where it is
    /// not known.
    pub half_width: f64,
    /// What is largest there, SI; none of edges.
    pub value: Option<f64>,
    /// Points that were computed for it.
    pub runs: u32,
}

/// Why a landmark is not found.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Unfound {
    /// All points step, or none.
    #[error("not within the range: {0}")]
    Outside(&'static str),
    /// A point between that has no motion.
    #[error("a point beside it has no motion: {0}")]
    Motionless(Motionless),
    /// Nobody looked, or not to the end.
    #[error("not run")]
    NotRun,
}

impl From<Motionless> for Unfound {
    fn from(why: Motionless) -> Self {
        if why == Motionless::NotRun { Self::NotRun } else { Self::Motionless(why) }
    }
}

impl Curve {
    /// Adds what is looked for on this curve, to a share of its place, on so many cores; the same for any number. Loads have a stall,
    /// amplitudes S₀; speeds over frequencies, power against loads, and steps over anything else have a best point. The watcher is told
    /// how many points were computed for them.
    ///
    /// # Errors
    /// A tolerance out of its range, 1e-9 to 0.1.
    pub fn mark(
        &self,
        traced: &mut Traced,
        tolerance: f64,
        cores: usize,
        watcher: &(dyn Watcher + Sync),
    ) -> Result<(), CurveError> {
        Bracket::check(tolerance)?;
        let sought = self.sought();
        let done = AtomicUsize::new(0);
        let search = Search { traced, tolerance, watcher, done: &done };
        let landmarks = each(sought.len(), cores, |place| match sought[place] {
            // Of half a curve nobody knows where it is best.
            Sought::Edge { name, .. } | Sought::Best { name, .. } if search.traced.is_cut() => {
                Landmark::unfound(name, Unfound::NotRun, 0)
            }
            Sought::Edge { name, rises } => self.edge(&search, (name, rises)),
            Sought::Best { name, yields } => self.best(&search, (name, yields)),
        });
        traced.landmarks = landmarks;
        Ok(())
    }

    /// What is looked for on a curve of its kind.
    fn sought(&self) -> Vec<Sought> {
        let edge = |name, rises| Sought::Edge { name, rises };
        let best = |name, yields| Sought::Best { name, yields };
        match self.kind {
            Kind::StepAmplitude => vec![edge("zero_step", true)],
            Kind::SpeedFrequency => vec![best("best_speed", Yield::Speed)],
            Kind::ForceSpeed => vec![edge("stall", false), best("best_power", Yield::Power)],
            Kind::StepLoad => vec![edge("stall", false)],
            Kind::Preload | Kind::Vary(_) => vec![best("best_step", Yield::Step)],
        }
    }

    /// The motion at a place that is looked at.
    fn look(&self, search: &Search<'_>, at: f64) -> Result<Motion, Motionless> {
        let motion = self.motion_at(at, search.traced.direction, search.watcher);
        search.watcher.reached((search.done.fetch_add(1, Ordering::Relaxed) + 1) as f64);
        motion
    }

    /// Where steps begin for the last time, or end for the first. They have the sense of the longest.
    fn edge(&self, search: &Search<'_>, (name, rises): (&'static str, bool)) -> Landmark {
        let traced = search.traced;
        let sense = if self.kind.is_of_load() { traced.direction } else { sense(traced) };
        let mut errors: Vec<(f64, f64)> = Vec::new();
        let mut length = |at: f64, motion: Result<Motion, Motionless>| match motion {
            Ok(motion) => {
                errors.push((at, motion.error));
                Ok(motion.steps(sense).then_some(sense * motion.step))
            }
            Err(fault) if fault.makes_no_step() => Ok(None),
            Err(fault) => Err(fault),
        };
        let points = traced.points.iter();
        let known =
            points.filter_map(|point| Some((point.value, length(point.value, point.motion.clone()).ok()?)));
        let mut known: Vec<(f64, Option<f64>)> = known.collect();
        // From the side with steps the first place without is the edge's, whichever way it lies.
        if rises {
            known.reverse();
        }
        let from = if rises { 0 } else { known.iter().position(|(_, step)| step.is_some()).unwrap_or(0) };
        let steps: Vec<(f64, f64)> =
            known[from..].iter().map_while(|(at, step)| step.map(|step| (*at, step))).collect();
        let Some((still, _)) = known.get(from + steps.len()).filter(|_| !steps.is_empty()) else {
            let why = match (steps.is_empty(), rises) {
                (false, _) => "the drive steps at all points",
                (true, true) => "no step at the end of the range",
                (true, false) => "the drive steps at none",
            };
            return Landmark::unfound(name, Unfound::Outside(why), 0);
        };
        let nearest: Vec<(f64, f64)> = steps.iter().rev().take(2).copied().collect();
        let slope = slope(&nearest, *still);
        let mut runs = 0;
        let bracket = Bracket::narrow(nearest, *still, search.tolerance, |at| {
            runs += 1;
            length(at, self.look(search, at))
        });
        match bracket {
            Ok(Some(bracket)) => {
                let at_its_ends = errors.iter().filter(|(at, _)| [bracket.steps, bracket.still].contains(at));
                let doubt = at_its_ends.fold(0.0, |most: f64, (_, error)| most.max(*error)) / slope;
                let half_width = bracket.half_width() + doubt;
                Landmark { name, at: Ok(bracket.middle()), half_width, value: None, runs }
            }
            Ok(None) => Landmark::unfound(name, Unfound::Outside("the drive steps at none"), runs),
            Err(fault) => Landmark::unfound(name, fault.into(), runs),
        }
    }

    /// The best place, between the neighbours of the best point.
    fn best(&self, search: &Search<'_>, (name, yields): (&'static str, Yield)) -> Landmark {
        let traced = search.traced;
        let sense = if self.kind.is_of_load() { traced.direction } else { sense(traced) };
        let seen = |at: f64, motion: &Motion| {
            let per_step = match yields {
                Yield::Step => 1.0,
                Yield::Speed => motion.period.recip(),
                Yield::Power => at / motion.period,
            };
            Seen { at, value: sense * per_step * motion.step, error: per_step.abs() * motion.error }
        };
        let points = traced.points.iter().filter_map(|point| {
            let motion = point.motion.as_ref().ok()?;
            Some(seen(point.value, motion))
        });
        let known: Vec<Seen> = points.collect();
        let best = (0..known.len()).max_by(|a, b| known[*a].value.total_cmp(&known[*b].value));
        let Some(place) = best.filter(|place| known[*place].value > known[*place].error) else {
            return Landmark::unfound(name, Unfound::Outside("the drive steps at none"), 0);
        };
        if place == 0 || place + 1 == known.len() {
            return Landmark::unfound(name, Unfound::Outside("it is at an end, or beyond"), 0);
        }
        let within = [known[place - 1].at, known[place + 1].at];
        let mut runs = 0;
        let peak = Peak::narrow(known[place], within, search.tolerance, |at| {
            runs += 1;
            self.look(search, at).map(|motion| seen(at, &motion))
        });
        match peak {
            Ok(peak) => {
                let half_width = 0.5 * (peak.within[1] - peak.within[0]);
                Landmark { name, at: Ok(peak.best.at), half_width, value: Some(peak.best.value), runs }
            }
            Err(fault) => Landmark::unfound(name, fault.into(), runs),
        }
    }
}

/// What is looked for.
#[derive(Debug, Clone, Copy)]
enum Sought {
    /// Where steps begin for the last time (`rises`), or end for the first.
    Edge { name: &'static str, rises: bool },
    /// Where something is largest.
    Best { name: &'static str, yields: Yield },
}

/// How it is looked for, and how many points were computed for it.
struct Search<'a> {
    traced: &'a Traced,
    tolerance: f64,
    watcher: &'a (dyn Watcher + Sync),
    done: &'a AtomicUsize,
}

/// What is largest at the best point of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Yield {
    /// The step, m.
    Step,
    /// The mean speed, m/s.
    Speed,
    /// Mean speed times load, W.
    Power,
}

impl Landmark {
    /// What it is, in words.
    #[must_use]
    pub fn words(&self) -> &'static str {
        match self.name {
            "zero_step" => "S\u{2080}, largest amplitude without a step",
            "stall" => "stall",
            "best_speed" => "fastest",
            "best_power" => "most power",
            _ => "longest step",
        }
    }

    fn unfound(name: &'static str, why: Unfound, runs: u32) -> Self {
        Self { name, at: Err(why), half_width: 0.0, value: None, runs }
    }
}

/// By how much steps become longer with the distance from where there is none: between the two places nearest to it, or from the
/// nearest to a place without.
fn slope(nearest: &[(f64, f64)], still: f64) -> f64 {
    let (at, step) = nearest.first().copied().unwrap_or((still, 0.0));
    let (other, longer) = nearest.get(1).copied().unwrap_or((still, 0.0));
    ((step - longer) / (at - other)).abs()
}

/// Sense of the longest step, 1 or -1.
fn sense(traced: &Traced) -> f64 {
    let steps = traced.points.iter().filter_map(|point| point.motion.as_ref().ok()).map(|motion| motion.step);
    let longest = steps.max_by(|a, b| a.abs().total_cmp(&b.abs()));
    if longest.is_some_and(|step| step < 0.0) { -1.0 } else { 1.0 }
}
