//! What a waveform looks like, as its user gives it: the table of its kinds, each in a file of its own.

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
    /// By constant accelerations: from rest at 0 along a parabola, over a turn at the stroke, back along its mirror image.
    Parabola {
        /// Peak to peak, any sign.
        stroke: f64,
        /// Time of the turn, s, 0 (a cusp) or more, below the period.
        turn: f64,
    },
    /// From 0 straight to the stroke, held, straight back, at rest until the period ends.
    Trapezoid {
        /// Peak to peak, any sign.
        stroke: f64,
        /// Time of the way to the stroke, s, 0 (a jump) or more.
        rise: f64,
        /// Time at the stroke, s, 0 or more.
        hold: f64,
        /// Time of the way back, s, 0 (a jump) or more. All three are together above 0 and at most the period.
        fall: f64,
    },
    /// Like the sawtooth, each way at rest at both ends, with a jerk that is constant in four phases and 0 between them.
    SCurve {
        /// Peak to peak, any sign.
        stroke: f64,
        /// Time of the way back, s, above 0 and below the period.
        flyback: f64,
        /// Time of each phase of constant jerk, s, above 0 and at most a quarter of the shorter way.
        rounding: f64,
    },
    /// A sawtooth through a limit of the rate, for which it is late after each flyback.
    Limited {
        /// Peak to peak, any sign, of what is asked for.
        stroke: f64,
        /// Time of the way back that is asked for, s, 0 (a jump) or more, below the period.
        flyback: f64,
        /// Largest rate, per s, above 0 and at least that of the way up.
        rate: f64,
    },
    /// offset + amplitude sin(phase + 2π(from s + (to - from) s²/(2 duration))), s from 0 to the duration; held before and after.
    Chirp(Sweep),
    /// 0 until a time, s, a value from then on.
    Step {
        /// Value after the step.
        height: f64,
        /// When, s after the delay.
        at: f64,
    },
    /// Points like those of a table, one after the other by cubics that keep their shape, or again and again.
    Curve {
        /// Times rise; exactly two points at one time are a jump.
        points: Vec<(f64, f64)>,
        /// By cubics (Fritsch and Butland 1984), or straight.
        smooth: bool,
        /// Again and again, the last point at the time of the first, or once.
        repeated: bool,
    },
    /// Runs of a periodic shape and rests between them, again and again.
    Pattern {
        /// The shape, whose period the timing says.
        carrier: Box<Shape>,
        /// Runs and rests, one after the other.
        parts: Vec<Section>,
    },
    /// Straight between points (time after the delay in s, value), held before the first and after the last.
    Table {
        /// Times rise; exactly two points at one time are a jump.
        points: Vec<(f64, f64)>,
    },
    /// What a caller gives while it runs; until then, and in a run without a caller, the initial value.
    Input {
        /// Value from t = 0 on, in the range.
        initial: f64,
        /// Smallest and largest value that a caller may give. What is checked before a run holds for all of them.
        range: (f64, f64),
        /// How it goes from one value to the next.
        interpolation: Interpolation,
    },
    /// Cycles made inside, their parameters commanded while they run.
    Generator(Generator),
}

impl Shape {
    /// When it runs: as its user says, but for what knows that by itself.
    pub(super) fn timing(&self, given: Timing) -> Timing {
        match self {
            Self::Generator(generator) => generator.timing(),
            Self::Pattern { parts, .. } => pattern::timing(parts, &given),
            Self::Curve { points, repeated: true, .. } => curve::timing(points, &given),
            _ => given,
        }
    }

    /// What its kind makes of its parameters, where they make sense.
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
