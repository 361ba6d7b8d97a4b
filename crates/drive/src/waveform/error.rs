//! Errors of waveforms, and checks that several shapes share.

/// Reason why a waveform is invalid.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum WaveformError {
    /// A number is out of range.
    #[error("{key}: expected {expected}, got {got}")]
    Number {
        /// Name of the parameter.
        key: &'static str,
        /// Allowed values.
        expected: &'static str,
        /// Given value.
        got: f64,
    },
    /// The flyback is negative or leaves no time for the forward stroke.
    #[error("flyback: expected a time of at least 0 and below the period of {period} s, got {got}")]
    Flyback {
        /// Period, s.
        period: f64,
        /// Given value, s.
        got: f64,
    },
    /// The duration of the turn is negative or leaves no time for the other segments.
    #[error("turn: expected a time of at least 0 and below the period of {period} s, got {got}")]
    Turn {
        /// Period, s.
        period: f64,
        /// Given value, s.
        got: f64,
    },
    /// The sum of rise, hold and fall is zero or longer than the period.
    #[error(
        "rise: expected rise, hold and fall above 0 and within the period of {period} s, got {got} s together"
    )]
    Busy {
        /// Period, s.
        period: f64,
        /// Sum of rise, hold and fall, s.
        got: f64,
    },
    /// The duration of the phases of constant jerk is zero or too long.
    #[error(
        "rounding: expected a time above 0 and at most a quarter of the shorter stroke time, {most} s, got {got}"
    )]
    Rounding {
        /// A quarter of the shorter stroke, s.
        most: f64,
        /// Given value, s.
        got: f64,
    },
    /// The rate limit is below the rate of the slow stroke.
    #[error("rate: expected at least the rate of the slow stroke, {least} per s, got {got}")]
    Rate {
        /// Rate of the slow stroke, per s.
        least: f64,
        /// Given value, per s.
        got: f64,
    },
    /// The points to be repeated have zero duration.
    #[error("points: expected points of different times to repeat, got {got} s from first to last")]
    Span {
        /// Time from the first to the last point, s.
        got: f64,
    },
    /// A shape with jumps cannot be reversed.
    #[error("reversed: expected a waveform without a jump")]
    Reversed,
    /// The cycles of the shape are not all equal.
    #[error("sequence: expected a waveform with identical cycles")]
    Carrier,
    /// A list of points or terms is empty.
    #[error("{key}: expected at least one, got none")]
    Empty {
        /// Name of the list.
        key: &'static str,
    },
    /// The times of a table do not increase.
    #[error("points: expected increasing times, got {got} s after {before} s at point {place} (from 0)")]
    Times {
        /// Index of the point, from 0.
        place: usize,
        /// Time of the previous point, s.
        before: f64,
        /// Time of the point, s.
        got: f64,
    },
    /// Three points of a table have the same time.
    #[error(
        "points: expected at most two points at one time (a jump), got a third at {time} s, point {place} (from 0)"
    )]
    Crowd {
        /// Index of the third point, from 0.
        place: usize,
        /// Time, s.
        time: f64,
    },
    /// The bounds of an input's range are in the wrong order.
    #[error("range: expected the smallest value before the largest, got {low} and {high}")]
    Range {
        /// First bound.
        low: f64,
        /// Second bound.
        high: f64,
    },
    /// The initial value of an input is out of range.
    #[error("initial: expected a value in the range from {low} to {high}, got {got}")]
    Initial {
        /// Smallest value of the range.
        low: f64,
        /// Largest value of the range.
        high: f64,
        /// Given value.
        got: f64,
    },
    /// The bounds of a generator's range are in the wrong order.
    #[error("{key}: expected a range with the smallest value before the largest, got {low} and {high}")]
    Bounds {
        /// Name of the parameter.
        key: &'static str,
        /// First bound.
        low: f64,
        /// Second bound.
        high: f64,
    },
    /// An initial parameter of a generator is out of range.
    #[error("{key}: expected a value in the range from {low} to {high}, got {got}")]
    Outside {
        /// Name of the parameter.
        key: &'static str,
        /// Smallest value of the range.
        low: f64,
        /// Largest value of the range.
        high: f64,
        /// Given value.
        got: f64,
    },
    /// The flyback is not shorter than the shortest period that may be commanded.
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
    /// Returns the name of the invalid parameter.
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

/// Checks that a value and its steepest rate of change are finite.
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
