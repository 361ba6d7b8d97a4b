//! What is looked for on a curve: where it meets zero, and where it is best.

use super::ahead::{self, Found};
use super::{Bracket, Curve, CurveError, Kind, Motion, Motionless, Peak, Point, Seen, Traced};
use crate::each::each;
use std::sync::{Mutex, PoisonError};
use stickslip_run::Watcher;
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
    /// Of S₀: whether the drive steps the other way at smaller amplitudes, so that its step changes its sign here.
    pub turns: bool,
    /// Of S₀ where all points step: the smallest amplitude of them, below which it lies.
    pub below: Option<f64>,
    /// Of the amplitude beyond which a drive ceases to step: what cuts its stroke there.
    pub beyond: Option<Beyond>,
}

/// What cuts the stroke beyond the largest amplitude with a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Beyond {
    /// The command leaves the window of a driver.
    Window,
    /// A driver has a largest current, and its window is kept.
    Current,
    /// Neither.
    Other,
}

impl Beyond {
    /// As one word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Window => "window",
            Self::Current => "current",
            Self::Other => "other",
        }
    }
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

/// Why nothing is found where no point has steps at all.
const NO_MOTION: &str = "no point has a motion";

impl From<Motionless> for Unfound {
    fn from(why: Motionless) -> Self {
        if why == Motionless::NotRun { Self::NotRun } else { Self::Motionless(why) }
    }
}

impl Curve {
    /// Adds what is looked for on this curve, to a share of its place, on so many cores; the same for any number. Loads have a stall,
    /// amplitudes S₀, and a largest one with a step where larger ones have none; speeds over frequencies, power against loads, and steps over anything else have a best point. The watcher is told
    /// how much of the way to them is behind, 0 to 1.
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
        let behind = Mutex::new(vec![0.0; sought.len()]);
        let told = |place: usize, share: f64| {
            let mut behind = behind.lock().unwrap_or_else(PoisonError::into_inner);
            behind[place] = share.max(behind[place]);
            watcher.reached(behind.iter().sum::<f64>() / behind.len() as f64);
        };
        let landmarks = each(sought.len(), cores, |place| {
            // Several are looked for side by side, each on its part of the cores.
            let (cores, told) = (cores.div_ceil(sought.len()), &|share| told(place, share));
            let search = Search { traced, tolerance, watcher, cores, told };
            let landmark = match sought[place] {
                // Of half a curve nobody knows where it is best.
                Sought::Edge { name, .. } | Sought::Best { name, .. } if search.traced.is_cut() => {
                    Some(Landmark::unfound(name, Unfound::NotRun, 0))
                }
                Sought::Upper { .. } if search.traced.is_cut() => None,
                Sought::Edge { name, rises } => Some(self.edge(&search, (name, rises))),
                Sought::Upper { name } => self.upper_edge(&search, name),
                Sought::Best { name, yields } => Some(self.best(&search, (name, yields))),
            };
            told(1.0);
            landmark
        });
        traced.landmarks = landmarks.into_iter().flatten().collect();
        Ok(())
    }

    /// What is looked for on a curve of its kind.
    fn sought(&self) -> Vec<Sought> {
        let edge = |name, rises| Sought::Edge { name, rises };
        let best = |name, yields| Sought::Best { name, yields };
        match self.kind {
            Kind::StepAmplitude => vec![edge("zero_step", true), Sought::Upper { name: "zero_step" }],
            Kind::SpeedFrequency => vec![best("best_speed", Yield::Speed)],
            Kind::ForceSpeed => vec![edge("stall", false), best("best_power", Yield::Power)],
            Kind::StepLoad => vec![edge("stall", false)],
            Kind::Preload | Kind::Vary(_) => vec![best("best_step", Yield::Step)],
        }
    }

    /// The motion at a place that is looked at.
    fn look(&self, search: &Search<'_>, at: f64) -> Result<Motion, Motionless> {
        self.motion_at(at, search.traced.direction, search.watcher)
    }

    /// Where steps begin for the last time as something grows, whichever sign it has, or end for the first. They have the sense of the
    /// longest.
    fn edge(&self, search: &Search<'_>, (name, rises): (&'static str, bool)) -> Landmark {
        let traced = search.traced;
        let (sense, lengths) = self.lengths(traced);
        let known = from_steps(&lengths, rises);
        let from = known.iter().position(|(_, step)| step.is_some()).unwrap_or(0);
        let steps: Vec<(f64, f64)> =
            known[from..].iter().map_while(|(at, step)| step.map(|step| (*at, step))).collect();
        let Some((smallest, _)) = steps.last().copied() else {
            let why = if lengths.is_empty() { NO_MOTION } else { "the drive steps at none" };
            return Landmark::unfound(name, Unfound::Outside(why), 0);
        };
        let traced_still = known.get(from + steps.len()).map(|(still, _)| *still);
        // An amplitude of 0 moves nothing.
        let Some(still) = traced_still.or(rises.then_some(0.0)) else {
            return Landmark::unfound(name, Unfound::Outside("the drive steps at all points"), 0);
        };
        let below = traced_still.is_none().then_some(smallest);
        let nearest: Vec<(f64, f64)> = steps.iter().rev().take(2).copied().collect();
        // Of the other sign it steps the other way anyway.
        let side = nearest.first().map_or(1.0, |(at, _)| at.signum());
        let is_smaller = |point: &&Point| (0.0..=(side * still).max(0.0)).contains(&(side * point.value));
        let is_back = |point: &Point| point.motion.as_ref().is_ok_and(|motion| motion.steps(-sense));
        let turns = rises && traced.points.iter().filter(is_smaller).any(is_back);
        let found = self.close_in(search, (name, sense), &Around { lengths, nearest, still });
        Landmark { turns, below, ..found }
    }

    /// Where a drive ceases to step as its amplitude grows; none where the largest has a step, or none has.
    fn upper_edge(&self, search: &Search<'_>, name: &'static str) -> Option<Landmark> {
        let (sense, lengths) = self.lengths(search.traced);
        let known = from_steps(&lengths, true);
        let first = known.iter().position(|(_, step)| step.is_some()).filter(|first| *first > 0)?;
        let (still, _) = *known.get(first - 1)?;
        let steps = known[first..].iter().map_while(|(at, step)| step.map(|step| (*at, step)));
        let nearest: Vec<(f64, f64)> = steps.take(2).collect();
        let beyond = Some(self.beyond(still, search.traced.direction));
        let found = self.close_in(search, (name, sense), &Around { lengths, nearest, still });
        Some(Landmark { beyond, ..found })
    }

    /// What cuts the stroke at an amplitude.
    fn beyond(&self, at: f64, direction: f64) -> Beyond {
        let Ok(job) = self.variant(&self.overrides(at, direction)) else { return Beyond::Other };
        let stacks = &job.scenario.stacks;
        match () {
            () if stacks.iter().any(|stack| stack.cut(&job.scenario.scene).is_some()) => Beyond::Window,
            () if stacks.iter().any(|stack| stack.driver.is_some_and(|spec| spec.current.is_some())) => {
                Beyond::Current
            }
            () => Beyond::Other,
        }
    }

    /// The sense of the steps, and the lengths of all points that have one.
    fn lengths(&self, traced: &Traced) -> (f64, Vec<(f64, Length)>) {
        let sense = if self.kind.is_of_load() { traced.direction } else { sense(traced) };
        let length = |point: &Point| Some((point.value, Length::of(point.motion.clone(), sense).ok()?));
        (sense, traced.points.iter().filter_map(length).collect())
    }

    /// An edge among what is known around it.
    fn close_in(&self, search: &Search<'_>, (name, sense): (&'static str, f64), around: &Around) -> Landmark {
        let Around { lengths, nearest, still } = around;
        let Found { outcome, asked } = ahead::search(
            search.cores,
            |ask| {
                Bracket::narrow(nearest.clone(), *still, search.tolerance, |at, behind| {
                    ask(at, behind).map(|length: Length| length.step)
                })
            },
            |asked, at| {
                let steps = asked.iter().filter_map(|(place, length)| Some((*place, length.step?)));
                let step = ahead::line(steps.chain(nearest.iter().copied()), at);
                Length { step: step.filter(|step| *step > 0.0), error: None, rest: 0.0 }
            },
            |at| Length::of(self.look(search, at), sense),
            search.told,
        );
        let runs = asked.len() as u32;
        match outcome {
            Ok(Some(bracket)) => {
                let heard = asked.into_iter().filter_map(|(at, length)| Some((at, length.ok()?)));
                let all = heard.chain(lengths.iter().copied());
                let ends = all.filter(|(at, _)| [bracket.steps, bracket.still].contains(at));
                let doubt = ends.map(|(_, length)| length.error.unwrap_or(0.0).max(length.rest));
                let doubt = doubt.fold(0.0, f64::max);
                let half_width = bracket.half_width() + doubt / slope(nearest, *still);
                Landmark {
                    at: Ok(bracket.middle()),
                    half_width,
                    ..Landmark::unfound(name, Unfound::NotRun, runs)
                }
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
            let why = match yields {
                _ if known.is_empty() => NO_MOTION,
                Yield::Power => "no point with a step does work against its load",
                Yield::Step | Yield::Speed => "the drive steps at none",
            };
            return Landmark::unfound(name, Unfound::Outside(why), 0);
        };
        if let Some(why) = at_an_end(traced, &known, place) {
            return Landmark::unfound(name, Unfound::Outside(why), 0);
        }
        let within = [known[place - 1].at, known[place + 1].at];
        let Found { outcome, asked } = ahead::search(
            search.cores,
            |ask| Peak::narrow(known[place], within, search.tolerance, ask),
            |asked, at| {
                let all = asked.iter().map(|(_, seen)| seen).chain(&known);
                Seen { at, value: ahead::parabola(all.map(|seen| (seen.at, seen.value)), at), error: 0.0 }
            },
            |at| self.look(search, at).map(|motion| seen(at, &motion)),
            search.told,
        );
        let runs = asked.len() as u32;
        match outcome {
            Ok(peak) => {
                let half_width = 0.5 * (peak.within[1] - peak.within[0]);
                // Of drives that go back it is below 0; power is what goes into a load whichever way.
                let value = if yields == Yield::Power { peak.best.value } else { sense * peak.best.value };
                let blank = Landmark::unfound(name, Unfound::NotRun, runs);
                Landmark { at: Ok(peak.best.at), half_width, value: Some(value), ..blank }
            }
            Err(fault) => Landmark::unfound(name, fault.into(), runs),
        }
    }
}

/// Why the best of the points that have a motion, that at `place`, has none beside it on one side; none where both are there.
fn at_an_end(traced: &Traced, known: &[Seen], place: usize) -> Option<&'static str> {
    let is = |end: Option<&Point>| end.is_some_and(|point| point.value == known[place].at);
    match (place == 0, place + 1 == known.len()) {
        (false, false) => None,
        (true, _) if is(traced.points.first()) => Some("the first point of the range is the best"),
        (_, true) if is(traced.points.last()) => Some("the last point of the range is the best"),
        _ => Some("the points on one side of the best one have no motion"),
    }
}

/// What is looked for.
#[derive(Debug, Clone, Copy)]
enum Sought {
    /// Where steps begin for the last time (`rises`), or end for the first.
    Edge { name: &'static str, rises: bool },
    /// Where a drive that stepped ceases to as its amplitude grows.
    Upper { name: &'static str },
    /// Where something is largest.
    Best { name: &'static str, yields: Yield },
}

/// How it is looked for.
struct Search<'a> {
    traced: &'a Traced,
    tolerance: f64,
    watcher: &'a (dyn Watcher + Sync),
    cores: usize,
    /// Hears how much of the way is behind.
    told: &'a (dyn Fn(f64) + Sync),
}

/// The length of a step, none where there is no step, and its error, where it has one, m.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Length {
    step: Option<f64>,
    error: Option<f64>,
    /// What a step may have and count as none, where there is something of it: the edge is that much farther away.
    rest: f64,
}

/// What is known around an edge: the lengths of all points, the nearest two with a step, and the nearest without.
struct Around {
    lengths: Vec<(f64, Length)>,
    nearest: Vec<(f64, f64)>,
    still: f64,
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

impl Length {
    /// Of a motion, along a sense; nothing where a drive without a motion makes no step.
    fn of(motion: Result<Motion, Motionless>, sense: f64) -> Result<Self, Motionless> {
        match motion {
            Ok(motion) => {
                let step = motion.steps(sense).then_some(sense * motion.step);
                let is_short = step.is_none() && sense * motion.step > motion.error;
                let rest = if is_short { motion.least() } else { 0.0 };
                Ok(Self { step, error: Some(motion.error), rest })
            }
            Err(fault) if fault.makes_no_step() => Ok(Self { step: None, error: None, rest: 0.0 }),
            Err(fault) => Err(fault),
        }
    }
}

impl Landmark {
    /// What it is, in words.
    #[must_use]
    pub fn words(&self) -> &'static str {
        match self.name {
            "zero_step" if self.beyond == Some(Beyond::Window) => {
                "largest amplitude with a step, by the driver's window"
            }
            "zero_step" if self.beyond == Some(Beyond::Current) => {
                "largest amplitude with a step, by the driver's current"
            }
            "zero_step" if self.beyond.is_some() => "largest amplitude with a step",
            "zero_step" if self.turns => {
                "S\u{2080}, zero-step amplitude: forward steps above it, backward steps below"
            }
            "zero_step" => "S\u{2080}, zero-step amplitude",
            "stall" => "stall",
            "best_speed" => "maximum speed",
            "best_power" => "maximum power",
            _ => "maximum step",
        }
    }

    /// What its value is in.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match self.name {
            "best_speed" => "m/s",
            "best_power" => "W",
            _ => "m",
        }
    }

    fn unfound(name: &'static str, why: Unfound, runs: u32) -> Self {
        Self {
            name,
            at: Err(why),
            half_width: 0.0,
            value: None,
            runs,
            turns: false,
            below: None,
            beyond: None,
        }
    }
}

/// The steps of points from the side on which there are some: from the largest amplitude where steps rise with it, from the least load.
fn from_steps(lengths: &[(f64, Length)], rises: bool) -> Vec<(f64, Option<f64>)> {
    let mut known: Vec<(f64, Option<f64>)> = lengths.iter().map(|(at, length)| (*at, length.step)).collect();
    let size = |place: Option<&(f64, Option<f64>)>| place.map_or(0.0, |(at, _)| at.abs());
    if rises && size(known.last()) >= size(known.first()) {
        known.reverse();
    }
    known
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
