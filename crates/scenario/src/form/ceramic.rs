//! Hysteresis and creep of a stack.

use super::Count;
use crate::quantity::{Length, Time};
use crate::schema::above_zero;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// Hysteresis between the stroke that is asked for and the one that a stack makes, independent of the rate; input and output are free strokes, m. It acts on the stroke only, without feedback on the voltage, and has no part in the energy balance: see docs/piezo_material.md.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum HysteresisForm {
    /// Prandtl–Ishlinskii from one number, the width of the loop.
    #[schemars(example = json!({ "loop": { "percent": 12 } }))]
    Loop(LoopForm),
    /// Prandtl–Ishlinskii by its plays.
    #[schemars(example = json!({ "plays": { "direct": 0.8, "thresholds": ["0.2 um", "0.6 um"], "weights": [0.2, 0.2] } }))]
    Plays(PlaysForm),
    /// Bouc–Wen: the stroke less a part z that is kept back, dz/ds = A[1 ∓ |z/z_m|ⁿ] as z grows or goes back.
    #[schemars(example = json!({ "bouc_wen": { "slope": 0.3, "limit": "0.3 um" } }))]
    BoucWen(BoucWenForm),
}

/// A loop by its width.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LoopForm {
    /// Greatest width of the loop in per cent of its stroke, above 0 and below 50; typical 8 to 15.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 50), example = 12)]
    pub(crate) percent: f64,
    /// Stroke, peak to peak, at which it is that wide, m, above 0; smaller loops are narrower in proportion. By default that of
    /// `data_sheet`, else the one that is commanded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"4.6 um", transform = above_zero)]
    pub(crate) stroke: Option<Length>,
    /// Number of plays, 1 to 64: corners of a branch.
    #[serde(default = "ten")]
    #[schemars(range(min = 1, max = 64), example = 10)]
    pub(crate) operators: Count,
}

fn ten() -> Count {
    Count(10)
}

/// s = w₀ v + Σ wᵢ pᵢ with plays |v - pᵢ| ≤ rᵢ.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlaysForm {
    /// Weight w₀ of the input itself, above 0; typical 0.7 to 1.
    #[schemars(extend("exclusiveMinimum" = 0), example = 0.8)]
    pub(crate) direct: f64,
    /// Thresholds rᵢ, m, ascending from above 0; at most 64.
    #[schemars(transform = above_zero, extend("maxItems" = 64), example = json!(["0.2 um", "0.6 um"]))]
    pub(crate) thresholds: Vec<Length>,
    /// Weights wᵢ, as many; w₀ + w₁ + … stays above 0 after each.
    #[schemars(extend("maxItems" = 64), example = json!([0.2, 0.2]))]
    pub(crate) weights: Vec<f64>,
}

/// z' = A v' - β|v'||z|ⁿ⁻¹z - γ v'|z|ⁿ, A/(β + γ) = z_mⁿ.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoucWenForm {
    /// Part A of a small motion that is kept back, above 0 and below 1/(2 `share`); typical 0.1 to 0.4.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1), example = 0.3)]
    pub(crate) slope: f64,
    /// z_m: the most that is kept back, m, above 0; typical a twentieth of the stroke.
    #[schemars(example = &"0.3 um", transform = above_zero)]
    pub(crate) limit: Length,
    /// β/(β + γ), 0.5 to 1: how much faster z goes back than it grows.
    #[serde(default = "half")]
    #[schemars(extend("minimum" = 0.5, "maximum" = 1), example = 0.5)]
    pub(crate) share: f64,
    /// n, 1 to 16: how sharp the knee is.
    #[serde(default = "one")]
    #[schemars(extend("minimum" = 1, "maximum" = 16), example = 1)]
    pub(crate) exponent: f64,
}

fn half() -> f64 {
    0.5
}

fn one() -> f64 {
    1.0
}

/// Creep: after a step the stroke continues as L₁[1 + γ lg(t/t₀)], as a sum of exponentials over some decades.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CreepForm {
    /// γ: relative stroke added per decade of time, above 0 and below 0.5; typical 0.01 to 0.02.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 0.5), example = 0.015)]
    pub(crate) per_decade: f64,
    /// t₀, s, above 0: when after a step the stroke is the nominal one; 0.1 s by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"0.1 s", transform = above_zero)]
    pub(crate) from: Option<Time>,
    /// Decades of time from t₀ on over which the logarithm holds, 1 to 6; beyond, it settles.
    #[serde(default = "five")]
    #[schemars(range(min = 1, max = 6), example = 5)]
    pub(crate) decades: Count,
}

fn five() -> Count {
    Count(5)
}
