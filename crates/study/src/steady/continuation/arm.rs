//! A branch followed from its start in one sense.
//!
//! A step goes along the tangent and is corrected back onto the branch; it is shortened where the branch bends or nothing is found, and
//! lengthened where it was easy. Where the same happens in the periods at both its ends the signs of the test functions tell whether
//! something lies between; where not the event is closed in on, and the branch goes on beyond.

use super::bifurcation::{Bifurcation, Mark, Test, root};
use super::corrector::{Corrected, Wanted, correct};
use super::error::Trouble;
use super::happened::{Happened, Period, changes};
use super::place::Bench;
use super::standing::{Measure, Point, Standing, by_value};

/// Lengths of a step: the first, the longest, the shortest; the range of what is varied is 1.
const FIRST: f64 = 1.0 / 64.0;
const LONGEST: f64 = 1.0 / 32.0;
const SHORTEST: f64 = 1e-9;
/// Cosine of the most that the branch may turn in a step; shorter steps than this may turn by any angle.
const TURNS: f64 = 0.9;
const ANY: f64 = 1e-6;
/// An end of the range is come to where no more than this share of it is left.
const AT: f64 = 1e-12;
/// Motions on either side of an event that are farther apart than this are of two branches.
const JUMP: f64 = 1e-3;
/// How far a motion may lie from where it was predicted, in steps.
const ASTRAY: f64 = 0.5;
/// Steps of the corrector that make a step an easy one.
const EASY: u32 = 4;
/// The map's moment is chosen anew where it is nearer to an event than this share of the time between the two about it.
const NEAR: f64 = 0.2;
/// Where the varied number hardly changes along the branch, the sense of it cannot tell how the branch goes on from another moment.
const TURNING: f64 = 0.02;

/// Why a branch goes no further.
#[derive(Debug, Clone, PartialEq)]
pub enum End {
    /// It has come to an end of the range.
    Range,
    /// Beyond, contacts never slip grossly: steady motions are a whole family.
    Shakedown(Vec<String>),
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
struct Probe {
    corrected: Corrected,
    period: Period,
}

/// Follows a branch.
pub(super) struct Walk<'a> {
    pub(super) bench: &'a Bench<'a>,
    pub(super) measure: Measure,
    /// Ends of the range.
    range: [f64; 2],
    /// Most points.
    most: usize,
    /// How exactly places are told, as a share of the range.
    accuracy: f64,
    /// Told how many points there are.
    told: &'a dyn Fn(usize),
    arm: Arm,
}

impl<'a> Walk<'a> {
    pub(super) fn new(
        (bench, measure): (&'a Bench<'a>, Measure),
        range: [f64; 2],
        (most, accuracy): (usize, f64),
        told: &'a dyn Fn(usize),
    ) -> Self {
        let arm = Arm { points: Vec::new(), marks: Vec::new(), end: End::Range };
        Self { bench, measure, range, most, accuracy, told, arm }
    }

    /// Follows it from a motion on.
    pub(super) fn go(mut self, start: Standing) -> Arm {
        let (mut here, mut length) = (start, FIRST);
        self.arm.end = loop {
            if self.arm.points.len() >= self.most {
                break End::Points;
            }
            if self.is_beyond(&here) {
                break End::Range;
            }
            if here.margin < NEAR {
                here = self.another_moment(&here).unwrap_or(here);
            }
            let (to, at_end) = self.aim(&here, length);
            let next = self.probe(&here, to, at_end).and_then(|probe| {
                let easy = probe.corrected.steps <= EASY;
                Ok((self.advance(&here, probe, (length, at_end.is_some()))?, easy))
            });
            match next {
                Ok((next, easy)) => {
                    here = next;
                    length = if easy { (1.5 * length).min(LONGEST) } else { length };
                }
                Err(trouble) if trouble.is_final() => break End::Interrupted,
                Err(_) if length > SHORTEST => {
                    length *= 0.25;
                    if here.margin < 2.0 * NEAR {
                        here = self.another_moment(&here).unwrap_or(here);
                    }
                }
                Err(trouble) => match self.beyond(&here, &trouble) {
                    Ok(next) => (here, length) = (next, FIRST * 1e-2),
                    Err(end) => break end,
                },
            }
        };
        self.arm
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
    fn probe(&self, here: &Standing, length: f64, end: Option<f64>) -> Result<Probe, Trouble> {
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

    fn stand(&self, here: &Standing, probe: Probe) -> Result<Standing, Trouble> {
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
        self.cross(here, &next, gone)?;
        self.keep(&next);
        Ok(next)
    }

    /// How far along the tangent a motion at the end of the range is.
    fn reach(&self, here: &Standing, next: &Standing) -> f64 {
        (next.point.value - here.point.value) / self.bench.span / here.pace()
    }

    pub(super) fn keep(&mut self, standing: &Standing) {
        self.arm.points.push(standing.point.clone());
        (self.told)(self.arm.points.len());
    }

    /// Finds what lies between two motions in whose periods the same happens.
    fn cross(&mut self, here: &Standing, next: &Standing, length: f64) -> Result<(), Trouble> {
        let mut found: Vec<(f64, Standing, Mark)> = Vec::new();
        for test in Test::ALL {
            let [at_here, at_next] = [here, next].map(|standing| test.at(standing, self.measure));
            if at_here * at_next >= 0.0 {
                continue;
            }
            let value = |at: f64| {
                let standing = self.stand(here, self.probe(here, at, None)?)?;
                Ok::<_, Trouble>((test.at(&standing, self.measure), (at, standing)))
            };
            let ([low, high], best) = root((0.0, at_here), (length, at_next), self.accuracy, value)?;
            let Some((at, standing)) = best else { continue };
            let Some(kind) = test.kind(&standing) else { continue };
            // Where the branch turns the bracket has no width: what is left is the tolerance of the runs.
            let width = (0.5 * (high - low) * standing.pace().abs()).max(self.bench.options.tolerance);
            let half_width = width * self.bench.span;
            // Near the place no multiplier is far from 1: its side is what counts.
            let sides = [here, next].map(|standing| standing.point.radius() < 1.0);
            let mark = self.mark(kind, &standing, half_width, sides);
            found.push((at, standing, mark));
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, standing, mark) in found {
            self.keep(&standing);
            self.arm.marks.push(mark);
        }
        Ok(())
    }

    fn mark(&self, kind: Bifurcation, at: &Standing, half_width: f64, along: [bool; 2]) -> Mark {
        let [first, second] = along;
        let stable = if at.pace() < 0.0 && kind != Bifurcation::Fold { [second, first] } else { along };
        let stable = if kind == Bifurcation::Fold { [first, second] } else { stable };
        Mark { kind, value: at.point.value, half_width, step: at.point.step, stable }
    }

    /// Closes in on an event between a motion and one in whose period something else happens, and goes on from beyond it.
    fn pass(&mut self, here: &Standing, far: Probe, length: f64) -> Result<Standing, Trouble> {
        let (mut low, mut high) = (0.0, length);
        let (mut near, mut far): (Option<Probe>, Probe) = (None, far);
        while high - low > self.accuracy {
            let middle = 0.5 * (low + high);
            let probe = self.probe(here, middle, None)?;
            if probe.period.happened == here.happened {
                (low, near) = (middle, Some(probe));
            } else {
                (high, far) = (middle, probe);
            }
        }
        let gone = near.as_ref().map_or_else(|| &here.tangent * 0.0, |near| near.corrected.gone.clone());
        if self.measure.length(&(&far.corrected.gone - gone)) > JUMP {
            return Err(Trouble::Bends);
        }
        let before = match near {
            Some(near) => {
                let near = self.stand(here, near)?;
                self.cross(here, &near, low)?;
                self.keep(&near);
                near
            }
            None => here.clone(),
        };
        let mut beyond = self.stand(&before, far)?;
        beyond.point.piece += 1;
        self.event(&before, (beyond.point.value, &beyond.happened, beyond.point.is_stable()));
        self.keep(&beyond);
        Ok(beyond)
    }

    /// Tells what differs between a motion and one just beyond.
    pub(super) fn event(&mut self, before: &Standing, (value, happened, stable): (f64, &Happened, bool)) {
        let values = [before.point.value, value];
        let mut sides = [(&before.happened, before.point.is_stable()), (happened, stable)];
        if value < before.point.value {
            sides.reverse();
        }
        self.arm.marks.push(Mark {
            kind: Bifurcation::Event(changes(sides[0].0, sides[1].0)),
            value: 0.5 * (values[0] + values[1]),
            half_width: 0.5 * (values[0] - values[1]).abs(),
            step: before.point.step,
            stable: sides.map(|(_, stable)| stable),
        });
    }

    /// The same motion at the moment of its period that is farthest from events.
    fn another_moment(&self, here: &Standing) -> Option<Standing> {
        if here.pace().abs() < TURNING {
            return None;
        }
        let place = self.bench.moment(&here.place).ok()?;
        let period = Period::of(self.bench, &place).ok()?;
        let row = by_value(place.fixed.defect.len(), here.pace().signum());
        let mut there = Standing::of(self.bench, place, period, (Some(self.measure), &row)).ok()?;
        there.point.piece = here.point.piece;
        (there.margin > here.margin).then_some(there)
    }
}
