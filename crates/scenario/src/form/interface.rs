//! What another program sees of a scenario.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// Inputs, outputs and parameters for a program that runs the scenario as a part of its own model, such as the host of an FMU.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct InterfaceForm {
    /// Names of waveforms of kind `input` or `generator` that the host sets; by default all of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["drive"]))]
    pub(crate) inputs: Option<Vec<String>>,
    /// Names of columns of `trace.csv` that the host reads; by default all of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["slider.x_m", "ball.fx_N"]))]
    pub(crate) outputs: Option<Vec<String>>,
    /// Key paths of numbers that the host may set before the start; none by default.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(example = json!(["contacts.ball.friction", "bodies.slider.mass"]))]
    pub(crate) parameters: Vec<String>,
}

impl InterfaceForm {
    pub(crate) fn is_empty(&self) -> bool {
        self.inputs.is_none() && self.outputs.is_none() && self.parameters.is_empty()
    }
}
