//! Key with one length for all entries of another list, or with one length for each entry.

use crate::quantity::Length;
use crate::schema::above_zero;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::SeqAccessDeserializer;
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// One length for all entries of another list, or one length for each entry.
#[derive(Debug, Clone)]
pub(crate) enum Lengths {
    /// One length for all entries.
    All(Length),
    /// One length for each entry.
    Each(Vec<Length>),
}

impl Serialize for Lengths {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::All(length) => length.serialize(serializer),
            Self::Each(lengths) => lengths.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Lengths {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct LengthsVisitor;
        impl<'de> Visitor<'de> for LengthsVisitor {
            type Value = Lengths;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a length such as \"5 um\" or a list of lengths")
            }

            fn visit_f64<E: de::Error>(self, si: f64) -> Result<Lengths, E> {
                Length::from_si(si).map(Lengths::All).map_err(E::custom)
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Lengths, E> {
                self.visit_f64(value as f64)
            }

            fn visit_u64<E: de::Error>(self, value: u64) -> Result<Lengths, E> {
                self.visit_f64(value as f64)
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Lengths, E> {
                Length::parse(text).map(Lengths::All).map_err(E::custom)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Lengths, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(seq)).map(Lengths::Each)
            }
        }
        deserializer.deserialize_any(LengthsVisitor)
    }
}

impl JsonSchema for Lengths {
    fn schema_name() -> Cow<'static, str> {
        "Lengths".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let length = generator.subschema_for::<Length>();
        let mut list = json_schema!({ "type": "array", "items": length });
        above_zero(&mut list);
        json_schema!({ "anyOf": [length, list] })
    }
}
