//! Laws of pieces: what a waveform is between two corners.

use super::chirp::Sweep;
use super::cubic::Cubic;
use super::cycloid::Cycloid;
use super::harmonics::{self, Harmonic};
use super::sine::Sine;
use super::turn::Turn;
use crate::waveform::straight::Straight;
use crate::waveform::{Sample, Timing};
use std::f64::consts::TAU;

/// Law of one piece.
///
/// What is more than a few numbers stays in the chain, and the piece says which of it it is: states keep a piece of every
/// waveform, and a straight one must not grow by what others need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::waveform) enum Law {
    /// Straight, or held.
    Straight(Straight),
    /// Cycloidal.
    Cycloid(Cycloid),
    /// By the sines of the waveform itself.
    Sines,
    /// By a way of the chain.
    Leg(Placed),
}

/// A piece whose law is one of the ways of its chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::waveform) struct Placed {
    /// Its start and end, s, also where it is cut short.
    pub(in crate::waveform) from: f64,
    pub(in crate::waveform) to: f64,
    place: u32,
}

impl Placed {
    /// Which way of the chain.
    pub(in crate::waveform) fn place(&self) -> usize {
        self.place as usize
    }
}

impl Law {
    /// The law from one (time, value) to the other, by the way at this place of the chain.
    pub(in crate::waveform) fn between(way: Way, from: (f64, f64), to: (f64, f64), place: usize) -> Self {
        match way {
            Way::Straight => Self::Straight(Straight::between(from, to)),
            Way::Cycloid => Self::Cycloid(Cycloid::between(from, to)),
            Way::Cubic(_) | Way::Chirp(_) | Way::Sines { .. } => {
                Self::Leg(Placed { from: from.0, to: to.0, place: u32::try_from(place).unwrap_or(u32::MAX) })
            }
        }
    }

    /// Value and derivatives at `t`, s; none where they are up to the waveform.
    #[inline]
    pub(in crate::waveform) fn at(&self, t: f64) -> Option<Sample> {
        match self {
            Self::Straight(straight) => Some(straight.at(t)),
            Self::Cycloid(cycloid) => Some(cycloid.at(t)),
            Self::Sines | Self::Leg(_) => None,
        }
    }
}

/// Kind of a way between two corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::waveform) enum Way {
    Straight,
    Cycloid,
    /// A cubic with these rates at its start and end, per s.
    Cubic(Cubic),
    /// A swept sine.
    Chirp(Sweep),
    /// Whole cycles of the carrier, from its start on or back to it.
    Sines {
        reversed: bool,
    },
}

impl Way {
    /// Value and derivatives at `t`, s, between (time, value) and (time, value); those at the very end are set exactly.
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
                // At its end it is where it started, whatever rounding makes of whole cycles.
                let time = if t == to.0 { 0.0 } else { t - from.0 };
                carrier.at(time, reversed)
            }
            (Self::Cycloid, _) => Cycloid::between(from, to).at(t),
            (Self::Straight | Self::Sines { .. }, _) => Straight::between(from, to).at(t),
        }
    }

    /// The same way gone the other way round in time.
    pub(super) fn reversed(self) -> Self {
        match self {
            Self::Cubic(cubic) => Self::Cubic(cubic.reversed()),
            Self::Sines { reversed } => Self::Sines { reversed: !reversed },
            Self::Straight | Self::Cycloid | Self::Chirp(_) => self,
        }
    }
}

/// Sines that begin anew with every run of a pattern.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::waveform) struct Carrier {
    pub(super) sines: Sines,
    /// s.
    pub(super) period: f64,
}

impl Carrier {
    /// Value and derivatives `time` (s) after a start.
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
    /// Value and derivatives at `t`, s.
    #[inline]
    pub(in crate::waveform) fn at(&self, timing: &Timing, t: f64) -> Sample {
        let turn = Turn::at(timing, t);
        match self {
            Self::One(sine) => sine.at(turn),
            Self::Sum(terms) => harmonics::at(terms, turn),
        }
    }

    /// A bound of the third derivative, per s³: Σ |amplitude| (order ω)³, reached by a single sine.
    pub(in crate::waveform) fn jerk(&self, timing: &Timing) -> f64 {
        let of = |amplitude: f64, order: f64| amplitude.abs() * (order * TAU / timing.period).powi(3);
        match self {
            Self::One(sine) => of(sine.amplitude, 1.0),
            Self::Sum(terms) => terms.iter().map(|term| of(term.amplitude, term.order)).sum(),
        }
    }
}
