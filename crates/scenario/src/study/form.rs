//! Types that mirror the keys of a study file. Their doc comments become the descriptions of the schema.

use crate::form::{Count, Parts};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Value, json};
use std::borrow::Cow;
use std::fmt;

/// Study: many runs of one scenario that differ in the numbers named in `vary`. Each run is a case, and each case is a row of the result.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "stickslip study, version 1")]
pub(crate) struct StudyForm {
    /// Address of the JSON Schema for editors; nothing by default. The program ignores it.
    #[serde(rename = "$schema", default)]
    #[schemars(example = &"../schema/study-1.json")]
    #[expect(dead_code, reason = "the key is allowed but ignored")]
    pub(super) schema: Option<String>,
    /// Version of the study format.
    #[schemars(extend("const" = 1), example = 1)]
    pub(super) stickslip_study: Count,
    /// Scenario that is run: the path of its file, relative to the study file, or the scenario itself.
    #[schemars(example = &"p1.json")]
    pub(super) scenario: SubjectForm,
    /// Values of the scenario that are the same in all cases and differ from its file, by key path; none by default.
    #[serde(default)]
    #[schemars(example = json!({ "run.stepper.event.tolerance": 1e-6 }), transform = by_paths)]
    pub(super) set: Parts<Value>,
    /// Number of samples of the distributions at each point of the product of the grids. Left out where no distribution is named.
    #[serde(default)]
    #[schemars(extend("minimum" = 1), example = 1024)]
    pub(super) cases: Option<Count>,
    /// Seed of the samples, 1 by default: another seed draws other numbers.
    #[serde(default)]
    #[schemars(example = 1)]
    pub(super) seed: Option<Count>,
    /// How the samples of the distributions are drawn: `sobol` by default; `product` where no distribution is named.
    #[serde(default)]
    #[schemars(example = &"sobol")]
    pub(super) sampling: Option<Sampling>,
    /// Numbers that vary, by their key path in the scenario, such as `contacts.ball.friction` or `run.duration`. Values are numbers in SI
    /// or texts with a unit.
    #[serde(default)]
    #[schemars(example = json!({ "contacts.ball.friction": { "uniform": [0.1, 0.2] } }), transform = by_paths)]
    pub(super) vary: Parts<VariationForm>,
    /// Results of each case: paths of `summary.json`, such as `steps.last_m`, or channels of `trace.csv` at the end of the run, such as
    /// `slider.x_m`.
    #[serde(default)]
    #[schemars(example = json!(["slider.x_m", "steps.last_m"]), extend("minItems" = 1))]
    pub(super) results: Vec<String>,
    /// Number of cases in one part of the result, 1000 by default: what is computed, written and taken up again as a whole.
    #[serde(default)]
    #[schemars(extend("minimum" = 1), example = 10_000)]
    pub(super) chunk: Option<Count>,
    /// Result of which `stickslip study optimise` finds the maximum; named as in `results`. The file then has `over` or `waveform`, and
    /// no `vary`, `results`, `cases`, `sampling` and `chunk`.
    #[serde(default)]
    #[schemars(example = &"steady_motion.speed_m_s")]
    pub(super) maximise: Option<String>,
    /// Result of which the minimum is found; give either this or `maximise`.
    #[serde(default)]
    #[schemars(example = &"steps.steady.back_step")]
    pub(super) minimise: Option<String>,
    /// Numbers over which the optimum is searched, at most six, by their key path: least and largest value.
    #[serde(default)]
    #[schemars(example = json!({ "waveforms.drive.sawtooth.flyback": ["5 us", "0.5 ms"] }), transform = by_paths)]
    pub(super) over: Parts<[Amount; 2]>,
    /// Waveform over whose shape the optimum is searched.
    #[serde(default)]
    pub(super) waveform: Option<ShapeForm>,
    /// Number of local searches, 1 to 64, 8 by default. Each begins at another of the best of four times as many Sobol points.
    #[serde(default)]
    #[schemars(extend("minimum" = 1, "maximum" = 64), example = 8)]
    pub(super) starts: Option<Count>,
    /// Most evaluations of a local search; by default 40 (n + 1) for n numbers.
    #[serde(default)]
    #[schemars(extend("minimum" = 1, "maximum" = 100_000), example = 200)]
    pub(super) evaluations: Option<Count>,
    /// Whether a result is judged by its worst value at the period, at 0.99 and at 1.01 times the period of all waveforms. True by
    /// default if a named waveform has a period.
    #[serde(default)]
    #[schemars(example = true)]
    pub(super) worst_of_period: Option<bool>,
}

/// Shape of a waveform that is searched: corners or harmonics within the limits of a driver.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ShapeForm {
    /// Key path of the waveform.
    #[schemars(example = &"waveforms.drive")]
    pub(super) path: String,
    /// Number of corners of a polygon at equal distances in time, 3 to 24; give either this or `harmonics`.
    #[serde(default)]
    #[schemars(extend("minimum" = 3, "maximum" = 24), example = 12)]
    pub(super) corners: Option<Count>,
    /// Number of harmonics, 2 to 24; give either this or `corners`.
    #[serde(default)]
    #[schemars(extend("minimum" = 2, "maximum" = 24), example = 3)]
    pub(super) harmonics: Option<Count>,
    /// Least and largest period, s; that of the waveform by default.
    #[serde(default)]
    #[schemars(example = json!(["0.5 ms", "1 ms"]))]
    pub(super) period: Option<[Amount; 2]>,
    /// Least and largest value; the window of the driver by default.
    #[serde(default)]
    #[schemars(example = json!(["0 V", "120 V"]))]
    pub(super) window: Option<[Amount; 2]>,
    /// Largest current, A; that of the driver by default. It limits the rate of the voltage to current/capacitance.
    #[serde(default)]
    #[schemars(example = &"2 A")]
    pub(super) current: Option<Amount>,
    /// Bandwidth, Hz; that of the driver by default. No harmonic lies above it, and the time between two corners is at least half of
    /// its period.
    #[serde(default)]
    #[schemars(example = &"10 kHz")]
    pub(super) bandwidth: Option<Amount>,
}

/// Keys are paths, not names of parts.
fn by_paths(schema: &mut Schema) {
    schema.remove("propertyNames");
}

/// How samples are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Sampling {
    /// Pseudo-random numbers.
    Random,
    /// Points of the Sobol sequence with a digital shift by the seed.
    Sobol,
    /// A Latin hypercube: each of as many strata as there are cases has one sample.
    LatinHypercube,
    /// Samples for sensitivity indices by Saltelli's scheme: k + 2 runs for each of the cases, with k distributions.
    Saltelli,
    /// No samples: all combinations of grids and lists.
    Product,
}

/// How a number varies.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum VariationForm {
    /// Equally spaced values: first, last and their number.
    #[schemars(example = json!({ "grid": ["0.4 um", "0.6 um", 11] }))]
    Grid((Amount, Amount, Count)),
    /// Values in equal ratios: first, last and their number.
    #[schemars(example = json!({ "log": ["1 mN", "1 N", 31] }))]
    Log((Amount, Amount, Count)),
    /// These values.
    #[schemars(example = json!({ "list": [0.1, 0.15, 0.3] }))]
    List(Vec<Amount>),
    /// Uniform distribution: lower and upper bound.
    #[schemars(example = json!({ "uniform": [0.1, 0.2] }))]
    Uniform([Amount; 2]),
    /// Normal distribution: mean and standard deviation; with a lower and an upper bound the truncated normal distribution.
    #[schemars(example = json!({ "normal": ["20 g", "1 g"] }))]
    Normal(Normal),
    /// Lognormal distribution: median and geometric standard deviation, a factor above 1.
    #[schemars(example = json!({ "lognormal": ["1 N", 1.2] }))]
    Lognormal((Amount, f64)),
    /// Triangular distribution: lower bound, mode and upper bound.
    #[schemars(example = json!({ "triangular": [0.1, 0.12, 0.2] }))]
    Triangular([Amount; 3]),
}

/// Mean and standard deviation, or these and two bounds.
#[derive(Debug, Clone)]
pub(crate) struct Normal(pub(super) Vec<Amount>);

impl<'de> Deserialize<'de> for Normal {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let all = Vec::<Amount>::deserialize(deserializer)?;
        if matches!(all.len(), 2 | 4) {
            return Ok(Self(all));
        }
        let wanted = "mean and standard deviation, or these and a lower and an upper bound";
        Err(de::Error::custom(format!("expected {wanted}, got {} entries", all.len())))
    }
}

impl JsonSchema for Normal {
    fn schema_name() -> Cow<'static, str> {
        "Normal".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let amount = generator.subschema_for::<Amount>();
        let list = |n: usize| json!({ "type": "array", "items": amount, "minItems": n, "maxItems": n });
        json_schema!({ "anyOf": [list(2), list(4)] })
    }
}

/// A number, or a text with a unit.
#[derive(Debug, Clone)]
pub(crate) enum Amount {
    Number(f64),
    Text(String),
}

impl<'de> Deserialize<'de> for Amount {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AmountVisitor;
        impl Visitor<'_> for AmountVisitor {
            type Value = Amount;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number in SI or a text with a unit")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Amount, E> {
                Ok(Amount::Number(value))
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Amount, E> {
                Ok(Amount::Number(value as f64))
            }

            fn visit_u64<E: de::Error>(self, value: u64) -> Result<Amount, E> {
                Ok(Amount::Number(value as f64))
            }

            fn visit_str<E: de::Error>(self, value: &str) -> Result<Amount, E> {
                Ok(Amount::Text(value.to_owned()))
            }
        }
        deserializer.deserialize_any(AmountVisitor)
    }
}

impl JsonSchema for Amount {
    fn schema_name() -> Cow<'static, str> {
        "Amount".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "description": "A number in SI, or a text with a unit such as \"5 um\".", "type": ["number", "string"] })
    }
}

/// A scenario, or the path of its file.
#[derive(Debug, Clone)]
pub(crate) enum SubjectForm {
    Path(String),
    Inline(Value),
}

impl<'de> Deserialize<'de> for SubjectForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Value::deserialize(deserializer)? {
            Value::String(path) => Ok(Self::Path(path)),
            inline @ Value::Object(_) => Ok(Self::Inline(inline)),
            _ => Err(de::Error::custom("expected the path of a scenario file or a scenario")),
        }
    }
}

impl JsonSchema for SubjectForm {
    fn schema_name() -> Cow<'static, str> {
        "Subject".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": ["string", "object"] })
    }
}
