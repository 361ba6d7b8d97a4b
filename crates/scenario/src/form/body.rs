//! Bodies.

use super::WaveformRef;
use crate::quantity::{Angle, AngularVelocity, Inertia, Length, Mass, Velocity};
use crate::schema::{above_zero, inertia_where_free};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// A rigid body in the plane of the axes x, along the slide, and z, normal to the slide. The coordinates of a body are displacements from
/// the reference position.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = inertia_where_free)]
pub(crate) struct BodyForm {
    /// Mass, kg, above 0; needed where x or z is free; typical 1 g to 1 kg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"10 g", transform = above_zero)]
    pub(crate) mass: Option<Mass>,
    /// Moment of inertia about the reference point, the centre of mass, kg m², above 0; needed where pitch is free. A solid ball of radius
    /// R has 2/5 m R². A block of length l and height h has m (l² + h²)/12.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"250 g mm^2", transform = above_zero)]
    pub(crate) inertia: Option<Inertia>,
    /// Coordinate along the slide: "fixed" by default, "free", "balanced", or a coordinate that follows a waveform of lengths.
    #[serde(default)]
    #[schemars(example = &"free", example = json!({ "follows": "drive" }))]
    pub(crate) x: FreedomForm,
    /// Coordinate normal to the slide, upwards: "fixed" by default, "free", "balanced", or a coordinate that follows a waveform of lengths.
    /// If z is fixed, a guide carries weight and loads.
    #[serde(default, skip_serializing_if = "FreedomForm::is_fixed")]
    #[schemars(example = &"free", example = json!({ "follows": "lift" }))]
    pub(crate) z: FreedomForm,
    /// Small angle θ of rotation, positive from x towards z: "fixed" by default, "free", or an angle that follows a waveform of angles. A
    /// point at (X, Z) from the reference point moves by -Zθ along x and by Xθ along z.
    #[serde(default, skip_serializing_if = "FreedomForm::is_fixed")]
    #[schemars(example = &"free", example = json!({ "follows": "rock" }))]
    pub(crate) pitch: FreedomForm,
    /// Initial position and velocity of the body at t = 0; by default at rest in the reference position.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "z": "20 um", "vx": "2 mm/s" }))]
    pub(crate) start: Option<BodyStartForm>,
}

/// Type of motion of a coordinate: "fixed", "free", "balanced", or {"follows": waveform}.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum FreedomForm {
    /// The coordinate does not move.
    #[default]
    Fixed,
    /// The coordinate obeys Newton's second law; x and z need a mass, pitch needs a moment of inertia.
    Free,
    /// Force control without mass: at every moment, x or z has the value at which the forces of loads, springs and contacts balance. The
    /// forces at t = 0 move the body from the reference position to the balanced position. A balanced coordinate has no mass and no
    /// damping. If a coordinate is balanced, no coordinate of the scenario may be free.
    Balanced,
    /// The coordinate follows a waveform, given in m for x and z, in rad for pitch. Write its name, or the waveform itself.
    #[schemars(example = json!({ "follows": "drive" }))]
    Follows(WaveformRef),
}

impl FreedomForm {
    pub(crate) fn is_fixed(&self) -> bool {
        matches!(self, Self::Fixed)
    }
}

/// Initial position and velocity of a body at t = 0.
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
