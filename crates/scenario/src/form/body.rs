//! Bodies.

use super::{Reserved, WaveformRef};
use crate::quantity::{Length, Mass, Velocity};
use crate::schema::{above_zero, mass_where_free};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// A rigid body. Its coordinates are displacements from the position drawn.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = mass_where_free)]
pub(crate) struct BodyForm {
    /// Mass, kg, above 0; needed where x is free; typical 1 g to 1 kg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 g", transform = above_zero)]
    pub(crate) mass: Option<Mass>,
    /// Moment of inertia about the reference point, kg m². Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) inertia: Option<Reserved>,
    /// The coordinate along the slide: "fixed", "free", or one that follows a waveform of lengths.
    #[serde(default)]
    #[schemars(example = &"free", example = json!({ "follows": "drive" }))]
    pub(crate) x: FreedomForm,
    /// The coordinate normal to the slide, up. Only "fixed" in this version.
    #[serde(default, skip_serializing_if = "FreedomForm::is_fixed")]
    #[schemars(example = &"fixed", extend("const" = "fixed"))]
    pub(crate) z: FreedomForm,
    /// The small angle of rotation, positive from x towards z. Only "fixed" in this version.
    #[serde(default, skip_serializing_if = "FreedomForm::is_fixed")]
    #[schemars(example = &"fixed", extend("const" = "fixed"))]
    pub(crate) pitch: FreedomForm,
    /// Where the body is at t = 0, and how fast; by default at rest where it is drawn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "x": "1 um" }))]
    pub(crate) start: Option<BodyStartForm>,
}

/// What a coordinate does: "fixed", "free", or {"follows": waveform}.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum FreedomForm {
    /// Stays where it is.
    #[default]
    Fixed,
    /// Obeys Newton; needs a mass.
    Free,
    /// Follows a waveform of lengths, m: its name, or one written out here.
    #[schemars(example = json!({ "follows": "drive" }))]
    Follows(WaveformRef),
}

impl FreedomForm {
    pub(crate) fn is_fixed(&self) -> bool {
        matches!(self, Self::Fixed)
    }
}

/// Where a body is at t = 0, and how fast.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyStartForm {
    /// Position x, m, as a displacement from the position drawn, 0 by default; not where x follows a waveform.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"1 um")]
    pub(crate) x: Option<Length>,
    /// Velocity along x, m/s, 0 by default; only where x is free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"2 mm/s")]
    pub(crate) vx: Option<Velocity>,
    /// Position z, m. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) z: Option<Reserved>,
    /// Velocity along z, m/s. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) vz: Option<Reserved>,
    /// Angle, rad. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) pitch: Option<Reserved>,
    /// Angular velocity, rad/s. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) vpitch: Option<Reserved>,
}
