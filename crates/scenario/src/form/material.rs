//! Materials.

use crate::quantity::Pressure;
use crate::schema::above_zero;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A linear elastic, isotropic material.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MaterialForm {
    /// Young's modulus E, Pa, above 0; typical 1 GPa to 1000 GPa, steel 210 GPa.
    #[schemars(example = &"210 GPa", transform = above_zero)]
    pub(crate) youngs_modulus: Pressure,
    /// Poisson's ratio ν, above -1 and up to 0.5; typical 0.2 to 0.35, rubber 0.5.
    #[schemars(range(max = 0.5), extend("exclusiveMinimum" = -1), example = 0.3)]
    pub(crate) poisson_ratio: f64,
}
