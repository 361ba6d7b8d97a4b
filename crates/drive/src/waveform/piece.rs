//! Pieces: what a waveform is between two corners, and how one follows another.

use super::course::Chain;
use super::shape::Law;
use super::straight::{Line, Straight};
use super::{Corners, Sample, Waveform};

/// A smooth piece of a waveform, on [start, end). A state keeps one for each waveform: where a step ends at a corner, both
/// pieces hold there, and only who comes from where knows which velocity counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Start, s; [`f64::NEG_INFINITY`] for the value held before a waveform starts.
    pub start: f64,
    /// End, s; [`f64::INFINITY`] if there is none.
    pub end: f64,
    /// Place in the chain, 0 for what is held before the start; 0 also for all pieces of an input, which has no chain.
    pub index: u64,
    pub(super) law: Law,
}

impl Piece {
    /// Held at `value` from `start` (s, finite) on, without an end.
    pub(crate) fn held(start: f64, value: f64) -> Self {
        let law = Law::Straight(Straight::held(start, value));
        Self { start, end: f64::INFINITY, index: 0, law }
    }

    /// Straight from one (time in s, value) to a later one. It is the piece of a sawtooth between such corners to the bit.
    pub(crate) fn straight(from: (f64, f64), to: (f64, f64)) -> Self {
        Self { start: from.0, end: to.0, index: 0, law: Law::Straight(Straight::between(from, to)) }
    }

    /// What a supplied piece is made of: start and end, s, and its straight way.
    pub(crate) fn supplied(&self) -> [f64; 7] {
        let Law::Straight(straight) = &self.law else { return [f64::NAN; 7] };
        let [a, b, c, d, rate] = straight.numbers();
        [self.start, self.end, a, b, c, d, rate]
    }

    /// A supplied piece of these; none where its time does not go on or its way is not finite.
    pub(crate) fn of_supplied([start, end, a, b, c, d, rate]: [f64; 7]) -> Option<Self> {
        let way = [a, b, c, d, rate];
        let goes_on = start <= end && way.iter().all(|number| number.is_finite());
        goes_on.then_some(Self { start, end, index: 0, law: Law::Straight(Straight::of(way)) })
    }

    /// The line that the value follows, where it moves at a constant rate.
    pub(crate) fn line(&self) -> Option<Line> {
        match &self.law {
            Law::Straight(straight) => Some(straight.line()),
            _ => None,
        }
    }

    /// Whether the value follows the sines of its waveform.
    pub(crate) fn is_sines(&self) -> bool {
        self.law == Law::Sines
    }
}

impl Waveform {
    /// Shortest time between two turns, s, but for few: its shortest piece, or its shortest wave; infinite where it never moves.
    #[must_use]
    pub fn quickest(&self) -> f64 {
        let pieces = self.corners().map_or(f64::INFINITY, Corners::shortest);
        self.extent().min(self.course.wave).min(pieces)
    }

    /// Jump of the value from the end of one piece to the start of the next.
    ///
    /// A supplied piece ends where the next one starts, also where it would have gone on.
    pub(crate) fn jump_between(&self, piece: &Piece, next: &Piece) -> f64 {
        let end = match self.course.chain {
            Chain::Supplied(_) => piece.end.min(next.start),
            Chain::Corners(_) | Chain::Sines(_) | Chain::Step(_) => piece.end,
        };
        self.sample(next, next.start).value - self.sample(piece, end).value
    }

    /// Its sines at `t`, whatever piece it is on; zeros where it has none.
    pub(crate) fn sines_at(&self, t: f64) -> Sample {
        match &self.course.chain {
            Chain::Sines(sines) => sines.at(&self.timing, t),
            _ => Sample { value: 0.0, rate: 0.0, acceleration: 0.0 },
        }
    }

    /// A bound of the third derivative of its sines, per s³; 0 where it has none.
    pub(crate) fn sines_jerk(&self) -> f64 {
        match &self.course.chain {
            Chain::Sines(sines) => sines.jerk(&self.timing),
            _ => 0.0,
        }
    }

    /// The piece with this index, the same to the bit however it was reached; none where the chain has no such piece, and
    /// none of an input, whose pieces only their caller knows.
    pub(crate) fn piece(&self, index: u64) -> Option<Piece> {
        let last = match &self.course.chain {
            Chain::Corners(corners) => corners.after(),
            Chain::Sines(_) => 2,
            Chain::Step(_) => 1,
            Chain::Supplied(_) => return None,
        };
        match index {
            0 => Some(self.before()),
            _ if index < last => {
                Some(self.corners().map_or_else(|| self.sines(), |c| Corners::piece(c, index)))
            }
            _ => (index == last && self.window.1 < f64::INFINITY).then(|| self.last()),
        }
    }

    /// The piece that holds the value with which a supplied one ends; that one itself where it has no end.
    pub(super) fn kept(&self, piece: &Piece) -> Piece {
        if piece.end == f64::INFINITY {
            return *piece;
        }
        Piece::held(piece.end, self.sample(piece, piece.end).value)
    }
}
