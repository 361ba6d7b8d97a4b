//! Deserializer from JSON values to the Rust types of the keys. The deserializer differs from the one in `serde_json` in its error type and
//! in one rule. A list never stands for an object with its values in order.
//!
//! If a value does not fit, the method that serde called gives the expected type. Types that accept several sorts of values use
//! `deserialize_any`; references to other parts use `deserialize_identifier`. Their visitors describe the expected value.

use crate::misfit::{Misfit, Wanted};
use serde::de::value::BorrowedStrDeserializer;
use serde::de::{self, Deserializer, Expected, IntoDeserializer, Visitor};
use serde_json::{Number, Value};

/// Value to be deserialized.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reader<'de>(pub(crate) &'de Value);

fn unfit<T>(wanted: Wanted) -> Result<T, Misfit> {
    Err(Misfit::Unfit(wanted))
}

/// Returns whether the description of an expected value comes from a derived reader of fixed-length lists.
fn is_plain(called: &str) -> bool {
    ["an array of length", "a tuple of size"].iter().any(|plain| called.starts_with(plain))
}

/// Returns the description that a visitor gives of its expected value.
fn called<'de>(visitor: &impl Visitor<'de>) -> String {
    (visitor as &dyn Expected).to_string()
}

fn number<'de, V: Visitor<'de>>(number: &Number, visitor: V) -> Result<V::Value, Misfit> {
    match (number.as_u64(), number.as_i64(), number.as_f64()) {
        (Some(whole), ..) => visitor.visit_u64(whole),
        (None, Some(whole), _) => visitor.visit_i64(whole),
        (None, None, Some(value)) => visitor.visit_f64(value),
        (None, None, None) => unfit(Wanted::Number),
    }
}

fn list<'de, V: Visitor<'de>>(entries: &'de [Value], visitor: V) -> Result<V::Value, Misfit> {
    visitor.visit_seq(de::value::SeqDeserializer::new(entries.iter().map(Reader)))
}

fn object<'de, V: Visitor<'de>>(
    entries: &'de serde_json::Map<String, Value>,
    visitor: V,
) -> Result<V::Value, Misfit> {
    let mut left = Entries { left: entries.iter(), value: None };
    let read = visitor.visit_map(&mut left)?;
    // Only a reader of a single key leaves other entries unread.
    if left.left.len() == 0 { Ok(read) } else { Err(Misfit::NotOneKind) }
}

impl<'de> Deserializer<'de> for Reader<'de> {
    type Error = Misfit;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        match self.0 {
            Value::Null => visitor.visit_unit(),
            Value::Bool(value) => visitor.visit_bool(*value),
            Value::Number(value) => number(value, visitor),
            Value::String(text) => visitor.visit_borrowed_str(text),
            Value::Array(entries) => list(entries, visitor),
            Value::Object(entries) => object(entries, visitor),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        match self.0 {
            Value::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        match self.0 {
            Value::Number(value) => number(value, visitor),
            _ => unfit(Wanted::Number),
        }
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        match self.0 {
            Value::Number(value) => number(value, visitor),
            _ => unfit(Wanted::WholeNumber),
        }
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        match self.0 {
            Value::String(text) => visitor.visit_borrowed_str(text),
            _ => unfit(Wanted::Text),
        }
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        self.deserialize_str(visitor)
    }

    fn deserialize_identifier<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        match self.0 {
            Value::String(text) => visitor.visit_borrowed_str(text),
            Value::Object(entries) => object(entries, visitor),
            _ => unfit(Wanted::Name(called(&visitor))),
        }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        match self.0 {
            Value::Array(entries) => list(entries, visitor),
            _ => unfit(Wanted::List),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Misfit> {
        match self.0 {
            // Derived readers of fixed-length lists stop at the last entry; others describe themselves what they expect.
            Value::Array(entries) if entries.len() > length && is_plain(&called(&visitor)) => {
                Err(Misfit::Length { wanted: format!("{length} entries"), got: entries.len() })
            }
            Value::Array(entries) => list(entries, visitor),
            _ => unfit(Wanted::Shape(called(&visitor))),
        }
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        match self.0 {
            Value::Object(entries) => object(entries, visitor),
            _ => unfit(Wanted::Shape(called(&visitor))),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misfit> {
        match self.0 {
            Value::Object(entries) => object(entries, visitor),
            _ => unfit(Wanted::Object),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misfit> {
        match self.0 {
            Value::String(kind) => visitor.visit_enum(Choice { kind, inside: None }),
            Value::Object(entries) => {
                let mut entries = entries.iter();
                match (entries.next(), entries.next()) {
                    (Some((kind, inside)), None) => visitor.visit_enum(Choice { kind, inside: Some(inside) }),
                    _ => Err(Misfit::NotOneKind),
                }
            }
            _ => unfit(Wanted::Kind),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Misfit> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misfit> {
        visitor.visit_unit()
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u128 f32 char bytes byte_buf unit unit_struct tuple_struct
    }
}

impl<'de> IntoDeserializer<'de, Misfit> for Reader<'de> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

/// Entries of an object that are still to be read.
struct Entries<'de> {
    left: serde_json::map::Iter<'de>,
    /// Value of the key that was read last.
    value: Option<&'de Value>,
}

impl<'de> de::MapAccess<'de> for Entries<'de> {
    type Error = Misfit;

    fn next_key_seed<K: de::DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Misfit> {
        let Some((key, value)) = self.left.next() else { return Ok(None) };
        self.value = Some(value);
        seed.deserialize(BorrowedStrDeserializer::new(key)).map(Some)
    }

    fn next_value_seed<V: de::DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Misfit> {
        // serde requests a value only after its key.
        seed.deserialize(Reader(self.value.take().unwrap_or(&Value::Null)))
    }
}

/// Variant of an enum: its name and its contents.
struct Choice<'de> {
    kind: &'de str,
    inside: Option<&'de Value>,
}

impl<'de> de::EnumAccess<'de> for Choice<'de> {
    type Error = Misfit;
    type Variant = Self;

    fn variant_seed<V: de::DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Misfit> {
        let kind = seed.deserialize(BorrowedStrDeserializer::<Misfit>::new(self.kind))?;
        Ok((kind, self))
    }
}

impl<'de> de::VariantAccess<'de> for Choice<'de> {
    type Error = Misfit;

    fn unit_variant(self) -> Result<(), Misfit> {
        match self.inside {
            None | Some(Value::Null) => Ok(()),
            Some(_) => unfit(Wanted::Nothing),
        }
    }

    fn newtype_variant_seed<T: de::DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Misfit> {
        match self.inside {
            Some(value) => seed.deserialize(Reader(value)),
            None => unfit(Wanted::Inside),
        }
    }

    fn tuple_variant<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Misfit> {
        match self.inside {
            Some(value) => Reader(value).deserialize_tuple(length, visitor),
            None => unfit(Wanted::Inside),
        }
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        keys: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misfit> {
        match self.inside {
            Some(value) => Reader(value).deserialize_struct("", keys, visitor),
            None => unfit(Wanted::Inside),
        }
    }
}
