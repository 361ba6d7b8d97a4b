//! Contacts.

use super::{Count, Lengths, Moving, Reserved, Two};
use crate::quantity::{self, Force, Length};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A frictional contact: u = x(first) - x(second); friction pulls the second body along with the
/// first.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactForm {
    /// First (lower) and second body; `ground` is one too.
    pub(crate) between: Two,
    /// Names of the two materials; their order does not matter.
    pub(crate) materials: Two,
    /// Profile of the gap.
    pub(crate) profile: ProfileForm,
    /// Coulomb's coefficient of friction, 0 to 1000; typical 0.05 to 0.6.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub(crate) friction: f64,
    /// What presses the contact.
    pub(crate) normal: NormalForm,
    /// Number of identical contacts that share this motion, 1 to 1 000 000.
    #[serde(default = "one")]
    #[schemars(range(min = 1, max = 1_000_000))]
    pub(crate) count: Count,
    /// The contact's own state at t = 0; u counts from where the bodies start.
    #[serde(default)]
    pub(crate) start: ContactStartForm,
    /// How the tangential problem is solved.
    #[serde(default)]
    pub(crate) engine: EngineForm,
    /// Contact point relative to the bodies' reference points. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) at: Option<Reserved>,
    /// Gap before the start, m. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) gap: Option<Reserved>,
    /// Time constant of the stuck springs, s. Not yet in this version.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) damping: Option<Reserved>,
}

fn one() -> Count {
    Count(1)
}

/// Profile of the gap between the undeformed bodies.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ProfileForm {
    /// Flat cylindrical punch.
    Flat(RadiusForm),
    /// Cone, f = slope · r.
    Cone(ConeForm),
    /// Paraboloid, f = r²/(2R): Hertz.
    Paraboloid(RadiusForm),
    /// Sphere, f = R - √(R²-r²), exact.
    Sphere(RadiusForm),
    /// Power law, f = A rⁿ.
    Power(PowerForm),
    /// One-dimensional foundation given by its heights; need not be monotone.
    Foundation(FoundationForm),
    /// Table of the profile. Not yet in this version.
    Table(Reserved),
    /// Rough line. Not yet in this version.
    Rough(Reserved),
}

/// A profile with one radius.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RadiusForm {
    /// Radius, m, above 0.
    pub(crate) radius: Length,
}

/// A cone.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ConeForm {
    /// Slope of the flank against the plane, tan θ, above 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub(crate) slope: f64,
}

/// A power law.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PowerForm {
    /// Coefficient A in SI, m^(1-n), above 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub(crate) coefficient: f64,
    /// Exponent n, above 0.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub(crate) exponent: f64,
}

/// A one-dimensional foundation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FoundationForm {
    /// Heights of the springs above the lowest point, m, at least 0, in any order.
    pub(crate) heights: Vec<Length>,
    /// Length of foundation at each height, m, above 0: one for all, or one each.
    pub(crate) length: Lengths,
}

/// What presses a contact.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum NormalForm {
    /// Normal force of one contact, N, at least 0; at 0 the contact touches and its memory is gone.
    Force(Moving<quantity::dimension::Force>),
    /// Indentation, m; negative: open.
    Indentation(Moving<quantity::dimension::Length>),
    /// Contact radius, m, at least 0.
    Radius(Moving<quantity::dimension::Length>),
    /// From the bodies' z. Not yet in this version.
    Coupled,
}

/// State of a contact at t = 0. The preloaded kinds are reached monotonically from the untouched contact.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ContactStartForm {
    /// Springs unstretched.
    #[default]
    Untouched,
    /// Preloaded to this tangential force of one contact, N; below friction times normal force in magnitude.
    Force(Force),
    /// Preloaded by this displacement u, m.
    Displacement(Length),
}

/// How the tangential problem of a contact is solved.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum EngineForm {
    /// The exact memory curve.
    #[default]
    Curve,
    /// A row of springs.
    Springs(SpringsForm),
}

/// A row of springs.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpringsForm {
    /// Number of springs, 1 to 1 000 000.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub(crate) count: Count,
    /// Length of the row, m, above 0; by default the contact's width at the largest indentation known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) span: Option<Length>,
}
