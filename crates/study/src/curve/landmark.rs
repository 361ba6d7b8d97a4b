//! Special points of a curve (landmarks): zero-step stroke, stall force, maxima.

use super::ahead::{self, Found};
use super::{Bracket, Curve, CurveError, Kind, Motion, Motionless, Peak, Point, Seen, Traced};
use crate::each::each;
use std::sync::{Mutex, PoisonError};
use stickslip_run::Watcher;
use thiserror::Error;

/// Special point of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Landmark {
    /// `zero_step` (S₀, the largest amplitude without a steady step), `stall` (the smallest load that stops the steps), or the maxima
    /// `best_speed`, `best_power` and `best_step`.
    pub name: &'static str,
    /// Value of the parameter at this point, SI, or the reason why it was not found.
    pub at: Result<f64, Unfound>,
    /// Uncertainty of the value: half of the bracket, and for `zero_step` and `stall` also the effect of the step
    /// length errors. 0 if not found.
    pub half_width: f64,
    /// Maximum, SI. `None` for `zero_step` and `stall`.
    pub value: Option<f64>,
    /// Number of points computed to find the landmark.
    pub runs: u32,
    /// For S₀: true if the drive steps in the opposite direction at smaller amplitudes.
    pub turns: bool,
    /// Upper bound of S₀ if all points of the curve have steps: the smallest amplitude of these points.
    pub below: Option<f64>,
    /// Cause of the missing steps above the largest amplitude with a step. `None` for other landmarks.
    pub beyond: Option<Beyond>,
}

/// Cause of missing steps at large amplitudes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Beyond {
    /// The command exceeds the voltage window of a driver.
    Window,
    /// A driver has a current limit, and no command exceeds its window.
    Current,
    /// Another cause.
    Other,
}

impl Beyond {
    /// Returns the name in output files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Window => "window",
            Self::Current => "current",
            Self::Other => "other",
        }
    }
}

/// Reason why a landmark is not found.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Unfound {
    /// The landmark lies outside the range of the curve.
    #[error("not within the range: {0}")]
    Outside(&'static str),
    /// A point of the search has no steady motion.
    #[error("a neighbouring point has no result: {0}")]
    Motionless(Motionless),
    /// The search was not run or was interrupted.
    #[error("not run")]
    NotRun,
}

/// Error text for a curve in which no point has a steady motion.
const NO_MOTION: &str = "no point has a result";

impl From<Motionless> for Unfound {
    fn from(why: Motionless) -> Self {
        if why == Motionless::NotRun { Self::NotRun } else { Self::Motionless(why) }
    }
}

impl Curve {
    /// Computes the landmarks of the curve to a relative tolerance, on `cores` threads. The result does not depend on
    /// the number of threads.
    ///
    /// Curves over a load have a stall force; curves over an amplitude have S₀ and possibly a largest amplitude with a
    /// step. Maxima are searched for velocity versus frequency, power versus load, and step length versus other
    /// parameters. The watcher receives the progress of the search, 0 to 1.
    ///
    /// # Errors
    /// Fails if the tolerance is outside 1e-9 to 0.1.
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
            // Landmarks are computed in parallel, each with a part of the cores.
            let (cores, told) = (cores.div_ceil(sought.len()), &|share| told(place, share));
            let search = Search { traced, tolerance, watcher, cores, told };
            let landmark = match sought[place] {
                // The maximum of an interrupted curve is unknown.
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

    /// Returns the landmarks of this type of curve.
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

    /// Returns the motion at a point of the search.
    fn look(&self, search: &Search<'_>, at: f64) -> Result<Motion, Motionless> {
        self.motion_at(at, search.traced.direction, search.watcher)
    }

    /// Finds the parameter value at which steps begin for the last time (`rises`) or end for the first time as the parameter increases in
    /// magnitude. Only steps in the direction of the largest step count.
    fn edge(&self, search: &Search<'_>, (name, rises): (&'static str, bool)) -> Landmark {
        let traced = search.traced;
        let (sense, lengths) = self.lengths(traced);
        let known = from_steps(&lengths, rises);
        let from = known.iter().position(|(_, step)| step.is_some()).unwrap_or(0);
        let steps: Vec<(f64, f64)> =
            known[from..].iter().map_while(|(at, step)| step.map(|step| (*at, step))).collect();
        let Some((smallest, _)) = steps.last().copied() else {
            let why = if lengths.is_empty() { NO_MOTION } else { "the drive makes no step at any point" };
            return Landmark::unfound(name, Unfound::Outside(why), 0);
        };
        let traced_still = known.get(from + steps.len()).map(|(still, _)| *still);
        // An amplitude of 0 makes no steps.
        let Some(still) = traced_still.or(rises.then_some(0.0)) else {
            return Landmark::unfound(name, Unfound::Outside("the drive makes steps at all points"), 0);
        };
        let below = traced_still.is_none().then_some(smallest);
        let nearest: Vec<(f64, f64)> = steps.iter().rev().take(2).copied().collect();
        // At parameter values of the opposite sign, the drive steps in the opposite direction in any case; these points do not count.
        let side = nearest.first().map_or(1.0, |(at, _)| at.signum());
        let is_smaller = |point: &&Point| (0.0..=(side * still).max(0.0)).contains(&(side * point.value));
        let is_back = |point: &Point| point.motion.as_ref().is_ok_and(|motion| motion.steps(-sense));
        let turns = rises && traced.points.iter().filter(is_smaller).any(is_back);
        let found = self.close_in(search, (name, sense), &Around { lengths, nearest, still });
        Landmark { turns, below, ..found }
    }

    /// Finds the largest amplitude with a step. Returns `None` if the largest amplitude of the curve has a step, or no amplitude has one.
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

    /// Returns the cause of missing steps at an amplitude.
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

    /// Returns the direction of the steps, and the step lengths of all points whose step length is known.
    fn lengths(&self, traced: &Traced) -> (f64, Vec<(f64, Length)>) {
        let sense = if self.kind.is_of_load() { traced.direction } else { sense(traced) };
        let length = |point: &Point| Some((point.value, Length::of(point.motion.clone(), sense).ok()?));
        (sense, traced.points.iter().filter_map(length).collect())
    }

    /// Narrows the bracket of a zero of the step length.
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
            Ok(None) => {
                Landmark::unfound(name, Unfound::Outside("the drive makes no step at any point"), runs)
            }
            Err(fault) => Landmark::unfound(name, fault.into(), runs),
        }
    }

    /// Searches for the maximum between both neighbours of the best point of the curve.
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
                Yield::Power => "the drive does no work against the load at any point",
                Yield::Step | Yield::Speed => "the drive makes no step at any point",
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
                // Backward steps and velocities are negative; power into the load is positive in both directions.
                let value = if yields == Yield::Power { peak.best.value } else { sense * peak.best.value };
                let blank = Landmark::unfound(name, Unfound::NotRun, runs);
                Landmark { at: Ok(peak.best.at), half_width, value: Some(value), ..blank }
            }
            Err(fault) => Landmark::unfound(name, fault.into(), runs),
        }
    }
}

/// Returns the reason why the best point (index `place`) lacks a neighbour with a result on one side. Returns `None` with two neighbours.
fn at_an_end(traced: &Traced, known: &[Seen], place: usize) -> Option<&'static str> {
    let is = |end: Option<&Point>| end.is_some_and(|point| point.value == known[place].at);
    match (place == 0, place + 1 == known.len()) {
        (false, false) => None,
        (true, _) if is(traced.points.first()) => Some("the maximum is at the first point of the range"),
        (_, true) if is(traced.points.last()) => Some("the maximum is at the last point of the range"),
        _ => Some("the points on one side of the maximum have no result"),
    }
}

/// Landmark to be found.
#[derive(Debug, Clone, Copy)]
enum Sought {
    /// Parameter value at which steps begin for the last time (`rises`) or end for the first time as the parameter increases.
    Edge { name: &'static str, rises: bool },
    /// Largest amplitude with a step.
    Upper { name: &'static str },
    /// Maximum of a quantity.
    Best { name: &'static str, yields: Yield },
}

/// Settings of a search.
struct Search<'a> {
    traced: &'a Traced,
    tolerance: f64,
    watcher: &'a (dyn Watcher + Sync),
    cores: usize,
    /// Receives the progress of the search.
    told: &'a (dyn Fn(f64) + Sync),
}

/// Step length with its error, m. `None` if there is no step.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Length {
    step: Option<f64>,
    error: Option<f64>,
    /// Displacement per period too short to count as a step, m; it adds to the uncertainty of the zero of the step length.
    rest: f64,
}

/// Data around a zero of the step length: step lengths at all points, the nearest two points with a step, the nearest point without a step.
struct Around {
    lengths: Vec<(f64, Length)>,
    nearest: Vec<(f64, f64)>,
    still: f64,
}

/// Quantity to be maximised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Yield {
    /// Step length, m.
    Step,
    /// Mean velocity, m/s.
    Speed,
    /// Mean velocity times load, W.
    Power,
}

impl Length {
    /// Returns the step length of a motion in a direction. Also accepts a missing motion whose reason implies that there are no steps.
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
    /// Returns the name of the landmark in words. `varied` is the name of the varied parameter, such as `stroke` or `amplitude`.
    #[must_use]
    pub fn words(&self, varied: &str) -> String {
        let is_amplitude = varied == "amplitude";
        let size = if is_amplitude { "amplitude" } else { "stroke" };
        match self.name {
            "zero_step" if self.beyond == Some(Beyond::Window) => {
                format!("largest {size} with a step, limited by the window of the driver")
            }
            "zero_step" if self.beyond == Some(Beyond::Current) => {
                format!("largest {size} with a step, limited by the current of the driver")
            }
            "zero_step" if self.beyond.is_some() => format!("largest {size} with a step"),
            "zero_step" => {
                let amplitude = if is_amplitude { " (as amplitude)" } else { "" };
                let turns = if self.turns { ": forward steps above it, backward steps below" } else { "" };
                format!("S\u{2080}, zero-step stroke{amplitude}{turns}")
            }
            "stall" => "stall".to_owned(),
            "best_speed" => "maximum speed".to_owned(),
            "best_power" => "maximum power".to_owned(),
            _ => "maximum step".to_owned(),
        }
    }

    /// Returns the unit of the maximum.
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

/// Returns the step lengths of points, from the largest amplitude down if steps grow with the amplitude, or from the smallest load up.
fn from_steps(lengths: &[(f64, Length)], rises: bool) -> Vec<(f64, Option<f64>)> {
    let mut known: Vec<(f64, Option<f64>)> = lengths.iter().map(|(at, length)| (*at, length.step)).collect();
    let size = |place: Option<&(f64, Option<f64>)>| place.map_or(0.0, |(at, _)| at.abs());
    if rises && size(known.last()) >= size(known.first()) {
        known.reverse();
    }
    known
}

/// Returns the slope of the step length near its zero. The slope is computed from the two nearest points with steps, or from the nearest
/// point with steps and the point without steps.
fn slope(nearest: &[(f64, f64)], still: f64) -> f64 {
    let (at, step) = nearest.first().copied().unwrap_or((still, 0.0));
    let (other, longer) = nearest.get(1).copied().unwrap_or((still, 0.0));
    ((step - longer) / (at - other)).abs()
}

/// Returns the direction of the step with the largest absolute value, 1 or -1.
fn sense(traced: &Traced) -> f64 {
    let steps = traced.points.iter().filter_map(|point| point.motion.as_ref().ok()).map(|motion| motion.step);
    let longest = steps.max_by(|a, b| a.abs().total_cmp(&b.abs()));
    if longest.is_some_and(|step| step < 0.0) { -1.0 } else { 1.0 }
}
