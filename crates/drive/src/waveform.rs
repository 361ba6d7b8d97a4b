//! Prescribed motions (or forces, or strokes) in time, with exact corners.
//!
//! A waveform is a chain of smooth pieces, each on a half-open interval [start, end). A stepper keeps the [`Piece`] it
//! is on, samples that one also at its very end (the limit from the left), and then goes on to the piece
//! [`Waveform::after`] it. A value that jumps does so between two pieces.
//!
//! An input has no chain: its pieces are supplied while it runs, and without a caller it has a single one, its initial value.
//! A generator has the chain that it runs through without a caller; one that is commanded makes its pieces as it goes, and the
//! state of the run knows them.

mod corners;
mod course;
mod error;
mod piece;
mod shape;
mod straight;
mod timing;

pub use error::WaveformError;
pub use piece::Piece;
pub use shape::{Command, Cycle, Generator, Harmonic, Heading, Interpolation, Section, Shape, Steps, Sweep};
pub use timing::Timing;

use corners::Corners;
use course::{Chain, Course};
use shape::Law;

/// A prescribed function of time.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    shape: Shape,
    given: Timing,
    timing: Timing,
    course: Course,
    /// Values held before the start and after the stop.
    held: (f64, f64),
    /// When it starts and stops, s.
    window: (f64, f64),
}

/// Value of a waveform and its derivatives at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Value, in the unit of what is driven.
    pub value: f64,
    /// First derivative, per s.
    pub rate: f64,
    /// Second derivative, per s².
    pub acceleration: f64,
}

impl Waveform {
    /// Checks and prepares a waveform.
    ///
    /// # Errors
    ///
    /// [`WaveformError`] names the parameter, what was expected and what came.
    pub fn new(shape: Shape, timing: Timing) -> Result<Self, WaveformError> {
        let course = shape.course(&timing)?;
        let given = timing;
        let timing = shape.timing(given);
        let window = match &course.chain {
            Chain::Corners(corners) => corners.window(),
            Chain::Sines(_) => (timing.delay, timing.stop()),
            Chain::Step(time) => (*time, *time),
            Chain::Supplied(_) => (0.0, 0.0),
        };
        let mut waveform = Self { shape, given, timing, course, held: (0.0, 0.0), window };
        waveform.held = waveform.course.ends.unwrap_or_else(|| waveform.ends());
        Ok(waveform)
    }

    /// Becomes another one's copy, in the room there is; nothing is done where both are the same.
    pub(crate) fn copy(&mut self, from: &Self) {
        if self == from {
            return;
        }
        if self.shape != from.shape {
            self.shape.clone_from(&from.shape);
        }
        self.course.copy(&from.course);
        (self.given, self.timing) = (from.given, from.timing);
        (self.held, self.window) = (from.held, from.window);
    }

    /// Zero for ever, without a corner.
    pub(crate) fn held() -> Self {
        let shape = Shape::Table { points: vec![(0.0, 0.0)] };
        let held = (0.0, 0.0);
        let course = Course {
            chain: Chain::Step(0.0),
            ends: Some(held),
            period: None,
            range: held,
            wave: f64::INFINITY,
            has_jumps: false,
        };
        Self { shape, given: Timing::every(1.0), timing: Timing::every(1.0), course, held, window: held }
    }

    /// The piece that holds at `t` (s).
    #[must_use]
    pub fn piece_at(&self, t: f64) -> Piece {
        let (start, stop) = self.window;
        if t >= stop || matches!(self.course.chain, Chain::Supplied(_)) {
            self.last()
        } else if t >= start {
            self.corners().map_or_else(|| self.sines(), |corners| corners.piece_at(t))
        } else {
            self.before()
        }
    }

    /// The piece after this one; the last piece has no end and is followed by itself. An input holds the value with which
    /// a supplied piece ends.
    #[must_use]
    pub fn after(&self, piece: &Piece) -> Piece {
        let mut next = *piece;
        // Pieces shorter than the spacing of doubles are skipped, never all ways of a period.
        for _ in 0..self.corners().map_or(1, Corners::count).saturating_add(2) {
            next = self.following(&next);
            if next.start < next.end {
                break;
            }
        }
        next
    }

    /// The piece that holds at `t` (s) and those after it, to the last, which has no end.
    pub fn pieces_from(&self, t: f64) -> impl Iterator<Item = Piece> {
        let next = |piece: &Piece| (piece.end < f64::INFINITY).then(|| self.after(piece));
        std::iter::successors(Some(self.piece_at(t)), next)
    }

    /// Value, rate and acceleration at `t` (s) by the law of `piece`, also exactly at its end: the limit from the left.
    #[must_use]
    #[inline]
    pub fn sample(&self, piece: &Piece, t: f64) -> Sample {
        match &piece.law {
            Law::Straight(straight) => straight.at(t),
            _ => self.curved(piece, t),
        }
    }

    /// The laws that are not straight, kept out of the way of those that are.
    #[inline(never)]
    fn curved(&self, piece: &Piece, t: f64) -> Sample {
        match &piece.law {
            Law::Sines => self.sines_at(t),
            Law::Leg(placed) => {
                self.corners().map_or_else(|| self.sines_at(t), |corners| corners.on(placed, t))
            }
            law => law.at(t).unwrap_or_else(|| self.sines_at(t)),
        }
    }

    /// Value and slopes at t = 0.
    pub fn first(&self) -> Sample {
        self.sample(&self.piece_at(0.0), 0.0)
    }

    /// Jump of the value at the end of `piece`; exactly 0 where it is continuous.
    #[must_use]
    pub fn jump_after(&self, piece: &Piece) -> f64 {
        if piece.end == f64::INFINITY {
            return 0.0;
        }
        self.jump_between(piece, &self.after(piece))
    }

    /// Whether all its pieces are straight lines.
    #[must_use]
    pub fn is_straight(&self) -> bool {
        match &self.course.chain {
            Chain::Corners(corners) => corners.are_straight(),
            Chain::Sines(_) => false,
            Chain::Step(_) | Chain::Supplied(_) => true,
        }
    }

    /// How an input goes from value to value; none for what needs no caller.
    #[must_use]
    pub fn interpolation(&self) -> Option<Interpolation> {
        match self.course.chain {
            Chain::Supplied(interpolation) => Some(interpolation),
            Chain::Corners(_) | Chain::Sines(_) | Chain::Step(_) => None,
        }
    }

    /// What a caller may command of it; none for what is no generator.
    #[must_use]
    pub fn generator(&self) -> Option<&Generator> {
        match &self.shape {
            Shape::Generator(generator) => Some(generator),
            _ => None,
        }
    }

    /// Whether the value ever jumps by design.
    #[must_use]
    pub fn has_jumps(&self) -> bool {
        self.course.has_jumps
    }

    /// Smallest and largest value over all time: exact but for sums of several sines, where it is a bound, safe and
    /// usually within a few millionths; of an input what a caller may give.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        self.course.range
    }

    /// Period, s; none for what comes once, an input, or a generator that rests until it is commanded.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        self.course.period
    }

    /// Time after which it has shown all that it does, s: its period, or from its start to its stop; infinite where it never
    /// moves. Of a generator the shortest period: it moves as soon as it is told to.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let (start, stop) = self.window;
        let whole = stop - start;
        self.shortest_period().unwrap_or(if whole > 0.0 { whole } else { f64::INFINITY })
    }

    /// Shortest period that it can have, s: of a generator that of the largest frequency that may be commanded.
    #[must_use]
    pub(crate) fn shortest_period(&self) -> Option<f64> {
        let commanded = self.generator().map(|generator| generator.frequencies.1.recip());
        commanded.filter(|period| period.is_finite()).or(self.period())
    }

    /// Period of the fastest of its sines, s; none where it has none.
    #[must_use]
    pub(crate) fn fastest_sine(&self) -> Option<f64> {
        let order = match &self.shape {
            Shape::Sine { .. } => 1.0,
            Shape::Harmonics { terms } => terms.iter().map(|term| term.order).fold(1.0, f64::max),
            _ => return None,
        };
        Some(self.timing.period / order)
    }

    /// From when to when it moves, s; the second is infinite where that has no end.
    #[must_use]
    pub fn window(&self) -> (f64, f64) {
        self.window
    }

    /// Longest step, s, that cannot overlook a wave inside a smooth piece: a quarter of the shortest one; infinite where
    /// all pieces are straight or cubic.
    #[must_use]
    pub fn resolution(&self) -> f64 {
        0.25 * self.course.wave
    }

    /// Its form, as given.
    #[must_use]
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// When it runs, as given: of a pattern that of one cycle of what it repeats. With [`Self::shape`] it makes the same waveform again.
    #[must_use]
    pub fn given(&self) -> &Timing {
        &self.given
    }

    /// When it runs: of a pattern its own.
    #[must_use]
    pub fn timing(&self) -> &Timing {
        &self.timing
    }

    fn following(&self, piece: &Piece) -> Piece {
        if let Chain::Supplied(_) = self.course.chain {
            return self.kept(piece);
        }
        if piece.end >= self.window.1 {
            return self.last();
        }
        match self.corners() {
            Some(corners) => corners.piece(piece.index.saturating_add(1)),
            None => self.sines(),
        }
    }

    fn corners(&self) -> Option<&Corners> {
        match &self.course.chain {
            Chain::Corners(corners) => Some(corners),
            Chain::Sines(_) | Chain::Step(_) | Chain::Supplied(_) => None,
        }
    }

    /// The piece of a waveform without corners.
    fn sines(&self) -> Piece {
        Piece { start: self.window.0, end: self.window.1, index: 1, law: Law::Sines }
    }

    /// What is held before the start.
    fn before(&self) -> Piece {
        let start = self.window.0;
        Piece { start: f64::NEG_INFINITY, end: start, ..Piece::held(start, self.held.0) }
    }

    /// What is held after the stop, or of an input from the start on.
    fn last(&self) -> Piece {
        let stop = self.window.1;
        let index = match &self.course.chain {
            Chain::Corners(corners) => corners.after(),
            Chain::Sines(_) => 2,
            Chain::Step(_) => 1,
            // Nothing comes before it.
            Chain::Supplied(_) => 0,
        };
        Piece { index, ..Piece::held(stop, self.held.1) }
    }

    /// Values where the chain starts and ends.
    fn ends(&self) -> (f64, f64) {
        let (start, stop) = self.window;
        let first = self.corners().map_or_else(|| self.sines(), |corners| corners.piece(1));
        let ahead = self.corners().and_then(Corners::ahead);
        let before = ahead.unwrap_or_else(|| self.sample(&first, start).value);
        if stop == f64::INFINITY {
            return (before, before);
        }
        let last = self.corners().map_or(first, |corners| corners.piece(corners.after() - 1));
        let jumped = self.corners().and_then(Corners::beyond);
        (before, jumped.unwrap_or_else(|| self.sample(&last, stop).value))
    }
}

#[cfg(test)]
mod tests;
