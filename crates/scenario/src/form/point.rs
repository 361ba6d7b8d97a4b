//! Points of bodies.

use super::Parts;
use crate::quantity::Length;
use schemars::JsonSchema;
use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt;

/// A point of a body in the reference position, relative to the body's reference point, its centre of mass.
#[derive(Debug, Clone, Copy, Serialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub(crate) struct PointForm {
    /// Coordinate along the slide, m, 0 by default.
    #[schemars(default = "no_length", example = "5 mm")]
    pub(crate) x: Length,
    /// Coordinate normal to the slide, upwards, m, 0 by default.
    #[schemars(default = "no_length", example = "-3 mm")]
    pub(crate) z: Length,
}

/// Points by the names of their bodies; the reference point of each body by default.
pub(crate) type Points = Parts<PointForm>;

fn no_length() -> Length {
    Length::new(0.0)
}

// Deserialized by hand, so that a list [x, z] gives an error that shows how to write a point.
impl<'de> Deserialize<'de> for PointForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PointVisitor;
        impl<'de> Visitor<'de> for PointVisitor {
            type Value = PointForm;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a point such as {\"x\": \"5 mm\", \"z\": \"-3 mm\"}")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<PointForm, A::Error> {
                let mut point = PointForm { x: no_length(), z: no_length() };
                while let Some(key) = map.next_key::<String>()? {
                    match key.as_str() {
                        "x" => point.x = map.next_value()?,
                        "z" => point.z = map.next_value()?,
                        other => return Err(de::Error::unknown_field(other, &["x", "z"])),
                    }
                }
                Ok(point)
            }
        }
        deserializer.deserialize_any(PointVisitor)
    }
}
