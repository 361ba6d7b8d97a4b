//! Cycles of one form, one after the other: where each begins and turns.

use crate::Piece;
use crate::waveform::{Command, Cycle};

/// Cycles of one form, one after the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Span {
    /// Start of the first, s.
    pub(in crate::state) origin: f64,
    /// s.
    pub(in crate::state) period: f64,
    /// When after its start a cycle turns, s.
    pub(in crate::state) top: f64,
    /// Value there.
    pub(in crate::state) stroke: f64,
}

impl Span {
    /// Cycles of a command from a time, s, on.
    pub(super) fn of(cycle: Cycle, command: &Command, origin: f64) -> Self {
        Self { origin, period: command.period(), top: cycle.top(command), stroke: command.stroke }
    }

    /// Whether it is made of the same cycles.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        (self.period, self.top, self.stroke) == (other.period, other.top, other.stroke)
    }

    /// Start of cycle `k`, s.
    pub(super) fn start(&self, k: u64) -> f64 {
        self.origin + k as f64 * self.period
    }

    /// Turn of cycle `k`, s.
    fn turn(&self, k: u64) -> f64 {
        self.origin + (k as f64 * self.period + self.top)
    }

    /// First or second way of cycle `k`.
    pub(super) fn piece(&self, k: u64, turned: bool) -> Piece {
        let top = (self.turn(k), self.stroke);
        if turned {
            Piece::straight(top, (self.start(k.saturating_add(1)), 0.0))
        } else {
            Piece::straight((self.start(k), 0.0), top)
        }
    }

    /// The way on which it is at `t`, s, from its first cycle on.
    pub(super) fn piece_at(&self, t: f64) -> Piece {
        let mut k = ((t - self.origin) / self.period).floor().max(0.0) as u64;
        // The division may be off by one where `t` lies on a corner.
        if k > 0 && self.start(k) > t {
            k -= 1;
        } else if self.start(k.saturating_add(1)) <= t {
            k = k.saturating_add(1);
        }
        self.piece(k, self.turn(k) <= t)
    }
}
