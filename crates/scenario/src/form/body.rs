//! Bodies.

use super::{Reserved, WaveformRef};
use crate::quantity::{Length, Mass, Velocity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A rigid body. Its coordinates are displacements from the position drawn.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyForm {
    /// Mass, kg, above 0; needed where a coordinate is free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) mass: Option<Mass>,
    /// Moment of inertia about the reference point, kg m². Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) inertia: Option<Reserved>,
    /// The coordinate along the slide.
    #[serde(default)]
    pub(crate) x: FreedomForm,
    /// The coordinate normal to the slide, up. Only "fixed" in this version.
    #[serde(default, skip_serializing_if = "FreedomForm::is_fixed")]
    pub(crate) z: FreedomForm,
    /// The small angle of rotation, positive from x towards z. Only "fixed" in this version.
    #[serde(default, skip_serializing_if = "FreedomForm::is_fixed")]
    pub(crate) pitch: FreedomForm,
    /// Where the body is at t = 0, and how fast.
    #[serde(default, skip_serializing_if = "Option::is_none")]
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
    /// Follows a waveform of lengths.
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
    /// Position x, m, as a displacement from the position drawn; not for a coordinate that follows a waveform.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) x: Option<Length>,
    /// Velocity along x, m/s; for a free coordinate only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
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
