//! Settings of a comparison.

/// Allowed differences of a comparison. The integrators of both runs determine all tolerances that are not given.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Terms {
    /// Whether the tables of rows and of events must be byte-identical.
    pub exact: bool,
    /// Relative tolerance of all channels and summary values, 0 or more. A tolerance of 0 requires identical bits.
    pub tolerance: Option<f64>,
    /// Absolute tolerances of channels or summary values, with units, such as "1 nm". For a repeated name, the last tolerance counts.
    pub absolute: Vec<(String, String)>,
    /// Allowed time difference of an event, s, 0 or more.
    pub time_tolerance: Option<f64>,
    /// Names that are ignored. The name of a body, contact or waveform includes all of its channels and summary values.
    pub ignore: Vec<String>,
}
