//! Charge due to strain of the stack: Q = CV + kα(e - αV).

use super::Driver;
use super::stage::{At, LOW};
use stickslip_drive::Sample;

/// Coupling between strain and charge of the stack.
#[derive(Debug, Clone, Copy)]
pub(super) struct Strain {
    /// Coupling κ = kα²/C, above 0 and below 1.
    pub(super) coupling: f64,
}

impl Driver {
    /// Returns the elongation of the stack, m, and its rate; 0 without strain coupling.
    pub(super) fn elongation(&self, inputs: &[Sample]) -> Sample {
        let none = Sample { value: 0.0, rate: 0.0, acceleration: 0.0 };
        self.strain.and_then(|_| inputs.get(1).copied()).unwrap_or(none)
    }

    /// Returns the current as a stroke rate αI/C, m/s.
    ///
    /// `rate` is the rate of the voltage as a stroke and `elongated` the rate of the elongation, both in m/s.
    pub(super) fn flow(&self, rate: f64, elongated: f64) -> f64 {
        self.strain.map_or(rate, |Strain { coupling }| (1.0 - coupling) * rate + coupling * elongated)
    }

    /// Returns the rate of the voltage as a stroke, m/s, at a current: the inverse of [`flow`](Self::flow).
    ///
    /// Applied to values instead of rates, the function returns the voltage at a charge.
    pub(super) fn charged(&self, flow: f64, elongated: f64) -> f64 {
        self.strain.map_or(flow, |Strain { coupling }| (flow - coupling * elongated) / (1.0 - coupling))
    }

    /// Returns the stiffness of the stack, N/m: κC/α²; 0 without strain coupling.
    pub(super) fn stiffness(&self) -> f64 {
        let farads = self.spec.capacitance / self.spec.gain.powi(2);
        self.strain.map_or(0.0, |Strain { coupling }| coupling * farads)
    }

    /// Returns the stored energy, J: ½CV² - kαV(αV - e). Arguments are the voltage as a stroke and the elongation, both in m.
    pub(super) fn stored(&self, stroke: f64, elongation: f64) -> f64 {
        let volts = stroke / self.spec.gain;
        0.5 * self.spec.capacitance * volts * volts - self.stiffness() * stroke * (stroke - elongation)
    }

    /// Returns the index of the state with the work of the stack; this state follows the states of the low-pass.
    pub(super) fn worked(&self) -> Option<usize> {
        self.strain.map(|_| if self.spec.low.is_some() { LOW + 2 } else { LOW })
    }

    /// Returns the power of the stack, W: force of the stack times rate of its free stroke.
    pub(super) fn power(&self, voltage: Sample, at: &At<'_>) -> f64 {
        self.stiffness() * (voltage.value - self.elongation(at.inputs).value) * voltage.rate
    }
}
