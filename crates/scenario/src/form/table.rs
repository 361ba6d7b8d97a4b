//! Keys of waveforms given by points, in the scenario itself or in a file.

use super::periodic::{is_false, no_time, no_value};
use crate::quantity::{AnyQuantity, Time};
use crate::schema::{above_zero, at_least_zero, points_or_file};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::json;
use std::borrow::Cow;
use std::fmt;

/// Interpolation between the points of a table.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum JoinForm {
    /// Linear interpolation.
    #[default]
    Straight,
    /// Cubic interpolation that preserves the shape of the points (Fritsch and Butland 1984). At a point only the second derivative jumps.
    Cubic,
}

/// Table of times and values, given by `points`, or by `file` with the names of its columns.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = points_or_file)]
pub(crate) struct TableForm {
    /// Pairs of time and value, at least two, in the order of time; two equal times are a jump; give either this or `file`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2), example = json!([[0, 0], ["1 ms", "200 nm"], ["2 ms", 0]]))]
    pub(crate) points: Option<Vec<Point>>,
    /// Table of an instrument, or CSV file with a header line, in the scenario's own folder or below it; give either this or `points`. Numbers are in SI, or in the
    /// unit of their column head, as in `disp (µm)`, `t [ms]`, `disp_um` and `time/ms`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"measured.csv")]
    pub(crate) file: Option<String>,
    /// Name of the column of times, with or without the unit in its head; required with `file` unless there is a `recipe`. Times are in s unless the head has a unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"time_s")]
    pub(crate) time: Option<String>,
    /// Name of the column of values, with or without the unit in its head; required with `file` unless there is a `recipe`. Values are in SI unless the head has a
    /// unit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"stroke_m")]
    pub(crate) value: Option<String>,
    /// How the file is read: a recipe of `stickslip import`, or its path; by default the file is read as `stickslip import` shows it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"scope-recipe.json")]
    pub(crate) recipe: Option<RecipeForm>,
    /// Time window, s, above 0, in which a measured motion is a parabola: the noise of the values is removed by least squares; by default
    /// the values are used as they are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"20 ms", transform = above_zero)]
    pub(crate) smooth: Option<Time>,
    /// Interpolation between the points: "straight" by default, or "cubic", which is smooth and without overshoot.
    #[serde(default, skip_serializing_if = "is_straight")]
    #[schemars(example = &"cubic")]
    pub(crate) interpolation: JoinForm,
    /// Factor by which all values are multiplied, of any sign but not 0; 1 by default.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    #[schemars(example = 0.5, extend("not" = json!({ "const": 0 }), "default" = 1.0))]
    pub(crate) gain: f64,
    /// Offset added to all values after the gain, in the unit of the driven quantity; 0 by default.
    #[serde(default = "no_value")]
    #[schemars(example = &"100 nm")]
    pub(crate) offset: AnyQuantity,
    /// Whether the table is repeated periodically; by default the table runs once. The period is the time from the first to the last point.
    #[serde(default, skip_serializing_if = "is_false")]
    #[schemars(example = true)]
    pub(crate) repeat: bool,
    /// Delay, s, at least 0, which is added to all times.
    #[serde(default = "no_time")]
    #[schemars(example = &"1 ms", transform = at_least_zero)]
    pub(crate) delay: Time,
}

/// How a file is read.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub(crate) enum RecipeForm {
    /// Path of a recipe that `stickslip import` wrote, in the scenario's own folder or below it.
    File(String),
    /// The recipe itself; `stickslip schema recipe` prints its keys.
    Own(serde_json::Map<String, serde_json::Value>),
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

fn one() -> f64 {
    1.0
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks so")]
fn is_one(value: &f64) -> bool {
    *value == 1.0
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks so")]
fn is_straight(join: &JoinForm) -> bool {
    *join == JoinForm::Straight
}
