//! Keys of springs, loads and gravity.

use super::{Moving, PointForm, Points, Two};
use crate::quantity::{Acceleration, Angle, Damping, Force, Length, Stiffness, dimension};
use crate::schema::{above_zero, at_least_zero, items_or_null, something_on_it, something_to_do};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::f64::consts::PI;

/// Standard gravity, m/s² (CGPM 1901).
const STANDARD_GRAVITY: f64 = 9.80665;

/// Direction of a spring or actuator.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum DirectionForm {
    /// Along the slide.
    #[default]
    X,
    /// Normal to the slide.
    Z,
}

/// Linear spring with a damper. The force on the second body is preload - k e - c ė. The elongation e is x(second) - x(first) at the ends
/// of the spring, or z(second) - z(first).
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = something_to_do)]
pub(crate) struct SpringForm {
    /// Names of the first and the second body; the fixed `ground` counts as a body.
    #[schemars(extend("uniqueItems" = true), example = json!(["ground", "slider"]))]
    pub(crate) between: Two,
    /// Direction in which the spring acts: "x", along the slide, by default, or "z", normal to the slide.
    #[serde(default)]
    #[schemars(example = &"z")]
    pub(crate) direction: DirectionForm,
    /// End point of the spring on each body by body name, relative to the body's reference point; by default the reference point itself.
    #[serde(default, skip_serializing_if = "Points::is_empty")]
    #[schemars(example = json!({ "slider": { "x": "5 mm" } }))]
    pub(crate) at: Points,
    /// Stiffness k, N/m, at least 0; typical 1 kN/m to 100 N/um.
    #[serde(default = "no_stiffness")]
    #[schemars(example = &"2 N/um", transform = at_least_zero)]
    pub(crate) stiffness: Stiffness,
    /// Damping c, N s/m, at least 0; typical 0.1 N s/m to 100 N s/m.
    #[serde(default = "no_damping")]
    #[schemars(example = &"0.5 N s/m", transform = at_least_zero)]
    pub(crate) damping: Damping,
    /// Preload, the force on the second body at e = 0, N; typical 1 mN to 100 N.
    #[serde(default = "no_force")]
    #[schemars(example = &"-1 mN")]
    pub(crate) preload: Force,
}

/// End stops of a body: springs that act beyond a position only and never pull. At the penetration p the force is kp + cṗ, at least 0.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StopForm {
    /// Name of the body.
    #[schemars(example = &"slider")]
    pub(crate) on: String,
    /// Lowest and highest free position of the body along x, m; `null` without a stop there. Give `x` or `z`; the other one has no stops by
    /// default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["0 mm", "1 mm"]), example = json!([null, "1 mm"]), transform = items_or_null)]
    pub(crate) x: Option<[Option<Length>; 2]>,
    /// Lowest and highest free position of the body along z, m; `null` without a stop there. Give `x` or `z`; the other one has no stops by
    /// default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!(["0 mm", null]), transform = items_or_null)]
    pub(crate) z: Option<[Option<Length>; 2]>,
    /// Stiffness k of each stop, N/m, above 0; typical 1 N/um to 1 kN/um.
    #[schemars(example = &"100 N/um", transform = above_zero)]
    pub(crate) stiffness: Stiffness,
    /// Damping c of each stop, N s/m, at least 0, 0 by default.
    #[serde(default = "no_damping")]
    #[schemars(example = &"50 N s/m", transform = at_least_zero)]
    pub(crate) damping: Damping,
}

/// Force and moment on a body; give at least one of `x`, `z` and `pitch`.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = something_on_it)]
pub(crate) struct LoadForm {
    /// Name of the body on which the load acts.
    #[schemars(example = &"slider")]
    pub(crate) on: String,
    /// Force along x, N, 0 by default; typical 1 mN to 10 N.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"-0.02 N", example = json!({ "follows": "push" }))]
    pub(crate) x: Option<Moving<dimension::Force>>,
    /// Force along z, N, 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"-1 N")]
    pub(crate) z: Option<Moving<dimension::Force>>,
    /// Moment about the pitch axis, N m, 0 by default; positive from x towards z.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"0.5 mN m")]
    pub(crate) pitch: Option<Moving<dimension::Moment>>,
    /// Point at which the forces act, relative to the body's reference point; by default the reference point itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = json!({ "x": "4 mm", "z": "2 mm" }))]
    pub(crate) at: Option<PointForm>,
}

/// Gravity: a force of -m g sin(incline) along x and -m g cos(incline) along z acts on a body of mass m. Along a coordinate that is not
/// free, a guide carries the weight.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GravityForm {
    /// Acceleration g, m/s², at least 0; standard gravity by default.
    #[serde(default = "standard_gravity")]
    #[schemars(example = &"9.81 m/s²", transform = at_least_zero)]
    pub(crate) acceleration: Acceleration,
    /// Inclination by which the slide rises along x from the horizontal, a number in rad, -180 deg to 180 deg; typical 0 deg or 90 deg.
    #[serde(default = "horizontal")]
    #[schemars(extend("minimum" = -PI, "maximum" = PI), example = &"90 deg")]
    pub(crate) incline: Angle,
}

fn no_stiffness() -> Stiffness {
    Stiffness::new(0.0)
}

fn no_damping() -> Damping {
    Damping::new(0.0)
}

fn no_force() -> Force {
    Force::new(0.0)
}

fn standard_gravity() -> Acceleration {
    Acceleration::new(STANDARD_GRAVITY)
}

fn horizontal() -> Angle {
    Angle::new(0.0)
}
