//! Chain of pieces and further properties that each kind of waveform computes from its parameters.

use super::corners::Corners;
use super::shape::{Interpolation, Sines};

/// Chain of pieces and properties of a waveform.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Course {
    pub(super) chain: Chain,
    /// Values before the start and after the stop, if they differ from the ends of the chain.
    pub(super) ends: Option<(f64, f64)>,
    /// Period, s, if any.
    pub(super) period: Option<f64>,
    /// Smallest and largest value over all time, or bounds of them.
    pub(super) range: (f64, f64),
    /// Period of the shortest wave in a smooth piece, s; infinite for polynomials, whose shape the error estimate of a step detects.
    pub(super) wave: f64,
    /// Whether the value has jumps.
    pub(super) has_jumps: bool,
}

/// Source of the pieces between start and stop.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Chain {
    /// Segments between corners.
    Corners(Corners),
    /// One sinusoidal piece without corners.
    Sines(Sines),
    /// A jump only: one constant value before this time (s), another one after it.
    Step(f64),
    /// Pieces supplied during the run; the initial value until then.
    Supplied(Interpolation),
}

impl Course {
    /// Copies another chain and its properties, reusing allocated memory.
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
