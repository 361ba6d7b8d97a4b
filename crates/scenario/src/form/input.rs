//! Keys of inputs: waveforms whose values a calling program supplies during the run.

use crate::quantity::AnyQuantity;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::json;
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

/// Input: values that a calling program supplies during the run.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct InputForm {
    /// Initial value, in the unit of the driven quantity; within the range. The input keeps the initial value until the calling program
    /// gives another value. `stickslip run` has no calling program and keeps the initial value throughout.
    #[schemars(example = &"0 nm")]
    pub(crate) initial: AnyQuantity,
    /// Smallest and largest value that a calling program may give, in the unit of the driven quantity. A value outside this range is
    /// refused. The checks before a run cover the whole range.
    #[schemars(example = json!(["-1 um", "1 um"]))]
    pub(crate) range: Bounds,
    /// Interpolation between supplied values: "held", the default, or "linear". A "held" input keeps each value until the next one, and
    /// then jumps. In a jump, contacts move instantaneously on a straight path, and the friction work of this motion counts. A damper whose
    /// end would jump is refused, because its force would be infinite. A "linear" input ramps to the supplied value at the supplied time.
    #[serde(default)]
    #[schemars(example = &"linear")]
    pub(crate) interpolation: InterpolationForm,
}

/// Interpolation of an input between supplied values.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum InterpolationForm {
    /// The value is held until the calling program gives another value; then the input jumps to the new value.
    #[default]
    Held,
    /// The calling program gives a target value and a target time. The input ramps linearly from the present value to the target value and
    /// never jumps.
    Linear,
}

/// Smallest and largest value.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Bounds<Q = AnyQuantity>(pub(crate) Q, pub(crate) Q);

impl<'de, Q: Deserialize<'de>> Deserialize<'de> for Bounds<Q> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct BoundsVisitor<Q>(PhantomData<Q>);
        impl<'de, Q: Deserialize<'de>> Visitor<'de> for BoundsVisitor<Q> {
            type Value = Bounds<Q>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a pair [smallest, largest]")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Bounds<Q>, A::Error> {
                let short = |length| de::Error::invalid_length(length, &self);
                let low = seq.next_element()?.ok_or_else(|| short(0))?;
                let high = seq.next_element()?.ok_or_else(|| short(1))?;
                let mut got = 2;
                while seq.next_element::<de::IgnoredAny>()?.is_some() {
                    got += 1;
                }
                if got > 2 { Err(short(got)) } else { Ok(Bounds(low, high)) }
            }
        }
        deserializer.deserialize_tuple(2, BoundsVisitor(PhantomData))
    }
}

impl<Q: JsonSchema> JsonSchema for Bounds<Q> {
    fn schema_name() -> Cow<'static, str> {
        "Bounds".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let value = generator.subschema_for::<Q>();
        json_schema!({ "type": "array", "prefixItems": [value, value], "minItems": 2, "maxItems": 2 })
    }
}
