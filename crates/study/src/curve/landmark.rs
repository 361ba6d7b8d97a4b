//! What is looked for on a curve: where it meets zero, and where it is best.

use super::{Bracket, Curve, CurveError, Kind, Motion, Motionless, Peak, Traced};
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
    /// How far it may be off: half of the bracket. 0 where it is not known.
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
    Motionless(#[from] Motionless),
}

impl Curve {
    /// Adds what is looked for on this curve, to a share of its place. Loads have a stall, amplitudes S₀; speeds over frequencies,
    /// power against loads, and steps over anything else have a best point.
    ///
    /// # Errors
    /// A tolerance out of its range, 1e-9 to 0.1.
    pub fn mark(&self, traced: &mut Traced, tolerance: f64, watcher: &dyn Watcher) -> Result<(), CurveError> {
        if !(1e-9..=0.1).contains(&tolerance) {
            return Err(CurveError::Tolerance(tolerance));
        }
        traced.landmarks = self.landmarks(traced, tolerance, watcher);
        Ok(())
    }

    fn landmarks(&self, traced: &Traced, tolerance: f64, watcher: &dyn Watcher) -> Vec<Landmark> {
        let edge = |name, rises| self.edge(traced, (name, rises), tolerance, watcher);
        let best = |name, yields: Yield| self.best(traced, (name, yields), tolerance, watcher);
        match self.kind {
            Kind::StepAmplitude => vec![edge("zero_step", true)],
            Kind::SpeedFrequency => vec![best("best_speed", Yield::Speed)],
            Kind::ForceSpeed => vec![edge("stall", false), best("best_power", Yield::Power)],
            Kind::StepLoad => vec![edge("stall", false)],
            Kind::Preload | Kind::Vary(_) => vec![best("best_step", Yield::Step)],
        }
    }

    /// Where steps begin for the last time, or end for the first. They have the sense of the longest.
    fn edge(
        &self,
        traced: &Traced,
        (name, rises): (&'static str, bool),
        tolerance: f64,
        watcher: &dyn Watcher,
    ) -> Landmark {
        let sense = if self.kind.is_of_load() { traced.direction } else { sense(traced) };
        // What goes on changing is no steady step either: it creeps, or is dragged away.
        let length = |motion: Result<Motion, Motionless>| match motion {
            Ok(motion) => Ok(motion.steps(sense).then_some(sense * motion.step)),
            Err(Motionless::Unsettled { .. }) => Ok(None),
            Err(fault) => Err(fault),
        };
        let points = traced.points.iter();
        let known = points.filter_map(|point| Some((point.value, length(point.motion.clone()).ok()?)));
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
        let nearest = steps.iter().rev().take(2).copied().collect();
        let mut runs = 0;
        let bracket = Bracket::narrow(nearest, *still, tolerance, |at| {
            runs += 1;
            length(self.motion_at(at, traced.direction, watcher))
        });
        match bracket {
            Ok(Some(bracket)) => Landmark {
                name,
                at: Ok(bracket.middle()),
                half_width: bracket.half_width(),
                value: None,
                runs,
            },
            Ok(None) => Landmark::unfound(name, Unfound::Outside("the drive steps at none"), runs),
            Err(fault) => Landmark::unfound(name, fault.into(), runs),
        }
    }

    /// The best place, between the neighbours of the best point.
    fn best(
        &self,
        traced: &Traced,
        (name, yields): (&'static str, Yield),
        tolerance: f64,
        watcher: &dyn Watcher,
    ) -> Landmark {
        let sense = if self.kind.is_of_load() { traced.direction } else { sense(traced) };
        let worth = |at: f64, motion: &Motion| match yields {
            Yield::Step => sense * motion.step,
            Yield::Speed => sense * motion.speed(),
            Yield::Power => sense * at * motion.speed(),
        };
        let points = traced.points.iter().filter_map(|point| {
            let motion = point.motion.as_ref().ok()?;
            Some((point.value, worth(point.value, motion)))
        });
        let known: Vec<(f64, f64)> = points.collect();
        let best = (0..known.len()).max_by(|a, b| known[*a].1.total_cmp(&known[*b].1));
        let Some(place) = best.filter(|place| known[*place].1 > 0.0) else {
            return Landmark::unfound(name, Unfound::Outside("the drive steps at none"), 0);
        };
        if place == 0 || place + 1 == known.len() {
            return Landmark::unfound(name, Unfound::Outside("it is at an end, or beyond"), 0);
        }
        let within = [known[place - 1].0, known[place + 1].0];
        let mut runs = 0;
        let peak = Peak::narrow(known[place], within, tolerance, |at| {
            runs += 1;
            self.motion_at(at, traced.direction, watcher).map(|motion| worth(at, &motion))
        });
        match peak {
            Ok(peak) => {
                let half_width = 0.5 * (peak.within[1] - peak.within[0]);
                Landmark { name, at: Ok(peak.at), half_width, value: Some(peak.value), runs }
            }
            Err(fault) => Landmark::unfound(name, fault.into(), runs),
        }
    }
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

/// Sense of the longest step, 1 or -1.
fn sense(traced: &Traced) -> f64 {
    let steps = traced.points.iter().filter_map(|point| point.motion.as_ref().ok()).map(|motion| motion.step);
    let longest = steps.max_by(|a, b| a.abs().total_cmp(&b.abs()));
    if longest.is_some_and(|step| step < 0.0) { -1.0 } else { 1.0 }
}
