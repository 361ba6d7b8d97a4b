//! Smooth pieces of a waveform between two corners.

use super::course::Chain;
use super::shape::Law;
use super::straight::{Line, Straight};
use super::{Corners, Sample, Waveform};

/// A smooth piece of a waveform on [start, end). The state holds the present piece of each waveform. At a corner, the piece determines
/// whether the velocity before or after the corner applies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Start, s; [`f64::NEG_INFINITY`] for the value before the waveform starts.
    pub start: f64,
    /// End, s; [`f64::INFINITY`] if the piece has no end.
    pub end: f64,
    /// Index of the piece in the chain; 0 for the value before the start and for all pieces of an input.
    pub index: u64,
    pub(super) law: Law,
}

impl Piece {
    /// Returns a piece with a constant `value` from `start` (s, finite), without an end.
    pub(crate) fn held(start: f64, value: f64) -> Self {
        let law = Law::Straight(Straight::held(start, value));
        Self { start, end: f64::INFINITY, index: 0, law }
    }

    /// Returns a linear piece between two points (time in s, value), with bits identical to a segment of a sawtooth.
    pub(crate) fn straight(from: (f64, f64), to: (f64, f64)) -> Self {
        Self { start: from.0, end: to.0, index: 0, law: Law::Straight(Straight::between(from, to)) }
    }

    /// Returns the data of a supplied piece: start and end, s, and the coefficients of its linear law.
    pub(crate) fn supplied(&self) -> [f64; 7] {
        let Law::Straight(straight) = &self.law else { return [f64::NAN; 7] };
        let [a, b, c, d, rate] = straight.numbers();
        [self.start, self.end, a, b, c, d, rate]
    }

    /// Returns a supplied piece from its data. None if the end precedes the start or a coefficient is not finite.
    pub(crate) fn of_supplied([start, end, a, b, c, d, rate]: [f64; 7]) -> Option<Self> {
        let way = [a, b, c, d, rate];
        let goes_on = start <= end && way.iter().all(|number| number.is_finite());
        goes_on.then_some(Self { start, end, index: 0, law: Law::Straight(Straight::of(way)) })
    }

    /// Returns the piece as a straight line, if its rate is constant.
    pub(crate) fn line(&self) -> Option<Line> {
        match &self.law {
            Law::Straight(straight) => Some(straight.line()),
            _ => None,
        }
    }

    /// Whether the piece follows the sines of its waveform.
    pub(crate) fn is_sines(&self) -> bool {
        self.law == Law::Sines
    }
}

impl Waveform {
    /// Returns the shortest time scale, s: the shortest piece or wave. Infinite if the waveform never moves.
    #[must_use]
    pub fn quickest(&self) -> f64 {
        let pieces = self.corners().map_or(f64::INFINITY, Corners::shortest);
        self.extent().min(self.course.wave).min(pieces)
    }

    /// Returns the jump from the end of one piece to the start of the next. A supplied piece ends where the next one starts.
    pub(crate) fn jump_between(&self, piece: &Piece, next: &Piece) -> f64 {
        let end = match self.course.chain {
            Chain::Supplied(_) => piece.end.min(next.start),
            Chain::Corners(_) | Chain::Sines(_) | Chain::Step(_) => piece.end,
        };
        self.sample(next, next.start).value - self.sample(piece, end).value
    }

    /// Returns the sum of sines of the waveform at `t` (s); zeros if it has no sines.
    pub(crate) fn sines_at(&self, t: f64) -> Sample {
        match &self.course.chain {
            Chain::Sines(sines) => sines.at(&self.timing, t),
            _ => Sample { value: 0.0, rate: 0.0, acceleration: 0.0 },
        }
    }

    /// Returns a bound on the third derivative of the sum of sines, per s³; 0 without sines.
    pub(crate) fn sines_jerk(&self) -> f64 {
        match &self.course.chain {
            Chain::Sines(sines) => sines.jerk(&self.timing),
            _ => 0.0,
        }
    }

    /// Returns the piece with this index, bit-identical to the piece in the chain. None for an input or an index beyond the chain.
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

    /// Returns the piece that holds the final value of a supplied piece. A piece without an end is returned unchanged.
    pub(super) fn kept(&self, piece: &Piece) -> Piece {
        if piece.end == f64::INFINITY {
            return *piece;
        }
        Piece::held(piece.end, self.sample(piece, piece.end).value)
    }
}
