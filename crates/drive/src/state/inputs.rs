//! What a caller supplies of the inputs.
//!
//! A piece lies ahead of the run when it is supplied. Where it begins, the waveform has a corner, and a jump where the value
//! is another one: the run stops before it, and turns it when it goes on.

use super::State;
use crate::{Interpolation, Model, Piece, RunError, Waveform};
use thiserror::Error;

/// Why an input does not take a value.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum InputError {
    /// No waveform, or one that needs no caller.
    #[error("waveform {0} of the scene is no input")]
    NoInput(usize),
    /// A value to be held, for an input that goes straight from value to value, or the other way round.
    #[error("input {input} is {}: it takes {}", name(*.is), takes(*.is))]
    Interpolation {
        /// Place of the waveform in the scene.
        input: usize,
        /// What it is.
        is: Interpolation,
    },
    /// Not a number, or beyond what the checks before the run went by.
    #[error("input {input} takes values from {low} to {high}, got {got}")]
    Range {
        /// Place of the waveform in the scene.
        input: usize,
        /// Smallest value.
        low: f64,
        /// Largest value.
        high: f64,
        /// What came.
        got: f64,
    },
    /// A piece that ends where it begins, or before, or so soon after that its rate is not finite.
    #[error("the next piece of input {input} begins at t = {from:e} s and cannot end at t = {until:e} s")]
    Time {
        /// Place of the waveform in the scene.
        input: usize,
        /// Where it begins, s.
        from: f64,
        /// Where it was to end, s.
        until: f64,
    },
    /// The piece after the present one is there already.
    #[error("input {input} has its next piece, up to t = {until:e} s: advance first")]
    Occupied {
        /// Place of the waveform in the scene.
        input: usize,
        /// Where that ends, s.
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
        Interpolation::Linear => "a value and the time at which it is there",
    }
}

impl State {
    /// Holds input `w` at a value from the present time on. The value it has already changes nothing.
    pub(crate) fn hold(&mut self, model: &Model, w: usize, value: f64) -> Result<(), InputError> {
        let waveform = input(model, w, Interpolation::Held)?;
        check(waveform, w, value)?;
        let piece = &mut self.pieces[w];
        let same = waveform.sample(piece, self.t).value == value;
        (piece.end, self.supplied[w]) =
            if same { (f64::INFINITY, None) } else { (self.t, Some(Piece::held(self.t, value))) };
        Ok(())
    }

    /// Leads input `w` straight to a value at a time, s, from where its last piece ends; from the present time on where that
    /// has no end.
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
        // Before anything has moved there is nothing to turn.
        if self.underway.is_none() && self.counts.steps == 0 && piece.end == f64::INFINITY {
            self.pieces[w] = next;
        } else {
            (self.pieces[w].end, self.supplied[w]) = (from, Some(next));
        }
        Ok(())
    }

    /// The piece of waveform `w` after the present one, which a generator then is on; none of an input that has not been given
    /// one.
    pub(crate) fn next_piece(&mut self, w: usize, waveform: &Waveform) -> Option<Piece> {
        match waveform.interpolation() {
            None => Some(match self.generators.get_mut(w) {
                Some(Some(generating)) => generating.next(self.pieces[w].end),
                _ => waveform.after(&self.pieces[w]),
            }),
            Some(_) => self.supplied[w].take(),
        }
    }

    /// Puts every input whose piece is over on the one supplied. Tells whether any was.
    pub(crate) fn take_supplied(&mut self) -> bool {
        let mut taken = false;
        for (w, supplied) in self.supplied.iter_mut().enumerate() {
            if let Some(next) = supplied.take_if(|next| next.start <= self.t) {
                (self.pieces[w], taken) = (next, true);
            }
        }
        taken
    }

    /// When the first piece ends that a caller has given, or the first generator goes over to other cycles, s; infinite without
    /// any.
    pub(crate) fn next_input(&self, model: &Model) -> f64 {
        let end = |(w, supplied): (usize, &Option<Piece>)| {
            let present = self.pieces[w].end;
            model.waveforms[w].interpolation()?;
            Some(if present > self.t { present } else { supplied.map_or(present, |piece| piece.end) })
        };
        let first = self.supplied.iter().enumerate().filter_map(end).fold(f64::INFINITY, f64::min);
        if self.generators.is_empty() { first } else { first.min(self.next_change()) }
    }

    /// Whether the piece of an input is over and its caller has not given the next one yet.
    #[inline]
    pub(crate) fn waits_for_input(&self, model: &Model) -> bool {
        let over = |(w, supplied): (usize, &Option<Piece>)| {
            model.waveforms[w].interpolation().is_some() && self.pieces[w].end <= self.t && supplied.is_none()
        };
        self.supplied.iter().enumerate().any(over)
    }

    /// Whether all inputs have values up to a time, s.
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

/// The waveform, if it is an input of this kind.
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
    // Not a number is in no range.
    if value >= low && value <= high {
        Ok(())
    } else {
        Err(InputError::Range { input, low, high, got: value })
    }
}
