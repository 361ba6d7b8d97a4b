//! What a block of this crate reads, and how large and fast that is.

/// A signal that a block reads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Its place among the signals of the scene: waveforms, then blocks.
    pub signal: usize,
    /// Natural span of the signal, in its own unit, above 0. Guards and errors of states are measured by it.
    pub span: f64,
    /// The fastest at which it swings, 1/s, above 0: 2π over the shortest period, or the bandwidth of what makes it.
    pub swings: f64,
    /// The fastest at which it turns, 1/s, above 0: 2π over the shortest time between two turns. More than `swings` where a waveform
    /// has corners close together.
    pub turns: f64,
    /// Name of the block's column, with its SI unit.
    pub column: &'static str,
}
