//! Keys of the waveform shapes, such as sawtooth, sine and chirp.

use super::periodic::{BurstForm, Periodic, SectionForm, is_no_value, no_angle, no_time, no_value, periodic};
use crate::quantity::{Angle, AnyQuantity, Frequency, Time};
use crate::schema::{above_zero, at_least_zero, flyback_or_resonance, period_or_frequency};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

periodic! {
    /// Sawtooth.
    #[schemars(transform = flyback_or_resonance)]
    SawtoothForm {
        /// Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um.
        #[schemars(example = &"200 nm")]
        stroke: AnyQuantity,
        /// Duration of the flyback, the return to 0, s, at least 0 (a jump) and below the period; typical a hundredth of the period. Give
        /// this or `resonance`; with `rate`, the flyback is 0 by default.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(example = &"10 us", transform = at_least_zero)]
        flyback: Option<Time>,
        /// Resonance frequency that the flyback shall not excite, Hz, above 0; give either this or `flyback`. The flyback takes one period
        /// of this resonance.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(example = &"4.15 kHz", transform = above_zero)]
        resonance: Option<Frequency>,
        /// Slew rate limit of the waveform, per s, in the unit of the driven quantity, at least the slew rate of the rise; no limit by
        /// default. The waveform falls at this rate in the flyback until it meets the next rise.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(example = &"20 mm/s", transform = above_zero)]
        rate: Option<AnyQuantity>,
    }
}

periodic! {
    /// Triangle.
    TriangleForm {
        /// Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um.
        #[schemars(example = &"200 nm")]
        stroke: AnyQuantity,
    }
}

periodic! {
    /// Sine.
    SineForm {
        /// Half the peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um.
        #[schemars(example = &"100 nm")]
        amplitude: AnyQuantity,
        /// Mean value, in the unit of the driven quantity.
        #[serde(default = "no_value")]
        #[schemars(example = &"100 nm")]
        offset: AnyQuantity,
    }
}

periodic! {
    /// Sum of sines.
    HarmonicsForm {
        /// Sine terms of the sum, at least one; at most 1000 in all waveforms together.
        #[schemars(length(min = 1, max = 1000), example = json!([{ "amplitude": "100 nm", "order": 1 }]))]
        terms: Vec<HarmonicForm>,
        /// Mean value, in the unit of the driven quantity; 0 by default.
        #[serde(default = "no_value", skip_serializing_if = "is_no_value")]
        #[schemars(example = &"60 V")]
        offset: AnyQuantity,
    }
}

periodic! {
    /// Cycloid.
    CycloidForm {
        /// Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um.
        #[schemars(example = &"200 nm")]
        stroke: AnyQuantity,
        /// Duration of the flyback, the return to 0, s, above 0 and below the period; half a period by default.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(example = &"1 ms", transform = above_zero)]
        flyback: Option<Time>,
    }
}

/// One sine of a sum.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct HarmonicForm {
    /// Amplitude, in the unit of the driven quantity; typical 1 nm to 10 um.
    #[schemars(example = &"100 nm")]
    pub(crate) amplitude: AnyQuantity,
    /// Multiple of the frequency, a whole number, 1 to 1000.
    #[schemars(range(min = 1, max = 1000), example = 2)]
    pub(crate) order: super::Count,
    /// Phase of this sine, rad.
    #[serde(default = "no_angle")]
    #[schemars(example = &"90 deg")]
    pub(crate) phase: Angle,
}

periodic! {
    /// Two harmonics.
    TwoHarmonicsForm {
        /// Amplitude of the fundamental, in the unit of the driven quantity; typical 10 nm to 10 um.
        #[schemars(example = &"100 nm")]
        amplitude: AnyQuantity,
        /// Amplitude of the second harmonic as a share of `amplitude`, -0.25 to 0.25, not 0; 0.25 by default. A positive share makes the
        /// waveform rise fast and fall slowly, which carries a slider in the negative direction. A negative share does the opposite.
        #[serde(default = "quarter")]
        #[schemars(range(min = -0.25, max = 0.25), example = 0.25)]
        second: f64,
    }
}

periodic! {
    /// Parabola.
    ParabolaForm {
        /// Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um.
        #[schemars(example = &"200 nm")]
        stroke: AnyQuantity,
        /// Duration of the turn at the stroke, s, at least 0 (a cusp, the default) and below the period.
        #[serde(default = "no_time")]
        #[schemars(example = &"20 us", transform = at_least_zero)]
        turn: Time,
    }
}

periodic! {
    /// Trapezoid.
    TrapezoidForm {
        /// Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um.
        #[schemars(example = &"200 nm")]
        stroke: AnyQuantity,
        /// Duration of the rise to the stroke, s, at least 0 (a jump).
        #[schemars(example = &"1 ms", transform = at_least_zero)]
        rise: Time,
        /// Duration of the hold at the stroke, s, at least 0, which is the default.
        #[serde(default = "no_time")]
        #[schemars(example = &"3 ms", transform = at_least_zero)]
        hold: Time,
        /// Duration of the fall to 0, s, at least 0 (a jump); by default equal to the rise. The waveform rests at 0 for the remaining
        /// period.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(example = &"1 ms", transform = at_least_zero)]
        fall: Option<Time>,
    }
}

periodic! {
    /// S-curve.
    SCurveForm {
        /// Peak-to-peak value, in the unit of the driven quantity; typical 10 nm to 10 um.
        #[schemars(example = &"200 nm")]
        stroke: AnyQuantity,
        /// Duration of the flyback, the return to 0, s, above 0 and below the period; half a period by default.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(example = &"1 ms", transform = above_zero)]
        flyback: Option<Time>,
        /// Duration of each phase of constant jerk, s, above 0 and at most a quarter of the shorter of rise and flyback. Rise and flyback
        /// each have four such phases.
        #[schemars(example = &"100 us", transform = above_zero)]
        rounding: Time,
    }
}

/// Chirp.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ChirpForm {
    /// Half the peak-to-peak value, in the unit of the driven quantity; typical 1 nm to 1 um.
    #[schemars(example = &"100 nm")]
    pub(crate) amplitude: AnyQuantity,
    /// Mean value, in the unit of the driven quantity.
    #[serde(default = "no_value")]
    #[schemars(example = &"100 nm")]
    pub(crate) offset: AnyQuantity,
    /// Frequency at the start, Hz, at least 0.
    #[schemars(example = &"100 Hz", transform = at_least_zero)]
    pub(crate) from: Frequency,
    /// Frequency at the end, Hz, at least 0; `from` and `to` are not both 0.
    #[schemars(example = &"10 kHz", transform = at_least_zero)]
    pub(crate) to: Frequency,
    /// Duration of the frequency sweep, s, above 0; then the last value is held.
    #[schemars(example = &"100 ms", transform = above_zero)]
    pub(crate) duration: Time,
    /// Phase at the start, rad.
    #[serde(default = "no_angle")]
    #[schemars(example = &"90 deg")]
    pub(crate) phase: Angle,
    /// Delay, s, at least 0: the first value is held until the delay has passed.
    #[serde(default = "no_time")]
    #[schemars(example = &"1 ms", transform = at_least_zero)]
    pub(crate) delay: Time,
}

/// Step.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StepForm {
    /// Value after the step, in the unit of the driven quantity; the value before it is 0.
    #[schemars(example = &"100 nm")]
    pub(crate) height: AnyQuantity,
    /// Time of the step, s, at least 0, which is the default.
    #[serde(default = "no_time")]
    #[schemars(example = &"1 ms", transform = at_least_zero)]
    pub(crate) at: Time,
}

fn quarter() -> f64 {
    0.25
}
