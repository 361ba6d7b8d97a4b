//! Where a waveform turns: times of its corners and the values there.

use super::shape::{Carrier, Law, Placed, Way};
use super::{Piece, Sample, Timing};
use std::f64::consts::TAU;

/// Segments between corners, numbered from 0 at the start of the period that the delay falls into.
///
/// Corner n lies at k·period + origin, never at a sum of steps: after a million periods it is as exact as at first.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Corners {
    /// s; 0 for a table, whose corners come once.
    period: f64,
    /// Segments per period; for a table more than there are.
    per_period: u64,
    /// Times of the corners of the first period, s.
    origins: Vec<f64>,
    /// Values at the start and at the end of each segment, and how it goes between them.
    ways: Vec<((f64, f64), Way)>,
    /// Sines that segments run through, each from their start on.
    carrier: Option<Carrier>,
    /// Value at the very start, where the first segment comes from elsewhere than its corner.
    lead: Option<f64>,
    /// Value from which a period that begins with a jump jumps.
    foot: Option<f64>,
    /// First and last segment that run, and when the first starts and the last stops.
    first: u64,
    last: u64,
    start: f64,
    stop: f64,
}

/// One way between two corners.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    /// Its start, s: after that of the period, or of the whole where there is none.
    pub(super) start: f64,
    /// Values at its start and end.
    pub(super) values: (f64, f64),
    /// How it goes from one to the other.
    pub(super) way: Way,
}

impl Leg {
    /// A straight one.
    pub(super) fn straight(start: f64, values: (f64, f64)) -> Self {
        Self { start, values, way: Way::Straight }
    }
}

impl Corners {
    /// Becomes another one's copy, in the room there is.
    pub(super) fn copy(&mut self, from: &Self) {
        let Self { period, per_period, origins, ways, carrier, lead, foot, first, last, start, stop } = from;
        self.origins.clone_from(origins);
        self.ways.clone_from(ways);
        self.carrier.clone_from(carrier);
        (self.period, self.per_period) = (*period, *per_period);
        (self.lead, self.foot) = (*lead, *foot);
        (self.first, self.last) = (*first, *last);
        (self.start, self.stop) = (*start, *stop);
    }

    /// Corners of a period that these ways fill from its start to its end.
    ///
    /// A way that ends where it starts is a jump: none is there. Where it is the first one the value from which it jumps is what is
    /// held before the first period and after the last: the limit of a short way.
    pub(super) fn periodic(legs: &[Leg], timing: &Timing) -> Self {
        let period = timing.period;
        let ends = legs.iter().skip(1).map(|leg| leg.start).chain([period]);
        let jump = legs.first().zip(legs.get(1)).filter(|(first, second)| first.start >= second.start);
        let foot = jump.map(|(first, _)| first.values.0);
        let legs = || legs.iter().zip(ends.clone()).filter(|(leg, end)| leg.start < *end).map(|(leg, _)| leg);
        let knots: Vec<f64> = legs().map(|leg| leg.start).collect();
        let shift = shift(&knots, timing);
        let mut corners = Self {
            period,
            per_period: knots.len() as u64,
            origins: knots.iter().map(|knot| timing.delay + (knot - shift)).collect(),
            ways: legs().map(|leg| (leg.values, leg.way)).collect(),
            carrier: None,
            lead: None,
            foot,
            first: 0,
            last: u64::MAX,
            start: timing.delay,
            stop: f64::INFINITY,
        };
        corners.first = corners.segment_at(timing.delay);
        if timing.cycles.is_some() {
            corners.stop_at(timing.stop());
        }
        corners
    }

    /// Corners that come once, after a delay (s), the last way ending at `end` (s); none without a way.
    pub(super) fn once(legs: &[Leg], end: f64, delay: f64) -> Option<Self> {
        let (first, last) = (legs.first()?, (legs.len() as u64).checked_sub(1)?);
        let end = delay + end;
        Some(Self {
            period: 0.0,
            per_period: u64::MAX,
            origins: legs.iter().map(|leg| delay + leg.start).chain([end]).collect(),
            ways: legs.iter().map(|leg| (leg.values, leg.way)).collect(),
            carrier: None,
            lead: None,
            foot: None,
            first: 0,
            last,
            start: delay + first.start,
            stop: end,
        })
    }

    /// The same, segments by sines running through these.
    pub(super) fn carried_by(self, carrier: Option<Carrier>) -> Self {
        Self { carrier, ..self }
    }

    /// The same, starting with this value on the second segment, whose line goes back to it beyond its own corner.
    ///
    /// That corner may come after the stop, or round to the start: the second segment it is, nevertheless.
    pub(super) fn led_by(self, value: f64) -> Self {
        let first = self.first.max(1);
        Self { lead: Some(value), first, last: self.last.max(first), ..self }
    }

    /// Whether the value moves in straight lines from corner to corner.
    pub(super) fn are_straight(&self) -> bool {
        self.ways.iter().all(|(_, way)| *way == Way::Straight)
    }

    /// The ways of one period, as they were given, of those of no length the first alone.
    pub(super) fn legs(&self) -> impl Iterator<Item = Leg> {
        let ways = self.origins.iter().zip(&self.ways);
        let jump = self.foot.zip(ways.clone().next());
        let jump = jump.map(|(foot, (start, (values, _)))| Leg::straight(*start, (foot, values.0)));
        jump.into_iter().chain(ways.map(|(start, (values, way))| Leg {
            start: *start,
            values: *values,
            way: *way,
        }))
    }

    /// Number of segments of a period, or of all where there is none.
    pub(super) fn count(&self) -> usize {
        self.ways.len()
    }

    /// Duration of the shortest segment, s.
    pub(super) fn shortest(&self) -> f64 {
        let again = self.origins.first().filter(|_| self.period > 0.0).map(|first| self.period + first);
        let ends = self.origins.iter().skip(1).copied().chain(again);
        self.origins.iter().zip(ends).map(|(start, end)| end - start).fold(f64::INFINITY, f64::min)
    }

    /// Value and derivatives on a segment whose law is kept here.
    pub(super) fn on(&self, placed: &Placed, t: f64) -> Sample {
        let (values, way) = self.ways.get(placed.place()).copied().unwrap_or(((0.0, 0.0), Way::Straight));
        let (from, to) = ((placed.from, values.0), (placed.to, values.1));
        way.at(from, to, self.carrier.as_ref(), t)
    }

    /// When the first segment starts and the last stops, s.
    pub(super) fn window(&self) -> (f64, f64) {
        (self.start, self.stop)
    }

    /// Index of the piece after the last segment.
    pub(super) fn after(&self) -> u64 {
        (self.last - self.first).saturating_add(2)
    }

    /// The piece that holds at a time inside the window.
    pub(super) fn piece_at(&self, t: f64) -> Piece {
        // At a time beyond all counting the segment is the largest number there is.
        self.piece((self.segment_at(t).clamp(self.first, self.last) - self.first).saturating_add(1))
    }

    /// The piece with this index, 1 for the first segment that runs.
    pub(super) fn piece(&self, index: u64) -> Piece {
        let n = self.first.saturating_add(index.saturating_sub(1)).min(self.last);
        let (from, to) = (self.corner(n), self.corner(n.saturating_add(1)));
        let place = self.place(n);
        let (values, way) = self.ways.get(place).copied().unwrap_or(((0.0, 0.0), Way::Straight));
        let from = match self.lead {
            Some(value) if n == self.first => (self.start, value),
            _ => (from, values.0),
        };
        let to = (to, values.1);
        let law = Law::between(way, from, to, place);
        let start = if n == self.first { self.start } else { from.0 };
        Piece { start, end: to.0.min(self.stop), index, law }
    }

    /// Value that a jump at the very end of the last segment leads to; none where the end is no corner.
    pub(super) fn beyond(&self) -> Option<f64> {
        let next = self.last.checked_add(1)?;
        let corner = self.period > 0.0 && self.corner(next) == self.stop;
        let foot = self.foot.filter(|_| self.place(next) == 0);
        corner.then(|| foot.or(self.ways.get(self.place(next)).map(|(values, _)| values.0)))?
    }

    /// Value before a jump at the very start; none where it starts otherwise.
    pub(super) fn ahead(&self) -> Option<f64> {
        self.foot.filter(|_| self.place(self.first) == 0 && self.corner(self.first) == self.start)
    }

    /// Time of corner `n`, the start of segment `n`.
    fn corner(&self, n: u64) -> f64 {
        let origin = self.origins.get(self.place(n)).copied().unwrap_or(f64::INFINITY);
        (n / self.per_period) as f64 * self.period + origin
    }

    fn place(&self, n: u64) -> usize {
        usize::try_from(n % self.per_period).unwrap_or(usize::MAX)
    }

    /// The segment on [start, end) that contains `t`.
    fn segment_at(&self, t: f64) -> u64 {
        let origin = self.origins.first().copied().unwrap_or(0.0);
        let periods = if self.period > 0.0 { ((t - origin) / self.period).floor().max(0.0) } else { 0.0 };
        let passed = self.origins.partition_point(|o| periods * self.period + o <= t);
        let mut n =
            (periods as u64).saturating_mul(self.per_period).saturating_add(passed as u64).saturating_sub(1);
        // The division may be off by one period where `t` lies on a corner.
        for _ in 0..=self.origins.len() {
            if n > 0 && self.corner(n) > t {
                n -= 1;
            } else if self.corner(n.saturating_add(1)) <= t {
                n = n.saturating_add(1);
            } else {
                break;
            }
        }
        n
    }

    /// Ends the waveform at `stop`, or at the corner that it misses by rounding only.
    fn stop_at(&mut self, stop: f64) {
        let slack = SLACK * self.period + 2.0 * f64::EPSILON * stop.abs();
        let n = self.segment_at(stop);
        let near = |n: u64| (self.corner(n) - stop).abs() <= slack;
        (self.last, self.stop) = if n > self.first && near(n) {
            (n - 1, self.corner(n))
        } else if near(n.saturating_add(1)) {
            (n, self.corner(n.saturating_add(1)))
        } else {
            (n, stop)
        };
    }
}

/// Part of a period below which a time counts as on a corner: a phase of π has an error of a few 1e-16 of it.
const SLACK: f64 = 1e-13;

/// Time by which the phase advances the waveform, within one period, on the knot itself if it is meant to be there.
fn shift(knots: &[f64], timing: &Timing) -> f64 {
    let period = timing.period;
    let shift = (timing.phase / TAU).rem_euclid(1.0) * period;
    if period - shift <= SLACK * period {
        return 0.0;
    }
    knots.iter().copied().find(|knot| (knot - shift).abs() <= SLACK * period).unwrap_or(shift)
}
