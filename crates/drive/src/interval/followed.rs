//! Prescribed part of a contact's displacement between two events.

use crate::model::{Measure, Model};
use crate::state::State;
use crate::{Sample, Waveform};

/// Prescribed part of a contact displacement as a closed form of time, computed once per interval without access to the waveform's piece.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Followed<'a> {
    /// Sum of prescribed motions with constant rates: constant + rate (t - start).
    Line { constant: f64, rate: f64, start: f64 },
    /// One prescribed motion that is a sum of sines: constant + factor · waveform.
    Sines { constant: f64, factor: f64, waveform: &'a Waveform },
}

impl<'a> Followed<'a> {
    /// Returns the prescribed part of a displacement in a state; `None` if it is neither linear in time nor one sum of sines.
    pub(crate) fn of(measure: &Measure, model: &'a Model, state: &State) -> Option<Self> {
        if let [(w, factor)] = measure.driven[..]
            && state.pieces.get(w)?.is_sines()
        {
            return Some(Self::Sines { constant: measure.constant, factor, waveform: &model.waveforms[w] });
        }
        let mut start = None;
        let (mut constant, mut rate) = (measure.constant, 0.0);
        for &(w, a) in &measure.driven {
            // Outputs of blocks have neither form.
            let line = state.pieces.get(w)?.line()?;
            // A common reference time avoids rounding.
            let from = *start.get_or_insert(line.time);
            constant += a * line.at(from);
            rate += a * line.rate;
        }
        Some(Self::Line { constant, rate, start: start.unwrap_or(0.0) })
    }

    /// Returns a prescribed displacement that is constant, m.
    pub(crate) fn constant(constant: f64) -> Self {
        Self::Line { constant, rate: 0.0, start: 0.0 }
    }

    /// Returns the closed form of one signal; `None` if its present piece is neither linear nor a sum of sines.
    pub(crate) fn signal(w: usize, model: &'a Model, state: &State) -> Option<Self> {
        let piece = state.pieces.get(w)?;
        if piece.is_sines() {
            return Some(Self::Sines { constant: 0.0, factor: 1.0, waveform: &model.waveforms[w] });
        }
        let line = piece.line()?;
        Some(Self::Line { constant: line.at(line.time), rate: line.rate, start: line.time })
    }

    /// Returns the prescribed displacement (m) and its derivatives at time t (s).
    #[inline(always)]
    pub(crate) fn at(&self, t: f64) -> Sample {
        match self {
            Self::Line { constant, rate, start } => {
                Sample { value: constant + rate * (t - start), rate: *rate, acceleration: 0.0 }
            }
            Self::Sines { constant, factor, waveform } => {
                let Sample { value, rate, acceleration } = waveform.sines_at(t);
                let value = constant + factor * value;
                Sample { value, rate: factor * rate, acceleration: factor * acceleration }
            }
        }
    }

    /// Returns value at the start, rate and start time, if the displacement is linear in time.
    pub(crate) fn line(&self) -> Option<[f64; 3]> {
        match *self {
            Self::Line { constant, rate, start } => Some([constant, rate, start]),
            Self::Sines { .. } => None,
        }
    }
}
