//! Materials.

use crate::quantity::Pressure;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A linear elastic, isotropic material.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MaterialForm {
    /// Young's modulus E, Pa, above 0.
    pub(crate) youngs_modulus: Pressure,
    /// Poisson's ratio ν, above -1 and up to 0.5.
    #[schemars(range(max = 0.5), extend("exclusiveMinimum" = -1))]
    pub(crate) poisson_ratio: f64,
}
