//! Laws of pieces between two corners.

use super::chirp::Sweep;
use super::cubic::Cubic;
use super::cycloid::Cycloid;
use super::harmonics::{self, Harmonic};
use super::sine::Sine;
use super::turn::Turn;
use crate::waveform::straight::Straight;
use crate::waveform::{Sample, Timing};
use std::f64::consts::TAU;

/// Law of a piece.
///
/// Laws with many parameters are stored in the chain and referred to by index, so that the pieces in states are small.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::waveform) enum Law {
    /// Linear or constant.
    Straight(Straight),
    /// Cycloidal.
    Cycloid(Cycloid),
    /// Sines of the waveform.
    Sines,
    /// Segment of the chain.
    Leg(Placed),
}

/// Piece whose law is stored as a segment of the chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::waveform) struct Placed {
    /// Start and end of the complete segment, s.
    pub(in crate::waveform) from: f64,
    pub(in crate::waveform) to: f64,
    place: u32,
}

impl Placed {
    /// Returns the index of the segment in the chain.
    pub(in crate::waveform) fn place(&self) -> usize {
        self.place as usize
    }
}

impl Law {
    /// Returns the law of the segment with index `place` in the chain, between two points (time, value).
    pub(in crate::waveform) fn between(way: Way, from: (f64, f64), to: (f64, f64), place: usize) -> Self {
        match way {
            Way::Straight => Self::Straight(Straight::between(from, to)),
            Way::Cycloid => Self::Cycloid(Cycloid::between(from, to)),
            Way::Cubic(_) | Way::Chirp(_) | Way::Sines { .. } => {
                Self::Leg(Placed { from: from.0, to: to.0, place: u32::try_from(place).unwrap_or(u32::MAX) })
            }
        }
    }

    /// Returns value and derivatives at `t` (s). None if the law is stored in the waveform, which must compute them.
    #[inline]
    pub(in crate::waveform) fn at(&self, t: f64) -> Option<Sample> {
        match self {
            Self::Straight(straight) => Some(straight.at(t)),
            Self::Cycloid(cycloid) => Some(cycloid.at(t)),
            Self::Sines | Self::Leg(_) => None,
        }
    }
}

/// Form of a segment between two corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::waveform) enum Way {
    Straight,
    Cycloid,
    /// Cubic with given rates at both ends, per s.
    Cubic(Cubic),
    /// Sine sweep.
    Chirp(Sweep),
    /// Whole cycles of the carrier, forward or reversed in time.
    Sines {
        reversed: bool,
    },
}

impl Way {
    /// Returns value and derivatives at `t` (s) between two points (time, value); the value at the end is exact.
    pub(in crate::waveform) fn at(
        self,
        from: (f64, f64),
        to: (f64, f64),
        carrier: Option<&Carrier>,
        t: f64,
    ) -> Sample {
        match (self, carrier) {
            (Self::Cubic(cubic), _) => cubic.at(from, to, t),
            (Self::Chirp(sweep), _) => sweep.at(t - from.0),
            (Self::Sines { reversed }, Some(carrier)) => {
                // After whole cycles the value is exactly that of the start.
                let time = if t == to.0 { 0.0 } else { t - from.0 };
                carrier.at(time, reversed)
            }
            (Self::Cycloid, _) => Cycloid::between(from, to).at(t),
            (Self::Straight | Self::Sines { .. }, _) => Straight::between(from, to).at(t),
        }
    }

    /// Returns the form of the segment reversed in time.
    pub(super) fn reversed(self) -> Self {
        match self {
            Self::Cubic(cubic) => Self::Cubic(cubic.reversed()),
            Self::Sines { reversed } => Self::Sines { reversed: !reversed },
            Self::Straight | Self::Cycloid | Self::Chirp(_) => self,
        }
    }
}

/// Sines whose time starts at 0 in every run of a pattern.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::waveform) struct Carrier {
    pub(super) sines: Sines,
    /// Period, s.
    pub(super) period: f64,
}

impl Carrier {
    /// Returns value and derivatives `time` seconds after the start of a run.
    pub(super) fn at(&self, time: f64, reversed: bool) -> Sample {
        let timing = Timing::every(self.period);
        if !reversed {
            return self.sines.at(&timing, time);
        }
        let Sample { value, rate, acceleration } = self.sines.at(&timing, -time);
        Sample { value, rate: -rate, acceleration }
    }
}

/// Sines of a waveform without corners.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::waveform) enum Sines {
    One(Sine),
    Sum(Vec<Harmonic>),
}

impl Sines {
    /// Returns value and derivatives at `t` (s).
    #[inline]
    pub(in crate::waveform) fn at(&self, timing: &Timing, t: f64) -> Sample {
        let turn = Turn::at(timing, t);
        match self {
            Self::One(sine) => sine.at(turn),
            Self::Sum(terms) => harmonics::at(terms, turn),
        }
    }

    /// Returns a bound on the third derivative, per s³: Σ |amplitude| (order ω)³, exact for a single sine.
    pub(in crate::waveform) fn jerk(&self, timing: &Timing) -> f64 {
        let of = |amplitude: f64, order: f64| amplitude.abs() * (order * TAU / timing.period).powi(3);
        match self {
            Self::One(sine) => of(sine.amplitude, 1.0),
            Self::Sum(terms) => terms.iter().map(|term| of(term.amplitude, term.order)).sum(),
        }
    }
}
