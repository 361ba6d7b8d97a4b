//! What strain makes of the charge: Q = CV + kα(e - αV).

use super::Driver;
use super::stage::{At, LOW};
use stickslip_drive::Sample;

/// The charge of strain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Strain {
    /// κ = kα²/C, above 0 and below 1.
    pub(super) coupling: f64,
}

impl Driver {
    /// The elongation, m, and its rate; 0 where strain makes no charge.
    pub(super) fn elongation(&self, inputs: &[Sample]) -> Sample {
        let none = Sample { value: 0.0, rate: 0.0, acceleration: 0.0 };
        self.strain.and_then(|_| inputs.get(1).copied()).unwrap_or(none)
    }

    /// Current as a rate of the stroke, αI/C, m/s, at these rates of the voltage (as a stroke) and of the elongation.
    pub(super) fn flow(&self, rate: f64, elongated: f64) -> f64 {
        self.strain.map_or(rate, |Strain { coupling }| (1.0 - coupling) * rate + coupling * elongated)
    }

    /// The rate of the voltage, as a stroke, m/s, at this current: what [`flow`](Self::flow) undoes. Of values: the voltage at a charge.
    pub(super) fn charged(&self, flow: f64, elongated: f64) -> f64 {
        self.strain.map_or(flow, |Strain { coupling }| (flow - coupling * elongated) / (1.0 - coupling))
    }

    /// Stiffness of the stack, N/m, κC/α²; 0 where strain makes no charge.
    pub(super) fn stiffness(&self) -> f64 {
        let farads = self.spec.capacitance / self.spec.gain.powi(2);
        self.strain.map_or(0.0, |Strain { coupling }| coupling * farads)
    }

    /// Energy that is stored at a voltage, as a stroke, and an elongation, J: ½CV² - k αV(αV - e).
    pub(super) fn stored(&self, stroke: f64, elongation: f64) -> f64 {
        let volts = stroke / self.spec.gain;
        0.5 * self.spec.capacitance * volts * volts - self.stiffness() * stroke * (stroke - elongation)
    }

    /// Place of the work done by the stack among its states: after those of the low-pass.
    pub(super) fn worked(&self) -> Option<usize> {
        self.strain.map(|_| if self.spec.low.is_some() { LOW + 2 } else { LOW })
    }

    /// Power of the stack, W: its force along the rate of its stroke.
    pub(super) fn power(&self, voltage: Sample, at: &At<'_>) -> f64 {
        self.stiffness() * (voltage.value - self.elongation(at.inputs).value) * voltage.rate
    }
}
