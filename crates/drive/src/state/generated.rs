//! What generators do: the cycle under way, and what has been commanded.
//!
//! Cycles of the same parameters that follow each other are a *span*: cycle k begins at origin + k·period, a product and never
//! a sum, as the corners of any periodic waveform. A command that changes the parameters ends the span at the end of its cycle.

mod span;

use super::State;
use crate::waveform::{Command, Cycle, Generator, Steps};
use crate::{Model, Piece, Waveform};
pub(super) use span::Span;
use thiserror::Error;

/// Why a generator does not take a command.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum CommandError {
    /// No waveform, or none that is generated.
    #[error("waveform {0} of the scene is no generator")]
    NoGenerator(usize),
    /// A stroke beyond what the checks before the run went by.
    #[error("generator {generator} takes strokes from {low} to {high}, got {got}")]
    Stroke {
        /// Place of the waveform in the scene.
        generator: usize,
        /// Smallest stroke.
        low: f64,
        /// Largest stroke.
        high: f64,
        /// What came.
        got: f64,
    },
    /// A frequency beyond what the checks before the run went by.
    #[error("generator {generator} takes frequencies from {low} Hz to {high} Hz, got {got}")]
    Frequency {
        /// Place of the waveform in the scene.
        generator: usize,
        /// Smallest frequency, Hz.
        low: f64,
        /// Largest frequency, Hz.
        high: f64,
        /// What came.
        got: f64,
    },
}

/// More cycles than a fixed step goes over.
const MOST: f64 = 1e9;

/// What a generator is doing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Generated {
    /// What the next cycle begins with; its steps are those still to begin, without a cycle that is under way.
    pub next: Command,
    /// Whether a cycle is under way; else it rests at 0.
    pub runs: bool,
    /// Cycles begun since t = 0.
    pub begun: u64,
    /// The steps of a command that is given now and leaves their number as it is: those of `next`, and a cycle that begins at this
    /// very moment, for which the command is in force, too.
    pub left: Steps,
}

/// What the future pieces of a generator depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Generating {
    /// Form of its cycles: the model's.
    pub(super) cycle: Cycle,
    /// What cycles begin with; its steps are left to begin.
    pub(super) command: Command,
    /// What takes its place in cycles that begin at this time, s, or later.
    pub(super) asked: Option<(f64, Command)>,
    /// The cycles under way; none at rest.
    pub(super) span: Option<Span>,
    /// Place of the present cycle in its span.
    pub(super) count: u64,
    /// Whether it is on its second way.
    pub(super) turned: bool,
    /// Cycles begun since t = 0.
    pub(super) begun: u64,
}

impl Generating {
    /// A generator from `t`, s, on, and its first piece.
    pub(super) fn new(cycle: Cycle, command: Command, t: f64) -> (Self, Piece) {
        let mut generating =
            Self { cycle, command, asked: None, span: None, count: 0, turned: false, begun: 0 };
        let first = generating.begin(t);
        (generating, first)
    }

    /// The piece after one that ends at `end`, s.
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

    /// A cycle from `t`, s, on, or rest: until the next command, where one waits.
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

    /// The piece that holds at `t`, s, for a step that began or ends beside the present one, among cycles like it; none at rest,
    /// which has no other.
    pub(crate) fn piece_at(&self, t: f64) -> Option<Piece> {
        self.span.map(|span| span.piece_at(t))
    }

    /// The same at a time, s, to which the steps of a run have come that do not end at corners, and the piece there.
    fn at(mut self, mut piece: Piece, t: f64) -> (Self, Piece) {
        while piece.end <= t {
            piece = self.next(piece.end);
        }
        (self, piece)
    }

    /// When after `t`, s, cycles of another form begin, or rest; infinite where nothing changes.
    fn changes(&self, piece: Piece, t: f64) -> f64 {
        let (mut ahead, piece) = self.at(piece, t);
        let Some(span) = ahead.span else { return piece.end };
        let end = span.start(ahead.count.saturating_add(1));
        ahead.turned = true;
        ahead.next(end);
        if ahead.span == Some(span) { f64::INFINITY } else { end }
    }

    /// Whether it can be on this piece at `t`, s: that of its cycle, or its rest, which ends where a command waits.
    pub(super) fn is_on(&self, piece: &Piece, t: f64) -> bool {
        let end = self.asked.map_or(f64::INFINITY, |(since, _)| since);
        let own = match self.span {
            Some(span) => span.piece(self.count, self.turned),
            None => rest(piece.start, end),
        };
        // Steps that cross corners stop less than a step beyond one; none has this many cycles.
        let cycles = (t - piece.end) * self.span.map_or(0.0, |span| span.period.recip());
        own == *piece
            && (cycles.is_nan() || cycles <= MOST)
            && (self.span.is_none() || self.begun > self.count)
    }

    /// Takes a command at `t`, s, on its present piece.
    fn take(&mut self, command: Command, piece: &mut Piece, t: f64) {
        // What was asked before has its place before the corner that comes next; two at one time are one.
        if let Some((_, before)) = self.asked.take_if(|(since, _)| *since < t) {
            self.command = before;
        }
        match self.span {
            // At rest; what does nothing needs no corner.
            None if piece.end > t && command.is_idle() => self.command = command,
            None => (self.asked, piece.end) = (Some((t, command)), piece.end.min(t)),
            Some(span) if piece.start == t && piece.end > t && !self.turned => {
                self.replace(span, command, piece);
            }
            Some(_) => self.asked = Some((t, command)),
        }
    }

    /// Takes a command at the very moment at which a cycle has begun: it is the cycle of the command.
    fn replace(&mut self, span: Span, mut command: Command, piece: &mut Piece) {
        let t = piece.start;
        if !command.is_idle() && Span::of(self.cycle, &command, t).is_like(&span) {
            if let Steps::Left(steps) = &mut command.steps {
                *steps -= 1;
            }
            self.command = command;
            return;
        }
        // It has not begun yet. What does begins with a corner of its own: velocities are others.
        (self.span, self.count, self.asked) = (None, 0, Some((t, command)));
        self.begun -= 1;
        *piece = rest(t, t);
    }
}

/// At 0 from one time to another, s.
fn rest(from: f64, end: f64) -> Piece {
    let mut piece = Piece::held(from, 0.0);
    piece.end = end;
    piece
}

impl Model {
    /// The generators of a state at t = 0, by the places of their waveforms; nothing in a scene without.
    pub(super) fn generators(&self) -> Vec<Option<Generating>> {
        if self.waveforms.iter().all(|waveform| waveform.generator().is_none()) {
            return Vec::new();
        }
        let of = |generator: &Generator| Generating::new(generator.cycle, generator.initial, 0.0).0;
        self.waveforms.iter().map(|waveform| waveform.generator().map(of)).collect()
    }

    /// The first piece of waveform `w`.
    pub(super) fn first_piece(&self, w: usize) -> Piece {
        let waveform = &self.waveforms[w];
        match waveform.generator() {
            Some(generator) => Generating::new(generator.cycle, generator.initial, 0.0).1,
            None => waveform.piece_at(0.0),
        }
    }
}

impl State {
    /// Commands generator `w` from the present time on.
    pub(crate) fn command(&mut self, model: &Model, w: usize, command: Command) -> Result<(), CommandError> {
        let generator = model.waveforms.get(w).and_then(Waveform::generator);
        let (Some(generator), Some(Some(generating))) = (generator, self.generators.get_mut(w)) else {
            return Err(CommandError::NoGenerator(w));
        };
        check(generator, w, &command)?;
        // Before anything has moved there is nothing to turn.
        if self.underway.is_none() && self.counts.steps == 0 {
            (*generating, self.pieces[w]) = Generating::new(generator.cycle, command, self.t);
        } else {
            generating.take(command, &mut self.pieces[w], self.t);
        }
        Ok(())
    }

    /// What generator `w`, the waveform at that place of the scene, is doing; none for another waveform.
    #[must_use]
    pub fn generated(&self, w: usize) -> Option<Generated> {
        let generating = (*self.generators.get(w)?)?;
        // Fixed steps stop beside corners: what has begun since is told.
        let (now, piece) = generating.at(self.pieces[w], self.t);
        let next = now.asked.map_or(now.command, |(_, command)| command);
        let begins = now.span.is_some() && !now.turned && piece.start == self.t;
        let left = match next.steps {
            Steps::Left(steps) if begins => Steps::Left(steps.saturating_add(1)),
            steps => steps,
        };
        Some(Generated { next, runs: now.span.is_some(), begun: now.begun, left })
    }

    /// The piece of a waveform without a caller that holds at `t`, s, after the present one; a generator then is on it.
    pub(crate) fn piece_at(&mut self, w: usize, waveform: &Waveform, t: f64) -> Piece {
        match self.generators.get_mut(w) {
            Some(Some(generating)) => {
                let (ahead, piece) = generating.at(self.pieces[w], t);
                *generating = ahead;
                piece
            }
            _ => waveform.piece_at(t),
        }
    }

    /// When the first generator changes its cycles, s: steps that cross corners end there. Infinite without generators.
    pub(crate) fn next_change(&self) -> f64 {
        let all = self.generators.iter().zip(&self.pieces);
        let changes = all.filter_map(|(generating, piece)| Some((*generating)?.changes(*piece, self.t)));
        changes.fold(f64::INFINITY, f64::min)
    }
}

fn check(generator: &Generator, place: usize, command: &Command) -> Result<(), CommandError> {
    let Command { stroke, frequency, .. } = *command;
    let (low, high) = generator.strokes;
    // Not a number is in no range.
    if !(stroke >= low && stroke <= high) {
        return Err(CommandError::Stroke { generator: place, low, high, got: stroke });
    }
    let (low, high) = generator.frequencies;
    if !(frequency >= low && frequency <= high) {
        return Err(CommandError::Frequency { generator: place, low, high, got: frequency });
    }
    Ok(())
}
