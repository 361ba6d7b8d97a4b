//! What a comparison is asked to allow.

/// What may differ, where not what the steppers of both runs promise.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Terms {
    /// Whether the tables of rows and of events must have the same bytes.
    pub exact: bool,
    /// Relative tolerance of all channels and figures, 0 or more; 0 asks for the same bits. None: the steppers decide.
    pub tolerance: Option<f64>,
    /// Absolute tolerances by channel or figure, with their units, such as "1 nm"; of several for one the last counts.
    pub absolute: Vec<(String, String)>,
    /// How far apart in time an event may be, s, 0 or more. None: the steppers decide.
    pub time_tolerance: Option<f64>,
    /// Channels and figures that are left out, or bodies, contacts and waveforms with all that belongs to them.
    pub ignore: Vec<String>,
}
