//! State of generators: the present cycle and commands.
//!
//! Successive cycles with equal parameters form a *span*. Cycle k of a span begins at origin + k·period, computed as a product. A command
//! with other parameters ends the span at the end of the cycle in progress.

mod span;

use super::State;
use crate::waveform::{Command, Cycle, Generator, Steps};
use crate::{Model, Piece, Waveform};
pub(super) use span::Span;
use thiserror::Error;

/// Reason why a generator refuses a command.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CommandError {
    /// The waveform does not exist or is no generator.
    #[error("waveform {0} is not a generator")]
    NoGenerator(usize),
    /// The stroke is out of range.
    #[error("generator {generator}: expected a stroke from {low} to {high}, got {got}")]
    Stroke {
        /// Index of the waveform.
        generator: usize,
        /// Smallest stroke.
        low: f64,
        /// Largest stroke.
        high: f64,
        /// Given value.
        got: f64,
    },
    /// The frequency is out of range.
    #[error("generator {generator}: expected a frequency from {low} Hz to {high} Hz, got {got}")]
    Frequency {
        /// Index of the waveform.
        generator: usize,
        /// Smallest frequency, Hz.
        low: f64,
        /// Largest frequency, Hz.
        high: f64,
        /// Given value, Hz.
        got: f64,
    },
}

/// Largest number of cycles in a fixed step.
const MOST: f64 = 1e9;

/// Present activity of a generator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Generated {
    /// Command for the next cycle. The number of steps in the command does not include a cycle in progress.
    pub next: Command,
    /// Whether a cycle is in progress; otherwise the generator rests at 0.
    pub runs: bool,
    /// Number of cycles begun since t = 0.
    pub begun: u64,
    /// Number of steps that a command given now must contain to leave the number of remaining cycles unchanged. A cycle that begins at this
    /// time is included, because the command would apply to it.
    pub left: Steps,
}

/// State of a generator, which determines its future pieces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Generating {
    /// Form of the generator's cycles, from the model.
    pub(super) cycle: Cycle,
    /// Present command; its number of steps counts cycles not yet begun.
    pub(super) command: Command,
    /// Command for cycles that begin at this time (s) or later.
    pub(super) asked: Option<(f64, Command)>,
    /// Present span of cycles; none at rest.
    pub(super) span: Option<Span>,
    /// Index of the present cycle in its span.
    pub(super) count: u64,
    /// Whether the cycle is in its second half.
    pub(super) turned: bool,
    /// Number of cycles begun since t = 0.
    pub(super) begun: u64,
}

impl Generating {
    /// Returns a generator that starts at `t` (s), and its first piece.
    pub(super) fn new(cycle: Cycle, command: Command, t: f64) -> (Self, Piece) {
        let mut generating =
            Self { cycle, command, asked: None, span: None, count: 0, turned: false, begun: 0 };
        let first = generating.begin(t);
        (generating, first)
    }

    /// Returns the piece that follows the piece ending at `end` (s).
    pub(super) fn next(&mut self, end: f64) -> Piece {
        if let (Some(span), false) = (self.span, self.turned) {
            self.turned = true;
            return span.piece(self.count, true);
        }
        if let Some((_, command)) = self.asked.take_if(|(since, _)| *since <= end) {
            self.command = command;
        }
        self.begin(end)
    }

    /// Begins a cycle at `t` (s), or a rest until the next command.
    fn begin(&mut self, t: f64) -> Piece {
        self.turned = false;
        if self.command.is_idle() {
            (self.span, self.count) = (None, 0);
            let end = self.asked.map_or(f64::INFINITY, |(since, _)| since);
            return rest(t, end);
        }
        if let Steps::Left(steps) = &mut self.command.steps {
            *steps -= 1;
        }
        self.begun += 1;
        let fresh = Span::of(self.cycle, &self.command, t);
        match self.span {
            Some(span) if span.is_like(&fresh) => self.count += 1,
            _ => (self.span, self.count) = (Some(fresh), 0),
        }
        self.span.unwrap_or(fresh).piece(self.count, false)
    }

    /// Returns the generator and its piece at a later time `t` (s).
    fn at(mut self, mut piece: Piece, t: f64) -> (Self, Piece) {
        while piece.end <= t {
            piece = self.next(piece.end);
        }
        (self, piece)
    }

    /// Whether `piece` is the piece of this state, and `t` (s) is not too far beyond its end.
    pub(super) fn is_on(&self, piece: &Piece, t: f64) -> bool {
        let end = self.asked.map_or(f64::INFINITY, |(since, _)| since);
        let own = match self.span {
            Some(span) => span.piece(self.count, self.turned),
            None => rest(piece.start, end),
        };
        // Fixed steps cross a corner by less than a step.
        let cycles = (t - piece.end) * self.span.map_or(0.0, |span| span.period.recip());
        own == *piece
            && (cycles.is_nan() || cycles <= MOST)
            && (self.span.is_none() || self.begun > self.count)
    }

    /// Accepts a command at `t` (s) while the waveform is on `piece`.
    fn take(&mut self, command: Command, piece: &mut Piece, t: f64) {
        // A pending command of an earlier time takes effect first; of two commands at one time the later replaces the earlier.
        if let Some((_, before)) = self.asked.take_if(|(since, _)| *since < t) {
            self.command = before;
        }
        match self.span {
            // At rest a command without motion needs no corner.
            None if piece.end > t && command.is_idle() => self.command = command,
            None => (self.asked, piece.end) = (Some((t, command)), piece.end.min(t)),
            Some(span) if piece.start == t && piece.end > t && !self.turned => {
                self.replace(span, command, piece);
            }
            Some(_) => self.asked = Some((t, command)),
        }
    }

    /// Accepts a command at the start of a cycle. The command applies to this cycle.
    fn replace(&mut self, span: Span, mut command: Command, piece: &mut Piece) {
        let t = piece.start;
        if !command.is_idle() && Span::of(self.cycle, &command, t).is_like(&span) {
            if let Steps::Left(steps) = &mut command.steps {
                *steps -= 1;
            }
            self.command = command;
            return;
        }
        // The cycle is replaced; the new one begins with a corner.
        (self.span, self.count, self.asked) = (None, 0, Some((t, command)));
        self.begun -= 1;
        *piece = rest(t, t);
    }
}

/// Returns a piece with value 0 between two times, s.
fn rest(from: f64, end: f64) -> Piece {
    let mut piece = Piece::held(from, 0.0);
    piece.end = end;
    piece
}

impl Model {
    /// Returns the generators at t = 0 by index of their waveforms; empty if the model has no generators.
    pub(super) fn generators(&self) -> Vec<Option<Generating>> {
        if self.waveforms.iter().all(|waveform| waveform.generator().is_none()) {
            return Vec::new();
        }
        let of = |generator: &Generator| Generating::new(generator.cycle, generator.initial, 0.0).0;
        self.waveforms.iter().map(|waveform| waveform.generator().map(of)).collect()
    }

    /// Returns the first piece of waveform `w`.
    pub(super) fn first_piece(&self, w: usize) -> Piece {
        let waveform = &self.waveforms[w];
        match waveform.generator() {
            Some(generator) => Generating::new(generator.cycle, generator.initial, 0.0).1,
            None => waveform.piece_at(0.0),
        }
    }
}

impl State {
    /// Gives generator `w` a command at the present time.
    pub(crate) fn command(&mut self, model: &Model, w: usize, command: Command) -> Result<(), CommandError> {
        let generator = model.waveforms.get(w).and_then(Waveform::generator);
        let (Some(generator), Some(Some(generating))) = (generator, self.generators.get_mut(w)) else {
            return Err(CommandError::NoGenerator(w));
        };
        check(generator, w, &command)?;
        // Before the first step the initial command is replaced.
        if self.underway.is_none() && self.counts.steps == 0 {
            (*generating, self.pieces[w]) = Generating::new(generator.cycle, command, self.t);
        } else {
            generating.take(command, &mut self.pieces[w], self.t);
        }
        Ok(())
    }

    /// Returns the activity of the generator with waveform index `w`. None if this waveform is not a generator.
    #[must_use]
    pub fn generated(&self, w: usize) -> Option<Generated> {
        let generating = (*self.generators.get(w)?)?;
        // Fixed steps stop near corners; later cycles are included.
        let (now, piece) = generating.at(self.pieces[w], self.t);
        let next = now.asked.map_or(now.command, |(_, command)| command);
        let begins = now.span.is_some() && !now.turned && piece.start == self.t;
        let left = match next.steps {
            Steps::Left(steps) if begins => Steps::Left(steps.saturating_add(1)),
            steps => steps,
        };
        Some(Generated { next, runs: now.span.is_some(), begun: now.begun, left })
    }
}

fn check(generator: &Generator, place: usize, command: &Command) -> Result<(), CommandError> {
    let Command { stroke, frequency, .. } = *command;
    let (low, high) = generator.strokes;
    // NaN is in no range.
    if !(stroke >= low && stroke <= high) {
        return Err(CommandError::Stroke { generator: place, low, high, got: stroke });
    }
    let (low, high) = generator.frequencies;
    if !(frequency >= low && frequency <= high) {
        return Err(CommandError::Frequency { generator: place, low, high, got: frequency });
    }
    Ok(())
}
