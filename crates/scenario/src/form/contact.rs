//! Contacts.

use super::{Count, Moving, Points, ProfileForm, Two};
use crate::quantity::{Force, Length, Time, dimension};
use crate::schema::{above_zero, at_least_zero};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;

/// A frictional contact: u = x(first) - x(second) at the contact point; friction pulls the second body along with the
/// first.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactForm {
    /// First (lower) and second body; `ground` is one too.
    #[schemars(extend("uniqueItems" = true), example = json!(["foot", "slider"]))]
    pub(crate) between: Two,
    /// Names of the two materials; their order does not matter. Those of `materials`, or alumina, aluminium, brass, glass,
    /// hardened steel, PTFE, ruby, sapphire, silicon, steel, titanium, zirconia.
    #[schemars(example = json!(["ruby", "hardened steel"]))]
    pub(crate) materials: Two,
    /// Profile of the gap.
    #[schemars(example = json!({ "paraboloid": { "radius": "0.5 mm" } }))]
    pub(crate) profile: ProfileForm,
    /// The Coulomb coefficient of the pair, 0 to 1000; typical 0.05 to 0.6.
    #[schemars(range(min = 0.0, max = 1000.0), example = 0.2)]
    pub(crate) friction: f64,
    /// What presses the contact.
    #[schemars(example = json!({ "force": "0.3 N" }))]
    pub(crate) normal: NormalForm,
    /// Number of identical contacts that share this motion, 1 to 1 000 000.
    #[serde(default = "one")]
    #[schemars(range(min = 1, max = 1_000_000), example = 3)]
    pub(crate) count: Count,
    /// Initial state of the contact at t = 0; u is measured from the initial positions of the bodies.
    #[serde(default)]
    #[schemars(example = json!({ "force": "10 mN" }))]
    pub(crate) start: ContactStartForm,
    /// How the tangential problem is solved.
    #[serde(default)]
    #[schemars(example = &"curve", example = json!({ "springs": { "count": 1024 } }))]
    pub(crate) engine: EngineForm,
    /// Contact point on each body by its name, relative to the body's reference point, which it is by default.
    #[serde(default, skip_serializing_if = "Points::is_empty")]
    #[schemars(example = json!({ "slider": { "x": "5 mm", "z": "-3 mm" } }))]
    pub(crate) at: Points,
    /// Gap between the bodies in the reference position, m, 0 by default; a negative value is an initial overlap. Only of a contact whose normal
    /// is "coupled".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"2 um")]
    pub(crate) gap: Option<Length>,
    /// Time constant β of the stuck springs, s, at least 0, 0 by default: they carry βG*ṡ beside G*s, slipping springs carry none of it.
    #[serde(default = "no_time", skip_serializing_if = "is_zero")]
    #[schemars(example = &"1 us", transform = at_least_zero)]
    pub(crate) damping: Time,
}

fn one() -> Count {
    Count(1)
}

fn no_time() -> Time {
    Time::new(0.0)
}

fn is_zero(time: &Time) -> bool {
    time.si == 0.0
}

/// What presses a contact.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum NormalForm {
    /// Normal force of one contact, N, at least 0; at 0 the contact touches and its memory is gone; typical 1 mN to
    /// 100 N.
    #[schemars(transform = at_least_zero, example = json!({ "force": "0.3 N" }))]
    Force(Moving<dimension::Force>),
    /// Indentation, m; negative: open; typical 1 nm to 1 um.
    #[schemars(example = json!({ "indentation": "50 nm" }))]
    Indentation(Moving<dimension::Length>),
    /// Contact radius, m, at least 0; typical 1 um to 100 um.
    #[schemars(transform = at_least_zero, example = json!({ "radius": "5 um" }))]
    Radius(Moving<dimension::Length>),
    /// From the bodies' motion: d = z(first) - z(second) - gap at the contact point.
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
    #[schemars(example = json!({ "force": "10 mN" }))]
    Force(Force),
    /// Preloaded by this displacement u, m; typical below the displacement of gross slip, some 10 nm.
    #[schemars(example = json!({ "displacement": "3 nm" }))]
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
    #[schemars(example = json!({ "springs": { "count": 1024 } }))]
    Springs(SpringsForm),
}

/// A row of springs.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpringsForm {
    /// Number of springs, 1 to 1 000 000; typical 256 to 4096.
    #[schemars(range(min = 1, max = 1_000_000), example = 1024)]
    pub(crate) count: Count,
    /// Length of the row, m, above 0; by default the contact's width at the largest indentation known, or as much as it takes to bear
    /// the largest force known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"20 um", transform = above_zero)]
    pub(crate) span: Option<Length>,
}
