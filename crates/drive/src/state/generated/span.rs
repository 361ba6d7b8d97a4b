//! Successive cycles of a generator with equal parameters: their start and turning times.

use crate::Piece;
use crate::waveform::{Command, Cycle};

/// Successive cycles of a generator with equal parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Span {
    /// Start of the first cycle, s.
    pub(in crate::state) origin: f64,
    /// Period, s.
    pub(in crate::state) period: f64,
    /// Time from the start of a cycle to its turning point, s.
    pub(in crate::state) top: f64,
    /// Value at the turning point.
    pub(in crate::state) stroke: f64,
}

impl Span {
    /// Returns the cycles that a command produces from time `origin` (s).
    pub(super) fn of(cycle: Cycle, command: &Command, origin: f64) -> Self {
        Self { origin, period: command.period(), top: cycle.top(command), stroke: command.stroke }
    }

    /// Whether the cycles of both spans are equal.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        (self.period, self.top, self.stroke) == (other.period, other.top, other.stroke)
    }

    /// Returns the start of cycle `k`, s.
    pub(super) fn start(&self, k: u64) -> f64 {
        self.origin + k as f64 * self.period
    }

    /// Returns the turning time of cycle `k`, s.
    fn turn(&self, k: u64) -> f64 {
        self.origin + (k as f64 * self.period + self.top)
    }

    /// Returns the first or the second half of cycle `k`.
    pub(super) fn piece(&self, k: u64, turned: bool) -> Piece {
        let top = (self.turn(k), self.stroke);
        if turned {
            Piece::straight(top, (self.start(k.saturating_add(1)), 0.0))
        } else {
            Piece::straight((self.start(k), 0.0), top)
        }
    }
}
