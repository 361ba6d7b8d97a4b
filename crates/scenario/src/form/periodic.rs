//! Keys that all periodic waveforms have: period, phase, delay, cycles, bursts and sequences.

use super::Count;
use crate::quantity::{Angle, AnyQuantity, Frequency, Time};
use crate::schema::{above_zero, cycles_or_dwell, period_or_dwell};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Burst: a number of cycles and a rest, repeated periodically.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = period_or_dwell)]
pub(crate) struct BurstForm {
    /// Number of cycles in a burst, a whole number from 1 to 10 000.
    #[schemars(range(min = 1, max = 10_000), example = 5)]
    pub(crate) cycles: Count,
    /// Time from the start of a burst to the start of the next, s, at least as long as its cycles; give either this or `dwell`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"20 ms", transform = above_zero)]
    pub(crate) period: Option<Time>,
    /// Rest between two bursts, s, above 0; give either this or `period`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"15 ms", transform = above_zero)]
    pub(crate) dwell: Option<Time>,
}

/// Section of a sequence: a run of cycles, or a rest.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = cycles_or_dwell)]
pub(crate) struct SectionForm {
    /// Number of cycles, a whole number of at least 1, at most 10 000 in the whole sequence; give either this or `dwell`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 10_000), example = 10)]
    pub(crate) cycles: Option<Count>,
    /// Whether each cycle is reversed in time, so that a drive steps in the opposite direction; false by default. The range of values is
    /// unchanged.
    #[serde(default, skip_serializing_if = "is_false")]
    #[schemars(example = true)]
    pub(crate) reversed: bool,
    /// Duration of a rest at the initial value of a cycle, s, above 0; give either this or `cycles`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"5 ms", transform = above_zero)]
    pub(crate) dwell: Option<Time>,
}

pub(super) fn is_false(value: &bool) -> bool {
    !value
}

/// Values of the keys that all periodic waveforms have.
#[derive(Debug, Clone)]
pub(crate) struct Periodic {
    pub(crate) period: Option<Time>,
    pub(crate) frequency: Option<Frequency>,
    pub(crate) phase: Angle,
    pub(crate) delay: Time,
    pub(crate) cycles: Option<f64>,
    pub(crate) burst: Option<BurstForm>,
    pub(crate) sequence: Option<Vec<SectionForm>>,
}

// The keys are repeated in every waveform, because serde's `flatten` would lose the positions of errors.
macro_rules! periodic {
    ($(#[$meta:meta])* $name:ident { $($(#[$field_meta:meta])* $field:ident: $type:ty,)* }) => {
        #[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
        $(#[$meta])*
        #[serde(deny_unknown_fields)]
        #[schemars(transform = period_or_frequency)]
        pub(crate) struct $name {
            $($(#[$field_meta])* pub(crate) $field: $type,)*
            /// Period, s, above 0; give either this or `frequency`; typical 1 us to 1 s.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[schemars(example = &"10 ms", transform = above_zero)]
            pub(crate) period: Option<Time>,
            /// Frequency, Hz, above 0; give either this or `period`; typical 1 Hz to 1 MHz.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[schemars(example = &"100 Hz", transform = above_zero)]
            pub(crate) frequency: Option<Frequency>,
            /// Phase, rad: the waveform is advanced by phase/2π of a cycle. In a burst or a sequence, the phase is counted in single
            /// cycles, not in lengths of the whole pattern.
            #[serde(default = "crate::form::periodic::no_angle")]
            #[schemars(example = &"90 deg")]
            pub(crate) phase: Angle,
            /// Delay, s, at least 0: the first value is held until the delay has passed.
            #[serde(default = "crate::form::periodic::no_time")]
            #[schemars(example = &"1 ms", transform = at_least_zero)]
            pub(crate) delay: Time,
            /// Number of cycles, above 0, after which the last value is held; without end by default. With `burst` or `sequence`, the whole
            /// pattern counts as one cycle.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[schemars(extend("exclusiveMinimum" = 0), example = 10)]
            pub(crate) cycles: Option<f64>,
            /// Burst: some cycles and a rest at the initial value of a cycle, repeated periodically; give either this or `sequence`.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[schemars(example = json!({ "cycles": 5, "period": "20 ms" }))]
            pub(crate) burst: Option<BurstForm>,
            /// Sequence of at most 1000 sections, repeated periodically; give either this or `burst`. A section is a run of cycles, forward
            /// or reversed, or a rest.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[schemars(length(min = 1, max = 1000), example = json!([{ "cycles": 10 }, { "dwell": "5 ms" }, { "cycles": 10, "reversed": true }]))]
            pub(crate) sequence: Option<Vec<SectionForm>>,
        }

        impl $name {
            pub(crate) fn periodic(&self) -> Periodic {
                Periodic {
                    period: self.period,
                    frequency: self.frequency,
                    phase: self.phase,
                    delay: self.delay,
                    cycles: self.cycles,
                    burst: self.burst,
                    sequence: self.sequence.clone(),
                }
            }
        }
    };
}

pub(super) use periodic;

pub(super) fn no_angle() -> Angle {
    Angle::new(0.0)
}

pub(super) fn no_time() -> Time {
    Time::new(0.0)
}

pub(super) fn no_value() -> AnyQuantity {
    AnyQuantity { si: 0.0, kind: None }
}

pub(super) fn is_no_value(value: &AnyQuantity) -> bool {
    value.si == 0.0
}
