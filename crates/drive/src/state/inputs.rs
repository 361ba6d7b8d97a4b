//! Input values that a caller supplies.
//!
//! A piece of an input is supplied before the run reaches its start. The waveform has a corner at this start, or a jump if the value
//! changes. The run stops before this corner and passes it when it continues.

use super::State;
use crate::{Interpolation, Model, Piece, RunError, Waveform};
use thiserror::Error;

/// Reason why an input refuses a value.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum InputError {
    /// The waveform does not exist or is no input.
    #[error("waveform {0} is not an input")]
    NoInput(usize),
    /// The caller gave a value to be held to a linear input, or vice versa.
    #[error("input {input} is {}: expected {}", name(*.is), takes(*.is))]
    Interpolation {
        /// Index of the waveform.
        input: usize,
        /// Interpolation of the input.
        is: Interpolation,
    },
    /// The value is NaN or out of range.
    #[error("input {input}: expected a value from {low} to {high}, got {got}")]
    Range {
        /// Index of the waveform.
        input: usize,
        /// Smallest value.
        low: f64,
        /// Largest value.
        high: f64,
        /// Given value.
        got: f64,
    },
    /// The piece does not end after its start, or is so short that the rate of change is not finite.
    #[error("the next section of input {input} begins at t = {from:e} s and cannot end at t = {until:e} s")]
    Time {
        /// Index of the waveform.
        input: usize,
        /// Start of the piece, s.
        from: f64,
        /// Requested end, s.
        until: f64,
    },
    /// The next piece has already been supplied.
    #[error("input {input} already has its next section, up to t = {until:e} s: advance first")]
    Occupied {
        /// Index of the waveform.
        input: usize,
        /// End of that piece, s.
        until: f64,
    },
}

fn name(interpolation: Interpolation) -> &'static str {
    match interpolation {
        Interpolation::Held => "held",
        Interpolation::Linear => "linear",
    }
}

fn takes(interpolation: Interpolation) -> &'static str {
    match interpolation {
        Interpolation::Held => "a value",
        Interpolation::Linear => "a value and the time at which it is reached",
    }
}

impl State {
    /// Holds input `w` at a value from the present time on. Has no effect if the input already has this value.
    pub(crate) fn hold(&mut self, model: &Model, w: usize, value: f64) -> Result<(), InputError> {
        let waveform = input(model, w, Interpolation::Held)?;
        check(waveform, w, value)?;
        let piece = &mut self.pieces[w];
        let same = waveform.sample(piece, self.t).value == value;
        (piece.end, self.supplied[w]) =
            if same { (f64::INFINITY, None) } else { (self.t, Some(Piece::held(self.t, value))) };
        Ok(())
    }

    /// Moves input `w` linearly to `value` at `until` (s), from the end of its present piece, or from now if the piece has no end.
    pub(crate) fn lead(
        &mut self,
        model: &Model,
        w: usize,
        (until, value): (f64, f64),
    ) -> Result<(), InputError> {
        let waveform = input(model, w, Interpolation::Linear)?;
        check(waveform, w, value)?;
        if let Some(next) = self.supplied[w] {
            return Err(InputError::Occupied { input: w, until: next.end });
        }
        let piece = self.pieces[w];
        let from = if piece.end < f64::INFINITY { piece.end } else { self.t };
        let start = waveform.sample(&piece, from).value;
        let rate = (value - start) / (until - from);
        if !(until > from && until < f64::INFINITY && rate.is_finite()) {
            return Err(InputError::Time { input: w, from, until });
        }
        let next = Piece::straight((from, start), (until, value));
        // Before the first step the initial piece is replaced.
        if self.underway.is_none() && self.counts.steps == 0 && piece.end == f64::INFINITY {
            self.pieces[w] = next;
        } else {
            (self.pieces[w].end, self.supplied[w]) = (from, Some(next));
        }
        Ok(())
    }

    /// Returns the next piece of waveform `w`; a generator advances to this piece. None for an input without a supplied piece.
    pub(crate) fn next_piece(&mut self, w: usize, waveform: &Waveform) -> Option<Piece> {
        match waveform.interpolation() {
            None => Some(match self.generators.get_mut(w) {
                Some(Some(generating)) => generating.next(self.pieces[w].end),
                _ => waveform.after(&self.pieces[w]),
            }),
            Some(_) => self.supplied[w].take(),
        }
    }

    /// Whether an input is at the end of its piece and no further piece has been supplied.
    #[inline]
    pub(crate) fn waits_for_input(&self, model: &Model) -> bool {
        let over = |(w, supplied): (usize, &Option<Piece>)| {
            model.waveforms[w].interpolation().is_some() && self.pieces[w].end <= self.t && supplied.is_none()
        };
        self.supplied.iter().enumerate().any(over)
    }

    /// Checks that all inputs have values up to a time (s).
    pub(crate) fn check_inputs(&self, model: &Model, until: f64) -> Result<(), RunError> {
        for (w, supplied) in self.supplied.iter().enumerate() {
            let known = supplied.map_or(self.pieces[w].end, |piece| piece.end);
            if model.waveforms[w].interpolation().is_some() && known < until {
                return Err(RunError::InputMissing { input: w, known, until });
            }
        }
        Ok(())
    }
}

/// Returns the waveform if it is an input with the interpolation `asked`.
fn input(model: &Model, w: usize, asked: Interpolation) -> Result<&Waveform, InputError> {
    let waveform = model.waveforms.get(w).ok_or(InputError::NoInput(w))?;
    match waveform.interpolation() {
        Some(is) if is == asked => Ok(waveform),
        Some(is) => Err(InputError::Interpolation { input: w, is }),
        None => Err(InputError::NoInput(w)),
    }
}

fn check(waveform: &Waveform, input: usize, value: f64) -> Result<(), InputError> {
    let (low, high) = waveform.range();
    // NaN is in no range.
    if value >= low && value <= high {
        Ok(())
    } else {
        Err(InputError::Range { input, low, high, got: value })
    }
}
