//! Shapes of waveforms, one module for each kind.

mod chirp;
mod cubic;
mod curve;
mod cycloid;
mod flyback;
mod generator;
mod harmonics;
mod input;
mod law;
mod limited;
mod parabola;
mod pattern;
mod s_curve;
mod sawtooth;
mod sine;
mod step;
mod table;
mod trapezoid;
mod triangle;
mod turn;

pub use chirp::Sweep;
pub use generator::{Command, Cycle, Generator, Heading, Steps};
pub use harmonics::Harmonic;
pub use input::Interpolation;
pub use pattern::Section;

pub(super) use law::{Carrier, Law, Placed, Sines, Way};

use super::course::Course;
use super::{Timing, WaveformError};
use sine::Sine;

/// Shape of one period, or of the whole waveform without a period. Values are in SI units of the driven quantity, angles in rad.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// Sawtooth: linear from 0 to the stroke, then linear return during the flyback at the end of the period.
    Sawtooth {
        /// Peak-to-peak value, of any sign.
        stroke: f64,
        /// Duration of the return stroke, s, at least 0 (a jump) and below the period.
        flyback: f64,
    },
    /// Triangle: linear from 0 to the stroke in half the period, then linear return.
    Triangle {
        /// Peak-to-peak value, of any sign.
        stroke: f64,
    },
    /// Sine: offset + amplitude sin(ωt + phase), ω = 2π/period.
    Sine {
        /// Amplitude, half of the peak-to-peak value.
        amplitude: f64,
        /// Phase, rad.
        phase: f64,
        /// Mean value.
        offset: f64,
    },
    /// Sum of sines: Σ amplitude sin(order ωt + phase).
    Harmonics {
        /// Terms, at least one.
        terms: Vec<Harmonic>,
    },
    /// Sawtooth with cycloidal strokes, stroke (τ - sin(2πτ)/2π), τ from 0 to 1. Velocity and acceleration are zero at both ends.
    Cycloid {
        /// Peak-to-peak value, of any sign.
        stroke: f64,
        /// Duration of the return stroke, s, at least 0 (a jump) and below the period.
        flyback: f64,
    },
    /// Waveform of constant accelerations: a parabola from rest at 0, a turn at the stroke, and the mirrored parabola.
    Parabola {
        /// Peak-to-peak value, of any sign.
        stroke: f64,
        /// Duration of the turn, s, at least 0 (a cusp) and below the period.
        turn: f64,
    },
    /// Trapezoid: linear rise from 0 to the stroke, hold, linear fall, then rest until the end of the period.
    Trapezoid {
        /// Peak-to-peak value, of any sign.
        stroke: f64,
        /// Duration of the rise, s, at least 0 (a jump).
        rise: f64,
        /// Duration at the stroke, s, at least 0.
        hold: f64,
        /// Duration of the fall, s, at least 0 (a jump). The sum of all three is above 0 and at most the period.
        fall: f64,
    },
    /// Sawtooth with strokes from rest to rest, each with four phases of constant jerk and zero jerk in between.
    SCurve {
        /// Peak-to-peak value, of any sign.
        stroke: f64,
        /// Duration of the return stroke, s, above 0 and below the period.
        flyback: f64,
        /// Duration of each phase of constant jerk, s, above 0 and at most a quarter of the shorter stroke.
        rounding: f64,
    },
    /// Rate-limited sawtooth, which lags behind the requested sawtooth after each flyback.
    Limited {
        /// Peak-to-peak value of the requested sawtooth, of any sign.
        stroke: f64,
        /// Requested duration of the return stroke, s, at least 0 (a jump) and below the period.
        flyback: f64,
        /// Rate limit, per s, above 0 and at least the rate of the forward stroke.
        rate: f64,
    },
    /// Chirp: offset + amplitude sin(phase + 2π(from s + (to - from) s²/(2 duration))), s from 0 to the duration; constant before
    /// and after.
    Chirp(Sweep),
    /// Step: 0 before a time, a value after it.
    Step {
        /// Value after the step.
        height: f64,
        /// Time of the step after the delay, s.
        at: f64,
    },
    /// Shape-preserving cubics through points (time after the delay in s, value), once or repeated.
    Curve {
        /// Points with increasing times; exactly two points at one time are a jump.
        points: Vec<(f64, f64)>,
        /// Cubics (Fritsch and Butland 1984) if true, otherwise linear pieces.
        smooth: bool,
        /// Whether the curve is repeated, with the last point at the time of the first.
        repeated: bool,
    },
    /// Repeated pattern of runs of a periodic shape and rests.
    Pattern {
        /// Shape, with the period of the timing.
        carrier: Box<Shape>,
        /// Runs and rests in order.
        parts: Vec<Section>,
    },
    /// Linear between points (time after the delay in s, value), constant before the first point and after the last.
    Table {
        /// Points with increasing times; exactly two points at one time are a jump.
        points: Vec<(f64, f64)>,
    },
    /// Values that a caller supplies during the run; the initial value until then.
    Input {
        /// Value from t = 0, within the range.
        initial: f64,
        /// Smallest and largest allowed value. Checks before a run cover this whole range.
        range: (f64, f64),
        /// Interpolation between values.
        interpolation: Interpolation,
    },
    /// Cycles whose parameters a caller commands during the run.
    Generator(Generator),
}

impl Shape {
    /// Returns the timing of the waveform: the given timing, or the timing that follows from the shape.
    pub(super) fn timing(&self, given: Timing) -> Timing {
        match self {
            Self::Generator(generator) => generator.timing(),
            Self::Pattern { parts, .. } => pattern::timing(parts, &given),
            Self::Curve { points, repeated: true, .. } => curve::timing(points, &given),
            _ => given,
        }
    }

    /// Checks the parameters of the shape and returns the chain of pieces.
    pub(super) fn course(&self, timing: &Timing) -> Result<Course, WaveformError> {
        timing.check()?;
        match *self {
            Self::Sawtooth { stroke, flyback } => sawtooth::course(stroke, flyback, timing),
            Self::Triangle { stroke } => triangle::course(stroke, timing),
            Self::Sine { amplitude, phase, offset } => Sine { amplitude, phase, offset }.course(timing),
            Self::Harmonics { ref terms } => harmonics::course(terms, timing),
            Self::Cycloid { stroke, flyback } => cycloid::course(stroke, flyback, timing),
            Self::Parabola { stroke, turn } => parabola::course(stroke, turn, timing),
            Self::Trapezoid { stroke, rise, hold, fall } => {
                trapezoid::course(stroke, [rise, hold, fall], timing)
            }
            Self::SCurve { stroke, flyback, rounding } => s_curve::course(stroke, flyback, rounding, timing),
            Self::Limited { stroke, flyback, rate } => limited::course(stroke, flyback, rate, timing),
            Self::Chirp(sweep) => sweep.course(timing),
            Self::Step { height, at } => step::course(height, at, timing),
            Self::Curve { ref points, smooth, repeated } => curve::course(points, smooth, repeated, timing),
            Self::Pattern { ref carrier, ref parts } => pattern::course(carrier, parts, timing),
            Self::Table { ref points } => table::course(points, timing),
            Self::Input { initial, range, interpolation } => {
                input::course(initial, range, interpolation, timing)
            }
            Self::Generator(ref generator) => generator.course(timing),
        }
    }
}
