//! What a waveform looks like, as its user gives it: the table of its kinds, each in a file of its own.

mod cycloid;
mod flyback;
mod generator;
mod harmonics;
mod input;
mod sawtooth;
mod sine;
mod table;
mod triangle;
mod turn;

pub use generator::{Command, Cycle, Generator, Heading, Steps};
pub use harmonics::Harmonic;
pub use input::Interpolation;

use super::course::Course;
use super::straight::Straight;
use super::{Sample, Timing, WaveformError};
use cycloid::Cycloid;
use sine::Sine;
use turn::Turn;

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
            Self::Table { ref points } => table::course(points, timing),
            Self::Input { initial, range, interpolation } => {
                input::course(initial, range, interpolation, timing)
            }
            Self::Generator(ref generator) => generator.course(timing),
        }
    }
}

/// Law of one piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Law {
    /// Straight, or held.
    Straight(Straight),
    /// Cycloidal.
    Cycloid(Cycloid),
    /// By the sines of the waveform itself.
    Sines,
}

impl Law {
    /// Value and derivatives at `t`, s; none where they are up to the waveform.
    #[inline]
    pub(super) fn at(&self, t: f64) -> Option<Sample> {
        match self {
            Self::Straight(straight) => Some(straight.at(t)),
            Self::Cycloid(cycloid) => Some(cycloid.at(t)),
            Self::Sines => None,
        }
    }
}

/// Kind of the ways between corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Way {
    Straight,
    Cycloid,
}

impl Way {
    /// The law from one (time, value) to the other.
    pub(super) fn between(self, from: (f64, f64), to: (f64, f64)) -> Law {
        match self {
            Self::Straight => Law::Straight(Straight::between(from, to)),
            Self::Cycloid => Law::Cycloid(Cycloid::between(from, to)),
        }
    }
}

/// Sines of a waveform without corners.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Sines {
    One(Sine),
    Sum(Vec<Harmonic>),
}

impl Sines {
    /// Value and derivatives at `t`, s.
    #[inline]
    pub(super) fn at(&self, timing: &Timing, t: f64) -> Sample {
        let turn = Turn::at(timing, t);
        match self {
            Self::One(sine) => sine.at(turn),
            Self::Sum(terms) => harmonics::at(terms, turn),
        }
    }
}
