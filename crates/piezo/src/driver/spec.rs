//! Specification of a driver.

use std::f64::consts::{PI, TAU};
use thiserror::Error;

/// Specification of a driver and of the stack that it drives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spec {
    /// Capacitance C of the stack, F, above 0.
    pub capacitance: f64,
    /// Stroke per volt α of the stack, m/V, above 0.
    pub gain: f64,
    /// Voltage window: smallest and largest voltage, V.
    pub window: Option<(f64, f64)>,
    /// Largest currents out of the stack and into the stack, A, both above 0.
    pub current: Option<(f64, f64)>,
    /// Resistance of the output stage, Ω, above 0.
    pub resistance: Option<f64>,
    /// Low-pass before the output stage.
    pub low: Option<Low>,
    /// Controlled quantity: voltage or charge.
    pub control: Control,
}

/// Second-order low-pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Low {
    /// Natural frequency, Hz, above 0.
    pub frequency: f64,
    /// Damping ratio ζ, above 0.
    pub ratio: f64,
}

/// Quantity that a driver controls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Control {
    /// The driver controls the voltage. The stack follows with hysteresis and creep.
    #[default]
    Voltage,
    /// The driver controls the charge. The stack follows with little hysteresis and creep. The voltage V then represents charge over C.
    Charge,
}

/// Reason why a driver specification is invalid.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SpecError {
    /// A value that must be above 0 is 0, negative or not finite.
    #[error("{0} must be a finite number above 0")]
    NotPositive(&'static str),
    /// The lower end of the window is not below the upper end.
    #[error("the first end of the window must be below the second")]
    Window,
}

impl Spec {
    /// Checks that all values are within their ranges.
    ///
    /// # Errors
    /// Returns the first value that is out of its range.
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

    /// Returns the largest falling and rising rates of the stroke, m/s: αI/C; infinite without a current limit.
    pub(crate) fn slew(&self) -> (f64, f64) {
        let of = |current: f64| self.gain * current / self.capacitance;
        self.current.map_or((f64::INFINITY, f64::INFINITY), |(sink, source)| (of(sink), of(source)))
    }

    /// Returns the voltage window as strokes, m.
    pub(crate) fn reach(&self) -> (f64, f64) {
        let (low, high) = self.window.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        (self.gain * low, self.gain * high)
    }

    /// Returns the time constant RC, s.
    pub(crate) fn time(&self) -> Option<f64> {
        self.resistance.map(|resistance| resistance * self.capacitance)
    }

    /// Returns the largest natural rate of the driver, 1/s: the maximum of ω and 1/RC; 0 for a driver without low-pass and resistance.
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.omega().max(self.time().map_or(0.0, f64::recip))
    }

    /// Returns the angular natural frequency ω of the low-pass, 1/s; 0 without a low-pass.
    pub(crate) fn omega(&self) -> f64 {
        self.low.map_or(0.0, |low| TAU * low.frequency)
    }

    /// Returns the largest possible ratio of the output range to the input range of the low-pass.
    ///
    /// The ratio is ∫|h|dt = coth(πζ/(2√(1-ζ²))), where h is the impulse response; 1 for ζ ≥ 1.
    pub(super) fn overshoot(&self) -> f64 {
        match self.low {
            Some(Low { ratio, .. }) if ratio < 1.0 => {
                math::tanh(PI * ratio / (2.0 * (1.0 - ratio * ratio).sqrt())).recip()
            }
            _ => 1.0,
        }
    }
}
