//! A branch followed from its start in one sense.
//!
//! A step goes along the tangent and is corrected back onto the branch; it is shortened where the branch bends or nothing is found, and
//! lengthened where it was easy. Where the same happens in the periods at both its ends the signs of the test functions tell whether
//! something lies between; where not the event is closed in on, and the branch goes on beyond.

use super::bifurcation::Mark;
use super::corrector::{Corrected, Wanted, correct};
use super::error::Trouble;
use super::happened::Period;
use super::place::Bench;
use super::standing::{Measure, Point, Standing, by_value};
use super::written::Written;
use crate::journal::Journal;
use serde::{Deserialize, Serialize};

/// Lengths of a step: the first, the longest, the shortest; the range of what is varied is 1.
const FIRST: f64 = 1.0 / 64.0;
const LONGEST: f64 = 1.0 / 32.0;
const SHORTEST: f64 = 1e-9;
/// Cosine of the most that the branch may turn in a step; shorter steps than this may turn by any angle.
const TURNS: f64 = 0.9;
const ANY: f64 = 1e-6;
/// An end of the range is come to where no more than this share of it is left.
const AT: f64 = 1e-12;
/// How far a motion may lie from where it was predicted, in steps.
const ASTRAY: f64 = 0.5;
/// Steps of the corrector that make a step an easy one.
const EASY: u32 = 4;
/// The map's moment is chosen anew where it is nearer to an event than this share of the time between the two about it.
const NEAR: f64 = 0.2;
/// Where the varied number hardly changes along the branch, the sense of it cannot tell how the branch goes on from another moment.
const TURNING: f64 = 0.02;

/// Why a branch goes no further.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum End {
    /// It has come to an end of the range.
    Range,
    /// Beyond, contacts never slip grossly: steady motions are a whole family.
    Shakedown(Vec<String>),
    /// What pulls a body is as much as friction holds: any speed does, and beyond it slides away.
    SlidesAway(String),
    /// So many natural lengths are gone in a period that rounding leaves nothing of what friction does in it.
    Rounded(f64),
    /// No motion was found beyond.
    Lost(String),
    /// The scenario allows no other values.
    Refused(String),
    /// As many points as were allowed.
    Points,
    /// Its caller has had enough.
    Interrupted,
}

/// One arm of a branch.
pub(super) struct Arm {
    pub(super) points: Vec<Point>,
    pub(super) marks: Vec<Mark>,
    pub(super) end: End,
}

/// A motion that was found, and not made out yet.
pub(super) struct Probe {
    pub(super) corrected: Corrected,
    pub(super) period: Period,
}

/// Follows a branch.
pub(super) struct Walk<'a> {
    pub(super) bench: &'a Bench<'a>,
    pub(super) measure: Measure,
    /// Ends of the range.
    pub(super) range: [f64; 2],
    /// Most points.
    most: usize,
    /// How exactly places are told, as a share of the range.
    pub(super) accuracy: f64,
    /// Told how many points there are.
    told: &'a dyn Fn(usize),
    /// Where there was an event, also one that the next took back.
    pub(super) passed: Vec<f64>,
    pub(super) arm: Arm,
}

/// A step of the way, as it is written down: where it has led, how long the next one is, what it has added, and whether it is the last.
#[derive(Serialize, Deserialize)]
struct Leg {
    to: Written,
    length: f64,
    /// By how much the varied number is moved for a difference.
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

    /// Follows it from a motion on, in a sense; steps that are in the journal are not taken again.
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
            // A motion that cannot be read is of another drive.
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

    /// One step.
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

    /// The same: how long the next one is to be; `at` is where it has led, if that is elsewhere.
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

    /// The end of the range that a motion's branch leads to, and how far along its tangent that is.
    fn end_of(&self, here: &Standing) -> (f64, f64) {
        let end = if here.pace() < 0.0 { self.range[0] } else { self.range[1] };
        (end, (end - here.point.value) / self.bench.span / here.pace())
    }

    /// Whether it has come there.
    fn is_beyond(&self, here: &Standing) -> bool {
        self.end_of(here).1 * here.pace().abs() <= AT
    }

    /// The length of a step, no longer than to an end of the range, and that end where it comes there.
    fn aim(&self, here: &Standing, length: f64) -> (f64, Option<f64>) {
        let (end, left) = self.end_of(here);
        if length >= left { (left, Some(end)) } else { (length, None) }
    }

    /// The motion a length along the tangent, or at an end of the range.
    pub(super) fn probe(&self, here: &Standing, length: f64, end: Option<f64>) -> Result<Probe, Trouble> {
        let to = &here.tangent * length;
        let row = match end {
            Some(_) => by_value(here.count(), 1.0),
            None => self.measure.row(&here.tangent),
        };
        let wanted = Wanted { to, row: &row };
        let corrected = correct(self.bench, (&here.place, &here.slopes), &wanted)?;
        let period = Period::of(self.bench, &corrected.place)?;
        // Events bend a branch where they are, and are closed in on.
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

    /// Makes out a motion that was found, with what lies on the way there.
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

    /// The end at which the figures' body slides away.
    pub(super) fn sliding(&self) -> End {
        let scenario = &self.bench.job.scenario;
        let body = scenario.figures.body.and_then(|body| scenario.scene.bodies.get(body));
        End::SlidesAway(body.map_or_else(String::new, |body| body.name.clone()))
    }

    /// How far along the tangent a motion at the end of the range is.
    fn reach(&self, here: &Standing, next: &Standing) -> f64 {
        (next.point.value - here.point.value) / self.bench.span / here.pace()
    }

    pub(super) fn keep(&mut self, standing: &Standing) {
        self.arm.points.push(standing.point.clone());
        (self.told)(self.arm.points.len());
    }

    /// The same motion at the moment of its period that is farthest from events.
    fn another_moment(&mut self, here: &Standing) -> Option<Standing> {
        if here.pace().abs() < TURNING {
            return None;
        }
        let place = self.bench.moment(&here.place).ok()?;
        let period = Period::of(self.bench, &place).ok()?;
        let row = by_value(place.fixed.defect.len(), here.pace().signum());
        let mut there = Standing::of(self.bench, place, period, (Some(self.measure), &row)).ok()?;
        there.point.piece = here.point.piece;
        // The plain periods on the way have led away from a motion that no run stays in.
        let probe = self.probe(&there, 0.0, Some(here.point.value)).ok()?;
        if probe.corrected.steps > 0 {
            there = self.stand(&there, probe).ok()?;
        }
        if there.margin <= here.margin {
            return None;
        }
        // What fell on the moment before was counted once too often, or not at all.
        self.event(here.pace(), here, (there.point.value, &there.happened, there.point.is_stable()));
        Some(there)
    }
}
