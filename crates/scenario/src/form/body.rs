//! Bodies.

use super::WaveformRef;
use crate::quantity::{Angle, AngularVelocity, Inertia, Length, Mass, Velocity};
use crate::schema::{above_zero, inertia_where_free};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// A rigid body in the plane. Its coordinates are displacements from the reference position.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = inertia_where_free)]
pub(crate) struct BodyForm {
    /// Mass, kg, above 0; needed where x or z is free; typical 1 g to 1 kg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 g", transform = above_zero)]
    pub(crate) mass: Option<Mass>,
    /// Moment of inertia about the reference point, the centre of mass, kg m², above 0; needed where pitch is free. A
    /// solid ball of radius R has 2/5 m R², a block of length l and height h m (l² + h²)/12.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"250 g mm^2", transform = above_zero)]
    pub(crate) inertia: Option<Inertia>,
    /// The coordinate along the slide: "fixed", "free", "balanced", or one that follows a waveform of lengths.
    #[serde(default)]
    #[schemars(example = &"free", example = json!({ "follows": "drive" }))]
    pub(crate) x: FreedomForm,
    /// The coordinate normal to the slide, up: "fixed" by default, "free", "balanced", or one that follows a waveform of
    /// lengths. While it is fixed, its guide carries weight and loads.
    #[serde(default, skip_serializing_if = "FreedomForm::is_fixed")]
    #[schemars(example = &"free", example = json!({ "follows": "lift" }))]
    pub(crate) z: FreedomForm,
    /// The small angle θ of rotation, positive from x towards z: "fixed" by default, "free", or one that follows a waveform of
    /// angles. A point at (X, Z) from the reference point moves by -Zθ along x and by Xθ along z.
    #[serde(default, skip_serializing_if = "FreedomForm::is_fixed")]
    #[schemars(example = &"free", example = json!({ "follows": "rock" }))]
    pub(crate) pitch: FreedomForm,
    /// Where the body is at t = 0, and how fast; by default at rest in the reference position.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "z": "20 um", "vx": "2 mm/s" }))]
    pub(crate) start: Option<BodyStartForm>,
}

/// What a coordinate does: "fixed", "free", "balanced", or {"follows": waveform}.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum FreedomForm {
    /// Stays where it is.
    #[default]
    Fixed,
    /// Obeys Newton; needs a mass, a pitch a moment of inertia.
    Free,
    /// Force control without mass: x or z is where loads, springs and contacts balance at every moment. What acts at t = 0
    /// moves it there from where it is drawn. Takes no mass and no damping, and no other coordinate may be free.
    Balanced,
    /// Follows a waveform of lengths, m, a pitch one of angles, rad: its name, or one written out here.
    #[schemars(example = json!({ "follows": "drive" }))]
    Follows(WaveformRef),
}

impl FreedomForm {
    pub(crate) fn is_fixed(&self) -> bool {
        matches!(self, Self::Fixed)
    }
}

/// Where a body is at t = 0, and how fast.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyStartForm {
    /// Position x, m, as a displacement from the reference position, 0 by default; not allowed if x follows a waveform.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"1 um")]
    pub(crate) x: Option<Length>,
    /// Velocity along x, m/s, 0 by default; only where x is free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"2 mm/s")]
    pub(crate) vx: Option<Velocity>,
    /// Position z, m, as a displacement from the reference position, 0 by default; not allowed if z follows a waveform.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"20 um")]
    pub(crate) z: Option<Length>,
    /// Velocity along z, m/s, 0 by default; only where z is free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"-2 mm/s")]
    pub(crate) vz: Option<Velocity>,
    /// Angle, rad, 0 by default; only where pitch is free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"0.1 mrad")]
    pub(crate) pitch: Option<Angle>,
    /// Angular velocity, rad/s, 0 by default; only where pitch is free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"3 rad/s")]
    pub(crate) vpitch: Option<AngularVelocity>,
}
