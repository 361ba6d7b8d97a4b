//! Values that may have several forms: a quantity or a waveform, a waveform or its name, and named parts in the order of the file.

use super::WaveformForm;
use crate::quantity::{Dimension, Quantity};
use crate::schema::names;
use crate::units::Kind;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::json;
use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt;
use std::marker::PhantomData;

/// Named parts in the order of the file, with an index by name for fast look-up.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Parts<T>(pub(crate) Vec<(String, T)>, HashMap<String, usize>);

impl<T> Parts<T> {
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| name.as_str())
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = (&str, &T)> {
        self.0.iter().map(|(name, part)| (name.as_str(), part))
    }

    /// Adds a part under a new name.
    pub(crate) fn add(&mut self, name: String, part: T) {
        self.1.insert(name.clone(), self.0.len());
        self.0.push((name, part));
    }

    pub(crate) fn find(&self, name: &str) -> Option<usize> {
        self.1.get(name).copied()
    }
}

impl<T> Default for Parts<T> {
    fn default() -> Self {
        Self(Vec::new(), HashMap::new())
    }
}

impl<T: Serialize> Serialize for Parts<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, part)| (name, part)))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Parts<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PartsVisitor<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for PartsVisitor<T> {
            type Value = Parts<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object of named parts")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Parts<T>, A::Error> {
                let (mut parts, mut places) = (Vec::new(), HashMap::new());
                while let Some((name, part)) = map.next_entry::<String, T>()? {
                    // Duplicate names were reported when the text was parsed.
                    places.entry(name.clone()).or_insert(parts.len());
                    parts.push((name, part));
                }
                Ok(Parts(parts, places))
            }
        }
        deserializer.deserialize_map(PartsVisitor(PhantomData))
    }
}

impl<T: JsonSchema> JsonSchema for Parts<T> {
    fn schema_name() -> Cow<'static, str> {
        format!("PartsOf{}", T::schema_name()).into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "object",
            "propertyNames": names(),
            "additionalProperties": generator.subschema_for::<T>()
        })
    }
}

/// A waveform: by name, or written out where it is used.
#[derive(Debug, Clone)]
pub(crate) enum WaveformRef {
    Name(String),
    Inline(Box<WaveformForm>),
}

impl Serialize for WaveformRef {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Name(name) => serializer.serialize_str(name),
            Self::Inline(waveform) => waveform.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for WaveformRef {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct RefVisitor;
        impl<'de> Visitor<'de> for RefVisitor {
            type Value = WaveformRef;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the name of a waveform or a waveform such as {\"sine\": {…}}")
            }

            fn visit_str<E: de::Error>(self, name: &str) -> Result<WaveformRef, E> {
                Ok(WaveformRef::Name(name.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<WaveformRef, A::Error> {
                WaveformForm::deserialize(MapAccessDeserializer::new(map))
                    .map(|waveform| WaveformRef::Inline(Box::new(waveform)))
            }
        }
        deserializer.deserialize_identifier(RefVisitor)
    }
}

impl JsonSchema for WaveformRef {
    fn schema_name() -> Cow<'static, str> {
        "WaveformRef".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A waveform: the name of one of `waveforms`, or one written out here.",
            "anyOf": [{ "type": "string" }, generator.subschema_for::<WaveformForm>()]
        })
    }
}

/// Reference to a waveform, written as `{"follows": waveform}`.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Follows {
    /// The waveform to follow: a name in `waveforms`, or a waveform written out here.
    #[schemars(example = &"drive", example = json!({ "sine": { "amplitude": "100 nm", "frequency": "100 Hz" } }))]
    follows: WaveformRef,
}

/// Quantity that may vary in time. In the file, a bare string is always a quantity, never the name of a waveform.
#[derive(Debug, Clone)]
pub(crate) enum Moving<D> {
    Constant(Quantity<D>),
    Follows(WaveformRef),
}

impl<D> Serialize for Moving<D> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Constant(quantity) => quantity.serialize(serializer),
            Self::Follows(waveform) => Follows { follows: waveform.clone() }.serialize(serializer),
        }
    }
}

impl<'de, D: Dimension> Deserialize<'de> for Moving<D> {
    fn deserialize<S: Deserializer<'de>>(deserializer: S) -> Result<Self, S::Error> {
        struct MovingVisitor<D>(PhantomData<D>);
        impl<'de, D: Dimension> Visitor<'de> for MovingVisitor<D> {
            type Value = Moving<D>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let kind: Kind = D::KIND;
                write!(f, "{} such as \"{}\" or {{\"follows\": waveform}}", kind.article(), kind.example())
            }

            fn visit_f64<E: de::Error>(self, si: f64) -> Result<Moving<D>, E> {
                Quantity::from_si(si).map(Moving::Constant).map_err(E::custom)
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Moving<D>, E> {
                self.visit_f64(value as f64)
            }

            fn visit_u64<E: de::Error>(self, value: u64) -> Result<Moving<D>, E> {
                self.visit_f64(value as f64)
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Moving<D>, E> {
                Quantity::parse(text).map(Moving::Constant).map_err(E::custom)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Moving<D>, A::Error> {
                Follows::deserialize(MapAccessDeserializer::new(map)).map(|f| Moving::Follows(f.follows))
            }
        }
        deserializer.deserialize_any(MovingVisitor(PhantomData))
    }
}

impl<D: Dimension> JsonSchema for Moving<D> {
    fn schema_name() -> Cow<'static, str> {
        format!("Moving{:?}", D::KIND).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": format!("{:?}, constant or following a waveform.", D::KIND),
            "anyOf": [generator.subschema_for::<Quantity<D>>(), generator.subschema_for::<Follows>()]
        })
    }
}
