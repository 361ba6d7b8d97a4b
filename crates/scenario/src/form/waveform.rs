//! Waveforms: prescribed courses in time.

use super::{GeneratorForm, InputForm, Reserved};
use crate::quantity::{Angle, AnyQuantity, Frequency, Time};
use crate::schema::{above_zero, at_least_zero, period_or_frequency, points_or_file};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::json;
use std::borrow::Cow;
use std::fmt;

/// A prescribed course in time. Peak-to-peak values are called stroke, half of it amplitude.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum WaveformForm {
    /// Starts at 0, rises linearly to the stroke, falls linearly to 0 in the flyback that ends the period.
    #[schemars(example = json!({ "sawtooth": { "stroke": "200 nm", "period": "10 ms", "flyback": "10 us" } }))]
    Sawtooth(SawtoothForm),
    /// Rises linearly from 0 to the stroke in half a period and falls back.
    #[schemars(example = json!({ "triangle": { "stroke": "200 nm", "period": "10 ms" } }))]
    Triangle(TriangleForm),
    /// offset + amplitude · sin(ωt + phase).
    #[schemars(example = json!({ "sine": { "amplitude": "100 nm", "frequency": "100 Hz" } }))]
    Sine(SineForm),
    /// Sum of amplitude · sin(order · ωt + phase).
    #[schemars(example = json!({ "harmonics": { "terms": [{ "amplitude": "100 nm", "order": 1 }, { "amplitude": "25 nm", "order": 2 }], "period": "10 ms" } }))]
    Harmonics(HarmonicsForm),
    /// Rises by the cycloidal law stroke · (τ - sin(2πτ)/2π), falls by the same law in the flyback that ends the period.
    #[schemars(example = json!({ "cycloid": { "stroke": "200 nm", "period": "10 ms" } }))]
    Cycloid(CycloidForm),
    /// Straight between given points, held before the first and after the last.
    #[schemars(example = json!({ "table": { "points": [[0, 0], ["1 ms", "200 nm"], ["2 ms", 0]] } }))]
    Table(TableForm),
    /// Given by a caller while it runs, held or straight from value to value; `stickslip run` holds the initial value. It
    /// has no period: no figures of steps per period are made of it.
    #[schemars(example = json!({ "input": { "initial": 0, "range": ["-1 um", "1 um"] } }))]
    Input(InputForm),
    /// Made inside: cycles whose stroke, frequency, heading and number a caller commands while they run. `stickslip run` takes
    /// the values given here.
    #[schemars(example = json!({ "generator": { "shape": { "sawtooth": { "flyback": "10 us" } }, "stroke": "200 nm", "frequency": "100 Hz", "range": { "stroke": [0, "300 nm"], "frequency": [0, "2 kHz"] } } }))]
    Generator(GeneratorForm),
    /// Not yet in this version.
    Parabola(Reserved),
    /// Not yet in this version.
    Trapezoid(Reserved),
    /// Not yet in this version.
    Chirp(Reserved),
    /// Not yet in this version.
    Step(Reserved),
}

impl WaveformForm {
    /// The word of a periodic waveform and what all of them share; none of what has no period.
    pub(crate) fn periodic(&self) -> Option<(&'static str, Periodic)> {
        match self {
            Self::Sawtooth(form) => Some(("sawtooth", form.periodic())),
            Self::Triangle(form) => Some(("triangle", form.periodic())),
            Self::Sine(form) => Some(("sine", form.periodic())),
            Self::Harmonics(form) => Some(("harmonics", form.periodic())),
            Self::Cycloid(form) => Some(("cycloid", form.periodic())),
            Self::Table(_)
            | Self::Input(_)
            | Self::Generator(_)
            | Self::Parabola(_)
            | Self::Trapezoid(_)
            | Self::Chirp(_)
            | Self::Step(_) => None,
        }
    }
}

/// What all periodic waveforms share.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Periodic {
    pub(crate) period: Option<Time>,
    pub(crate) frequency: Option<Frequency>,
    pub(crate) phase: Angle,
    pub(crate) delay: Time,
    pub(crate) cycles: Option<f64>,
}

// Written out in every waveform: serde's `flatten` would lose the places of errors.
macro_rules! periodic {
    ($(#[$meta:meta])* $name:ident { $($(#[$field_meta:meta])* $field:ident: $type:ty,)* }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        #[schemars(transform = period_or_frequency)]
        pub(crate) struct $name {
            $($(#[$field_meta])* pub(crate) $field: $type,)*
            /// Period, s, above 0; this or `frequency`; typical 1 us to 1 s.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[schemars(example = &"10 ms", transform = above_zero)]
            pub(crate) period: Option<Time>,
            /// Frequency, Hz, above 0; this or `period`; typical 1 Hz to 1 MHz.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[schemars(example = &"100 Hz", transform = above_zero)]
            pub(crate) frequency: Option<Frequency>,
            /// Phase, rad: advances the waveform by phase/2π periods.
            #[serde(default = "no_angle")]
            #[schemars(example = &"90 deg")]
            pub(crate) phase: Angle,
            /// Delay, s, at least 0: until then the first value is held.
            #[serde(default = "no_time")]
            #[schemars(example = &"1 ms", transform = at_least_zero)]
            pub(crate) delay: Time,
            /// Number of cycles, above 0, after which the last value is held; without end by default.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            #[schemars(extend("exclusiveMinimum" = 0), example = 10)]
            pub(crate) cycles: Option<f64>,
        }

        impl $name {
            pub(crate) fn periodic(&self) -> Periodic {
                Periodic {
                    period: self.period,
                    frequency: self.frequency,
                    phase: self.phase,
                    delay: self.delay,
                    cycles: self.cycles,
                }
            }
        }
    };
}

periodic! {
    /// Sawtooth.
    SawtoothForm {
        /// Peak-to-peak value, in the unit of what follows; typical 10 nm to 10 um.
        #[schemars(example = &"200 nm")]
        stroke: AnyQuantity,
        /// Duration of the fall, s, at least 0 (a jump) and below the period; typical a hundredth of the period.
        #[schemars(example = &"10 us", transform = at_least_zero)]
        flyback: Time,
    }
}

periodic! {
    /// Triangle.
    TriangleForm {
        /// Peak-to-peak value, in the unit of what follows; typical 10 nm to 10 um.
        #[schemars(example = &"200 nm")]
        stroke: AnyQuantity,
    }
}

periodic! {
    /// Sine.
    SineForm {
        /// Half the peak-to-peak value, in the unit of what follows; typical 10 nm to 10 um.
        #[schemars(example = &"100 nm")]
        amplitude: AnyQuantity,
        /// Mean value, in the unit of what follows.
        #[serde(default = "no_value")]
        #[schemars(example = &"100 nm")]
        offset: AnyQuantity,
    }
}

periodic! {
    /// Sum of sines.
    HarmonicsForm {
        /// The sines, at least one; at most 1000 in all waveforms together.
        #[schemars(length(min = 1, max = 1000), example = json!([{ "amplitude": "100 nm", "order": 1 }]))]
        terms: Vec<HarmonicForm>,
    }
}

periodic! {
    /// Cycloid.
    CycloidForm {
        /// Peak-to-peak value, in the unit of what follows; typical 10 nm to 10 um.
        #[schemars(example = &"200 nm")]
        stroke: AnyQuantity,
        /// Duration of the fall, s, above 0 and below the period; half a period by default.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(example = &"1 ms", transform = above_zero)]
        flyback: Option<Time>,
    }
}

/// One sine of a sum.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct HarmonicForm {
    /// Amplitude, in the unit of what follows; typical 1 nm to 10 um.
    #[schemars(example = &"100 nm")]
    pub(crate) amplitude: AnyQuantity,
    /// Multiple of the frequency, a whole number, 1 to 1000.
    #[schemars(range(min = 1, max = 1000), example = 2)]
    pub(crate) order: super::Count,
    /// Phase, rad.
    #[serde(default = "no_angle")]
    #[schemars(example = &"90 deg")]
    pub(crate) phase: Angle,
}

/// Table: `points`, or `file` with the names of its columns.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = points_or_file)]
pub(crate) struct TableForm {
    /// Pairs of time and value, at least two, times rising; two equal times are a jump; this or `file`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2), example = json!([[0, 0], ["1 ms", "200 nm"], ["2 ms", 0]]))]
    pub(crate) points: Option<Vec<Point>>,
    /// CSV file with a header, at or below the scenario's own folder; numbers in SI, or in the unit that the head of their
    /// column names, as in `disp (µm)`, `t [ms]`, `disp_um` and `time/ms`; this or `points`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"measured.csv")]
    pub(crate) file: Option<String>,
    /// Name of the column of times, s or the unit in its head, which the name may leave out; needed with `file`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"time_s")]
    pub(crate) time: Option<String>,
    /// Name of the column of values, SI or the unit in its head, which the name may leave out; needed with `file`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"stroke_m")]
    pub(crate) value: Option<String>,
    /// Delay, s, at least 0: added to all times.
    #[serde(default = "no_time")]
    #[schemars(example = &"1 ms", transform = at_least_zero)]
    pub(crate) delay: Time,
}

/// A point of a table.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Point(pub(crate) Time, pub(crate) AnyQuantity);

impl<'de> Deserialize<'de> for Point {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PointVisitor;
        impl<'de> Visitor<'de> for PointVisitor {
            type Value = Point;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a pair [time, value]")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Point, A::Error> {
                let short = |length| de::Error::invalid_length(length, &self);
                let time = seq.next_element()?.ok_or_else(|| short(0))?;
                let value = seq.next_element()?.ok_or_else(|| short(1))?;
                if seq.next_element::<de::IgnoredAny>()?.is_some() {
                    return Err(short(3));
                }
                Ok(Point(time, value))
            }
        }
        deserializer.deserialize_tuple(2, PointVisitor)
    }
}

impl JsonSchema for Point {
    fn schema_name() -> Cow<'static, str> {
        "Point".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Time and value.",
            "examples": [["1 ms", "200 nm"]],
            "type": "array",
            "prefixItems": [generator.subschema_for::<Time>(), generator.subschema_for::<AnyQuantity>()],
            "minItems": 2,
            "maxItems": 2
        })
    }
}

fn no_angle() -> Angle {
    Angle::new(0.0)
}

fn no_time() -> Time {
    Time::new(0.0)
}

fn no_value() -> AnyQuantity {
    AnyQuantity { si: 0.0, kind: None }
}
