//! What a waveform looks like, as its user gives it.

use std::f64::consts::TAU;

/// Form of one period, or of the whole where there is none. SI units of whatever the waveform drives; angles in rad.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// From 0 straight to the stroke, straight back in the flyback that ends the period.
    Sawtooth {
        /// Peak to peak, any sign.
        stroke: f64,
        /// Time of the way back, s, 0 (a jump) or more, below the period.
        flyback: f64,
    },
    /// From 0 straight to the stroke at half the period, straight back to 0.
    Triangle {
        /// Peak to peak, any sign.
        stroke: f64,
    },
    /// offset + amplitude sin(ωt + phase), ω = 2π/period.
    Sine {
        /// Half of peak to peak.
        amplitude: f64,
        /// Phase, rad.
        phase: f64,
        /// Mean value.
        offset: f64,
    },
    /// Σ amplitude sin(order ωt + phase).
    Harmonics {
        /// At least one.
        terms: Vec<Harmonic>,
    },
    /// Like the sawtooth, each way by the cycloidal law stroke (τ - sin(2πτ)/2π), τ from 0 to 1: at rest, without
    /// acceleration, at both ends.
    Cycloid {
        /// Peak to peak, any sign.
        stroke: f64,
        /// Time of the way back, s, 0 (a jump) or more, below the period.
        flyback: f64,
    },
    /// Straight between points (time after the delay in s, value), held before the first and after the last.
    Table {
        /// Times rise; exactly two points at one time are a jump.
        points: Vec<(f64, f64)>,
    },
}

/// One term of a sum of sines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Half of peak to peak.
    pub amplitude: f64,
    /// Multiple of the fundamental frequency, a whole number of at least 1.
    pub order: f64,
    /// Phase, rad.
    pub phase: f64,
}

/// When a waveform runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Period, s, above 0; a table has none and ignores it.
    pub period: f64,
    /// Start, s; before it the first value is held. Default 0.
    pub delay: f64,
    /// Advances the waveform by phase/2π periods, rad; default 0, and 0 for a table.
    pub phase: f64,
    /// Periods after which the last value is held, above 0; none: for ever. None for a table. A jump that ends the last
    /// period still takes place: it is the limit of a short flyback.
    pub cycles: Option<f64>,
}

impl Timing {
    /// From t = 0 for ever, with this `period` (s).
    #[must_use]
    pub fn every(period: f64) -> Self {
        Self { period, delay: 0.0, phase: 0.0, cycles: None }
    }
}

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
}

impl WaveformError {
    /// Name of the parameter that is wrong.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::Number { key, .. } | Self::Empty { key } => key,
            Self::Flyback { .. } => "flyback",
            Self::Times { .. } | Self::Crowd { .. } => "points",
        }
    }
}

pub(super) fn check(shape: &Shape, timing: &Timing) -> Result<(), WaveformError> {
    finite("delay", timing.delay)?;
    finite("phase", timing.phase)?;
    if let Shape::Table { points } = shape {
        return check_table(points, timing);
    }
    within("period", timing.period, "a finite number above 0", timing.period > 0.0)?;
    if let Some(cycles) = timing.cycles {
        within("cycles", cycles, "a finite number above 0", cycles > 0.0)?;
    }
    let curvature = (TAU / timing.period).powi(2);
    match shape {
        Shape::Sawtooth { stroke, flyback } | Shape::Cycloid { stroke, flyback } => {
            if !(*flyback >= 0.0 && timing.period - flyback > 0.0) {
                return Err(WaveformError::Flyback { period: timing.period, got: *flyback });
            }
            let rise = timing.period - flyback;
            let shortest = if *flyback > 0.0 { flyback.min(rise) } else { rise };
            let curved = matches!(shape, Shape::Cycloid { .. });
            smooth("stroke", *stroke, stroke / shortest * if curved { TAU / shortest } else { 1.0 })
        }
        Shape::Triangle { stroke } => smooth("stroke", *stroke, 2.0 * stroke / timing.period),
        Shape::Sine { amplitude, phase, offset } => {
            smooth("amplitude", *amplitude, amplitude * curvature)?;
            finite("phase", *phase)?;
            smooth("offset", *offset, offset.abs() + amplitude.abs())
        }
        Shape::Harmonics { terms } => check_terms(terms, curvature),
        Shape::Table { .. } => Ok(()),
    }
}

fn check_terms(terms: &[Harmonic], curvature: f64) -> Result<(), WaveformError> {
    if terms.is_empty() {
        return Err(WaveformError::Empty { key: "terms" });
    }
    let mut sum = 0.0;
    for term in terms {
        sum += term.amplitude.abs() * (term.order * term.order * curvature).max(1.0);
        smooth("amplitude", term.amplitude, sum)?;
        finite("phase", term.phase)?;
        let whole = term.order >= 1.0 && term.order.fract() == 0.0;
        within("order", term.order, "a whole number of at least 1", whole)?;
    }
    Ok(())
}

fn check_table(points: &[(f64, f64)], timing: &Timing) -> Result<(), WaveformError> {
    within("phase", timing.phase, "0 with a table, which has no period", timing.phase == 0.0)?;
    if let Some(cycles) = timing.cycles {
        within("cycles", cycles, "none with a table, which has no period", false)?;
    }
    if points.is_empty() {
        return Err(WaveformError::Empty { key: "points" });
    }
    for (time, value) in points {
        finite("points", *time)?;
        finite("points", *value)?;
    }
    for (i, pair) in points.windows(2).enumerate() {
        let (before, got) = (pair[0].0, pair[1].0);
        let time = if got > before { got - before } else { 1.0 };
        smooth("points", pair[1].1, (pair[1].1 - pair[0].1) / time)?;
        // Compared after the delay too: it may swallow a short interval.
        if got < before || got > before && timing.delay + got <= timing.delay + before {
            return Err(WaveformError::Times { place: i + 1, before, got });
        }
    }
    match points.windows(3).position(|three| three[0].0 == three[2].0) {
        Some(i) => Err(WaveformError::Crowd { place: i + 2, time: points[i].0 }),
        None => Ok(()),
    }
}

fn finite(key: &'static str, got: f64) -> Result<(), WaveformError> {
    within(key, got, "a finite number", true)
}

/// A value whose rate of change (or acceleration, or sum) is a number as well.
fn smooth(key: &'static str, got: f64, steepest: f64) -> Result<(), WaveformError> {
    within(key, got, "a value that changes at a finite rate", steepest.is_finite())
}

fn within(key: &'static str, got: f64, expected: &'static str, allowed: bool) -> Result<(), WaveformError> {
    if allowed && got.is_finite() { Ok(()) } else { Err(WaveformError::Number { key, expected, got }) }
}
