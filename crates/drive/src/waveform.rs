//! Prescribed functions of time (motions, forces, strokes) with exact corners.
//!
//! A waveform is a chain of smooth pieces on half-open intervals [start, end). A stepper samples the present [`Piece`] up to its end,
//! including the left-hand limit there, and continues with the piece [`Waveform::after`] it. Jumps occur between two pieces.
//!
//! Pieces of an input are supplied during the run; without them, the input has one piece with its initial value. A generator has pieces for
//! its initial command. After another command, the state of the run determines its pieces.

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
    /// Values before the start and after the stop.
    held: (f64, f64),
    /// Start and stop, s.
    window: (f64, f64),
}

/// Value of a waveform and its derivatives at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Value, in the unit of the driven quantity.
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
    /// [`WaveformError`] names the parameter, the expected and the given value.
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

    /// Returns the single cycles of a burst or a sequence within its period: start, s from the start of the period, and whether the cycle is
    /// reversed; and the duration of one cycle, s. `None` for other waveforms.
    #[must_use]
    pub fn pulses(&self) -> Option<(Vec<(f64, bool)>, f64)> {
        let Shape::Pattern { parts, .. } = &self.shape else { return None };
        let (mut pulses, mut start) = (Vec::new(), 0.0);
        for part in parts {
            match *part {
                Section::Run { cycles, reversed } => {
                    let from = start;
                    pulses.extend((0..cycles).map(|k| (from + f64::from(k) * self.given.period, reversed)));
                    start += f64::from(cycles) * self.given.period;
                }
                Section::Rest { duration } => start += duration,
            }
        }
        Some((pulses, self.given.period))
    }

    /// Copies another waveform, reusing allocated memory; does nothing if both are equal.
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

    /// Returns the constant zero, without corners.
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

    /// Returns the piece at `t` (s).
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

    /// Returns the piece that follows `piece`. The last piece has no end and follows itself. An input holds the final value of a supplied
    /// piece.
    #[must_use]
    pub fn after(&self, piece: &Piece) -> Piece {
        let mut next = *piece;
        // Skips pieces shorter than the spacing of floating-point times, at most one period.
        for _ in 0..self.corners().map_or(1, Corners::count).saturating_add(2) {
            next = self.following(&next);
            if next.start < next.end {
                break;
            }
        }
        next
    }

    /// Returns the piece at `t` (s) and all following pieces; the last piece has no end.
    pub fn pieces_from(&self, t: f64) -> impl Iterator<Item = Piece> {
        let next = |piece: &Piece| (piece.end < f64::INFINITY).then(|| self.after(piece));
        std::iter::successors(Some(self.piece_at(t)), next)
    }

    /// Returns value, rate and acceleration at `t` (s) on `piece`. The end of the piece gives the limit from the left.
    #[must_use]
    #[inline]
    pub fn sample(&self, piece: &Piece, t: f64) -> Sample {
        match &piece.law {
            Law::Straight(straight) => straight.at(t),
            _ => self.curved(piece, t),
        }
    }

    /// Samples a piece that is not linear. Never inlined, to keep [`Self::sample`] short.
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

    /// Returns value and derivatives at t = 0.
    pub fn first(&self) -> Sample {
        self.sample(&self.piece_at(0.0), 0.0)
    }

    /// Returns the jump of the value at the end of `piece`; exactly 0 if the waveform is continuous there.
    #[must_use]
    pub fn jump_after(&self, piece: &Piece) -> f64 {
        if piece.end == f64::INFINITY {
            return 0.0;
        }
        self.jump_between(piece, &self.after(piece))
    }

    /// Whether all pieces of the waveform are linear.
    #[must_use]
    pub fn is_straight(&self) -> bool {
        match &self.course.chain {
            Chain::Corners(corners) => corners.are_straight(),
            Chain::Sines(_) => false,
            Chain::Step(_) | Chain::Supplied(_) => true,
        }
    }

    /// Returns the interpolation of an input. None if the waveform is not an input.
    #[must_use]
    pub fn interpolation(&self) -> Option<Interpolation> {
        match self.course.chain {
            Chain::Supplied(interpolation) => Some(interpolation),
            Chain::Corners(_) | Chain::Sines(_) | Chain::Step(_) => None,
        }
    }

    /// Returns the generator of the waveform. None if the waveform is not a generator.
    #[must_use]
    pub fn generator(&self) -> Option<&Generator> {
        match &self.shape {
            Shape::Generator(generator) => Some(generator),
            _ => None,
        }
    }

    /// Whether the value has jumps.
    #[must_use]
    pub fn has_jumps(&self) -> bool {
        self.course.has_jumps
    }

    /// Returns the smallest and the largest value over all time. For a sum of sines these are bounds, usually within a few millionths; for
    /// an input they are the allowed range.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        self.course.range
    }

    /// Returns the period, s. None for waveforms that do not repeat, for inputs, and for generators at rest.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        self.course.period
    }

    /// Returns the characteristic duration, s: the period, or the time from start to stop. For a generator it is the shortest period.
    /// Infinite if the waveform never moves.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let (start, stop) = self.window;
        let whole = stop - start;
        self.shortest_period().unwrap_or(if whole > 0.0 { whole } else { f64::INFINITY })
    }

    /// Returns the shortest possible period, s. For a generator it is the period at the largest allowed frequency.
    #[must_use]
    pub(crate) fn shortest_period(&self) -> Option<f64> {
        let commanded = self.generator().map(|generator| generator.frequencies.1.recip());
        commanded.filter(|period| period.is_finite()).or(self.period())
    }

    /// Returns the period of the fastest sine in the waveform, s. None without sines.
    #[must_use]
    pub(crate) fn fastest_sine(&self) -> Option<f64> {
        let order = match &self.shape {
            Shape::Sine { .. } => 1.0,
            Shape::Harmonics { terms } => terms.iter().map(|term| term.order).fold(1.0, f64::max),
            _ => return None,
        };
        Some(self.timing.period / order)
    }

    /// Returns start and stop of the waveform, s; the stop may be infinite.
    #[must_use]
    pub fn window(&self) -> (f64, f64) {
        self.window
    }

    /// Returns a quarter of the shortest wave within a smooth piece, s: the largest step that cannot miss the wave. Infinite if all pieces
    /// are linear or cubic.
    #[must_use]
    pub fn resolution(&self) -> f64 {
        0.25 * self.course.wave
    }

    /// Returns the shape with which the waveform was created.
    #[must_use]
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Returns the timing with which the waveform was created; for a pattern it is the timing of one cycle of the repeated shape.
    #[must_use]
    pub fn given(&self) -> &Timing {
        &self.given
    }

    /// Returns the timing of the waveform; for a pattern it is the timing of the whole pattern.
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

    /// Returns the sinusoidal piece of a waveform without corners.
    fn sines(&self) -> Piece {
        Piece { start: self.window.0, end: self.window.1, index: 1, law: Law::Sines }
    }

    /// Returns the constant piece before the start.
    fn before(&self) -> Piece {
        let start = self.window.0;
        Piece { start: f64::NEG_INFINITY, end: start, ..Piece::held(start, self.held.0) }
    }

    /// Returns the constant piece after the stop, or the initial piece of an input.
    fn last(&self) -> Piece {
        let stop = self.window.1;
        let index = match &self.course.chain {
            Chain::Corners(corners) => corners.after(),
            Chain::Sines(_) => 2,
            Chain::Step(_) => 1,
            // An input has no piece before this one.
            Chain::Supplied(_) => 0,
        };
        Piece { index, ..Piece::held(stop, self.held.1) }
    }

    /// Returns the values before the start and after the stop of the waveform.
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
