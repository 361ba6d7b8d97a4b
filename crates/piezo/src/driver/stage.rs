//! What a driver's stages make of a moment: the window, the low-pass, the output stage.

use super::{Course, Driver, Output, Window};
use stickslip_drive::Sample;
use stickslip_drive::component::{Moment, Standing};

/// Rounding of a voltage against its range, and of a rate against its limit: below it nothing is decided.
pub(super) const ROUNDING: f64 = 1e-12;

pub(super) type At<'a> = Moment<'a, [Sample]>;
pub(super) type Now<'a> = Standing<'a, usize, Vec<f64>>;

/// Places of the states.
pub(super) const VOLTAGE: usize = 0;
pub(super) const WORK: usize = 1;
pub(super) const LOST: usize = 2;
pub(super) const LOW: usize = 3;
pub(super) const LOW_RATE: usize = 4;

impl Driver {
    /// What the output stage follows: the command in its window, through the low-pass.
    pub(super) fn followed(&self, course: Course, command: Sample, states: &[f64]) -> Sample {
        let (low, high) = self.spec.reach();
        let held = |value: f64| Sample { value, rate: 0.0, acceleration: 0.0 };
        let cut = match course.window {
            Window::Inside => command,
            Window::Below => held(low),
            Window::Above => held(high),
        };
        let Some(pass) = &self.spec.low else { return cut };
        let (omega, value, rate) = (self.spec.omega(), states[LOW], states[LOW_RATE]);
        let acceleration = omega * (omega * (cut.value - value) - 2.0 * pass.ratio * rate);
        Sample { value, rate, acceleration }
    }

    /// Rate that the output stage wishes for without a limit, m/s.
    pub(super) fn wish(&self, followed: Sample, states: &[f64]) -> f64 {
        self.spec.time().map_or(followed.rate, |time| (followed.value - states[VOLTAGE]) / time)
    }

    /// The voltage as a stroke, m, with its rate, m/s.
    pub(super) fn voltage(
        &self,
        course: Course,
        followed: Sample,
        (states, offset): (&[f64], f64),
    ) -> Sample {
        let (down, up) = self.spec.slew();
        let own = states[VOLTAGE] + offset;
        let limited = |rate: f64| Sample { value: own, rate, acceleration: 0.0 };
        match (course.output, self.spec.time()) {
            (Output::Rising, _) => limited(up),
            (Output::Falling, _) => limited(-down),
            (Output::Free, None) => followed,
            (Output::Free, Some(time)) => {
                let rate = self.wish(followed, states);
                Sample { value: own, rate, acceleration: (followed.rate - rate) / time }
            }
        }
    }

    pub(super) fn offset(memory: &[f64]) -> f64 {
        memory.first().copied().unwrap_or(0.0)
    }

    /// What is followed, and the voltage.
    pub(super) fn now(&self, standing: Now<'_>, at: &At<'_>) -> (Course, Sample, Sample) {
        let course = Course::of(*standing.law);
        let followed = self.followed(course, at.inputs[0], at.states);
        let voltage = self.voltage(course, followed, (at.states, Self::offset(standing.memory)));
        (course, followed, voltage)
    }

    /// What the output stage does from here on, by where it stands and what it wishes.
    pub(super) fn output(&self, followed: Sample, (states, voltage): (&[f64], f64)) -> Output {
        let (down, up) = self.spec.slew();
        if self.spec.current.is_none() {
            return Output::Free;
        }
        let ahead = followed.value - voltage;
        if self.spec.resistance.is_none() && ahead.abs() > ROUNDING * self.span {
            return if ahead > 0.0 { Output::Rising } else { Output::Falling };
        }
        let wish = self.wish(followed, states);
        if wish > up * (1.0 + ROUNDING) {
            Output::Rising
        } else if wish < -down * (1.0 + ROUNDING) {
            Output::Falling
        } else {
            Output::Free
        }
    }

    /// Current of a rate, A.
    pub(super) fn current(&self, rate: f64) -> f64 {
        self.spec.capacitance * rate / self.spec.gain
    }
}
