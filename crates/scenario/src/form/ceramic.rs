//! Hysteresis and creep of a stack.

use super::Count;
use crate::quantity::{Length, Time};
use crate::schema::above_zero;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// Rate-independent hysteresis of the free stroke: the input v is the stroke without hysteresis, m; the output is the actual stroke, m. The
/// hysteresis has no effect on the voltage or on the energy balance: see docs/how/hysteresis.md.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum HysteresisForm {
    /// Loop: the Prandtl–Ishlinskii model, given by the width of its hysteresis loop.
    #[schemars(example = json!({ "loop": { "percent": 12 } }))]
    Loop(LoopForm),
    /// Plays: the Prandtl–Ishlinskii model, given by the thresholds and weights of its play operators.
    #[schemars(example = json!({ "plays": { "direct": 0.8, "thresholds": ["0.2 um", "0.6 um"], "weights": [0.2, 0.2] } }))]
    Plays(PlaysForm),
    /// Bouc–Wen model: the output is the input v less a hysteretic part z. While |z| grows, dz/dv = A(1 - |z/z_m|ⁿ). While |z| decreases,
    /// dz/dv = A(1 + (2 `share` - 1)|z/z_m|ⁿ).
    #[schemars(example = json!({ "bouc_wen": { "slope": 0.3, "limit": "0.3 um" } }))]
    BoucWen(BoucWenForm),
}

/// Hysteresis loop given by its width.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LoopForm {
    /// Greatest width of the hysteresis loop in per cent of the peak-to-peak stroke, above 0 and below 50; typical 8 to 15.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 50), example = 12)]
    pub(crate) percent: f64,
    /// Peak-to-peak stroke at which the loop has the width `percent`, m, above 0; by default the stroke of `data_sheet`, or the commanded
    /// stroke if there is no data sheet. The relative width of smaller loops decreases about in proportion to their stroke.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"4.6 um", transform = above_zero)]
    pub(crate) stroke: Option<Length>,
    /// Number of play operators, 1 to 64; 10 by default. Each operator adds a corner to each branch of the loop.
    #[serde(default = "ten")]
    #[schemars(range(min = 1, max = 64), example = 10)]
    pub(crate) operators: Count,
}

fn ten() -> Count {
    Count(10)
}

/// Prandtl–Ishlinskii model s = w₀ v + Σ wᵢ pᵢ of the input v, with play operators |v - pᵢ| ≤ rᵢ.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlaysForm {
    /// Weight w₀ of the input itself, above 0; typical 0.7 to 1.
    #[schemars(extend("exclusiveMinimum" = 0), example = 0.8)]
    pub(crate) direct: f64,
    /// Thresholds rᵢ of the play operators, m, ascending from above 0; at most 64.
    #[schemars(transform = above_zero, extend("maxItems" = 64), example = json!(["0.2 um", "0.6 um"]))]
    pub(crate) thresholds: Vec<Length>,
    /// Weights wᵢ of the play operators, one for each threshold. Every partial sum w₀ + w₁ + … + wᵢ is above 0.
    #[schemars(extend("maxItems" = 64), example = json!([0.2, 0.2]))]
    pub(crate) weights: Vec<f64>,
}

/// Bouc–Wen model z' = A v' - β|v'||z|ⁿ⁻¹z - γ v'|z|ⁿ of the hysteretic part z, with A/(β + γ) = z_mⁿ.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoucWenForm {
    /// Slope A = dz/dv at z = 0, above 0 and below 1/(2 `share`); typical 0.1 to 0.4. A is the fraction by which hysteresis reduces the
    /// stroke of a small motion.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1), example = 0.3)]
    pub(crate) slope: f64,
    /// Limit z_m of the hysteretic part z, m, above 0; typical a twentieth of the stroke.
    #[schemars(example = &"0.3 um", transform = above_zero)]
    pub(crate) limit: Length,
    /// Ratio β/(β + γ), 0.5 to 1; 0.5 by default. With a larger ratio, |z| decreases faster after a reversal.
    #[serde(default = "half")]
    #[schemars(extend("minimum" = 0.5, "maximum" = 1), example = 0.5)]
    pub(crate) share: f64,
    /// Exponent n, 1 to 16; 1 by default. With a larger exponent, the knee at which z reaches the limit z_m is sharper.
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

/// Logarithmic creep: after a step of the command, the stroke grows as L₁[1 + γ lg(t/t₀)]. A sum of exponentials represents this law over a
/// number of decades.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CreepForm {
    /// Creep factor γ, the relative stroke added per decade of time, above 0 and below 0.5; typical 0.01 to 0.02.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 0.5), example = 0.015)]
    pub(crate) per_decade: f64,
    /// Reference time t₀ after a step of the command, s, above 0; 0.1 s by default. At this time the stroke has its nominal value L₁.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"0.1 s", transform = above_zero)]
    pub(crate) from: Option<Time>,
    /// Number of decades of time after t₀ in which creep is logarithmic, 1 to 6; 5 by default. After these decades the stroke settles.
    #[serde(default = "five")]
    #[schemars(range(min = 1, max = 6), example = 5)]
    pub(crate) decades: Count,
}

fn five() -> Count {
    Count(5)
}
