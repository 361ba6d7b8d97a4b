//! What a driver can do.

use std::f64::consts::{PI, TAU};
use thiserror::Error;

/// What a driver can do, and what hangs on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spec {
    /// Capacitance C of the stack, F, above 0.
    pub capacitance: f64,
    /// Stroke per volt α of the stack, m/V, above 0.
    pub gain: f64,
    /// Smallest and largest voltage, V.
    pub window: Option<(f64, f64)>,
    /// Largest currents out of the stack and into it, A, above 0.
    pub current: Option<(f64, f64)>,
    /// Resistance, Ω, above 0.
    pub resistance: Option<f64>,
    /// The low-pass before the output stage.
    pub low: Option<Low>,
    /// What it controls.
    pub control: Control,
}

/// A second-order low-pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Low {
    /// Natural frequency, Hz, above 0.
    pub frequency: f64,
    /// Damping ratio ζ, above 0.
    pub ratio: f64,
}

/// What a driver controls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Control {
    /// The voltage: the stack follows with hysteresis and creep.
    #[default]
    Voltage,
    /// The charge, which a stack follows nearly without: V here is charge over C.
    Charge,
}

/// A driver that there cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SpecError {
    /// A number that must be above zero.
    #[error("{0} must be a finite number above 0")]
    NotPositive(&'static str),
    /// A window from above to below.
    #[error("the window must rise")]
    Window,
}

impl Spec {
    /// Checks the numbers.
    ///
    /// # Errors
    /// The first one that there cannot be.
    pub fn check(&self) -> Result<(), SpecError> {
        let (sink, source) = self.current.unwrap_or((1.0, 1.0));
        let low = self.low.unwrap_or(Low { frequency: 1.0, ratio: 1.0 });
        let numbers = [
            ("capacitance", self.capacitance),
            ("stroke per volt", self.gain),
            ("sink current", sink),
            ("current", source),
            ("resistance", self.resistance.unwrap_or(1.0)),
            ("bandwidth", low.frequency),
            ("damping ratio", low.ratio),
        ];
        if let Some((name, _)) = numbers.iter().find(|(_, value)| !(*value > 0.0 && value.is_finite())) {
            return Err(SpecError::NotPositive(name));
        }
        match self.window {
            Some((low, high)) if !(low < high && low.is_finite() && high.is_finite()) => {
                Err(SpecError::Window)
            }
            _ => Ok(()),
        }
    }

    /// Largest rates of the stroke downwards and upwards, m/s: αI/C; infinite without a limit.
    pub(crate) fn slew(&self) -> (f64, f64) {
        let of = |current: f64| self.gain * current / self.capacitance;
        self.current.map_or((f64::INFINITY, f64::INFINITY), |(sink, source)| (of(sink), of(source)))
    }

    /// Window as a stroke, m.
    pub(crate) fn reach(&self) -> (f64, f64) {
        let (low, high) = self.window.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        (self.gain * low, self.gain * high)
    }

    /// RC, s.
    pub(crate) fn time(&self) -> Option<f64> {
        self.resistance.map(|resistance| resistance * self.capacitance)
    }

    /// The fastest at which what it makes swings or settles of itself, 1/s; 0 where it follows at once.
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.omega().max(self.time().map_or(0.0, f64::recip))
    }

    /// ω of the low-pass, 1/s.
    pub(crate) fn omega(&self) -> f64 {
        self.low.map_or(0.0, |low| TAU * low.frequency)
    }

    /// How many times the half range of what goes in may come out of the low-pass: ∫|h|dt of its impulse response, coth(πζ/2√(1-ζ²)),
    /// which some input reaches; 1 where it does not swing.
    pub(super) fn overshoot(&self) -> f64 {
        match self.low {
            Some(Low { ratio, .. }) if ratio < 1.0 => {
                math::tanh(PI * ratio / (2.0 * (1.0 - ratio * ratio).sqrt())).recip()
            }
            _ => 1.0,
        }
    }
}
