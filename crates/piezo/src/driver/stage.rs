//! Signals of the driver's stages at one time: window, low-pass and output stage.

use super::{Course, Driver, Output, Window};
use crate::figures::{Last, last};
use stickslip_drive::Sample;
use stickslip_drive::component::{Moment, Standing};

/// Relative rounding of a voltage against its range, and of a rate against its limit. Smaller differences do not change the mode.
pub(super) const ROUNDING: f64 = 1e-12;

pub(super) type At<'a> = Moment<'a, [Sample]>;
pub(super) type Now<'a> = Standing<'a, usize, Vec<f64>>;

/// Indices of the driver's states: voltage, source work, losses, low-pass output and output rate.
pub(super) const VOLTAGE: usize = 0;
pub(super) const WORK: usize = 1;
pub(super) const LOST: usize = 2;
pub(super) const LOW: usize = 3;
pub(super) const LOW_RATE: usize = 4;

impl Driver {
    /// Returns the signal that the output stage follows: the command, limited to the window and filtered by the low-pass.
    pub(super) fn followed(
        &self,
        (course, located): (Course, bool),
        command: Sample,
        states: &[f64],
    ) -> Sample {
        let (low, high) = self.spec.reach();
        let held = |value: f64| Sample { value, rate: 0.0, acceleration: 0.0 };
        let cut = match course.window {
            // If steps end at events, the signal is smooth in each mode. Other steps may cross an end of the window and are limited there.
            Window::Inside if located => command,
            Window::Below if located => held(low),
            Window::Above if located => held(high),
            _ if command.value < low => held(low),
            _ if command.value > high => held(high),
            _ => command,
        };
        let Some(pass) = &self.spec.low else { return cut };
        let (omega, value, rate) = (self.spec.omega(), states[LOW], states[LOW_RATE]);
        let acceleration = omega * (omega * (cut.value - value) - 2.0 * pass.ratio * rate);
        Sample { value, rate, acceleration }
    }

    /// Returns the current that the output stage would supply without current limits, as a stroke rate, m/s.
    ///
    /// `elongated` is the rate of the elongation, m/s.
    pub(super) fn wish(&self, followed: Sample, (states, elongated): (&[f64], f64)) -> f64 {
        let follows = || self.flow(followed.rate, elongated);
        self.spec.time().map_or_else(follows, |time| (followed.value - states[VOLTAGE]) / time)
    }

    /// Returns the voltage in a mode, as a stroke, m, with its rate, m/s.
    pub(super) fn voltage(
        &self,
        course: Course,
        followed: Sample,
        (states, offset, elongated): (&[f64], f64, f64),
    ) -> Sample {
        let (down, up) = self.spec.slew();
        let own = states[VOLTAGE] + offset;
        // The acceleration of the elongation is not known here; bodies at the stack do not use the second derivative of the voltage.
        let limited =
            |flow: f64| Sample { value: own, rate: self.charged(flow, elongated), acceleration: 0.0 };
        match (course.output, self.spec.time()) {
            (Output::Rising, _) => limited(up),
            (Output::Falling, _) => limited(-down),
            (Output::Free, None) => followed,
            (Output::Free, Some(time)) => {
                let rate = self.charged(self.wish(followed, (states, elongated)), elongated);
                let acceleration = self.charged((followed.rate - rate) / time, 0.0);
                Sample { value: own, rate, acceleration }
            }
        }
    }

    /// Returns the voltage for steps that do not locate events, with the current limits applied in every mode.
    ///
    /// From the last step to the time `t` (s), the voltage can change only as much as the current limits allow in this time.
    pub(super) fn saturated(
        &self,
        followed: Sample,
        (states, memory): (&[f64], &[f64]),
        (t, elongation): (f64, Sample),
    ) -> Sample {
        if self.spec.current.is_none() && self.spec.resistance.is_none() {
            return followed;
        }
        let (down, up) = self.spec.slew();
        let wish = self.wish(followed, (states, elongation.rate));
        let flow = wish.clamp(-down, up);
        let rate = self.charged(flow, elongation.rate);
        let within = |value: f64, acceleration: f64| Sample {
            value,
            rate,
            acceleration: if flow == wish { acceleration } else { 0.0 },
        };
        if let Some(time) = self.spec.time() {
            let acceleration = self.charged((followed.rate - rate) / time, 0.0);
            return within(states[VOLTAGE] + Self::offset(memory), acceleration);
        }
        let Last { stroke, elongation: from, at: since } = last(memory);
        let charge = self.flow(stroke, from);
        let reached = |flow: f64| self.charged(charge + flow * (t - since), elongation.value);
        let (lowest, highest) = (reached(-down), reached(up));
        let at_limit = |value: f64, flow: f64| Sample {
            value,
            rate: self.charged(flow, elongation.rate),
            acceleration: 0.0,
        };
        match followed.value {
            value if value < lowest => at_limit(lowest, -down),
            value if value > highest => at_limit(highest, up),
            value => within(value, followed.acceleration),
        }
    }

    pub(super) fn offset(memory: &[f64]) -> f64 {
        memory.first().copied().unwrap_or(0.0)
    }

    /// Returns the mode, the signal that the output stage follows, and the voltage.
    pub(super) fn now(&self, standing: Now<'_>, at: &At<'_>) -> (Course, Sample, Sample) {
        let course = Course::of(*standing.law);
        let followed = self.followed((course, at.located), at.inputs[0], at.states);
        let elongation = self.elongation(at.inputs);
        let voltage = if at.located {
            self.voltage(course, followed, (at.states, Self::offset(standing.memory), elongation.rate))
        } else {
            self.saturated(followed, (at.states, standing.memory), (at.t, elongation))
        };
        (course, followed, voltage)
    }

    /// Returns the mode of the output stage, from the voltage and the current that would flow without limits.
    pub(super) fn output(
        &self,
        followed: Sample,
        (states, voltage, elongated): (&[f64], f64, f64),
    ) -> Output {
        let (down, up) = self.spec.slew();
        if self.spec.current.is_none() {
            return Output::Free;
        }
        let ahead = followed.value - voltage;
        if self.spec.resistance.is_none() && ahead.abs() > ROUNDING * self.span {
            return if ahead > 0.0 { Output::Rising } else { Output::Falling };
        }
        let wish = self.wish(followed, (states, elongated));
        if wish > up * (1.0 + ROUNDING) {
            Output::Rising
        } else if wish < -down * (1.0 + ROUNDING) {
            Output::Falling
        } else {
            Output::Free
        }
    }

    /// Converts a current from a stroke rate, m/s, to A.
    pub(super) fn current(&self, flow: f64) -> f64 {
        self.spec.capacitance * flow / self.spec.gain
    }

    /// Returns the power of the source, W, from the followed signal and the current, both as strokes.
    pub(super) fn source(&self, followed: Sample, flow: f64) -> f64 {
        followed.value / self.spec.gain * self.current(flow)
    }
}
