//! Why a waveform makes no sense, and the checks that its kinds share.

/// Why a waveform makes no sense.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum WaveformError {
    /// A number out of its range.
    #[error("{key}: expected {expected}, got {got}")]
    Number {
        /// Name of the parameter.
        key: &'static str,
        /// What would be allowed.
        expected: &'static str,
        /// What came.
        got: f64,
    },
    /// A flyback that is negative or leaves no time for the way up.
    #[error("flyback: expected a time of at least 0 and below the period of {period} s, got {got}")]
    Flyback {
        /// Period, s.
        period: f64,
        /// What came, s.
        got: f64,
    },
    /// A turn that is negative or leaves no time for the ways beside it.
    #[error("turn: expected a time of at least 0 and below the period of {period} s, got {got}")]
    Turn {
        /// Period, s.
        period: f64,
        /// What came, s.
        got: f64,
    },
    /// Rise, hold and fall that take no time or more than there is.
    #[error(
        "rise: expected rise, hold and fall above 0 and within the period of {period} s, got {got} s together"
    )]
    Busy {
        /// Period, s.
        period: f64,
        /// All three, s.
        got: f64,
    },
    /// Phases of constant jerk for which there is no time.
    #[error(
        "rounding: expected a time above 0 and at most a quarter of the shorter way, {most} s, got {got}"
    )]
    Rounding {
        /// Quarter of the shorter way, s.
        most: f64,
        /// What came, s.
        got: f64,
    },
    /// A limit of the rate below the slow way's own.
    #[error("rate: expected at least {least} per s, at which the slow way goes, got {got}")]
    Rate {
        /// Rate of the slow way, per s.
        least: f64,
        /// What came, per s.
        got: f64,
    },
    /// Points to be repeated that span no time.
    #[error("points: expected points of different times to repeat, got {got} s from first to last")]
    Span {
        /// Time from the first to the last, s.
        got: f64,
    },
    /// A shape that jumps, to be run through backwards.
    #[error("reversed: expected a shape without a jump")]
    Reversed,
    /// A shape whose cycles do not begin anew.
    #[error("sequence: expected a shape whose every cycle is the same")]
    Carrier,
    /// No points or no terms.
    #[error("{key}: expected at least one, got none")]
    Empty {
        /// Name of the list.
        key: &'static str,
    },
    /// Times of a table that do not rise.
    #[error("points: expected times that rise, got {got} s after {before} s at point {place} (from 0)")]
    Times {
        /// Place of the point, from 0.
        place: usize,
        /// Time of the point before, s.
        before: f64,
        /// Its time, s.
        got: f64,
    },
    /// Three points of a table at one time.
    #[error(
        "points: expected at most two points at one time (a jump), got a third at {time} s, point {place} (from 0)"
    )]
    Crowd {
        /// Place of the third point, from 0.
        place: usize,
        /// The time, s.
        time: f64,
    },
    /// A range of an input whose bounds are the wrong way round.
    #[error("range: expected the smallest value before the largest, got {low} and {high}")]
    Range {
        /// First bound.
        low: f64,
        /// Second bound.
        high: f64,
    },
    /// An initial value of an input outside of its range.
    #[error("initial: expected a value in the range from {low} to {high}, got {got}")]
    Initial {
        /// Smallest value of the range.
        low: f64,
        /// Largest value of the range.
        high: f64,
        /// What came.
        got: f64,
    },
    /// A range of a generator whose bounds are the wrong way round.
    #[error("{key}: expected a range with the smallest value before the largest, got {low} and {high}")]
    Bounds {
        /// Name of the parameter.
        key: &'static str,
        /// First bound.
        low: f64,
        /// Second bound.
        high: f64,
    },
    /// An initial parameter of a generator outside of its range.
    #[error("{key}: expected a value in the range from {low} to {high}, got {got}")]
    Outside {
        /// Name of the parameter.
        key: &'static str,
        /// Smallest value of the range.
        low: f64,
        /// Largest value of the range.
        high: f64,
        /// What came.
        got: f64,
    },
    /// A flyback as long as the shortest period that may be commanded.
    #[error(
        "flyback: expected a time below the period of the largest frequency, {frequency} Hz, got {flyback}"
    )]
    Room {
        /// Time of the flyback, s.
        flyback: f64,
        /// Largest frequency, Hz.
        frequency: f64,
    },
}

impl WaveformError {
    /// Name of the parameter that is wrong.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::Number { key, .. } | Self::Empty { key } => key,
            Self::Bounds { key, .. } | Self::Outside { key, .. } => key,
            Self::Flyback { .. } | Self::Room { .. } => "flyback",
            Self::Turn { .. } => "turn",
            Self::Busy { .. } => "rise",
            Self::Rounding { .. } => "rounding",
            Self::Rate { .. } => "rate",
            Self::Reversed => "reversed",
            Self::Carrier => "sequence",
            Self::Times { .. } | Self::Crowd { .. } | Self::Span { .. } => "points",
            Self::Range { .. } => "range",
            Self::Initial { .. } => "initial",
        }
    }
}

pub(super) fn finite(key: &'static str, got: f64) -> Result<(), WaveformError> {
    within(key, got, "a finite number", true)
}

/// A value whose rate of change (or acceleration, or sum) is a number as well.
pub(super) fn smooth(key: &'static str, got: f64, steepest: f64) -> Result<(), WaveformError> {
    within(key, got, "a value that changes at a finite rate", steepest.is_finite())
}

pub(super) fn within(
    key: &'static str,
    got: f64,
    expected: &'static str,
    allowed: bool,
) -> Result<(), WaveformError> {
    if allowed && got.is_finite() { Ok(()) } else { Err(WaveformError::Number { key, expected, got }) }
}
