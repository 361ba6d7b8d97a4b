//! Profiles with a border, and sums of powers.

use crate::quantity::Length;
use crate::schema::above_zero;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// A worn cone, whose tip is a flat.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TruncatedConeForm {
    /// Radius of the flat, m, above 0; typical 1 um to 100 um.
    #[schemars(example = &"20 um", transform = above_zero)]
    pub(crate) flat: Length,
    /// Slope of the flank against the plane, tan θ, above 0; typical 0.001 to 0.1.
    #[schemars(extend("exclusiveMinimum" = 0), example = 0.01)]
    pub(crate) slope: f64,
}

/// A worn ball, whose lowest part is a flat.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TruncatedParaboloidForm {
    /// Radius of the flat, m, above 0; typical 1 um to 100 um.
    #[schemars(example = &"20 um", transform = above_zero)]
    pub(crate) flat: Length,
    /// Radius of curvature R of the ball, m, above 0; typical 0.1 mm to 50 mm.
    #[schemars(example = &"5 mm", transform = above_zero)]
    pub(crate) radius: Length,
}

/// A flat punch with a rounded edge.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RoundedFlatForm {
    /// Radius of the flat, m, above 0; typical 10 um to 5 mm.
    #[schemars(example = &"50 um", transform = above_zero)]
    pub(crate) flat: Length,
    /// Radius of curvature R of the edge, m, above 0; typical 10 um to 10 mm.
    #[schemars(example = &"1 mm", transform = above_zero)]
    pub(crate) radius: Length,
}

/// A paraboloid with a conical tip.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TippedParaboloidForm {
    /// Radius of curvature R of the paraboloid, m, above 0; typical 0.1 mm to 50 mm.
    #[schemars(example = &"5 mm", transform = above_zero)]
    pub(crate) radius: Length,
    /// Radius of the conical tip, m, above 0; typical 1 um to 50 um. The cone has the slope tip/R and joins the paraboloid smoothly.
    #[schemars(example = &"5 um", transform = above_zero)]
    pub(crate) tip: Length,
}

/// A sum of powers of the radius r.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PowersForm {
    /// Terms A rⁿ of the sum, at least one of them above 0.
    #[schemars(length(min = 1), example = json!([{ "coefficient": 100, "exponent": 2 }, { "coefficient": 1e9, "exponent": 4 }]))]
    pub(crate) terms: Vec<TermForm>,
}

/// A term of a sum of powers.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TermForm {
    /// Coefficient A of A rⁿ in SI, m^(1-n), at least 0.
    #[schemars(range(min = 0.0), example = 100)]
    pub(crate) coefficient: f64,
    /// Exponent n of A rⁿ, any number above 0.
    #[schemars(extend("exclusiveMinimum" = 0), example = 2)]
    pub(crate) exponent: f64,
}
