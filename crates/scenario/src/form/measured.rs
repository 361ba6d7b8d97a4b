//! Keys of profiles given by points or heights, in the scenario itself or in a file.

use super::{Count, RecipeForm};
use crate::quantity::{Force, Length};
use crate::schema::{above_zero, gaps_or_file, heights_or_file, law_or_file};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::json;
use std::borrow::Cow;
use std::fmt;

/// Profile given by points of radius and gap.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = gaps_or_file)]
pub(crate) struct GapTableForm {
    /// Pairs of radius and gap, 2 to 4000: the first is [0, 0], radii increase, gaps do not decrease; give either this or `file`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2, max = 4000), example = json!([[0, 0], ["10 um", "5 nm"], ["20 um", "20 nm"]]))]
    pub(crate) points: Option<Vec<GapPoint>>,
    /// CSV file with a header line, in the scenario's own folder or below it; give either this or `points`. Each column head contains a
    /// unit, as in `f (nm)`, `r [um]`, `r_um` and `f/nm`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"worn.csv")]
    pub(crate) file: Option<String>,
    /// Name of the column of radii, with or without the unit in its head; required with `file` unless there is a `recipe`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"r")]
    pub(crate) radius: Option<String>,
    /// Name of the column of gaps, with or without the unit in its head; required with `file` unless there is a `recipe`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"f")]
    pub(crate) gap: Option<String>,
    /// How the file is read: a recipe of `stickslip import`, or its path; by default the file is read as `stickslip import` shows it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"line-recipe.json")]
    pub(crate) recipe: Option<RecipeForm>,
    /// Radii of the points at which the slope of the profile jumps, m, such as the edge of a flat; none by default. Between these kinks the
    /// profile is assumed to be smooth.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(example = json!(["20 um"]), transform = above_zero)]
    pub(crate) kinks: Vec<Length>,
}

/// Profile given by its normal law, force over indentation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = law_or_file)]
pub(crate) struct NormalLawForm {
    /// Pairs of indentation and normal force of one contact, at least two: the first is [0, 0], both increase, and the slope never
    /// decreases; give either this or `file`. Give the forces for the two materials of this contact.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 2), example = json!([[0, 0], ["50 nm", "20 mN"], ["100 nm", "60 mN"]]))]
    pub(crate) points: Option<Vec<LawPoint>>,
    /// CSV file with a header line, in the scenario's own folder or below it; give either this or `points`. Each column head contains a
    /// unit, as in `d (nm)` and `F_mN`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"indenter.csv")]
    pub(crate) file: Option<String>,
    /// Name of the column of indentations, with or without the unit in its head; required with `file` unless there is a `recipe`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"d")]
    pub(crate) indentation: Option<String>,
    /// Name of the column of forces, with or without the unit in its head; required with `file` unless there is a `recipe`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"F")]
    pub(crate) force: Option<String>,
    /// How the file is read: a recipe of `stickslip import`, or its path; by default the file is read as `stickslip import` shows it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"line-recipe.json")]
    pub(crate) recipe: Option<RecipeForm>,
}

/// Rough line: the height profile of the one-dimensional foundation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = heights_or_file)]
pub(crate) struct RoughForm {
    /// Heights at equal distances, m, positive outwards from the body, relative to any reference level; give this or `file` or
    /// `self_affine`. The highest point touches first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1), example = json!([0, "12 nm", "7 nm"]))]
    pub(crate) heights: Option<Vec<Length>>,
    /// CSV file with a header line, in the scenario's own folder or below it; give either this or `heights`. The column head contains a
    /// unit, as in `z (nm)`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"line.csv")]
    pub(crate) file: Option<String>,
    /// Name of the column of heights, with or without the unit in its head; required with `file` unless there is a `recipe`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"z")]
    pub(crate) height: Option<String>,
    /// How the file is read: a recipe of `stickslip import`, or its path; by default the file is read as `stickslip import` shows it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"line-recipe.json")]
    pub(crate) recipe: Option<RecipeForm>,
    /// Shape that is removed from the heights by least squares: none by default, or a straight line (levelling), or a parabola (the form
    /// of a ball or cylinder).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"line")]
    pub(crate) level: Option<LevelForm>,
    /// Places between which the line counts, m from its first point; by default all of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["10 um", "50 um"]))]
    pub(crate) within: Option<[Length; 2]>,
    /// Spacing of the heights, m, above 0; required with `heights`; with `file` by default the mean distance of its places. Typical 10 nm to 10 um.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"1 um", transform = above_zero)]
    pub(crate) spacing: Option<Length>,
    /// Self-affine line, computed from these parameters, identical on every machine; give either this or `heights`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "rms": "20 nm", "hurst": 0.8, "longest": "20 um", "shortest": "1 um", "length": "100 um", "points": 1024, "seed": 1 }))]
    pub(crate) self_affine: Option<SelfAffineForm>,
}

/// A shape that is removed from heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum LevelForm {
    /// A straight line.
    Line,
    /// A parabola.
    Parabola,
}

/// Self-affine rough line: a sum of cosines with wavelengths between two cut-offs and pseudo-random phases. The amplitude of the wavelength
/// λ is proportional to λ^(H + 1/2).
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SelfAffineForm {
    /// Root mean square of the heights, m, above 0; typical 1 nm to 1 um.
    #[schemars(example = &"20 nm", transform = above_zero)]
    pub(crate) rms: Length,
    /// The Hurst exponent H, 0 to 1; typical 0.8.
    #[schemars(range(min = 0.0, max = 1.0), example = 0.8)]
    pub(crate) hurst: f64,
    /// Longest wavelength, m, at most the length.
    #[schemars(example = &"20 um", transform = above_zero)]
    pub(crate) longest: Length,
    /// Shortest wavelength, m, at most the longest and at least twice the spacing of the points.
    #[schemars(example = &"1 um", transform = above_zero)]
    pub(crate) shortest: Length,
    /// Length of the line, m, above 0.
    #[schemars(example = &"100 um", transform = above_zero)]
    pub(crate) length: Length,
    /// Number of points, a power of two from 4 to 1 048 576.
    #[schemars(range(min = 4, max = 1_048_576), example = 1024)]
    pub(crate) points: Count,
    /// Seed of the pseudo-random phases, a whole number, 0 by default.
    #[serde(default = "no_seed")]
    #[schemars(example = 1)]
    pub(crate) seed: Count,
}

fn no_seed() -> Count {
    Count(0)
}

/// Defines the type of a pair of quantities, which the file gives as a list of two entries.
macro_rules! pair {
    ($(#[$doc:meta])* $name:ident($first:ty, $second:ty), $expected:literal, $described:literal, $example:expr) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, Serialize)]
        pub(crate) struct $name(pub(crate) $first, pub(crate) $second);

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct PairVisitor;
                impl<'de> Visitor<'de> for PairVisitor {
                    type Value = $name;

                    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                        f.write_str($expected)
                    }

                    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<$name, A::Error> {
                        let short = |length| de::Error::invalid_length(length, &self);
                        let first = seq.next_element()?.ok_or_else(|| short(0))?;
                        let second = seq.next_element()?.ok_or_else(|| short(1))?;
                        if seq.next_element::<de::IgnoredAny>()?.is_some() {
                            return Err(short(3));
                        }
                        Ok($name(first, second))
                    }
                }
                deserializer.deserialize_tuple(2, PairVisitor)
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                json_schema!({
                    "description": $described,
                    "examples": [$example],
                    "type": "array",
                    "prefixItems": [generator.subschema_for::<$first>(), generator.subschema_for::<$second>()],
                    "minItems": 2,
                    "maxItems": 2
                })
            }
        }
    };
}

pair! {
    /// A point of a profile.
    GapPoint(Length, Length), "a pair [radius, gap]", "Radius and gap.", json!(["10 um", "5 nm"])
}

pair! {
    /// A point of a normal law.
    LawPoint(Length, Force), "a pair [indentation, force]", "Indentation and normal force.", json!(["50 nm", "20 mN"])
}
