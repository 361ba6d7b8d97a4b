//! Chirp: a single sine with a linear frequency sweep.

use super::Way;
use crate::waveform::corners::{Corners, Leg};
use crate::waveform::course::{Chain, Course};
use crate::waveform::error::{finite, smooth, within};
use crate::waveform::{Sample, Timing, WaveformError};
use std::f64::consts::TAU;

/// Sine with a linear frequency sweep: offset + amplitude sin(phase + 2π(from s + (to - from) s²/(2 duration))), s from 0 to the duration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sweep {
    /// Amplitude, half of the peak-to-peak value.
    pub amplitude: f64,
    /// Mean value.
    pub offset: f64,
    /// Initial phase, rad.
    pub phase: f64,
    /// Initial frequency, Hz, at least 0.
    pub from: f64,
    /// Final frequency, Hz, at least 0; not both frequencies may be 0.
    pub to: f64,
    /// Duration, s, above 0.
    pub duration: f64,
}

impl Sweep {
    /// Returns the number of turns `s` seconds after the start, without the initial phase.
    fn turns(&self, s: f64) -> f64 {
        s * (self.from + 0.5 * (self.to - self.from) * (s / self.duration))
    }

    /// Returns value and derivatives `s` seconds after the start.
    pub(super) fn at(&self, s: f64) -> Sample {
        let turns = self.turns(s);
        // Whole turns are removed first, because 2π would magnify their rounding.
        let (sin, cos) = math::sin_cos(TAU * (turns - turns.floor()) + self.phase);
        let omega = TAU * (self.from + (self.to - self.from) * (s / self.duration));
        let growth = TAU * ((self.to - self.from) / self.duration);
        Sample {
            value: self.offset + self.amplitude * sin,
            rate: self.amplitude * omega * cos,
            acceleration: self.amplitude * (growth * cos - omega * omega * sin),
        }
    }

    /// Returns the sweep as one smooth piece that ends with a corner.
    pub(super) fn course(self, timing: &Timing) -> Result<Course, WaveformError> {
        timing.check_single()?;
        let Self { amplitude, offset, phase, from, to, duration } = self;
        let wanted = "a finite frequency of at least 0";
        within("from", from, wanted, from >= 0.0)?;
        within(
            "to",
            to,
            "a finite frequency of at least 0, not 0 at both ends",
            to >= 0.0 && from.max(to) > 0.0,
        )?;
        within("duration", duration, "a finite time above 0", duration > 0.0)?;
        finite("phase", phase)?;
        let highest = from.max(to);
        let steepest = (TAU * highest).powi(2) + TAU * (to - from).abs() / duration;
        smooth("amplitude", amplitude, amplitude * steepest)?;
        smooth("duration", duration, duration * highest)?;
        smooth("offset", offset, offset.abs() + amplitude.abs())?;
        let values = (self.at(0.0).value, self.at(duration).value);
        let leg = Leg { start: 0.0, values, way: Way::Chirp(self) };
        let Some(corners) = Corners::once(&[leg], duration, timing.delay) else {
            return Err(WaveformError::Empty { key: "duration" });
        };
        Ok(Course {
            chain: Chain::Corners(corners),
            ends: None,
            period: None,
            range: self.range(),
            wave: highest.recip(),
            has_jumps: false,
        })
    }

    /// Returns the smallest and the largest value: extremes of the sine if the sweep reaches them, otherwise values at the ends.
    fn range(&self) -> (f64, f64) {
        let size = self.amplitude.abs();
        // A negative amplitude shifts the extremes by half a turn.
        let start = self.phase / TAU + if self.amplitude < 0.0 { 0.5 } else { 0.0 };
        let (first, last) = (self.at(0.0).value, self.at(self.duration).value);
        let comes_by = |crest: f64| (start - crest).ceil() - (start - crest) <= self.turns(self.duration);
        (
            if comes_by(0.75) { self.offset - size } else { first.min(last) },
            if comes_by(0.25) { self.offset + size } else { first.max(last) },
        )
    }
}
