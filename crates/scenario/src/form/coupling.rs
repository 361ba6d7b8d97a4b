//! What else acts on bodies: springs, actuators, loads, gravity.

use super::{Moving, Reserved, Two};
use crate::quantity::{Acceleration, Angle, Damping, Force, Stiffness, dimension};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Standard gravity, m/s² (CGPM 1901).
const STANDARD_GRAVITY: f64 = 9.80665;

/// Direction of a spring or actuator.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum DirectionForm {
    /// Along the slide.
    #[default]
    X,
    /// Normal to the slide. Not yet in this version.
    Z,
}

/// Linear spring with a damper: force on the second body preload - k e - c ė, e = x(second) - x(first).
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpringForm {
    /// First and second body; `ground` is one too.
    pub(crate) between: Two,
    /// Direction; only "x" in this version.
    #[serde(default)]
    pub(crate) direction: DirectionForm,
    /// Stiffness k, N/m, at least 0.
    #[serde(default = "no_stiffness")]
    pub(crate) stiffness: Stiffness,
    /// Damping c, N s/m, at least 0.
    #[serde(default = "no_damping")]
    pub(crate) damping: Damping,
    /// Force on the second body at e = 0, N.
    #[serde(default = "no_force")]
    pub(crate) preload: Force,
}

/// Piezo stack: force on the second body k(s-e) + c(ṡ-ė), e = x(second) - x(first), s the free stroke.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ActuatorForm {
    /// First and second body; `ground` is one too.
    pub(crate) between: Two,
    /// Direction; only "x" in this version.
    #[serde(default)]
    pub(crate) direction: DirectionForm,
    /// Stiffness k, N/m, above 0.
    pub(crate) stiffness: Stiffness,
    /// Damping c, N s/m, at least 0.
    #[serde(default = "no_damping")]
    pub(crate) damping: Damping,
    /// Free stroke s, m; needed in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) stroke: Option<Moving<dimension::Length>>,
    /// Voltage. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) voltage: Option<Reserved>,
    /// Free stroke per voltage. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) stroke_per_volt: Option<Reserved>,
    /// Capacitance. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) capacitance: Option<Reserved>,
    /// Driver: current limit, output resistance, voltage window. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) driver: Option<Reserved>,
    /// Hysteresis. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) hysteresis: Option<Reserved>,
    /// Creep. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) creep: Option<Reserved>,
}

/// Force on a body.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LoadForm {
    /// Name of the body.
    pub(crate) on: String,
    /// Force along x, N; needed in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) x: Option<Moving<dimension::Force>>,
    /// Force along z, N. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) z: Option<Reserved>,
    /// Moment, N m. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) pitch: Option<Reserved>,
    /// Point of attack. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) at: Option<Reserved>,
}

/// Gravity: the force along x is -m g sin(incline).
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GravityForm {
    /// Acceleration g, m/s², at least 0; standard gravity by default.
    #[serde(default = "standard_gravity")]
    pub(crate) acceleration: Acceleration,
    /// Angle by which the slide climbs from the horizontal, -180 to 180 degrees.
    #[serde(default = "horizontal")]
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
