//! Profiles of the gap.

use super::{
    GapTableForm, Lengths, NormalLawForm, PowersForm, RoughForm, RoundedFlatForm, TippedParaboloidForm,
    TruncatedConeForm, TruncatedParaboloidForm,
};
use crate::quantity::{HELP, Length};
use crate::schema::{above_zero, at_least_zero, radius_or_diameter};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, de};
use serde_json::json;

/// Profile f(r) of the gap between the undeformed bodies.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ProfileForm {
    /// Flat cylindrical punch.
    #[schemars(example = json!({ "flat": { "radius": "50 um" } }))]
    Flat(#[schemars(with = "FlatKeys")] FlatForm),
    /// Cone, f = slope · r.
    #[schemars(example = json!({ "cone": { "slope": 0.01 } }))]
    Cone(ConeForm),
    /// Paraboloid, f = r²/(2R), the profile of Hertzian contact.
    #[schemars(example = json!({ "paraboloid": { "radius": "0.5 mm" } }))]
    Paraboloid(#[schemars(with = "BallKeys")] BallForm),
    /// Sphere, f = R - √(R²-r²), without the parabolic approximation.
    #[schemars(example = json!({ "sphere": { "radius": "0.5 mm" } }))]
    Sphere(#[schemars(with = "BallKeys")] BallForm),
    /// Power law, f = A rⁿ.
    #[schemars(example = json!({ "power": { "coefficient": 1e6, "exponent": 4 } }))]
    Power(PowerForm),
    /// One-dimensional foundation given by the heights of its springs, in any order.
    #[schemars(example = json!({ "foundation": { "heights": [0, "10 nm", "20 nm"], "length": "1 um" } }))]
    Foundation(FoundationForm),
    /// Worn cone: flat up to a radius, beyond it f = slope · (r - flat).
    #[schemars(example = json!({ "truncated_cone": { "flat": "20 um", "slope": 0.01 } }))]
    TruncatedCone(TruncatedConeForm),
    /// Worn ball: flat up to a radius, beyond it f = (r² - flat²)/(2R).
    #[schemars(example = json!({ "truncated_paraboloid": { "flat": "20 um", "radius": "5 mm" } }))]
    TruncatedParaboloid(TruncatedParaboloidForm),
    /// Flat punch with a rounded edge: flat up to a radius, beyond it f = (r - flat)²/(2R).
    #[schemars(example = json!({ "rounded_flat": { "flat": "50 um", "radius": "1 mm" } }))]
    RoundedFlat(RoundedFlatForm),
    /// Paraboloid with a conical tip: f = tip · r/R up to the tip's radius, beyond it f = (r² + tip²)/(2R).
    #[schemars(example = json!({ "tipped_paraboloid": { "radius": "5 mm", "tip": "5 um" } }))]
    TippedParaboloid(TippedParaboloidForm),
    /// Sum of powers, f = Σ A rⁿ.
    #[schemars(example = json!({ "powers": { "terms": [{ "coefficient": 100, "exponent": 2 }, { "coefficient": 1e9, "exponent": 4 }] } }))]
    Powers(PowersForm),
    /// Profile given by points (r, f). The equivalent one-dimensional profile g(x) is computed from them.
    #[schemars(example = json!({ "table": { "points": [[0, 0], ["10 um", "5 nm"], ["20 um", "20 nm"]] } }))]
    Table(GapTableForm),
    /// Profile given by points of its normal law, force over indentation.
    #[schemars(example = json!({ "normal_law": { "points": [[0, 0], ["50 nm", "20 mN"], ["100 nm", "60 mN"]] } }))]
    NormalLaw(NormalLawForm),
    /// Rough one-dimensional profile: heights at equal distances, measured or computed. Only the distribution of the heights matters; the
    /// line is not a section of the surface.
    #[schemars(example = json!({ "rough": { "heights": [0, "12 nm", "7 nm"], "spacing": "1 um" } }))]
    Rough(RoughForm),
    /// Rough surface of spherical tips with exponentially distributed heights. Under a prescribed normal force the tail of the distribution
    /// has no end; otherwise the heights end at the expected highest one, at which the indentation begins.
    #[schemars(example = json!({ "exponential_asperities": { "mean_height": "1 um", "radius": "50 um", "count": 10000 } }))]
    ExponentialAsperities(ExponentialAsperitiesForm),
    /// Rough surface of spherical tips with normally distributed heights. Under a prescribed normal force the tail of the distribution
    /// has no end; otherwise the heights end at the expected highest one, at which the indentation begins.
    #[schemars(example = json!({ "gaussian_asperities": { "rms_height": "1 um", "radius": "50 um", "count": 10000 } }))]
    GaussianAsperities(GaussianAsperitiesForm),
    /// Paraboloid between bodies whose Young's modulus is E (z/depth)^exponent at the depth z; E is that of the materials. The ratio of
    /// tangential to normal stiffness is that of homogeneous bodies.
    #[schemars(example = json!({ "graded_paraboloid": { "radius": "3 mm", "exponent": 0.3, "depth": "10 um" } }))]
    GradedParaboloid(GradedParaboloidForm),
}

impl ProfileForm {
    /// Returns the key of the profile kind, as in the file.
    pub(crate) fn word(&self) -> &'static str {
        match self {
            Self::Flat(_) => "flat",
            Self::Cone(_) => "cone",
            Self::Paraboloid(_) => "paraboloid",
            Self::Sphere(_) => "sphere",
            Self::Power(_) => "power",
            Self::Foundation(_) => "foundation",
            Self::TruncatedCone(_) => "truncated_cone",
            Self::TruncatedParaboloid(_) => "truncated_paraboloid",
            Self::RoundedFlat(_) => "rounded_flat",
            Self::TippedParaboloid(_) => "tipped_paraboloid",
            Self::Powers(_) => "powers",
            Self::Table(_) => "table",
            Self::NormalLaw(_) => "normal_law",
            Self::Rough(_) => "rough",
            Self::ExponentialAsperities(_) => "exponential_asperities",
            Self::GaussianAsperities(_) => "gaussian_asperities",
            Self::GradedParaboloid(_) => "graded_paraboloid",
        }
    }
}

/// Spherical tips with exponentially distributed heights.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ExponentialAsperitiesForm {
    /// Mean height l of the tips above the reference plane, m, above 0; typical 10 nm to 5 um.
    #[schemars(example = &"1 um", transform = above_zero)]
    pub(crate) mean_height: Length,
    /// Radius of the tips, m, above 0; typical 1 um to 1 mm.
    #[schemars(example = &"50 um", transform = above_zero)]
    pub(crate) radius: Length,
    /// Number of tips, 10 to 1e15.
    #[schemars(range(min = 10.0, max = 1e15), example = 10000)]
    pub(crate) count: f64,
}

/// Spherical tips with normally distributed heights.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GaussianAsperitiesForm {
    /// Standard deviation of the heights about their mean plane, m, above 0; typical 10 nm to 5 um.
    #[schemars(example = &"1 um", transform = above_zero)]
    pub(crate) rms_height: Length,
    /// Radius of the tips, m, above 0; typical 1 um to 1 mm.
    #[schemars(example = &"50 um", transform = above_zero)]
    pub(crate) radius: Length,
    /// Number of tips, 10 to 1e15.
    #[schemars(range(min = 10.0, max = 1e15), example = 10000)]
    pub(crate) count: f64,
}

/// Paraboloid between graded bodies.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GradedParaboloidForm {
    /// Radius of curvature R, m, above 0; typical 1 mm to 10 mm.
    #[schemars(example = &"3 mm", transform = above_zero)]
    pub(crate) radius: Length,
    /// Exponent k of the modulus, at least 0 and below 1; 0 for homogeneous bodies.
    #[schemars(range(min = 0.0, max = 1.0), example = 0.3)]
    pub(crate) exponent: f64,
    /// Depth at which the modulus is that of the material, m, above 0; typical 1 um to 1 mm.
    #[schemars(example = &"10 um", transform = above_zero)]
    pub(crate) depth: Length,
}

/// A flat punch, given by its radius or its diameter.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct FlatForm {
    pub(crate) radius: Length,
}

/// A flat punch, given by its radius or its diameter.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FlatForm", transform = radius_or_diameter)]
struct FlatKeys {
    /// Radius of the flat face, m, above 0; typical 10 um to 5 mm. Give this or `diameter`.
    #[schemars(example = &"50 um", transform = above_zero)]
    radius: Option<Length>,
    /// Diameter of the flat face, m, above 0; give either this or `radius`; results always use `radius`.
    #[schemars(example = &"100 um", transform = above_zero)]
    diameter: Option<Length>,
}

/// A ball, given by its radius or its diameter.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct BallForm {
    pub(crate) radius: Length,
}

/// A ball, given by its radius or its diameter.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "BallForm", transform = radius_or_diameter)]
struct BallKeys {
    /// Radius of curvature R, m, above 0; typical 0.1 mm to 50 mm. Give this or `diameter`.
    #[schemars(example = &"0.5 mm", transform = above_zero)]
    radius: Option<Length>,
    /// Diameter 2R, m, above 0; give either this or `radius`; results always use `radius`.
    #[schemars(example = &"1 mm", transform = above_zero)]
    diameter: Option<Length>,
}

/// Returns the radius, given directly or as a diameter.
fn radius<E: de::Error>(radius: Option<Length>, diameter: Option<Length>) -> Result<Length, E> {
    match (radius, diameter) {
        (Some(radius), None) => Ok(radius),
        (None, Some(diameter)) => Ok(Length::new(diameter.si / 2.0)),
        (None, None) => Err(E::missing_field("radius")),
        (Some(_), Some(_)) => {
            Err(E::custom(format!("the radius and the diameter are given{HELP}keep one of them")))
        }
    }
}

impl<'de> Deserialize<'de> for FlatForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let keys = FlatKeys::deserialize(deserializer)?;
        radius(keys.radius, keys.diameter).map(|radius| Self { radius })
    }
}

impl<'de> Deserialize<'de> for BallForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let keys = BallKeys::deserialize(deserializer)?;
        radius(keys.radius, keys.diameter).map(|radius| Self { radius })
    }
}

/// A cone.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ConeForm {
    /// Slope of the flank against the plane, tan θ, above 0; typical 0.001 to 0.1.
    #[schemars(extend("exclusiveMinimum" = 0), example = 0.01)]
    pub(crate) slope: f64,
}

/// A power law f = A rⁿ.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PowerForm {
    /// Coefficient A of f = A rⁿ in SI, m^(1-n), above 0; the paraboloid of radius R has A = 1/(2R) and n = 2.
    #[schemars(extend("exclusiveMinimum" = 0), example = 1e6)]
    pub(crate) coefficient: f64,
    /// Exponent n of f = A rⁿ, above 0; 1 is a cone, 2 a paraboloid.
    #[schemars(extend("exclusiveMinimum" = 0), example = 4)]
    pub(crate) exponent: f64,
}

/// A one-dimensional foundation of springs.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FoundationForm {
    /// Heights of the springs above the lowest point, m, at least 0, in any order; typical 1 nm to 10 um.
    #[schemars(length(min = 1), example = json!([0, "10 nm", "20 nm"]), transform = at_least_zero)]
    pub(crate) heights: Vec<Length>,
    /// Length of foundation at each height, m, above 0: one value for all heights, or one for each; typical 10 nm to 100 um.
    #[schemars(example = &"1 um", example = json!(["1 um", "2 um", "1 um"]), transform = above_zero)]
    pub(crate) length: Lengths,
}
