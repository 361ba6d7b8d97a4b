//! What a kind of waveform makes of its parameters.

use super::corners::Corners;
use super::shape::{Interpolation, Sines};

/// All that a waveform asks of its kind: the chain of pieces, and what is known of it without following it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Course {
    pub(super) chain: Chain,
    /// Values held before the start and after the stop, where they are not where the chain starts and ends.
    pub(super) ends: Option<(f64, f64)>,
    /// Period, s, if it has one.
    pub(super) period: Option<f64>,
    /// Smallest and largest value over all time, or bounds of them.
    pub(super) range: (f64, f64),
    /// Period of the shortest wave in a smooth piece, s; infinite where all pieces are polynomials, of
    /// which a step misses nothing that its error does not show.
    pub(super) wave: f64,
    /// Whether the value ever jumps by design.
    pub(super) has_jumps: bool,
}

/// Where the pieces between start and stop come from.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Chain {
    /// Ways between corners.
    Corners(Corners),
    /// A single piece without a corner.
    Sines(Sines),
    /// No piece: one value up to this time (s), one from then on.
    Step(f64),
    /// Pieces that a caller supplies while it runs; until then the value at the start.
    Supplied(Interpolation),
}

impl Course {
    /// Becomes another one's copy, in the room there is.
    pub(super) fn copy(&mut self, from: &Self) {
        let Self { chain, ends, period, range, wave, has_jumps } = from;
        match (&mut self.chain, chain) {
            (Chain::Corners(own), Chain::Corners(from)) => own.copy(from),
            (own, from) => own.clone_from(from),
        }
        (self.ends, self.period, self.range) = (*ends, *period, *range);
        (self.wave, self.has_jumps) = (*wave, *has_jumps);
    }
}
