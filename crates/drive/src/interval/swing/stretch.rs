//! A stretch of a swing, counted by its clock.

use super::{PhasePoint, Swing};
use crate::record::Stride;

/// From one moment of a swing to another. Its parts go with the clock: no moment is searched for. Where slip reaches a centre at the end
/// nodes are crowded by whoever lays them, as the profile asks for.
#[derive(Debug)]
pub struct Stretch<'s> {
    pub(super) swing: &'s Swing<'s>,
    /// Where the clock stands at both ends, and when, s.
    pub(super) clock: [f64; 2],
    time: [f64; 2],
}

impl Stretch<'_> {
    /// Whether no contact holds back.
    pub(crate) fn is_free(&self) -> bool {
        self.swing.is_free()
    }

    /// How long it takes, s.
    pub(crate) fn duration(&self) -> f64 {
        let [from, to] = self.time;
        to - from
    }

    /// Direction of the slide along the coordinate, ±1.
    pub(crate) fn sense(&self) -> f64 {
        self.swing.sense
    }

    /// Places, among all contacts, of those in partial slip, in the order of [`Rates`](super::Rates).
    pub(crate) fn slipping(&self) -> impl Iterator<Item = usize> + '_ {
        self.swing.slips.iter().map(|slip| slip.contact)
    }
}

impl Swing<'_> {
    /// The stretch between two moments, s, the second of them the event where that `is_end`.
    pub(crate) fn stretch(&mut self, [from, to]: [f64; 2], is_end: bool) -> Stretch<'_> {
        let begin = self.clock_when(from, (from == self.start.t).then_some(self.from));
        let end = self.clock_when(to, is_end.then_some(self.to));
        Stretch { swing: self, clock: [begin, end], time: [from, to] }
    }

    /// Where the clock stands at a time, s, if that is not known.
    fn clock_when(&mut self, t: f64, known: Option<f64>) -> f64 {
        match known {
            _ if self.is_free() => t,
            Some(at) => at,
            None => self.clock_at(t - self.start.t),
        }
    }

    /// Place, velocity and dt by the clock, s, where it stands so; the time, s, counts for the place alone.
    fn standing(&self, at: f64, t: f64) -> (PhasePoint, f64) {
        let way = self.way(at);
        let [slowness] = self.slowness([at]);
        (self.place((t, t - self.start.t), way, self.velocity(way)), slowness)
    }
}

impl Stride for Stretch<'_> {
    /// Times between both ends are in proportion: the followers go straight, and how far the slide has got does not depend on them.
    fn at(&mut self, part: f64, y: &mut [f64]) -> [f64; 2] {
        let ([begin, end], [from, to]) = (self.clock, self.time);
        let t = from + part * (to - from);
        let (place, pace) = if self.swing.is_free() {
            (self.swing.freely(t, t - self.swing.start.t), to - from)
        } else {
            let (place, slowness) = self.swing.standing(begin + part * (end - begin), t);
            (place, slowness * (end - begin))
        };
        if let [x, v, ..] = y {
            (*x, *v) = (place.x, place.v);
        }
        [t, pace]
    }

    fn arc(&self) -> Option<&Stretch<'_>> {
        Some(self)
    }

    fn knots(&self) -> &[(usize, f64)] {
        &[]
    }
}
