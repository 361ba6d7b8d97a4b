//! Input signal of a block, with its scales.

/// Input signal of a block, with its magnitude, its frequencies and the name of the block's output column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Index of the signal in the model: waveforms first, then blocks.
    pub signal: usize,
    /// Natural span of the signal in its own unit, above 0. Event functions and errors of states are scaled by this span.
    pub span: f64,
    /// Largest angular frequency of the signal, 1/s, above 0: 2π over the shortest period, or the bandwidth of the source.
    pub swings: f64,
    /// Largest angular frequency of reversals, 1/s, above 0: 2π over the shortest time between two reversals.
    ///
    /// `turns` is larger than `swings` if a waveform has corners close together.
    pub turns: f64,
    /// Name of the block's output column, with its SI unit.
    pub column: &'static str,
}
