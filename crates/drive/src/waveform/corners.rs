//! Corners of waveforms: times and values.

use super::shape::{Carrier, Law, Placed, Way};
use super::{Piece, Sample, Timing};
use std::f64::consts::TAU;

/// Segments between corners, numbered from 0 at the start of the period that contains the delay.
///
/// The time of a corner is k·period + origin, computed as a product, so it stays exact after many periods.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Corners {
    /// Period, s; 0 for a table.
    period: f64,
    /// Number of segments per period; a large number for a table.
    per_period: u64,
    /// Times of the corners in the first period, s.
    origins: Vec<f64>,
    /// Values at start and end of each segment, and the form of the segment.
    ways: Vec<((f64, f64), Way)>,
    /// Sines on sinusoidal segments; their time starts at 0 in each segment.
    carrier: Option<Carrier>,
    /// Value at the start of the waveform, if it differs from the value at the corner of the first segment.
    lead: Option<f64>,
    /// Value before the jump, if the period begins with a jump.
    foot: Option<f64>,
    /// First and last segment in use; start of the first and end of the last one, s.
    first: u64,
    last: u64,
    start: f64,
    stop: f64,
}

/// Segment between two corners.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    /// Start, s, relative to the start of the period, or of the waveform if it has no period.
    pub(super) start: f64,
    /// Values at the start and the end of the segment.
    pub(super) values: (f64, f64),
    /// Form of the segment.
    pub(super) way: Way,
}

impl Leg {
    /// Returns a linear segment.
    pub(super) fn straight(start: f64, values: (f64, f64)) -> Self {
        Self { start, values, way: Way::Straight }
    }
}

impl Corners {
    /// Copies another set of corners, reusing allocated memory.
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

    /// Returns the corners of periodic segments that fill the period.
    ///
    /// A segment of zero length is a jump and is removed. If the first segment is a jump, the value before the jump is held before the
    /// first and after the last period.
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

    /// Returns the corners of segments that occur once, after a delay (s). The last segment ends at `end` (s). None without segments.
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

    /// Sets the sines on sinusoidal segments.
    pub(super) fn carried_by(self, carrier: Option<Carrier>) -> Self {
        Self { carrier, ..self }
    }

    /// Starts the waveform with this value in the second segment, whose line is extended back to the start.
    pub(super) fn led_by(self, value: f64) -> Self {
        let first = self.first.max(1);
        Self { lead: Some(value), first, last: self.last.max(first), ..self }
    }

    /// Whether all segments are linear.
    pub(super) fn are_straight(&self) -> bool {
        self.ways.iter().all(|(_, way)| *way == Way::Straight)
    }

    /// Returns the segments of one period as given; if several segments have zero length, only the first of these.
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

    /// Returns the number of segments in a period, or of all segments if there is no period.
    pub(super) fn count(&self) -> usize {
        self.ways.len()
    }

    /// Returns the duration of the shortest segment, s.
    pub(super) fn shortest(&self) -> f64 {
        let again = self.origins.first().filter(|_| self.period > 0.0).map(|first| self.period + first);
        let ends = self.origins.iter().skip(1).copied().chain(again);
        self.origins.iter().zip(ends).map(|(start, end)| end - start).fold(f64::INFINITY, f64::min)
    }

    /// Returns value and derivatives at `t` (s) on a segment that is stored in `self`.
    pub(super) fn on(&self, placed: &Placed, t: f64) -> Sample {
        let (values, way) = self.ways.get(placed.place()).copied().unwrap_or(((0.0, 0.0), Way::Straight));
        let (from, to) = ((placed.from, values.0), (placed.to, values.1));
        way.at(from, to, self.carrier.as_ref(), t)
    }

    /// Returns the start of the first and the end of the last segment, s.
    pub(super) fn window(&self) -> (f64, f64) {
        (self.start, self.stop)
    }

    /// Returns the index of the piece after the last segment.
    pub(super) fn after(&self) -> u64 {
        (self.last - self.first).saturating_add(2)
    }

    /// Returns the piece at a time `t` (s) between start and stop.
    pub(super) fn piece_at(&self, t: f64) -> Piece {
        // For extreme times the index saturates.
        self.piece((self.segment_at(t).clamp(self.first, self.last) - self.first).saturating_add(1))
    }

    /// Returns the piece with this index. Index 1 is the first segment in use.
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

    /// Returns the value after a jump at the end of the last segment. None if the waveform does not end at a corner.
    pub(super) fn beyond(&self) -> Option<f64> {
        let next = self.last.checked_add(1)?;
        let corner = self.period > 0.0 && self.corner(next) == self.stop;
        let foot = self.foot.filter(|_| self.place(next) == 0);
        corner.then(|| foot.or(self.ways.get(self.place(next)).map(|(values, _)| values.0)))?
    }

    /// Returns the value before a jump at the start of the waveform. None without such a jump.
    pub(super) fn ahead(&self) -> Option<f64> {
        self.foot.filter(|_| self.place(self.first) == 0 && self.corner(self.first) == self.start)
    }

    /// Returns the time of corner `n`, s, at which segment `n` starts.
    fn corner(&self, n: u64) -> f64 {
        let origin = self.origins.get(self.place(n)).copied().unwrap_or(f64::INFINITY);
        (n / self.per_period) as f64 * self.period + origin
    }

    fn place(&self, n: u64) -> usize {
        usize::try_from(n % self.per_period).unwrap_or(usize::MAX)
    }

    /// Returns the index of the segment [start, end) that contains `t` (s).
    fn segment_at(&self, t: f64) -> u64 {
        let origin = self.origins.first().copied().unwrap_or(0.0);
        let periods = if self.period > 0.0 { ((t - origin) / self.period).floor().max(0.0) } else { 0.0 };
        let passed = self.origins.partition_point(|o| periods * self.period + o <= t);
        let mut n =
            (periods as u64).saturating_mul(self.per_period).saturating_add(passed as u64).saturating_sub(1);
        // The division may be off by one period at a corner.
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

    /// Ends the waveform at `stop` (s), or at a corner that differs from `stop` by rounding.
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

/// Largest distance from a corner that counts as rounding, in periods.
const SLACK: f64 = 1e-13;

/// Returns the time by which the phase advances the waveform, s, within one period. A corner within rounding replaces the time.
fn shift(knots: &[f64], timing: &Timing) -> f64 {
    let period = timing.period;
    let shift = (timing.phase / TAU).rem_euclid(1.0) * period;
    if period - shift <= SLACK * period {
        return 0.0;
    }
    knots.iter().copied().find(|knot| (knot - shift).abs() <= SLACK * period).unwrap_or(shift)
}
