//! Continuation of a branch in one direction.
//!
//! A step follows the tangent and is corrected back to the branch. The step is shortened if the branch bends or no orbit is found, and
//! lengthened after an easy correction. If the orbits at both ends of a step have the same events, test functions detect bifurcations in
//! between. Otherwise the event is located and the branch continues beyond the event.

use super::bifurcation::Mark;
use super::corrector::{Corrected, Wanted, correct};
use super::error::Trouble;
use super::happened::Period;
use super::place::Bench;
use super::standing::{Measure, Point, Standing, by_value};
use super::written::Written;
use crate::journal::Journal;
use serde::{Deserialize, Serialize};

/// Step sizes, as fractions of the parameter range: first, longest, shortest.
const FIRST: f64 = 1.0 / 64.0;
const LONGEST: f64 = 1.0 / 32.0;
const SHORTEST: f64 = 1e-9;
/// Smallest cosine of the angle between successive tangents. Steps shorter than `ANY` are exempt from this limit.
const TURNS: f64 = 0.9;
const ANY: f64 = 1e-6;
/// Distance from the end of the range, as a fraction of the range, at which the end counts as reached.
const AT: f64 = 1e-12;
/// Largest distance between predicted and corrected orbit, as a multiple of the step size.
const ASTRAY: f64 = 0.5;
/// Number of corrector iterations up to which a step counts as easy.
const EASY: u32 = 4;
/// A new instant of the Poincaré section is chosen if its distance to an event is below this fraction of the interval between events.
const NEAR: f64 = 0.2;
/// Smallest change of the parameter along the branch at which a new instant can be chosen. At smaller changes, the direction of the branch
/// would be ambiguous.
const TURNING: f64 = 0.02;

/// Reason for the end of a branch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum End {
    /// The end of the range is reached.
    Range,
    /// Beyond this point, some contacts never slip grossly, and periodic orbits form a family.
    Shakedown(Vec<String>),
    /// The load on a body equals the friction limit: any velocity is possible, and beyond this point the body slides away.
    SlidesAway(String),
    /// The displacement per period, in natural scales, is so large that rounding errors exceed the effect of friction.
    Rounded(f64),
    /// No orbit was found beyond this point.
    Lost(String),
    /// The scenario does not allow values beyond this point.
    Refused(String),
    /// The maximum number of points is reached.
    Points,
    /// The caller interrupted the continuation.
    Interrupted,
}

/// Branch in one direction.
pub(super) struct Arm {
    pub(super) points: Vec<Point>,
    pub(super) marks: Vec<Mark>,
    pub(super) end: End,
}

/// An orbit from the corrector, not yet evaluated.
pub(super) struct Probe {
    pub(super) corrected: Corrected,
    pub(super) period: Period,
}

/// Continuation of a branch in one direction.
pub(super) struct Walk<'a> {
    pub(super) bench: &'a Bench<'a>,
    pub(super) measure: Measure,
    /// Ends of the range.
    pub(super) range: [f64; 2],
    /// Maximum number of points.
    most: usize,
    /// Accuracy of special points, as a fraction of the parameter range.
    pub(super) accuracy: f64,
    /// Receives the number of points in this direction.
    told: &'a dyn Fn(usize),
    /// Parameter values of all located events, including events that are cancelled by the next event.
    pub(super) passed: Vec<f64>,
    pub(super) arm: Arm,
}

/// Journal entry of a continuation step: its end point, the next step size, new points, new special points, and the
/// reason if the branch ends.
#[derive(Serialize, Deserialize)]
struct Leg {
    to: Written,
    length: f64,
    /// Distance of finite differences in the parameter.
    apart: f64,
    points: Vec<Point>,
    marks: Vec<Mark>,
    end: Option<End>,
}

impl<'a> Walk<'a> {
    pub(super) fn new(
        (bench, measure): (&'a Bench<'a>, Measure),
        range: [f64; 2],
        (most, accuracy): (usize, f64),
        told: &'a dyn Fn(usize),
    ) -> Self {
        let arm = Arm { points: Vec::new(), marks: Vec::new(), end: End::Range };
        Self { bench, measure, range, most, accuracy, told, passed: Vec::new(), arm }
    }

    /// Follows the branch from an orbit in the direction of its tangent. Steps in the journal are not computed again.
    pub(super) fn go(mut self, start: Standing, (journal, sense): (&Journal, f64)) -> Arm {
        let (mut here, mut length) = (start, FIRST);
        for count in 0.. {
            let take = || self.leg(&here, length);
            let is_kept = |leg: &Leg| leg.end != Some(End::Interrupted);
            let Leg { to, length: next, apart, points, marks, end } =
                journal.found(&(sense, count), take, is_kept);
            self.arm.points.extend(points);
            marks.into_iter().for_each(|mark| self.add(mark));
            (self.told)(self.arm.points.len());
            // A state that cannot be read belongs to another model.
            let end =
                end.map_or_else(|| to.read(self.bench).ok_or(End::Lost("damaged journal".to_owned())), Err);
            self.bench.apart.set(apart);
            match end {
                Ok(standing) => (here, length) = (standing, next),
                Err(end) => {
                    self.arm.end = end;
                    break;
                }
            }
        }
        self.arm
    }

    /// Takes one continuation step.
    fn leg(&mut self, here: &Standing, length: f64) -> Leg {
        let [points, marks] = [self.arm.points.len(), self.arm.marks.len()];
        let mut at = None;
        let (length, end) = match self.step(here, &mut at, length) {
            Ok(next) => (next, None),
            Err(end) => (length, Some(end)),
        };
        Leg {
            to: Written::of(at.as_ref().unwrap_or(here)),
            length,
            apart: self.bench.apart.get(),
            points: self.arm.points.split_off(points),
            marks: self.arm.marks.split_off(marks),
            end,
        }
    }

    /// Takes one continuation step and returns the next step size. Sets `at` to the new orbit, if there is one.
    fn step(&mut self, here: &Standing, at: &mut Option<Standing>, length: f64) -> Result<f64, End> {
        if self.arm.points.len() >= self.most {
            return Err(End::Points);
        }
        if self.is_beyond(here) {
            return Err(End::Range);
        }
        if here.margin < NEAR {
            *at = self.another_moment(here);
        }
        let here = at.clone().unwrap_or_else(|| here.clone());
        let (to, at_end) = self.aim(&here, length);
        let next = self.probe(&here, to, at_end).and_then(|probe| {
            let easy = probe.corrected.steps <= EASY;
            Ok((self.advance(&here, probe, (length, at_end.is_some()))?, easy))
        });
        match next {
            Ok((next, easy)) => {
                *at = Some(next);
                Ok(if easy { (1.5 * length).min(LONGEST) } else { length })
            }
            Err(trouble) if trouble.is_final() => Err(End::Interrupted),
            Err(Trouble::Slides) => Err(self.sliding()),
            Err(_) if length > SHORTEST => {
                if here.margin < 2.0 * NEAR {
                    *at = self.another_moment(&here).or(at.take());
                }
                Ok(0.25 * length)
            }
            Err(trouble) => {
                *at = Some(self.beyond(&here, &trouble)?);
                Ok(FIRST * 1e-2)
            }
        }
    }

    /// Returns the end of the range in the direction of the branch and the distance to this end along the tangent.
    fn end_of(&self, here: &Standing) -> (f64, f64) {
        let end = if here.pace() < 0.0 { self.range[0] } else { self.range[1] };
        (end, (end - here.point.value) / self.bench.span / here.pace())
    }

    /// Returns whether the end of the range is reached.
    fn is_beyond(&self, here: &Standing) -> bool {
        self.end_of(here).1 * here.pace().abs() <= AT
    }

    /// Returns the step size, limited by the end of the range. Also returns this end if the step reaches it.
    fn aim(&self, here: &Standing, length: f64) -> (f64, Option<f64>) {
        let (end, left) = self.end_of(here);
        if length >= left { (left, Some(end)) } else { (length, None) }
    }

    /// Computes the orbit at a distance along the tangent, or at an end of the range.
    pub(super) fn probe(&self, here: &Standing, length: f64, end: Option<f64>) -> Result<Probe, Trouble> {
        let to = &here.tangent * length;
        let row = match end {
            Some(_) => by_value(here.count(), 1.0),
            None => self.measure.row(&here.tangent),
        };
        let wanted = Wanted { to, row: &row };
        let corrected = correct(self.bench, (&here.place, &here.slopes), &wanted)?;
        let period = Period::of(self.bench, &corrected.place)?;
        // Events bend the branch and are located separately, so the check applies to orbits with the same events.
        let astray = self.measure.length(&(&corrected.gone - &wanted.to)) > ASTRAY * length;
        if astray && length > ANY && period.happened == here.happened {
            return Err(Trouble::Bends);
        }
        Ok(Probe { corrected, period })
    }

    pub(super) fn stand(&self, here: &Standing, probe: Probe) -> Result<Standing, Trouble> {
        let row = self.measure.row(&here.tangent);
        let Probe { corrected, period } = probe;
        let mut next = Standing::of(self.bench, corrected.place, period, (Some(self.measure), &row))?;
        next.point.piece = here.point.piece;
        Ok(next)
    }

    /// Evaluates a new orbit and locates special points before it.
    fn advance(
        &mut self,
        here: &Standing,
        probe: Probe,
        (length, at_end): (f64, bool),
    ) -> Result<Standing, Trouble> {
        if probe.period.happened != here.happened {
            return self.pass(here, probe, length);
        }
        let next = self.stand(here, probe)?;
        let turn = self.measure.row(&here.tangent).dot(&next.tangent);
        if turn < TURNS && length > ANY {
            return Err(Trouble::Bends);
        }
        let gone = if at_end { self.reach(here, &next) } else { length };
        if next.is_loose {
            return Err(Trouble::Slides);
        }
        self.cross(here, &next, gone)?;
        self.keep(&next);
        Ok(next)
    }

    /// Returns the end reason that the body named in `figures` slides away.
    pub(super) fn sliding(&self) -> End {
        let scenario = &self.bench.job.scenario;
        let body = scenario.figures.body.and_then(|body| scenario.scene.bodies.get(body));
        End::SlidesAway(body.map_or_else(String::new, |body| body.name.clone()))
    }

    /// Returns the distance along the tangent to an orbit at the end of the range.
    fn reach(&self, here: &Standing, next: &Standing) -> f64 {
        (next.point.value - here.point.value) / self.bench.span / here.pace()
    }

    pub(super) fn keep(&mut self, standing: &Standing) {
        self.arm.points.push(standing.point.clone());
        (self.told)(self.arm.points.len());
    }

    /// Returns an orbit with its Poincaré section moved to the instant farthest from events.
    fn another_moment(&mut self, here: &Standing) -> Option<Standing> {
        if here.pace().abs() < TURNING {
            return None;
        }
        let place = self.bench.moment(&here.place).ok()?;
        let period = Period::of(self.bench, &place).ok()?;
        let row = by_value(place.fixed.defect.len(), here.pace().signum());
        let mut there = Standing::of(self.bench, place, period, (Some(self.measure), &row)).ok()?;
        there.point.piece = here.point.piece;
        // The simulated periods may have left an unstable orbit, so the orbit is corrected.
        let probe = self.probe(&there, 0.0, Some(here.point.value)).ok()?;
        if probe.corrected.steps > 0 {
            there = self.stand(&there, probe).ok()?;
        }
        if there.margin <= here.margin {
            return None;
        }
        // An event at the previous instant may have been counted twice or not at all, so differences are recorded.
        self.event(here.pace(), here, (there.point.value, &there.happened, there.point.is_stable()));
        Some(there)
    }
}
