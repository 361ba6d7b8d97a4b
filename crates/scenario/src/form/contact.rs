//! Contacts.

use super::{Count, Moving, Points, ProfileForm, Two};
use crate::quantity::{Dimension, Force, Length, Quantity, Time, Velocity, dimension};
use crate::schema::{above_zero, at_least_zero};
use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::json;
use std::fmt;

/// A frictional contact between two bodies. The tangential displacement is u = x(first) - x(second) at the contact point. Friction drags
/// the second body along with the first body.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactForm {
    /// Names of the first (lower) and the second body; the fixed `ground` counts as a body.
    #[schemars(extend("uniqueItems" = true), example = json!(["foot", "slider"]))]
    pub(crate) between: Two,
    /// Names of the two materials, in any order. Each name is an entry of `materials` or a built-in material: alumina, aluminium, brass,
    /// glass, hardened steel, PTFE, ruby, sapphire, silicon, steel, titanium, zirconia.
    #[schemars(example = json!(["ruby", "hardened steel"]))]
    pub(crate) materials: Two,
    /// Profile of the gap between the undeformed bodies.
    #[schemars(example = json!({ "paraboloid": { "radius": "0.5 mm" } }))]
    pub(crate) profile: ProfileForm,
    /// The Coulomb coefficient of the pair, 0 to 1000; typical 0.05 to 0.6. Or the static and the kinetic coefficient.
    #[schemars(example = 0.2, example = json!({ "static": 0.3, "kinetic": 0.2 }))]
    pub(crate) friction: FrictionForm,
    /// Normal loading of the contact: a force, an indentation or a contact radius, or the motion of the bodies.
    #[schemars(example = json!({ "force": "0.3 N" }))]
    pub(crate) normal: NormalForm,
    /// Number of identical contacts with the same motion, 1 to 1 000 000.
    #[serde(default = "one")]
    #[schemars(range(min = 1, max = 1_000_000), example = 3)]
    pub(crate) count: Count,
    /// Initial state of the contact at t = 0; u is measured from the initial positions of the bodies.
    #[serde(default)]
    #[schemars(example = json!({ "force": "10 mN" }))]
    pub(crate) start: ContactStartForm,
    /// Method that solves the tangential contact problem: by default the exact solution from the stored turning points of the loading
    /// history, or a row of discrete springs.
    #[serde(default)]
    #[schemars(example = &"curve", example = json!({ "springs": { "count": 1024 } }))]
    pub(crate) engine: EngineForm,
    /// Contact point on each body by body name, relative to the body's reference point; by default the reference point itself.
    #[serde(default, skip_serializing_if = "Points::is_empty")]
    #[schemars(example = json!({ "slider": { "x": "5 mm", "z": "-3 mm" } }))]
    pub(crate) at: Points,
    /// Gap between the bodies in the reference position, m, 0 by default; a negative value is an initial overlap. Only a contact whose
    /// `normal` is "coupled" has a gap.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"2 um")]
    pub(crate) gap: Option<Length>,
    /// Damping of the contact: a time constant of its tangential springs, s, 0 by default, or an object with the damping along both
    /// directions.
    #[serde(default = "no_damping", skip_serializing_if = "is_undamped")]
    #[schemars(example = &"1 us", example = json!({ "tangential": "1 us", "restitution": 0.8, "at": "0.1 m/s" }))]
    pub(crate) damping: DampingForm,
}

/// Damping of a contact.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[serde(untagged)]
#[schemars(inline)]
pub(crate) enum DampingForm {
    /// Damping time constant β of the tangential springs, s, at least 0. A spring of stretch s carries G*(s + βu̇), limited to its friction
    /// limit. A slipping spring has no damping.
    Tangential(#[schemars(transform = at_least_zero)] Time),
    /// Damping along both directions.
    Both(BothDampingForm),
}

impl<'de> Deserialize<'de> for DampingForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        quantity_or(deserializer, Self::Tangential, Self::Both)
    }
}

/// Damping of a contact along both directions. Along the normal the contact is that of the elastic one pressed by d + βḋ: force, radius,
/// friction limit and slip memory follow d + βḋ, without tension. The damping time β along the normal is given by `normal`, or by the
/// coefficient of restitution of an impact.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BothDampingForm {
    /// Damping time constant of the tangential springs, s, at least 0, 0 by default.
    #[serde(default = "no_time", skip_serializing_if = "is_zero")]
    #[schemars(example = &"1 us", transform = at_least_zero)]
    pub(crate) tangential: Time,
    /// Damping time constant along the normal, s, at least 0, by default 0 or that of `restitution`. Only for a contact whose `normal` is "coupled" or an indentation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"2 us", transform = at_least_zero)]
    pub(crate) normal: Option<Time>,
    /// Coefficient of restitution of an impact of the two bodies at the speed `at`, above 0, at most 1; none by default. The impact
    /// has the effective mass of the bodies along the normal; a body that follows a waveform is infinitely heavy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0), example = 0.8)]
    pub(crate) restitution: Option<f64>,
    /// Speed of the impact, m/s, above 0; required beside `restitution`, none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"0.1 m/s", transform = above_zero)]
    pub(crate) at: Option<Velocity>,
}

/// Friction coefficient of a contact, or its static and its kinetic coefficient.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[serde(untagged)]
#[schemars(inline)]
pub(crate) enum FrictionForm {
    /// The Coulomb coefficient of the pair, 0 to 1000; typical 0.05 to 0.6.
    One(#[schemars(range(min = 0.0, max = 1000.0))] f64),
    /// Static and kinetic coefficient.
    Two(StaticKineticForm),
}

impl<'de> Deserialize<'de> for FrictionForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        number_or(deserializer, Self::One, Self::Two)
    }
}

/// Static friction coefficient, or its growth while the contact rests.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[serde(untagged)]
#[schemars(inline)]
pub(crate) enum StaticForm {
    /// The static coefficient, 0 to 1000; typical 0.1 to 0.8.
    One(#[schemars(range(min = 0.0, max = 1000.0))] f64),
    /// Growth of the static coefficient at rest.
    Growth(GrowthForm),
}

impl<'de> Deserialize<'de> for StaticForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        number_or(deserializer, Self::One, Self::Growth)
    }
}

/// Deserializes a number or an object, so that errors are those of a number or of the object's keys.
fn number_or<'de, D: Deserializer<'de>, T: Deserialize<'de>, V>(
    deserializer: D,
    number: fn(f64) -> V,
    object: fn(T) -> V,
) -> Result<V, D::Error> {
    struct NumberOr<T, V>(fn(f64) -> V, fn(T) -> V);
    impl<'de, T: Deserialize<'de>, V> Visitor<'de> for NumberOr<T, V> {
        type Value = V;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            // The word by which serde asks for a number.
            f.write_str("f64")
        }

        fn visit_f64<E: de::Error>(self, number: f64) -> Result<V, E> {
            Ok(self.0(number))
        }

        fn visit_u64<E: de::Error>(self, number: u64) -> Result<V, E> {
            Ok(self.0(number as f64))
        }

        fn visit_i64<E: de::Error>(self, number: i64) -> Result<V, E> {
            Ok(self.0(number as f64))
        }

        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<V, A::Error> {
            T::deserialize(MapAccessDeserializer::new(map)).map(self.1)
        }
    }
    deserializer.deserialize_any(NumberOr(number, object))
}

/// Static and kinetic friction coefficient. Partial slip obeys the static coefficient. When the last spring of the contact reaches its
/// limit, the contact breaks loose: the limits of all springs fall to the kinetic coefficient at once. When it stops, it sticks again.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StaticKineticForm {
    /// The static coefficient, 0 to 1000; typical 0.1 to 0.8. Or its growth while the contact rests.
    #[serde(rename = "static")]
    #[schemars(example = 0.3, example = json!({ "from": 0.2, "to": 0.3, "time": "1 s" }))]
    pub(crate) at_rest: StaticForm,
    /// The kinetic coefficient, 0 to the static one; typical 0.6 to 1 times the static one.
    #[schemars(range(min = 0.0, max = 1000.0), example = 0.2)]
    pub(crate) kinetic: f64,
}

/// Growth of the static friction coefficient μ_s with the time at rest t: μ_s = from + (to - from)(1 - e^(-t/time)), or
/// μ_s = from + per_e_fold ln(1 + t/time). The coefficient grows in 1024 stairs of `to - from` or `per_e_fold`; each stair keeps the value
/// with which it began. The time at rest begins when the contact closes or sticks again.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GrowthForm {
    /// The static coefficient at the beginning of rest, at least the kinetic one.
    #[schemars(range(min = 0.0, max = 1000.0), example = 0.2)]
    pub(crate) from: f64,
    /// The static coefficient after a long rest, at least `from`; by default there is `per_e_fold` in its place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1000.0), example = 0.3)]
    pub(crate) to: Option<f64>,
    /// Growth of the static coefficient each time that the time at rest grows by the factor e; by default there is `to` in its place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1000.0), example = 0.01)]
    pub(crate) per_e_fold: Option<f64>,
    /// Time constant of the growth, s, above 0.
    #[schemars(example = &"1 s", transform = above_zero)]
    pub(crate) time: Time,
}

/// Deserializes a quantity or an object, so that errors are those of a quantity or of the object's keys.
fn quantity_or<'de, D: Deserializer<'de>, K: Dimension, T: Deserialize<'de>, V>(
    deserializer: D,
    quantity: fn(Quantity<K>) -> V,
    object: fn(T) -> V,
) -> Result<V, D::Error> {
    struct QuantityOr<K, T, V>(fn(Quantity<K>) -> V, fn(T) -> V);
    impl<'de, K: Dimension, T: Deserialize<'de>, V> Visitor<'de> for QuantityOr<K, T, V> {
        type Value = V;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "{} such as \"{}\" or an object", K::KIND.article(), K::KIND.example())
        }

        fn visit_f64<E: de::Error>(self, si: f64) -> Result<V, E> {
            Quantity::from_si(si).map(self.0).map_err(E::custom)
        }

        fn visit_i64<E: de::Error>(self, value: i64) -> Result<V, E> {
            self.visit_f64(value as f64)
        }

        fn visit_u64<E: de::Error>(self, value: u64) -> Result<V, E> {
            self.visit_f64(value as f64)
        }

        fn visit_str<E: de::Error>(self, text: &str) -> Result<V, E> {
            Quantity::parse(text).map(self.0).map_err(E::custom)
        }

        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<V, A::Error> {
            T::deserialize(MapAccessDeserializer::new(map)).map(self.1)
        }
    }
    deserializer.deserialize_any(QuantityOr(quantity, object))
}

fn no_damping() -> DampingForm {
    DampingForm::Tangential(no_time())
}

fn is_undamped(damping: &DampingForm) -> bool {
    matches!(damping, DampingForm::Tangential(time) if is_zero(time))
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

/// Normal loading of a contact.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum NormalForm {
    /// Normal force of one contact, N, at least 0; typical 1 mN to 100 N. At 0 the bodies just touch, and the contact loses its memory of
    /// earlier motion.
    #[schemars(transform = at_least_zero, example = json!({ "force": "0.3 N" }))]
    Force(Moving<dimension::Force>),
    /// Indentation depth d, m; typical 1 nm to 1 um. At a negative depth the contact is open.
    #[schemars(example = json!({ "indentation": "50 nm" }))]
    Indentation(Moving<dimension::Length>),
    /// Contact radius, m, at least 0; typical 1 um to 100 um.
    #[schemars(transform = at_least_zero, example = json!({ "radius": "5 um" }))]
    Radius(Moving<dimension::Length>),
    /// Indentation depth d = z(first) - z(second) - gap at the contact point, set by the motion of the bodies.
    Coupled,
}

/// Initial tangential state of a contact at t = 0. A preload is applied monotonically to a contact without loading history.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ContactStartForm {
    /// No preload: all springs of the contact are unstretched.
    #[default]
    Untouched,
    /// Tangential preload force of one contact, N; its magnitude is below the friction coefficient times the normal force.
    #[schemars(example = json!({ "force": "10 mN" }))]
    Force(Force),
    /// Tangential displacement u of the preload, m; typical below the onset of gross slip, some 10 nm.
    #[schemars(example = json!({ "displacement": "3 nm" }))]
    Displacement(Length),
    /// Time for which the contact has rested without preload, s, at least 0; for a static friction coefficient that grows at rest.
    #[schemars(example = json!({ "rest": "10 s" }), transform = at_least_zero)]
    Rest(Time),
}

/// Method that solves the tangential problem of a contact.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum EngineForm {
    /// Exact memory curve, which stores the turning points of the loading history.
    #[default]
    Curve,
    /// Row of discrete springs in place of the continuous contact.
    #[schemars(example = json!({ "springs": { "count": 1024 } }))]
    Springs(SpringsForm),
}

/// Row of discrete springs in place of the continuous contact.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpringsForm {
    /// Number of springs, 1 to 1 000 000; typical 256 to 4096.
    #[schemars(range(min = 1, max = 1_000_000), example = 1024)]
    pub(crate) count: Count,
    /// Length of the row, m, above 0; by default the contact width at the largest known load. The largest known load is an indentation or a
    /// normal force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(example = &"20 um", transform = above_zero)]
    pub(crate) span: Option<Length>,
}
